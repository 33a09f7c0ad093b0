//! The promises of the scalars: exhausted on small fields, by quickcheck on the others, and broken on purpose.

mod broken;
mod common_divisor;
mod doubles;
mod every_scalar;
mod fields;
mod fractions;
mod interval;
mod logarithm;
mod lowest_terms;
mod modular;
mod normal;
mod quotient;
mod rational;

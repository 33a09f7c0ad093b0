//! The promises of the scalars: exhausted on small fields, by quickcheck on the others, and broken on purpose.

mod broken;
mod fields;
mod fractions;
mod interval;
mod modular;
mod normal;
mod rational;

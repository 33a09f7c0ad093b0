//! Floor 1 · Arithmetic modulo many word-sized primes, and the integers that it determines.
//!
//! Sums and products of large integers cost more the larger the integers are; their images modulo a prime cost a
//! machine word each. A computation that only adds, multiplies and divides is run in a few hundred [`PrimeField`]s
//! below 2⁶², independently of each other, and an integer of known length follows from its remainders (the Chinese
//! remainder theorem, [`Basis`]). Nothing here is a guess: a caller who knows that `|x| < 2^b` asks for the primes
//! that determine x.
//!
//! Source: J. von zur Gathen, J. Gerhard, Modern Computer Algebra, chapters 5 and 10; P. L. Montgomery, Modular
//! multiplication without trial division, 1985.

mod basis;
mod digits;
mod field;
mod primes;

pub use basis::{Basis, Determined};
pub use digits::Digits;
pub use field::PrimeField;
pub use primes::{PRIME_BITS, Primes};

//! Primes below 2⁶², from the largest downwards.

use std::sync::{Mutex, PoisonError};

use super::PrimeField;

/// Each of the first 2²⁰ primes below 2⁶² exceeds `2⁶² − 2²⁶`, so k of them multiply to more than `2^(62k−1)`; more of them
/// would determine integers of eight million bytes, where other ways are faster.
pub const PRIME_BITS: u64 = 62;

/// These bases together tell every composite number below 2⁶⁴ (J. Sinclair, 2011).
const BASES: [u64; 7] = [2, 325, 9375, 28178, 450_775, 9_780_504, 1_795_265_022];

/// Divisors that spare most composite numbers the longer test.
const SMALL: [u64; 14] = [3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47];

/// Above all of [`SMALL`].
const SMALL_END: u64 = 48;

/// The primes that this process has found so far, for all who ask.
static FOUND: Mutex<Vec<PrimeField>> = Mutex::new(Vec::new());

/// The primes below 2⁶², from the largest downwards.
#[derive(Clone, Debug, Default)]
pub struct Primes {
    /// How many were taken.
    taken: usize,
}

impl Iterator for Primes {
    type Item = PrimeField;

    /// There are more primes below 2⁶² than any memory holds.
    fn next(&mut self) -> Option<PrimeField> {
        // A list is right after each push, whoever panicked.
        let mut found = FOUND.lock().unwrap_or_else(PoisonError::into_inner);
        while found.len() <= self.taken {
            let below = found.last().map_or(1 << PRIME_BITS, PrimeField::modulus);
            let next = (SMALL_END..below).rev().filter(|candidate| candidate % 2 == 1).find_map(prime_field)?;
            found.push(next);
        }
        self.taken += 1;
        found.get(self.taken - 1).copied()
    }
}

/// The field of an odd number between 47 and 2⁶², if that is a prime (Miller and Rabin's test).
fn prime_field(candidate: u64) -> Option<PrimeField> {
    if SMALL.iter().any(|small| candidate.is_multiple_of(*small)) {
        return None;
    }
    // Montgomery's arithmetic needs an odd modulus, not a prime one.
    let field = PrimeField::new(candidate);
    let twos = (candidate - 1).trailing_zeros();
    let minus_one = field.negative(field.one());
    let passes = |base: &u64| {
        let base = field.form(*base);
        let mut power = field.power(base, (candidate - 1) >> twos);
        if base == 0 || power == field.one() || power == minus_one {
            return true;
        }
        (1..twos).any(|_| {
            power = field.product(power, power);
            power == minus_one
        })
    };
    BASES.iter().all(passes).then_some(field)
}

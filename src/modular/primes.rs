//! Primes below 2⁶², from the largest downwards.

use super::PrimeField;

/// Each of the first 2²⁰ primes below 2⁶² exceeds `2⁶² − 2²⁶`, so k of them multiply to more than `2^(62k−1)`.
pub const PRIME_BITS: u64 = 62;

/// These bases together tell every composite number below 2⁶⁴ (J. Sinclair, 2011).
const BASES: [u64; 7] = [2, 325, 9375, 28178, 450_775, 9_780_504, 1_795_265_022];

/// Divisors that spare most composite numbers the longer test.
const SMALL: [u64; 14] = [3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47];

/// The primes below 2⁶², from the largest downwards.
#[derive(Clone, Debug)]
pub struct Primes {
    next: u64,
}

impl Default for Primes {
    fn default() -> Self {
        Self { next: (1 << PRIME_BITS) - 1 }
    }
}

impl Iterator for Primes {
    type Item = PrimeField;

    fn next(&mut self) -> Option<PrimeField> {
        // There are more primes below 2⁶² than any memory holds.
        loop {
            let candidate = self.next;
            self.next = candidate.checked_sub(2).filter(|next| *next > 2)?;
            if let Some(field) = prime_field(candidate) {
                return Some(field);
            }
        }
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

//! Integers from their remainders, against the theorem written out in double words.

use exact_kalman::modular::{Basis, Primes};
use num_bigint::BigInt;

use crate::harness::{Replays, below, cover, harness};

/// `base^(p − 2) mod p`, the inverse of a number that p does not divide.
fn inverse(base: u128, p: u128) -> u128 {
    let (mut power, mut result, mut exponent) = (base % p, 1, p - 2);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = result * power % p;
        }
        power = power * power % p;
        exponent >>= 1;
    }
    result
}

harness! {
    /// An integer between −M/2 and M/2 is the one that its parts `x (M/pᵢ)⁻¹ mod pᵢ` lead back to, at both ends and around zero.
    ///
    /// Domain: one or two of the largest primes below 2⁶²; x from −50 to 50, and the 51 integers next to M/2 and to −M/2.
    integers_from_their_remainders, unwind 132, Replays::All(2 * 4 * 51),
    covers ["zero", "below zero", "the largest", "the least", "two primes"], {
        let count = 1 + usize::try_from(below(2)).unwrap_or(0);
        let mut basis = Basis::default();
        basis.extend(Primes::default().take(count));
        let primes: Vec<u128> = basis.fields().iter().map(|field| field.modulus().into()).collect();
        let product: u128 = primes.iter().product();
        // M is odd.
        let end = i128::try_from(product / 2).unwrap_or(i128::MAX);
        let kind = below(4);
        let distance = i128::from(below(51));
        let x = [distance, -distance, end - distance, distance - end][usize::try_from(kind).unwrap_or(0)];
        cover!(x == 0, "zero");
        cover!(x < 0, "below zero");
        cover!(x == end, "the largest");
        cover!(x == -end, "the least");
        cover!(count == 2, "two primes");
        let mut parts = Vec::new();
        for p in &primes {
            let remainder = x.rem_euclid(i128::try_from(*p).unwrap_or(1)).unsigned_abs();
            parts.push(u64::try_from(remainder * inverse(product / p, *p) % p).unwrap_or(0));
        }
        assert!(basis.determined().integer(&parts) == BigInt::from(x));
    }
}

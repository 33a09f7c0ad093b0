//! Which evidence is a rational multiple of which.
//!
//! The size `w d^(−½) exp(q)` of one is a rational multiple of that of another iff their q are equal and their d differ by
//! a square. Different such classes are linearly independent over the rationals: by the theorem of Lindemann and
//! Weierstrass a sum of algebraic multiples of exponentials of different rational numbers vanishes only term by term, and
//! so does a rational sum of square roots of fractions no two of which differ by a rational factor.

use std::collections::HashMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{ToPrimitive, Zero};

use super::Evidence;
use crate::scalar::{Rational, Scalar, ratio};

/// Components whose probabilities are rational multiples of each other, seen as one: of the size
/// `weight · determinant^(−½) · exp(exponent)`.
pub(super) type Class = Evidence<Rational>;

/// The classes of the components of a posterior.
#[derive(Clone, Debug)]
pub(super) struct Classes {
    pub(super) all: Vec<Class>,
    /// For each component its class, and its probability in that class.
    pub(super) members: Vec<(usize, Rational)>,
}

impl Classes {
    /// The classes of these sizes. Only sizes with one exponent and one [`fingerprint`] are compared, so the work grows with
    /// their number, not with its square.
    pub(super) fn of<'a>(evidence: impl Iterator<Item = &'a Evidence<Rational>>) -> Self {
        let mut all: Vec<Class> = Vec::new();
        let mut members = Vec::new();
        let mut alike: HashMap<(BigInt, BigInt, u32), Vec<usize>> = HashMap::new();
        for one in evidence {
            let key = (one.exponent.numer().clone(), one.exponent.denom().clone(), fingerprint(&one.determinant));
            let candidates = alike.entry(key).or_default();
            let found = candidates.iter().find_map(|&class| Some((class, share(&all[class], one)?)));
            let (class, share) = found.unwrap_or_else(|| {
                candidates.push(all.len());
                all.push(Class { weight: ratio(0, 1), ..one.clone() });
                (all.len() - 1, one.weight.clone())
            });
            all[class].weight = all[class].weight.plus(&share);
            members.push((class, share));
        }
        for (class, share) in &mut members {
            *share = &*share / &all[*class].weight;
        }
        Self { all, members }
    }

    /// The averages within each class of a value for each component.
    pub(super) fn averages(&self, value: impl Fn(usize) -> Rational) -> Vec<Rational> {
        let mut averages = vec![ratio(0, 1); self.all.len()];
        for (i, (class, share)) in self.members.iter().enumerate() {
            averages[*class] = averages[*class].plus(&share.times(&value(i)));
        }
        averages
    }
}

/// The weight in a class, if the determinant differs from that of the class by a square.
fn share(class: &Class, evidence: &Evidence<Rational>) -> Option<Rational> {
    let root = square_root(&class.determinant.over(&evidence.determinant).ok()?)?;
    Some(root.times(&evidence.weight))
}

/// The square root of a positive fraction, if it is a fraction.
pub(super) fn square_root(value: &Rational) -> Option<Rational> {
    let root = |n: &BigInt| {
        let root = n.sqrt();
        (&root * &root == *n).then_some(root)
    };
    Some(Rational::new_raw(root(value.numer())?, root(value.denom())?))
}

/// Two bits for each of some primes, the same for positive fractions that differ by a square: whether the prime divides it to
/// an odd power, and whether what is left is a square modulo the prime.
fn fingerprint(value: &Rational) -> u32 {
    const PRIMES: [u32; 16] = [3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59];
    PRIMES.iter().fold(0, |bits, &prime| {
        let (odd_above, above) = divided(value.numer(), prime);
        let (odd_below, below) = divided(value.denom(), prime);
        let is_odd = odd_above != odd_below;
        let is_square = is_residue(above * below % prime, prime);
        bits << 2 | u32::from(is_odd) << 1 | u32::from(is_square)
    })
}

/// Whether a prime divides a positive number to an odd power, and the remainder of what is left.
fn divided(value: &BigInt, prime: u32) -> (bool, u32) {
    let rest = |value: &BigInt| value.mod_floor(&prime.into()).to_u32().unwrap_or_default();
    let (mut left, mut odd, mut remainder) = (None, false, rest(value));
    while remainder == 0 && !value.is_zero() {
        let next = left.as_ref().unwrap_or(value) / prime;
        (odd, remainder) = (!odd, rest(&next));
        left = Some(next);
    }
    (odd, remainder)
}

/// Euler's criterion, for what the prime does not divide.
fn is_residue(value: u32, prime: u32) -> bool {
    (0..(prime - 1) / 2).fold(1, |power, _| power * value % prime) == 1
}

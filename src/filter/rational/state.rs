//! Mean and covariance as integers.

use num_bigint::BigInt;
use num_traits::One;

use super::image;
use super::law::Law;
use crate::matrix::{Fractions, Matrix};
use crate::scalar::{Precision, Rational, common_divisor};
use crate::trace::Moments;

/// `covariance = numerators / (scale · divisor)`, `mean = mean_numerators / (mean_scale · divisor)`.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// N
    pub(super) numerators: Matrix<BigInt>,
    /// u
    pub(super) scale: BigInt,
    /// d, positive and coprime to both scales: what is left of the last pivot of the elimination that left N.
    pub(super) divisor: BigInt,
    pub(super) mean_numerators: Matrix<BigInt>,
    pub(super) mean_scale: BigInt,
}

impl State {
    pub(super) fn of(moments: &Moments<Rational>) -> Self {
        let covariance = Fractions::of(&moments.covariance);
        let mean = Fractions::of(&moments.mean);
        Self {
            numerators: covariance.numerators,
            scale: covariance.denominator,
            divisor: BigInt::one(),
            mean_numerators: mean.numerators,
            mean_scale: mean.denominator,
        }
    }

    /// The length of the denominator of the covariance.
    pub(super) fn bits(&self) -> u64 {
        self.scale.bits() + self.divisor.bits()
    }

    /// The state as exact fractions.
    pub(super) fn moments(&self) -> Moments<Rational> {
        let [mean, covariance] = self.fractions();
        Moments {
            mean: mean.entrywise(Precision::Exact),
            covariance: covariance.symmetric(Precision::Exact),
            diffuse: None,
        }
    }

    /// Mean and covariance as integers over their denominators.
    pub(super) fn fractions(&self) -> [Fractions; 2] {
        let mean = self.mean_numerators.clone();
        let covariance = self.numerators.clone();
        [
            Fractions { numerators: mean, denominator: &self.mean_scale * &self.divisor },
            Fractions { numerators: covariance, denominator: &self.scale * &self.divisor },
        ]
    }

    /// `x ↦ A x + B u`, `P ↦ A P Aᵀ + D Dᵀ`: no elimination, so the divisor stays.
    pub(super) fn propagated(&self, transition: &Law) -> Self {
        let (w, z) = (transition.scale(), transition.mean_scale());
        let lower = image::covariance(self, &transition.map, &transition.noise, &w, |_, _| true);
        Self {
            numerators: Matrix::from_fn(lower.rows(), lower.rows(), |i, j| lower[(i.max(j), i.min(j))].clone()),
            scale: &self.scale * w,
            divisor: self.divisor.clone(),
            mean_numerators: image::mean(self, &transition.map, &transition.constant, &z),
            mean_scale: &self.mean_scale * z,
        }
        .reduced()
    }

    /// The same state with a divisor coprime to both scales, and without factors common to numerators and scale.
    ///
    /// The primes of the scales are those of the data's denominators: what the divisor has of them is moved to the
    /// scales, where numerators can cancel it. That the k-minors of N are divisible by d^(k−1) remains true, since d is
    /// coprime to all that is cancelled. No two large numbers meet in a greatest common divisor; scales that are
    /// powers of two cost nothing but shifts.
    pub(super) fn reduced(mut self) -> Self {
        let twos = self.divisor.trailing_zeros().unwrap_or(0);
        self.divisor >>= twos;
        let odd = odd_part(&self.scale) * odd_part(&self.mean_scale);
        let moved = split_off(&mut self.divisor, &odd) << twos;
        self.scale *= &moved;
        self.mean_scale *= moved;
        cancel(&mut self.numerators, &mut self.scale);
        cancel(&mut self.mean_numerators, &mut self.mean_scale);
        self
    }
}

/// Removes from a number all that its primes in common with `other` contribute, and returns it.
fn split_off(number: &mut BigInt, other: &BigInt) -> BigInt {
    let mut part = BigInt::one();
    let mut shared = common_divisor(number, other);
    while !shared.is_one() {
        *number /= &shared;
        part *= &shared;
        // A prime that is still common divides what has just been found; squares make few rounds.
        shared = common_divisor(number, &(&shared * &shared));
    }
    part
}

/// Divides numerators and scale by their common factor.
fn cancel(numerators: &mut Matrix<BigInt>, scale: &mut BigInt) {
    let Some(twos) = numerators.entries().iter().filter_map(BigInt::trailing_zeros).min() else {
        *scale = BigInt::one();
        return;
    };
    let twos = twos.min(scale.trailing_zeros().unwrap_or(0));
    let mut shared = odd_part(scale);
    for entry in numerators.entries() {
        if shared.is_one() {
            break;
        }
        shared = common_divisor(&shared, entry);
    }
    let divide = |number: &BigInt| if shared.is_one() { number >> twos } else { (number >> twos) / &shared };
    if twos > 0 || !shared.is_one() {
        *numerators = numerators.map(divide);
        *scale = divide(scale);
    }
}

/// The largest odd divisor of a positive number.
fn odd_part(number: &BigInt) -> BigInt {
    match number.trailing_zeros() {
        Some(twos) if twos + 1 == number.bits() => BigInt::one(),
        Some(twos) => number >> twos,
        None => BigInt::one(),
    }
}

#[cfg(test)]
mod tests {
    use num_integer::Integer;
    use num_traits::Signed;
    use proptest::prelude::*;

    use super::*;

    /// Products of small primes, some of them to high powers.
    fn smooth() -> impl Strategy<Value = BigInt> {
        proptest::collection::vec((0usize..5, 0u32..40), 0..4).prop_map(|powers| {
            let primes = [2u32, 3, 5, 7, 10_007];
            powers.into_iter().fold(BigInt::one(), |all, (prime, power)| all * BigInt::from(primes[prime]).pow(power))
        })
    }

    proptest! {
        /// Reducing changes no value, leaves the divisor coprime to both scales, and nothing to cancel.
        #[test]
        fn reduced_is_the_same_with_a_coprime_divisor(
            scales in [smooth(), smooth()], divisor in smooth(), factors in [smooth(), smooth()], entries in proptest::array::uniform4(-9i64..10),
        ) {
            let [scale, mean_scale] = scales;
            let [p, x] = factors;
            let [a, b, c, y] = entries;
            let state = State {
                numerators: Matrix::from_integers(&[[a, b], [b, c]]).scaled(&p),
                scale,
                divisor: divisor * 11,
                mean_numerators: Matrix::from_integers(&[[y], [0]]).scaled(&x),
                mean_scale,
            };
            let reduced = state.clone().reduced();
            let (before, after) = (state.moments(), reduced.moments());
            prop_assert_eq!(before.mean, after.mean);
            prop_assert_eq!(before.covariance, after.covariance);
            prop_assert!(reduced.divisor.is_positive());
            let lowest = |scale: &BigInt, numerators: &Matrix<BigInt>| {
                let content = numerators.entries().iter().fold(scale.clone(), |shared, entry| shared.gcd(entry));
                scale.gcd(&reduced.divisor).is_one() && content.is_one()
            };
            prop_assert!(lowest(&reduced.scale, &reduced.numerators));
            prop_assert!(lowest(&reduced.mean_scale, &reduced.mean_numerators));
        }
    }
}

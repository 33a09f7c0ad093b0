//! Mean and covariance as integers.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::Precision;
use crate::matrix::{Fractions, Matrix, least_common_multiple};
use crate::model::Transition;
use crate::scalar::Rational;
use crate::trace::{Moments, Quantity, Values};

/// `covariance = numerators / (scale · divisor)`, `mean = mean_numerators / (mean_scale · divisor)`.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// N
    pub(super) numerators: Matrix<BigInt>,
    /// u
    pub(super) scale: BigInt,
    /// d, odd: the last pivot of the elimination that left N.
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
        let mut values = Values::new();
        self.put(&mut values, [Quantity::FilteredMean, Quantity::FilteredCovariance], Precision::Exact);
        let mut taken = |quantity| values.remove(&quantity).unwrap_or_else(|| Matrix::zeros(0, 0));
        Moments { mean: taken(Quantity::FilteredMean), covariance: taken(Quantity::FilteredCovariance), diffuse: None }
    }

    /// Hands out mean and covariance under the given names.
    pub(super) fn put(&self, values: &mut Values<Rational>, names: [Quantity; 2], precision: Precision) {
        let [mean, covariance] = names;
        let denominator = &self.mean_scale * &self.divisor;
        values.insert(mean, self.mean_numerators.map(|n| precision.fraction(n, &denominator)));
        values.insert(covariance, symmetric_fractions(&self.numerators, &(&self.scale * &self.divisor), precision));
    }

    /// `x ↦ A x + B u`, `P ↦ A P Aᵀ + D Dᵀ`: no elimination, so the divisor stays.
    pub(super) fn propagated(&self, transition: &Transition<Rational>) -> Self {
        let a = Fractions::of(&transition.matrix);
        let noise = Fractions::of(&transition.noise);
        let input = Fractions::of(&transition.input);
        let square = &a.denominator * &a.denominator;
        let w = least_common_multiple(square.clone(), &noise.denominator);
        let z = least_common_multiple(a.denominator.clone(), &input.denominator);
        let moved = a.numerators.congruence(&self.numerators).scaled(&(&w / square));
        let mean = (&a.numerators * &self.mean_numerators).scaled(&(&z / &a.denominator));
        Self {
            numerators: moved + noise.over(&w).scaled(&(&self.scale * &self.divisor)),
            scale: &self.scale * w,
            divisor: self.divisor.clone(),
            mean_numerators: mean + input.over(&z).scaled(&(&self.mean_scale * &self.divisor)),
            mean_scale: &self.mean_scale * z,
        }
        .without_twos()
    }

    /// The same state with an odd divisor, and without powers of two common to numerators and scale.
    pub(super) fn without_twos(mut self) -> Self {
        let twos = self.divisor.trailing_zeros().unwrap_or(0);
        self.divisor >>= twos;
        self.scale <<= twos;
        self.mean_scale <<= twos;
        cancel_twos(&mut self.numerators, &mut self.scale);
        cancel_twos(&mut self.mean_numerators, &mut self.mean_scale);
        self
    }
}

fn cancel_twos(numerators: &mut Matrix<BigInt>, scale: &mut BigInt) {
    let shared = numerators.entries().iter().filter_map(BigInt::trailing_zeros).min();
    match (shared, scale.trailing_zeros()) {
        (None, _) => *scale = BigInt::one(),
        (Some(of_numerators), Some(of_scale)) => {
            let twos = of_numerators.min(of_scale);
            if !twos.is_zero() {
                *numerators = numerators.map(|entry| entry >> twos);
                *scale >>= twos;
            }
        }
        (Some(_), None) => {}
    }
}

/// A symmetric matrix of integers over one denominator, each pair handed out once.
pub(super) fn symmetric_fractions(
    numerators: &Matrix<BigInt>,
    denominator: &BigInt,
    precision: Precision,
) -> Matrix<Rational> {
    let n = numerators.rows();
    let lower = Matrix::from_fn(n, n, |i, j| {
        if j <= i { precision.fraction(&numerators[(i, j)], denominator) } else { Rational::zero() }
    });
    Matrix::from_fn(n, n, |i, j| lower[(i.max(j), i.min(j))].clone())
}

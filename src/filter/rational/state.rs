//! Mean and covariance as integers.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use crate::matrix::{Fractions, Matrix, least_common_multiple};
use crate::model::Transition;
use crate::scalar::{Precision, Rational};
use crate::trace::Moments;

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

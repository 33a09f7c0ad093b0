//! The exact equation as integers, and its values at a point.

use num_bigint::BigInt;
use num_traits::One;

use super::{Dyadics, odd_denominator};
use crate::certify::upper::Upper;
use crate::matrix::{Echelon, Matrix};
use crate::model::UnifiedStep;
use crate::scalar::Dyadic;

/// Bits of factors: closed loops may contract as little as 1 − 2⁻¹⁰⁰.
pub(super) const FACTOR: Upper = Upper { bits: 512 };

/// Where the state goes: `z = A x + w`, with the covariances of w and of w and the noise of what is read.
#[derive(Clone, Debug)]
pub(super) struct Target {
    /// A, over e.
    pub(super) map: Dyadics,
    /// Q, over w.
    pub(super) noise: Dyadics,
    /// S, over w.
    pub(super) cross: Dyadics,
}

/// All that is not dyadic stands over odd integers: maps over e, covariances over w = e² l.
#[derive(Clone, Debug)]
pub(super) struct Equation {
    pub(super) odd: BigInt,
    pub(super) lift: BigInt,
    pub(super) noise_odd: BigInt,
    /// H, over e.
    pub(super) observation: Dyadics,
    /// R, over w.
    pub(super) noise: Dyadics,
    pub(super) ahead: Target,
}

impl Equation {
    pub(super) fn of(step: &UnifiedStep) -> Self {
        let maps = [&step.transition, &step.observation];
        let odd = maps.into_iter().fold(BigInt::one(), |odd, map| odd_denominator(odd, map.entries()));
        let square = &odd * &odd;
        let noises = [&step.process_noise, &step.cross_noise, &step.observation_noise];
        let noise_odd = noises.into_iter().fold(square.clone(), |odd, noise| odd_denominator(odd, noise.entries()));
        Self {
            observation: Dyadics::of(&step.observation, &odd),
            noise: Dyadics::of(&step.observation_noise, &noise_odd),
            ahead: Target {
                map: Dyadics::of(&step.transition, &odd),
                noise: Dyadics::of(&step.process_noise, &noise_odd),
                cross: Dyadics::of(&step.cross_noise, &noise_odd),
            },
            lift: &noise_odd / square,
            odd,
            noise_odd,
        }
    }

    /// The state itself, given what is read.
    pub(super) fn same(&self) -> Target {
        let (n, m) = (self.observation.mantissas.columns(), self.observation.rows());
        let nothing = |columns| Dyadics { mantissas: Matrix::zeros(n, columns), exponent: 0 };
        let map = Dyadics { mantissas: Matrix::identity(n), exponent: 0 }.scaled(&self.odd);
        Target { map, noise: nothing(n), cross: nothing(m) }
    }
}

/// The step without entries of the reading that follow from others, and the indices of those that are kept.
pub(super) fn without_repeated(step: &UnifiedStep) -> (UnifiedStep, Vec<usize>) {
    let all: Vec<usize> = (0..step.sensors()).collect();
    let rows = step.observation.beside(&step.observation_noise).beside(&step.cross_noise.transpose());
    // The columns with a pivot are the rows that do not follow from those before them.
    let kept = Echelon::of(&rows.transpose(), all.len()).map_or(all, |echelon| echelon.pivots().to_vec());
    let less = UnifiedStep {
        transition: step.transition.clone(),
        process_noise: step.process_noise.clone(),
        observation: step.observation.select_rows(&kept),
        cross_noise: step.cross_noise.select_columns(&kept),
        observation_noise: step.observation_noise.select(&kept, &kept),
    };
    (less, kept)
}

/// A positive power of two.
pub(super) fn power_of_two(exponent: i64) -> Dyadic {
    Dyadic::new(BigInt::one(), exponent)
}

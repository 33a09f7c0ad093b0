//! The nearby problems whose answers a backward-stable method could have given.
//!
//! Every nonzero datum is moved by a relative 2⁻⁵³, up or down; zeros stay zero, equal matrices stay equal, and so do
//! equal rows of an observation matrix. Covariances stay symmetric, positive semidefinite and of the same rank: a
//! positive definite one is moved entry by entry, as rounding would move it; a singular one through its factors LDLᵀ.

use std::collections::HashMap;

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::filter::Precision;
use crate::matrix::{Ldl, Matrix, Shape};
use crate::model::{Initial, Observation, Path, Step, Transition};
use crate::scalar::{Field as _, Rational, Scalar, ratio};

/// Bits kept of a moved datum: enough to hold the move, few enough to keep exact work cheap.
const BITS: u32 = 64;

/// Which kind of datum a matrix is; equal matrices of one kind are moved alike.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Kind {
    Transition,
    Observation,
    Input,
    ObservationInput,
    Noise,
}

/// One seeded perturbation of a problem.
pub(super) struct Perturbation {
    signs: Pcg64Mcg,
    moved: HashMap<(Kind, Matrix<Rational>), Matrix<Rational>>,
}

impl Perturbation {
    pub(super) fn seeded(seed: u64) -> Self {
        Self { signs: Pcg64Mcg::seed_from_u64(seed), moved: HashMap::new() }
    }

    /// The problem, every datum moved.
    pub(super) fn of(mut self, path: &Path<Rational>) -> Path<Rational> {
        let initial = path.initial();
        let initial = Initial {
            mean: self.matrix(&initial.mean),
            covariance: self.covariance(&initial.covariance),
            diffuse: initial.diffuse.as_ref().map(|part| self.covariance(part)),
            ..initial.clone()
        };
        let steps = path.steps().iter().map(|step| self.step(step)).collect();
        Path::from_parts(path.timing(), initial, steps)
    }

    fn step(&mut self, step: &Step<Rational>) -> Step<Rational> {
        let reading = step.reading.try_map(|y| Ok::<_, std::convert::Infallible>(self.datum(y)));
        let reading: Observation<Rational> = match reading {
            Ok(reading) => reading,
            Err(never) => match never {},
        };
        let observation = self.once(Kind::Observation, &step.observation, Self::rows);
        let observation_input = self.once(Kind::ObservationInput, &step.observation_input, Self::rows);
        let (transition, observation_noise) = match &step.transition {
            None => (None, self.once(Kind::Noise, &step.observation_noise, Self::covariance)),
            Some(transition) => {
                let (transition, noise) = self.transition(transition, &step.observation_noise);
                (Some(transition), noise)
            }
        };
        Step { transition, observation, observation_input, observation_noise, reading }
    }

    fn transition(
        &mut self,
        transition: &Transition<Rational>,
        observation_noise: &Matrix<Rational>,
    ) -> (Transition<Rational>, Matrix<Rational>) {
        let n = transition.noise.rows();
        let cross = &transition.cross_noise;
        let matrix = self.once(Kind::Transition, &transition.matrix, Self::matrix);
        let input = self.once(Kind::Input, &transition.input, Self::matrix);
        if cross.is_zero() {
            let noise = self.once(Kind::Noise, &transition.noise, Self::covariance);
            let observation_noise = self.once(Kind::Noise, observation_noise, Self::covariance);
            return (Transition { matrix, input, noise, cross_noise: cross.clone() }, observation_noise);
        }
        let joint = transition.noise.beside(cross).above(&cross.transpose().beside(observation_noise));
        let joint = self.once(Kind::Noise, &joint, Self::covariance);
        let all = joint.rows();
        let (noise, cross_noise) = (joint.block(0..n, 0..n), joint.block(0..n, n..all));
        (Transition { matrix, input, noise, cross_noise }, joint.block(n..all, n..all))
    }

    fn once(
        &mut self,
        kind: Kind,
        matrix: &Matrix<Rational>,
        mut move_it: impl FnMut(&mut Self, &Matrix<Rational>) -> Matrix<Rational>,
    ) -> Matrix<Rational> {
        let key = (kind, matrix.clone());
        if let Some(moved) = self.moved.get(&key) {
            return moved.clone();
        }
        let moved = move_it(self, matrix);
        self.moved.insert(key, moved.clone());
        moved
    }

    fn datum(&mut self, value: &Rational) -> Rational {
        if value.is_zero() {
            return value.clone();
        }
        let unit = ratio(1, 1 << 53);
        let factor =
            if self.signs.next_u64() >> 63 == 0 { Rational::one().plus(&unit) } else { Rational::one().minus(&unit) };
        Precision::Rounded { bits: BITS }.of(&value.times(&factor))
    }

    fn matrix(&mut self, matrix: &Matrix<Rational>) -> Matrix<Rational> {
        matrix.map(|entry| self.datum(entry))
    }

    /// Moves a matrix row by row, equal rows alike.
    fn rows(&mut self, matrix: &Matrix<Rational>) -> Matrix<Rational> {
        let mut moved: Vec<Vec<Rational>> = Vec::new();
        for i in 0..matrix.rows() {
            let twin = (0..i).find(|&k| matrix.row(k) == matrix.row(i));
            let row = match twin {
                Some(k) => moved[k].clone(),
                None => matrix.row(i).iter().map(|entry| self.datum(entry)).collect(),
            };
            moved.push(row);
        }
        let Shape { rows, columns } = matrix.shape();
        Matrix::from_fn(rows, columns, |i, j| moved[i][j].clone())
    }

    /// Moves a symmetric matrix, mirrored entries alike.
    fn symmetric(&mut self, matrix: &Matrix<Rational>) -> Matrix<Rational> {
        let n = matrix.rows();
        let moved = self.matrix(matrix);
        Matrix::from_fn(n, n, |i, j| moved[(i.max(j), i.min(j))].clone())
    }

    /// Moves a covariance: entry by entry if it is positive definite and stays so, else through its factors. One that
    /// is not positive semidefinite is moved entry by entry.
    fn covariance(&mut self, matrix: &Matrix<Rational>) -> Matrix<Rational> {
        let Ok(ldl) = matrix.ldl() else { return self.symmetric(matrix) };
        if ldl.is_positive_definite() {
            let moved = self.symmetric(matrix);
            if moved.ldl().is_ok_and(|ldl| ldl.is_positive_definite()) {
                return moved;
            }
        }
        self.through_factors(matrix, &ldl)
    }

    /// Moves the factors of `P = LDLᵀ`, which keeps the rank. Where zeros of P are sums that cancel they would be lost:
    /// then P is multiplied from both sides by a diagonal matrix near the identity, which keeps zeros and rank.
    fn through_factors(&mut self, matrix: &Matrix<Rational>, ldl: &Ldl<Rational>) -> Matrix<Rational> {
        let n = matrix.rows();
        let lower = Matrix::from_fn(n, n, |i, j| if i == j { Rational::one() } else { self.datum(&ldl.lower[(i, j)]) });
        let pivots: Vec<Rational> = ldl.pivots.iter().map(|pivot| self.datum(pivot)).collect();
        let moved = lower.congruence(&Matrix::diagonal(&pivots));
        let lost = |(before, after): (&Rational, &Rational)| before.is_zero() && !after.is_zero();
        if matrix.entries().iter().zip(moved.entries()).any(lost) {
            let near_one: Vec<Rational> = (0..n).map(|_| self.datum(&Rational::one())).collect();
            return Matrix::diagonal(&near_one).congruence(matrix);
        }
        moved
    }
}

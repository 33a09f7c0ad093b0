//! The joint covariance of observed entries and targets in integers, and its elimination.

use num_bigint::{BigInt, Sign};
use num_traits::Zero;

use super::law::Law;
use super::state::State;
use crate::matrix::{Fractions, Matrix};

/// The elimination cannot go on: the data contradict each other, or the covariance is not semidefinite.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop;

/// The states that are left.
pub(super) struct Eliminated {
    /// x_k given y_k.
    pub(super) filtered: State,
    /// x_{k+1} given y_k, when the transition departs from k.
    pub(super) departed: Option<State>,
    /// The number of pivots, which is the rank of S.
    pub(super) rank: usize,
}

/// J and one more column, over `scale · divisor` and `mean_scale · divisor`; y first, then each target.
pub(super) struct Joint<'a> {
    law: &'a Law,
    covariance: Matrix<BigInt>,
    scale: BigInt,
    column: Matrix<BigInt>,
    mean_scale: BigInt,
    divisor: BigInt,
}

impl<'a> Joint<'a> {
    /// `J = (w/e²) Eᵢ N Eᵢᵀ + u d Qᵢ`, and the column `constant − E x`.
    pub(super) fn of(state: &State, law: &'a Law) -> Self {
        let (e, w, z) = (&law.map.denominator, law.scale(), law.mean_scale());
        let seen = law.map.numerators.congruence(&state.numerators).scaled(&(&w / (e * e)));
        let moved = (&law.map.numerators * &state.mean_numerators).scaled(&(&z / e));
        Self {
            covariance: seen + law.noise.over(&w).scaled(&(&state.scale * &state.divisor)),
            scale: &state.scale * w,
            column: law.constant.over(&z).scaled(&(&state.mean_scale * &state.divisor)) - moved,
            mean_scale: &state.mean_scale * z,
            divisor: state.divisor.clone(),
            law,
        }
    }

    /// The innovation and its covariance, before the elimination.
    pub(super) fn innovation(&self) -> [Fractions; 2] {
        let m = self.law.observed;
        let innovation = self.column.block(0..m, 0..1);
        let covariance = self.covariance.block(0..m, 0..m);
        [
            Fractions { numerators: innovation, denominator: &self.mean_scale * &self.divisor },
            Fractions { numerators: covariance, denominator: &self.scale * &self.divisor },
        ]
    }

    pub(super) fn eliminated(mut self) -> Result<Eliminated, Stop> {
        let mut rank = 0;
        for row in 0..self.law.observed {
            match self.covariance[(row, row)].sign() {
                Sign::Plus => {
                    self.eliminate(row);
                    rank += 1;
                }
                Sign::NoSign if self.is_settled(row) => {}
                Sign::NoSign | Sign::Minus => return Err(Stop),
            }
        }
        let mut targets = (0..self.law.targets).map(|target| self.target(target));
        match targets.next() {
            Some(filtered) => Ok(Eliminated { filtered, departed: targets.next(), rank }),
            None => Err(Stop),
        }
    }

    /// Whether a row with pivot zero is zero, its innovation included.
    fn is_settled(&self, row: usize) -> bool {
        let below = row + 1..self.covariance.rows();
        below.into_iter().all(|i| self.covariance[(i, row)].is_zero()) && self.column[(row, 0)].is_zero()
    }

    /// Bareiss' step on the lower triangle; blocks between two targets are not needed.
    fn eliminate(&mut self, row: usize) {
        let pivot = self.covariance[(row, row)].clone();
        let size = self.covariance.rows();
        let factors: Vec<BigInt> = (0..size).map(|i| self.covariance[(i.max(row), i.min(row))].clone()).collect();
        let head = self.column[(row, 0)].clone();
        for i in row + 1..size {
            for j in row + 1..=i {
                if j < self.law.observed || self.law.target_of(i) == self.law.target_of(j) {
                    let minor = &pivot * &self.covariance[(i, j)] - &factors[i] * &factors[j];
                    self.covariance[(i, j)] = minor / &self.divisor;
                }
            }
            self.column[(i, 0)] = (&pivot * &self.column[(i, 0)] - &factors[i] * &head) / &self.divisor;
        }
        self.divisor = pivot;
    }

    fn target(&self, target: usize) -> State {
        let rows = self.law.target(target);
        let (first, n) = (rows.start, rows.len());
        State {
            numerators: Matrix::from_fn(n, n, |i, j| self.covariance[(first + i.max(j), first + i.min(j))].clone()),
            scale: self.scale.clone(),
            divisor: self.divisor.clone(),
            mean_numerators: -self.column.block(rows, 0..1),
            mean_scale: self.mean_scale.clone(),
        }
        .reduced()
    }
}

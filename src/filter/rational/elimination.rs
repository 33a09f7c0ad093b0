//! The joint covariance of observed entries and targets in integers, and its elimination.

use std::ops::Range;

use num_bigint::{BigInt, Sign};
use num_traits::Zero;

use super::exact_division::Minors;
use super::image;
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
    /// `J = (w/e²) Eᵢ N Eᵢᵀ + u d Qᵢ`, its lower triangle, and the column `E x − constant`.
    pub(super) fn of(state: &State, law: &'a Law) -> Self {
        let (w, z) = (law.scale(), law.mean_scale());
        Self {
            covariance: image::covariance(state, &law.map, &law.noise, &w, |i, j| law.is_needed(i, j)),
            scale: &state.scale * w,
            column: image::mean(state, &law.map, &law.constant, &z),
            mean_scale: &state.mean_scale * z,
            divisor: state.divisor.clone(),
            law,
        }
    }

    /// The innovation and its covariance, before the elimination; nothing if nothing is observed.
    pub(super) fn innovation(&self) -> Option<[Fractions; 2]> {
        let m = Some(self.law.observed).filter(|observed| *observed > 0)?;
        let innovation = -self.column.block(0..m, 0..1);
        let covariance = self.symmetric(0..m);
        Some([
            Fractions { numerators: innovation, denominator: &self.mean_scale * &self.divisor },
            Fractions { numerators: covariance, denominator: &self.scale * &self.divisor },
        ])
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
        let size = self.covariance.rows();
        let pivot = std::mem::take(&mut self.covariance[(row, row)]);
        let head = std::mem::take(&mut self.column[(row, 0)]);
        // Nothing reads the column of a pivot again.
        let factors: Vec<BigInt> = (row + 1..size).map(|i| std::mem::take(&mut self.covariance[(i, row)])).collect();
        let minors = Minors::of(&pivot, &self.divisor, self.numerator_bits(row, &pivot, &factors, &head));
        for (i, factor) in (row + 1..).zip(&factors) {
            let minors = minors.row(factor);
            for (j, other) in (row + 1..=i).zip(&factors) {
                if self.law.is_needed(i, j) {
                    self.covariance[(i, j)] = minors.quotient(&self.covariance[(i, j)], other);
                }
            }
            self.column[(i, 0)] = minors.quotient(&self.column[(i, 0)], &head);
        }
        self.divisor = pivot;
    }

    /// A bound for the length of `p a − q b` over all that a pivot changes.
    fn numerator_bits(&self, row: usize, pivot: &BigInt, factors: &[BigInt], head: &BigInt) -> u64 {
        let longest = |numbers: &mut dyn Iterator<Item = &BigInt>| numbers.map(BigInt::bits).max().unwrap_or(0);
        let below = row + 1..self.covariance.rows();
        let entries =
            below.clone().flat_map(|i| (row + 1..=i).map(move |j| (i, j))).map(|place| &self.covariance[place]);
        let left = longest(&mut entries.chain(below.map(|i| &self.column[(i, 0)])));
        let factor = longest(&mut factors.iter());
        1 + (pivot.bits() + left).max(factor + factor.max(head.bits()))
    }

    fn symmetric(&self, rows: Range<usize>) -> Matrix<BigInt> {
        let (first, n) = (rows.start, rows.len());
        Matrix::from_fn(n, n, |i, j| self.covariance[(first + i.max(j), first + i.min(j))].clone())
    }

    fn target(&self, target: usize) -> State {
        let rows = self.law.target(target);
        State {
            numerators: self.symmetric(rows.clone()),
            scale: self.scale.clone(),
            divisor: self.divisor.clone(),
            mean_numerators: self.column.block(rows, 0..1),
            mean_scale: self.mean_scale.clone(),
        }
        .reduced()
    }
}

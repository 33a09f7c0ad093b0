//! The joint covariance of observed entries and targets in integers, and its elimination.

use num_bigint::{BigInt, Sign};
use num_traits::Zero;

use super::state::{State, symmetric_fractions};
use super::{Precision, Sensors};
use crate::matrix::{Fractions, Matrix, least_common_multiple};
use crate::model::{Timing, Transition};
use crate::scalar::Rational;

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
pub(super) struct Joint {
    observed: usize,
    states: usize,
    targets: usize,
    covariance: Matrix<BigInt>,
    scale: BigInt,
    column: Matrix<BigInt>,
    mean_scale: BigInt,
    divisor: BigInt,
}

impl Joint {
    /// The joint law of y_k, x_k and, when the transition departs from k, x_{k+1}.
    pub(super) fn of(
        state: &State,
        sensors: &Sensors<Rational>,
        transition: Option<&Transition<Rational>>,
        timing: Timing,
    ) -> Self {
        let n = sensors.matrix.columns();
        let m = sensors.observed.len();
        let shared = sensors.shared_with_state(timing);
        let (_, noise) = sensors.covariances(&Matrix::zeros(n, n), &shared);
        let zeros = Matrix::zeros(n, n);
        let mut map = sensors.matrix.above(&Matrix::identity(n));
        let mut covariance = noise.beside(&shared.transpose()).above(&shared.beside(&zeros));
        let mut constant = (&sensors.values - &sensors.input).above(&Matrix::zeros(n, 1));
        let departing = transition.filter(|_| timing == Timing::Departing);
        if let Some(transition) = departing {
            let cross = &sensors.cross_noise;
            map = map.above(&transition.matrix);
            covariance = covariance
                .beside(&cross.transpose().above(&zeros))
                .above(&cross.beside(&zeros).beside(&transition.noise));
            constant = constant.above(&-&transition.input);
        }
        Self::assembled(state, &map, &covariance, &constant, [m, n, 1 + usize::from(departing.is_some())])
    }

    /// `J = (w/e²) Eᵢ N Eᵢᵀ + u d Qᵢ`, and the column `constant − E x`.
    fn assembled(
        state: &State,
        map: &Matrix<Rational>,
        covariance: &Matrix<Rational>,
        constant: &Matrix<Rational>,
        [observed, states, targets]: [usize; 3],
    ) -> Self {
        let (e, q, k) = (Fractions::of(map), Fractions::of(covariance), Fractions::of(constant));
        let square = &e.denominator * &e.denominator;
        let w = least_common_multiple(square.clone(), &q.denominator);
        let z = least_common_multiple(e.denominator.clone(), &k.denominator);
        let seen = e.numerators.congruence(&state.numerators).scaled(&(&w / square));
        let moved = (&e.numerators * &state.mean_numerators).scaled(&(&z / &e.denominator));
        Self {
            observed,
            states,
            targets,
            covariance: seen + q.over(&w).scaled(&(&state.scale * &state.divisor)),
            scale: &state.scale * w,
            column: k.over(&z).scaled(&(&state.mean_scale * &state.divisor)) - moved,
            mean_scale: &state.mean_scale * z,
            divisor: state.divisor.clone(),
        }
    }

    /// The innovation and its covariance, before the elimination.
    pub(super) fn innovation(&self, precision: Precision) -> (Matrix<Rational>, Matrix<Rational>) {
        let m = self.observed;
        let denominator = &self.mean_scale * &self.divisor;
        let innovation = self.column.block(0..m, 0..1).map(|entry| precision.fraction(entry, &denominator));
        let block = self.covariance.block(0..m, 0..m);
        (innovation, symmetric_fractions(&block, &(&self.scale * &self.divisor), precision))
    }

    pub(super) fn eliminated(mut self) -> Result<Eliminated, Stop> {
        let mut rank = 0;
        for row in 0..self.observed {
            match self.covariance[(row, row)].sign() {
                Sign::Plus => {
                    self.eliminate(row);
                    rank += 1;
                }
                Sign::NoSign if self.is_settled(row) => {}
                Sign::NoSign | Sign::Minus => return Err(Stop),
            }
        }
        let mut targets = (0..self.targets).map(|target| self.target(target));
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
                if j < self.observed || self.target_of(i) == self.target_of(j) {
                    let minor = &pivot * &self.covariance[(i, j)] - &factors[i] * &factors[j];
                    self.covariance[(i, j)] = minor / &self.divisor;
                }
            }
            self.column[(i, 0)] = (&pivot * &self.column[(i, 0)] - &factors[i] * &head) / &self.divisor;
        }
        self.divisor = pivot;
    }

    fn target_of(&self, row: usize) -> Option<usize> {
        row.checked_sub(self.observed).map(|place| place / self.states)
    }

    fn target(&self, target: usize) -> State {
        let first = self.observed + target * self.states;
        let n = self.states;
        State {
            numerators: Matrix::from_fn(n, n, |i, j| self.covariance[(first + i.max(j), first + i.min(j))].clone()),
            scale: self.scale.clone(),
            divisor: self.divisor.clone(),
            mean_numerators: -self.column.block(first..first + n, 0..1),
            mean_scale: self.mean_scale.clone(),
        }
        .without_twos()
    }
}

//! The estimates of A and of the residual covariances, one reading after the other.

use super::lagged_sums::LaggedSums;
use super::{NoiseCovariances, ResidualCovariances, Series, SingularTransition, noise_covariances};
use crate::matrix::{Matrix, PseudoInverseError};
use crate::model::Reading;
use crate::scalar::Field;

/// Â(n), B(n,1) and B(n,2) from the readings y(1), …, y(n).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Estimates<S> {
    /// n ≥ 3.
    pub count: usize,
    /// Â(n), p×p.
    pub transition: Matrix<S>,
    /// B(n,1) and B(n,2).
    pub residuals: ResidualCovariances<S>,
}

impl<S: Field> Estimates<S> {
    /// V̂(n) and Ŵ(n), by AK-B.hat.
    ///
    /// # Errors
    ///
    /// [`SingularTransition`] where Â(n) is singular, with a vector that proves it.
    pub fn noise(&self) -> Result<NoiseCovariances<S>, SingularTransition<S>> {
        noise_covariances(&self.transition, &self.residuals)
    }
}

/// Why there is no estimate: over a finite field the lag sum may have no pseudo-inverse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no estimate from {count} readings: {source}")]
pub struct EstimateError {
    /// How many readings there were.
    pub count: usize,
    /// What is wrong with the lag sum.
    pub source: PseudoInverseError,
}

/// The running form: it keeps sums over the past and the last two readings, not the past.
///
/// AK-2.1: `Â(n) = (Σ_{k=3..n} y(k)yᵀ(k−2)) (Σ_{k=3..n} y(k−1)yᵀ(k−2))⁺, n ≥ 3`
///
/// AK-2.2: `B(n,i) = (1/n) Σ_{k=3..n} (y(k) − Â(k)ⁱy(k−i))(y(k) − Â(k)ⁱy(k−i))ᵀ, n ≥ 3, i = 1, 2`
///
/// [`Reading`] says which estimate of A stands at step k in (2.2). The paper takes Â(k) there so that the estimate is
/// recursive; but with the sums of y(k)yᵀ(k−i) and y(k−i)yᵀ(k−i) the reading [`Reading::Last`] (AK-Rem2.2) is
/// recursive as well, and its fractions stay short: those of the others have the product of all denominators of
/// Â(3), …, Â(n).
///
/// # Examples
///
/// ```
/// use exact_kalman::identify::Estimator;
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::Reading;
/// use exact_kalman::scalar::ratio;
///
/// let mut estimator = Estimator::new(1, Reading::Printed);
/// let mut last = None;
/// for y in [4, 2, 3, 1] {
///     last = estimator.observe(&Matrix::column(vec![ratio(y, 1)]))?;
/// }
/// // (3·4 + 1·2) / (2·4 + 3·2)
/// assert_eq!(last.map(|estimates| estimates.transition[(0, 0)].clone()), Some(ratio(1, 1)));
/// # Ok::<(), exact_kalman::identify::EstimateError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Estimator<S> {
    dimension: usize,
    reading: Reading,
    count: usize,
    /// y(n) and y(n−1), as far as there are.
    recent: Vec<Matrix<S>>,
    sums: LaggedSums<S>,
    /// Â(n), from n = 3 on.
    transition: Option<Matrix<S>>,
    /// n·B(n,1) and n·B(n,2), unless they follow from the sums.
    squares: [Matrix<S>; 2],
}

impl<S: Field> Estimator<S> {
    /// The estimator for readings of p components, before the first.
    pub fn new(dimension: usize, reading: Reading) -> Self {
        let zero = Matrix::zeros(dimension, dimension);
        Self {
            dimension,
            reading,
            count: 0,
            recent: Vec::new(),
            sums: LaggedSums::new(dimension),
            transition: None,
            squares: [zero.clone(), zero],
        }
    }

    /// Takes the next reading y(n), p×1; the estimates from n = 3 on.
    ///
    /// # Errors
    ///
    /// [`EstimateError`] over a finite field; never over the rationals.
    ///
    /// # Panics
    ///
    /// If the shape does not fit.
    pub fn observe(&mut self, y: &Matrix<S>) -> Result<Option<Estimates<S>>, EstimateError> {
        assert!(y.rows() == self.dimension && y.columns() == 1, "a reading of shape {}", y.shape());
        self.count += 1;
        let estimates = match self.recent.clone().as_slice() {
            [one, two] => Some(self.advance([y, one, two])?),
            _ => None,
        };
        self.recent.insert(0, y.clone());
        self.recent.truncate(2);
        Ok(estimates)
    }

    fn advance(&mut self, window: [&Matrix<S>; 3]) -> Result<Estimates<S>, EstimateError> {
        self.sums.add(window);
        let lag_sum = self.sums.of(1, 2).pseudo_inverse();
        let lag_sum = lag_sum.map_err(|source| EstimateError { count: self.count, source })?;
        let transition = self.sums.of(0, 2) * lag_sum;
        let before = self.transition.replace(transition.clone()).unwrap_or_else(|| transition.clone());
        self.squares = match self.reading {
            Reading::Printed => self.with_residuals(window, &transition, &(&transition * &transition)),
            Reading::Predictive => self.with_residuals(window, &before, &(&transition * &before)),
            Reading::Last => {
                [self.squared_residuals(&transition, 1), self.squared_residuals(&(&transition * &transition), 2)]
            }
        };
        let n = S::from_integer(i64::try_from(self.count).unwrap_or(i64::MAX));
        let Ok(share) = S::one().over(&n) else { panic!("1/n needs n ≠ 0 in the field") };
        let [one_step, two_step] = self.squares.each_ref().map(|sum| sum.scaled(&share));
        Ok(Estimates { count: self.count, transition, residuals: ResidualCovariances { one_step, two_step } })
    }

    /// The sums of (2.2) with the term k added, where `one` stands for Â(k) and `two` for its square.
    fn with_residuals(&self, [y, y1, y2]: [&Matrix<S>; 3], one: &Matrix<S>, two: &Matrix<S>) -> [Matrix<S>; 2] {
        let square = |residual: Matrix<S>| &residual * residual.transpose();
        [&self.squares[0] + square(y - one * y1), &self.squares[1] + square(y - two * y2)]
    }

    /// `Σ_{k=3..n} (y(k) − F y(k−i))(y(k) − F y(k−i))ᵀ`, from the sums.
    fn squared_residuals(&self, f: &Matrix<S>, i: usize) -> Matrix<S> {
        let cross = self.sums.of(0, i) * f.transpose();
        self.sums.of(0, 0) - &cross - cross.transpose() + f.congruence(&self.sums.of(i, i))
    }
}

/// The estimates from y(1), …, y(n) for n = 3, 4, ….
///
/// # Errors
///
/// [`EstimateError`] over a finite field; never over the rationals.
pub fn estimates<S: Field>(series: &Series<S>, reading: Reading) -> Result<Vec<Estimates<S>>, EstimateError> {
    let mut estimator = Estimator::new(series.dimension(), reading);
    let each = series.readings().iter().map(|y| estimator.observe(y));
    Ok(each.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

//! Estimates of A and of the noise covariances from readings, in `f64`.

use nalgebra::{DMatrix, SMatrix, SVector};

use crate::model::Reading;

/// Â(n), B(n,1), B(n,2) in `f64` (AK-2.1, AK-2.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimates<const P: usize> {
    /// n.
    pub count: usize,
    /// Â(n).
    pub transition: SMatrix<f64, P, P>,
    /// B(n,1).
    pub one_step: SMatrix<f64, P, P>,
    /// B(n,2).
    pub two_step: SMatrix<f64, P, P>,
}

impl<const P: usize> Estimates<P> {
    /// V̂(n) and Ŵ(n) (AK-B.hat); nothing where LU finds no inverse of Â(n), and for n < p + 2, where Â(n) has a rank of
    /// at most n − 2 and rounding would only hide it.
    pub fn noise(&self) -> Option<(SMatrix<f64, P, P>, SMatrix<f64, P, P>)> {
        let (a, b1) = (self.transition, self.one_step);
        if self.count < P + 2 {
            return None;
        }
        // A⁻¹ D A⁻ᵀ, with D = B(1) − B(2) symmetric.
        let half = solved(a, b1 - self.two_step)?;
        let observation = (b1 + solved(a, half.transpose())?) * 0.5;
        Some((b1 - observation - a * observation * a.transpose(), observation))
    }
}

/// The lag sum has no inverse in `f64`, so that there is no Â(n).
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the lag sum of {count} readings has no inverse")]
pub struct NoInverse {
    /// n.
    pub count: usize,
}

/// The running estimator in `f64`.
///
/// Residuals are computed as differences and squared, also where the last estimate of A stands in all of them: the
/// shorter form from sums of products would cancel.
#[derive(Clone, Debug)]
pub struct Estimator<const P: usize> {
    reading: Reading,
    readings: Vec<SVector<f64, P>>,
    ahead: SMatrix<f64, P, P>,
    lag: SMatrix<f64, P, P>,
    transition: Option<SMatrix<f64, P, P>>,
    squares: [SMatrix<f64, P, P>; 2],
}

impl<const P: usize> Estimator<P> {
    /// The estimator before the first reading.
    pub fn new(reading: Reading) -> Self {
        let zero = SMatrix::zeros();
        Self { reading, readings: Vec::new(), ahead: zero, lag: zero, transition: None, squares: [zero; 2] }
    }

    /// Takes the next reading.
    ///
    /// # Errors
    ///
    /// [`NoInverse`] if the lag sum is singular and not only short of terms; what follows has then no meaning.
    pub fn observe(&mut self, y: SVector<f64, P>) -> Result<(), NoInverse> {
        self.readings.push(y);
        let count = self.readings.len();
        if count < 3 {
            return Ok(());
        }
        let (y1, y2) = (self.readings[count - 2], self.readings[count - 3]);
        self.ahead += y * y2.transpose();
        self.lag += y1 * y2.transpose();
        let a = if count < P + 2 {
            self.early()
        } else {
            solved(self.lag.transpose(), self.ahead.transpose()).map(|a| a.transpose())
        };
        let a = a.ok_or(NoInverse { count })?;
        let before = self.transition.replace(a).unwrap_or(a);
        let (one, two) = match self.reading {
            Reading::Predictive => (before, a * before),
            Reading::Printed | Reading::Last => (a, a * a),
        };
        if self.reading != Reading::Last {
            let (first, second) = (y - one * y1, y - two * y2);
            self.squares[0] += first * first.transpose();
            self.squares[1] += second * second.transpose();
        }
        Ok(())
    }

    /// Â(n) for n < p + 2, where the lag sum YZᵀ has fewer terms than rows: (YZᵀ)⁺ is then (Zᵀ)⁺Y⁺, so that
    /// XZᵀ(YZᵀ)⁺ = XY⁺ = X(YᵀY)⁻¹Yᵀ, if the columns y(2), … of Y and y(1), … of Z are independent.
    fn early(&self) -> Option<SMatrix<f64, P, P>> {
        let terms = self.readings.len() - 2;
        let columns = |first: usize| DMatrix::from_fn(P, terms, |i, j| self.readings[first + j][i]);
        let (x, y, z) = (columns(2), columns(1), columns(0));
        (z.transpose() * &z).try_inverse()?;
        let a = x * (y.transpose() * &y).try_inverse()? * y.transpose();
        Some(SMatrix::from_fn(|i, j| a[(i, j)]))
    }

    /// The estimates from all readings so far; nothing before the third.
    pub fn estimates(&self) -> Option<Estimates<P>> {
        let a = self.transition?;
        let [one_step, two_step] = match self.reading {
            Reading::Last => [self.squared_residuals(a, 1), self.squared_residuals(a * a, 2)],
            Reading::Printed | Reading::Predictive => self.squares,
        };
        let count = self.readings.len();
        #[expect(clippy::cast_precision_loss, reason = "no series has 2^53 readings")]
        let n = count as f64;
        Some(Estimates { count, transition: a, one_step: one_step / n, two_step: two_step / n })
    }

    fn squared_residuals(&self, f: SMatrix<f64, P, P>, i: usize) -> SMatrix<f64, P, P> {
        let residual = |k: usize| self.readings[k] - f * self.readings[k - i];
        (2..self.readings.len()).map(residual).fold(SMatrix::zeros(), |sum, r| sum + r * r.transpose())
    }
}

/// The solution x of m x = right by LU with partial pivoting; a zero pivot is the only sign of a singular m.
///
/// Not `SMatrix::try_inverse`: up to order four it expands by cofactors, which is less accurate.
fn solved<const P: usize>(m: SMatrix<f64, P, P>, right: SMatrix<f64, P, P>) -> Option<SMatrix<f64, P, P>> {
    if P == 1 {
        return m.iter().all(|&entry| entry != 0.0).then(|| right.component_div(&m));
    }
    let dynamic = |matrix: SMatrix<f64, P, P>| DMatrix::from_fn(P, P, |i, j| matrix[(i, j)]);
    let x = dynamic(m).lu().solve(&dynamic(right))?;
    Some(SMatrix::from_fn(|i, j| x[(i, j)]))
}

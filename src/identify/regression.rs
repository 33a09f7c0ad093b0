//! The controlled autoregression, as a system whose state is its coefficients.

use std::sync::Arc;

use crate::matrix::{Matrix, SolveError};
use crate::model::{Before, Coefficient, Initial, Noise, Past, System, Timing};
use crate::scalar::{Field, Undefined};

/// What was read and put in before y_0; what is not told is 0.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct History<S> {
    /// y_{−1}, y_{−2}, …
    pub outputs: Vec<S>,
    /// u_{−1}, u_{−2}, …
    pub inputs: Vec<S>,
}

/// The autoregression with inputs whose coefficients θ = (a_1, …, a_p, b_1, …, b_q) are Gaussian:
/// `y_k = a_1 y_{k−1} + … + a_p y_{k−p} + b_1 u_{k−1} + … + b_q u_{k−q} + w_k`.
///
/// CKS-ARX: `y(t) = φᵀ(t−1)θ(t) + w(t), θ(t+1) = θ(t)`
///
/// [`filter`](crate::filter::filter) on [`Regression::system`] is recursive least squares, and exact whatever feedback
/// made the inputs: u_k may be any function of y_0, …, y_k that is finite, such as y³ or 1/y. The history is part of
/// what is given, and θ is Gaussian given it; w_k is white with variance `noise`.
///
/// # Examples
///
/// ```
/// use exact_kalman::filter::filter;
/// use exact_kalman::identify::{History, Regression};
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::Observation;
/// use exact_kalman::scalar::ratio;
///
/// let regression = Regression {
///     output_lags: 1,
///     input_lags: 1,
///     mean: Matrix::zeros(2, 1),
///     covariance: Matrix::identity(2),
///     noise: ratio(1, 1),
///     history: History { outputs: vec![ratio(1, 1)], inputs: vec![] },
/// };
/// let outputs = [ratio(2, 1), ratio(3, 1)];
/// // u = y³
/// let system = regression.system(|past| Ok(past.last_entry(0).cloned().unwrap_or(ratio(0, 1)).pow(3)));
/// let trace = filter(&system.realised(&outputs.clone().map(|y| Observation::complete([y])))?)?;
/// let batch = regression.at_once(&outputs, &[ratio(8, 1), ratio(27, 1)])?;
/// assert_eq!(trace.records[1].filtered.mean, batch.mean);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Regression<S> {
    /// p, the number of earlier outputs in a regressor.
    pub output_lags: usize,
    /// q, the number of earlier inputs in a regressor.
    pub input_lags: usize,
    /// The prior mean of θ, (p+q)×1.
    pub mean: Matrix<S>,
    /// The prior covariance of θ, (p+q)×(p+q); it may be singular.
    pub covariance: Matrix<S>,
    /// The variance of w.
    pub noise: S,
    /// What came before y_0.
    pub history: History<S>,
}

/// The law of θ given the data.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Posterior<S> {
    /// E θ, (p+q)×1.
    pub mean: Matrix<S>,
    /// cov θ, (p+q)×(p+q).
    pub covariance: Matrix<S>,
}

/// The information form needs P₀⁻¹ and a noise that is not zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the batch form needs a positive definite prior covariance and a positive noise variance; use the recursion")]
pub struct SingularPrior;

impl<S: Field + Send + Sync> Regression<S> {
    /// The system whose filter is recursive least squares; `law` tells u_k from y_0, …, y_k.
    ///
    /// The law is shown the past up to y_k only, with step k, so feedback cannot look ahead. Inputs that were recorded are a law
    /// as well: see [`Regression::recorded`].
    pub fn system(&self, law: impl Fn(Past<'_, S>) -> Result<S, Undefined> + Send + Sync + 'static) -> System<S> {
        let count = self.output_lags + self.input_lags;
        let regression = self.clone();
        let law = Arc::new(law);
        let row = move |past: Past<'_, S>| {
            let output = |k: usize| past.entry(k, 0).cloned().ok_or(Undefined::Missing);
            let input = |k: usize| law(past.truncated(k + 1).at(k));
            regression.regressor(past.step(), output, input)
        };
        System {
            timing: Timing::Arriving,
            initial: Initial::new(Before::Transition, self.mean.clone(), self.covariance.clone()),
            transition: Matrix::identity(count).into(),
            observation: Coefficient::adapted(row),
            noise: Noise::Covariances {
                process: Matrix::zeros(count, count).into(),
                cross: None,
                observation: Matrix::column(vec![self.noise.clone()]).into(),
            },
            input: None,
            observation_input: None,
        }
    }

    /// The same system for inputs u_0, u_1, … that were recorded; those that a regressor needs must be there.
    pub fn recorded(&self, inputs: Vec<S>) -> System<S> {
        self.system(move |past| inputs.get(past.step()).cloned().ok_or(Undefined::Missing))
    }

    /// φᵀ of y_k, 1×(p+q).
    fn regressor(
        &self,
        k: usize,
        output: impl Fn(usize) -> Result<S, Undefined>,
        input: impl Fn(usize) -> Result<S, Undefined>,
    ) -> Result<Matrix<S>, Undefined> {
        let earlier = |history: &[S], lag: usize| history.get(lag - k - 1).cloned().unwrap_or_else(S::zero);
        let outputs = (1..=self.output_lags)
            .map(|lag| if lag <= k { output(k - lag) } else { Ok(earlier(&self.history.outputs, lag)) });
        let inputs = (1..=self.input_lags)
            .map(|lag| if lag <= k { input(k - lag) } else { Ok(earlier(&self.history.inputs, lag)) });
        let row = outputs.chain(inputs).collect::<Result<Vec<_>, _>>()?;
        Ok(Matrix::from_fn(1, row.len(), |_, j| row[j].clone()))
    }

    /// The batch answer `(P₀⁻¹ + ΦᵀΦ/r)⁻¹ (P₀⁻¹θ₀ + Φᵀy/r)` with r the noise variance: the second route to the last
    /// step of the recursion.
    ///
    /// # Errors
    ///
    /// [`SingularPrior`] if P₀ or r has no inverse.
    ///
    /// # Panics
    ///
    /// If there are fewer inputs than the regressors need, or the shapes of the prior do not fit.
    pub fn at_once(&self, outputs: &[S], inputs: &[S]) -> Result<Posterior<S>, SingularPrior> {
        let rows = (0..outputs.len()).map(|k| {
            let row = self.regressor(k, |k| Ok(outputs[k].clone()), |k| Ok(inputs[k].clone()));
            row.unwrap_or_else(|_| unreachable!("recorded values are there"))
        });
        let phi = rows.fold(Matrix::zeros(0, self.mean.rows()), |phi, row| phi.above(&row));
        let share = S::one().over(&self.noise).map_err(|_| SingularPrior)?;
        let prior = inverse(&self.covariance)?;
        let weighted = phi.transpose().scaled(&share);
        let covariance = inverse(&(&prior + &weighted * &phi))?;
        let mean = &covariance * (prior * &self.mean + weighted * Matrix::column(outputs.to_vec()));
        Ok(Posterior { mean, covariance })
    }
}

fn inverse<S: Field>(matrix: &Matrix<S>) -> Result<Matrix<S>, SingularPrior> {
    matrix.inverse().map_err(|error: SolveError| match error {
        SolveError::Singular { .. } | SolveError::Undecided(_) => SingularPrior,
    })
}

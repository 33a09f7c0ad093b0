//! Floor 4 · Systems from data: the estimators of Anderson et al. and recursive least squares.
//!
//! * [`Estimator`] estimates A from y(1), …, y(n) alone, and the covariances of one-step and two-step residuals;
//!   [`noise_covariances`] recovers V and W from them; [`adaptive_filter`] runs the filter on the estimates.
//! * [`Regression`] is the controlled autoregression whose coefficients are the state of a filter: recursive least
//!   squares is [`filter`](crate::filter::filter) on it, and [`Regression::at_once`] is the batch answer.
//!
//! Every estimate from rational data is an exact fraction. Holds no random number and no floating point: the f64 twins
//! live in `float`, simulations in `reproduce`.
//!
//! Papers: Anderson, Kleindorfer, Kleindorfer, Woodroofe 1969, section 2; Chen, Kumar, van Schuppen 1989, section 1.

mod adaptive;
mod estimator;
mod lagged_sums;
mod noise;
mod regression;
mod residuals;
mod series;

pub use adaptive::{AdaptiveError, AdaptiveRecord, Belief, EstimatedModel, Obstacle, adaptive_filter};
pub use estimator::{EstimateError, Estimates, Estimator, estimates};
pub use noise::{NoiseCovariances, SingularTransition, noise_covariances};
pub use regression::{History, Posterior, Regression, SingularPrior};
pub use residuals::ResidualCovariances;
pub use series::{Series, SeriesError};

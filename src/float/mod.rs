//! Floor 3 · Kalman filters in `f64`, on nalgebra.
//!
//! Holds the recursion in the forms that people run, each in a file of its own, written independently of the
//! exact filter: the one must be able to be right when the other is wrong. Holds no verdict on what comes out.
//!
//! All forms compute the same conditional moments, and differ in what rounding does to them. With x̂, P the
//! predicted moments, M₁ the covariance of x − x̂ with the noise of y (arriving timing) and M₂ that of the noise
//! of the departing transition with the noise of y (departing timing):
//!
//! ```text
//! ν  = y − Gv − C x̂                        Γ  = P Cᵀ + M₁
//! S  = C P Cᵀ + C M₁ + M₁ᵀCᵀ + R           K  = Γ S⁻¹        K₊ = (A P Cᵀ + M₂) S⁻¹
//! filtered: x̂ + K ν,  P − K S Kᵀ           ahead: A x̂ + B u + K₊ ν,  A P Aᵀ + Q − K₊ S K₊ᵀ
//! ```
//!
//! A further form is one file that implements `Recursion`, and its variant in [`Form`]. [`predict_extended`] is the same
//! recursion on nonlinear systems.
//!
//! Beside the forms stand the parallel sum, the fixed point of the map of Riccati and Stein's equation.
//! [`Estimator`] and [`AdaptiveFilter`] are the twins of the exact ones in the room `identify`, which they do not know
//! (AK-2.1, AK-2.2, AK-B.hat, AK-2.3a, AK-2.4). [`FloatMode`] and [`expected_covariances`] are those of the random equation of Riccati.

mod adaptive;
mod ahead;
mod error;
mod estimator;
mod extended;
mod factor;
mod factored;
mod fixed_point;
mod form;
mod information;
mod joseph;
mod matrix_error;
mod mixture;
mod moments;
mod observed;
mod parallel_sum;
mod pseudo_inverse;
mod random_riccati;
mod rank;
mod recursion;
mod sequential;
mod short;
mod square_root;
mod stein;
mod svd;
mod symmetric;
mod symmetrised;
mod textbook;
mod transition;
mod ud;

pub use adaptive::{AdaptiveFilter, Gained};
pub use error::{FloatError, Inverted};
pub use estimator::{Estimates, Estimator, NoInverse};
pub use extended::{
    AdditiveNoise, ExtendedError, ExtendedObstacle, ExtendedStep, ExtendedSystem, ExtendedTrace, Function,
    Linearisation, Linearised, predict_extended,
};
pub use fixed_point::riccati_fixed_point;
pub use form::{Form, filter, predict_ahead};
pub use matrix_error::FloatMatrixError;
pub use mixture::{MixtureError, MixtureEstimate, MixturePart, estimate_mixture};
pub use parallel_sum::parallel_sum;
pub use random_riccati::{FloatMode, expected_covariances, gramian};
pub use stein::stein_solution;

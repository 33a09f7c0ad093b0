//! A nonlinear system with additive noise, and how it is made linear.

use crate::matrix::Matrix;

/// A function of the state at one point: its value and its derivative there.
#[derive(Clone, Debug, PartialEq)]
pub struct Linearised {
    /// The value, one column.
    pub value: Matrix<f64>,
    /// The Jacobian matrix, one column per state.
    pub jacobian: Matrix<f64>,
}

/// The point at which the transition is made linear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Linearisation {
    /// x̂(k|k−1), the predictor form: `x̂(k+1|k) = f(x̂(k|k−1)) + K₊ν`.
    Prediction,
    /// x̂(k|k), the filter form: `x̂(k+1|k) = f(x̂(k|k)) + DFᵀ S⁻¹ν`.
    Filtered,
}

/// The covariances of the noises added with index k.
#[derive(Clone, Debug, PartialEq)]
pub struct AdditiveNoise {
    /// Q = D Dᵀ, n×n: of the transition.
    pub process: Matrix<f64>,
    /// D Fᵀ, n×m: between the transition that departs from k and y_k.
    pub cross: Matrix<f64>,
    /// R = F Fᵀ, m×m: of y_k.
    pub observation: Matrix<f64>,
}

/// A function of step and state, with its derivative.
pub type Function<'a, E> = dyn Fn(usize, &Matrix<f64>) -> Result<Linearised, E> + 'a;

/// The system `x_{k+1} = f_k(x_k) + D w_k, y_k = h_k(x_k) + F w_k`, in departing timing, with what is believed of x_0.
#[derive(Clone, Copy)]
pub struct ExtendedSystem<'a, E> {
    /// x̂ of x_0 before y_0, n×1.
    pub mean: &'a Matrix<f64>,
    /// Its covariance, n×n.
    pub covariance: &'a Matrix<f64>,
    /// f, n×1 and n×n.
    pub transition: &'a Function<'a, E>,
    /// h, m×1 and m×n.
    pub observation: &'a Function<'a, E>,
    /// The noises of step k.
    pub noise: &'a dyn Fn(usize) -> AdditiveNoise,
    /// Where f is made linear; h always is at x̂(k|k−1).
    pub linearisation: Linearisation,
}

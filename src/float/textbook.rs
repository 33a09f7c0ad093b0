//! The form of the textbooks: S inverted.

use nalgebra::DMatrix;

use super::error::Obstacle;
use super::moments::Moments;
use super::observed::Observed;
use super::recursion::{MomentRecursion, Update};
use super::short;
use super::transition::{Departure, Transition};

/// The inverse of S by LU, as `numpy.linalg.inv` has it, and (I − KC)P.
pub(super) struct Textbook;

impl MomentRecursion for Textbook {
    const NAME: &'static str = "textbook";
    const DESCRIPTION: &'static str = "S inverted by LU, covariance (I - KC)P";

    fn predicted(belief: &Moments, transition: &Transition) -> Result<Moments, Obstacle> {
        Ok(short::predicted(belief, transition))
    }

    fn updated(
        belief: &Moments,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Moments>, Obstacle> {
        short::updated(belief, observed, departure, inverse)
    }
}

/// S⁻¹; a pivot that is exactly zero is the only sign of a singular matrix, as in LAPACK.
fn inverse(s: &DMatrix<f64>) -> Result<DMatrix<f64>, Obstacle> {
    s.clone().lu().try_inverse().ok_or(Obstacle::Singular)
}

//! The form of most libraries: (I − KC)P, made symmetric.

use nalgebra::DMatrix;

use super::error::Obstacle;
use super::moments::Moments;
use super::observed::Observed;
use super::recursion::{MomentRecursion, Update};
use super::short;
use super::symmetric::with_transpose;
use super::transition::{Departure, Transition};

/// (I − KC)P as in the textbooks, and after each step `(P + Pᵀ)/2`.
///
/// Carries mean and covariance. Keeping the symmetric part is the customary remedy (Grewal and Andrews, *Kalman
/// Filtering*, ch. 6): it ends the drift of the two triangles, which for an unstable A grows without bound. It mends nothing else: a variance that
/// cancels is as wrong as before, and may be negative.
pub(super) struct Symmetrised;

impl MomentRecursion for Symmetrised {
    const NAME: &'static str = "symmetrised";
    const DESCRIPTION: &'static str = "S inverted by LU, covariance (I - KC)P, then its symmetric part";

    fn predicted(belief: &Moments, transition: &Transition) -> Result<Moments, Obstacle> {
        Ok(symmetric(short::predicted(belief, transition)))
    }

    fn updated(
        belief: &Moments,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Moments>, Obstacle> {
        let inverse = |s: &DMatrix<f64>| symmetric_part(s).lu().try_inverse().ok_or(Obstacle::Singular);
        let update = short::updated(belief, observed, departure, inverse)?;
        Ok(Update {
            innovation_covariance: symmetric_part(&update.innovation_covariance),
            filtered: symmetric(update.filtered),
            ahead: update.ahead.map(symmetric),
            ..update
        })
    }
}

fn symmetric(Moments { mean, covariance }: Moments) -> Moments {
    Moments { mean, covariance: symmetric_part(&covariance) }
}

fn symmetric_part(p: &DMatrix<f64>) -> DMatrix<f64> {
    with_transpose(p) * 0.5
}

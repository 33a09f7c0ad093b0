//! Entries of a reading that follow from others.
//!
//! If v ≠ 0 has vᵀC = 0 and vᵀR = 0, for the observation matrix and its noise, then vᵀS = 0 for every covariance of the
//! state: a sensor repeats others, noise included. Such entries are left out; what remains may have a regular S, which an
//! enclosure can decide, and the others are linear in it.

use crate::gaussian::Inconsistent;
use crate::matrix::{Echelon, Matrix};
use crate::model::Step;
use crate::scalar::{Interval, Rational, Scalar as _};

/// Which entries are used, and how the others follow from them.
#[derive(Clone, Debug, Default)]
pub(super) struct Readings {
    /// The entries that are used, as indices of sensors.
    pub(super) kept: Vec<usize>,
    /// L, with `all observed entries = L · kept ones`; nothing if all are kept.
    combination: Option<Matrix<Rational>>,
}

impl Readings {
    /// Whether no entry is left out.
    #[cfg(feature = "judge")]
    pub(super) fn are_complete(&self) -> bool {
        self.combination.is_none()
    }

    pub(super) fn of(step: &Step<Rational>) -> Self {
        let observed = step.reading.present();
        let rows = step.observation.select_rows(&observed).beside(&step.observation_noise.select(&observed, &observed));
        // The columns with a pivot are the rows that do not follow from those before them.
        let columns = rows.transpose();
        let Ok(echelon) = Echelon::of(&columns, observed.len()) else {
            return Self { kept: observed, combination: None };
        };
        if echelon.rank() == observed.len() {
            return Self { kept: observed, combination: None };
        }
        let Ok(reduced) = echelon.reduced() else { return Self { kept: observed, combination: None } };
        let combination = Matrix::from_fn(observed.len(), echelon.rank(), |i, k| reduced[(k, i)].clone());
        let kept = echelon.pivots().iter().map(|&place| observed[place]).collect();
        Self { kept, combination: Some(combination) }
    }

    /// y − c for the entries that are used.
    pub(super) fn seen(&self, step: &Step<Rational>) -> Matrix<Rational> {
        let (all, observed) = (all_seen(step), step.reading.present());
        let place = |sensor: &usize| observed.iter().position(|other| other == sensor);
        all.select_rows(&self.kept.iter().filter_map(place).collect::<Vec<_>>())
    }

    /// A proof that what is left out does not follow from the entries that are used, if it does not.
    ///
    /// With z = y − c, `(I − LL⁺) z` is orthogonal to the image of L, so to S = L·L′ and to every Cx̂: its variance is zero, and its
    /// product with z is its own square. Where the covariance of the entries that are used is regular, it is the direction that
    /// the exact filter shows.
    pub(super) fn contradiction(&self, step: &Step<Rational>) -> Option<Inconsistent<Rational>> {
        let combination = self.combination.as_ref()?;
        let all = all_seen(step);
        if combination * self.seen(step) == all {
            return None;
        }
        let adjoint = combination.transpose();
        let inverse = (&adjoint * combination).inverse().ok()?;
        let direction = &all - combination * (inverse * (adjoint * &all));
        let value = (direction.transpose() * &all)[(0, 0)].clone();
        Some(Inconsistent { direction, value }.simplified())
    }

    /// All entries of an innovation and of its covariance, from those of the entries that are used.
    pub(super) fn all(
        &self,
        innovation: Matrix<Interval>,
        covariance: Matrix<Interval>,
        bits: u64,
    ) -> (Matrix<Interval>, Matrix<Interval>) {
        let Some(combination) = &self.combination else { return (innovation, covariance) };
        let image = |right: &Matrix<Interval>| product(combination, right, bits);
        let half = image(&covariance).transpose();
        (image(&innovation), image(&half))
    }

    /// The covariances of a state with all entries, from those with the entries that are used: `Γ Lᵀ`.
    pub(super) fn cross(&self, kept: Matrix<Interval>, bits: u64) -> Matrix<Interval> {
        let Some(combination) = &self.combination else { return kept };
        product(combination, &kept.transpose(), bits).transpose()
    }

    /// The gain with the pseudo-inverse of the covariance of all entries, from that of the entries that are used: `K L⁺`, since
    /// `(LSLᵀ)⁺ = L (LᵀL)⁻¹ S⁻¹ (LᵀL)⁻¹ Lᵀ` for an L of full column rank.
    pub(super) fn gain(&self, kept: Matrix<Interval>, bits: u64) -> Matrix<Interval> {
        let Some(combination) = &self.combination else { return kept };
        let square = combination.transpose() * combination;
        let Ok(inverse) = square.pseudo_inverse() else { return kept };
        product(&(combination * inverse), &kept.transpose(), bits).transpose()
    }

    /// `det LᵀL`, by which the product of the eigenvalues of `LSLᵀ` that are not zero exceeds det S; nothing where it is one.
    pub(super) fn determinant(&self) -> Option<Rational> {
        let combination = self.combination.as_ref()?;
        (combination.transpose() * combination).determinant().ok()
    }
}

/// y − c for all that is observed.
fn all_seen(step: &Step<Rational>) -> Matrix<Rational> {
    let all = step.reading.values();
    if step.observation_input.is_zero() {
        return all;
    }
    all - step.observation_input.select_rows(&step.reading.present())
}

/// Fractions times enclosed numbers.
fn product(left: &Matrix<Rational>, right: &Matrix<Interval>, bits: u64) -> Matrix<Interval> {
    Matrix::from_fn(left.rows(), right.columns(), |i, j| {
        let terms = (0..right.rows()).filter(|&k| left[(i, k)] != Rational::zero());
        let term = |k: usize| match &left[(i, k)] {
            one if *one == Rational::one() => right[(k, j)].clone(),
            other => right[(k, j)].times(&Interval::of(other, bits), bits),
        };
        terms.map(term).reduce(|sum, term| sum.plus(&term, bits)).unwrap_or_else(Interval::zero)
    })
}

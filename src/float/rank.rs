//! What counts as zero: the one place where forms decide on ranks.
//!
//! A number that a sum of terms t₁ + … + t_k leaves is zero where it is no more than the rounding of those terms could have
//! made it: |t₁ + … + t_k| ≤ 8kε(|t₁| + … + |t_k|), ε = 2⁻⁵². The terms are what it was computed from, so the decision is the same in
//! all units, also where each state and each sensor has one of its own; nothing is compared with a fixed number.
//!
//! Where sums are made of sums, as in a chain of reflections, the terms of each entry are carried along with it: what an earlier
//! step rounded off a large number is still there after the number itself has cancelled. That begins with the factors of the noise: an
//! entry of them that ought to be zero is what is left of a difference, and small beside its own terms only.
//!
//! A sum that is no more than that has no right digit left, so nothing is lost that was there. What is kept by the decision is
//! structure: a reading that can say nothing new has an innovation of variance zero and not 10⁻¹⁷, and nothing is
//! divided by that. A number that is small because its terms are is never taken for zero.

use nalgebra::{DMatrix, DVector};

/// Bounds of rounding errors are rarely met, and never exceeded eightfold by the few sums that lie between data and a decision.
const SLACK: f64 = 8.0;

/// Whether a sum of `count` terms is no more than their rounding; `terms` is the sum of their magnitudes.
pub(super) fn is_rounding(sum: f64, terms: f64, count: usize) -> bool {
    #[expect(clippy::cast_precision_loss, reason = "no matrix has 2^53 rows")]
    let count = count as f64;
    sum.abs() <= SLACK * count * f64::EPSILON * terms
}

/// A sum, or zero where it is no more than the rounding of its terms.
pub(super) fn rounded_off(sum: f64, terms: f64, count: usize) -> f64 {
    if is_rounding(sum, terms, count) { 0.0 } else { sum }
}

/// `a b`, entries that are nothing but rounding set to zero.
pub(super) fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    product_of_terms(a, b).0
}

/// The same with the magnitudes of the terms of each entry.
pub(super) fn product_of_terms(a: &DMatrix<f64>, b: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let Computed { entries, terms } = Computed::from(b.clone()).image(a);
    (entries, terms)
}

/// Numbers with the magnitudes of what each was computed from.
#[derive(Clone, Debug)]
pub(super) struct Computed {
    pub(super) entries: DMatrix<f64>,
    pub(super) terms: DMatrix<f64>,
}

impl From<DMatrix<f64>> for Computed {
    /// Numbers as they are given.
    fn from(entries: DMatrix<f64>) -> Self {
        Self { terms: entries.abs(), entries }
    }
}

impl Computed {
    /// `a x`, entries that are nothing but rounding set to zero.
    pub(super) fn image(&self, a: &DMatrix<f64>) -> Self {
        let terms = a.abs() * &self.terms;
        Self { entries: (a * &self.entries).zip_map(&terms, |sum, terms| rounded_off(sum, terms, a.ncols())), terms }
    }

    pub(super) fn beside(&self, other: &Self) -> Self {
        self.joined(other, side_by_side)
    }

    pub(super) fn above(&self, other: &Self) -> Self {
        self.joined(other, stacked)
    }

    /// With columns of zeros in front.
    pub(super) fn behind_zeros(&self, columns: usize) -> Self {
        Self::from(DMatrix::zeros(self.entries.nrows(), columns)).beside(self)
    }

    /// Some of the rows.
    pub(super) fn rows(&self, first: usize, count: usize) -> Self {
        let [entries, terms] = [&self.entries, &self.terms].map(|matrix| matrix.rows(first, count).into_owned());
        Self { entries, terms }
    }

    fn joined(&self, other: &Self, join: impl Fn(&DMatrix<f64>, &DMatrix<f64>) -> DMatrix<f64>) -> Self {
        Self { entries: join(&self.entries, &other.entries), terms: join(&self.terms, &other.terms) }
    }
}

pub(super) fn side_by_side(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    let columns = left.ncols();
    DMatrix::from_fn(left.nrows(), columns + right.ncols(), |i, j| {
        if j < columns { left[(i, j)] } else { right[(i, j - columns)] }
    })
}

pub(super) fn stacked(above: &DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let rows = above.nrows();
    DMatrix::from_fn(
        rows + below.nrows(),
        above.ncols(),
        |i, j| {
            if i < rows { above[(i, j)] } else { below[(i - rows, j)] }
        },
    )
}

/// `p` without the rows and columns of components whose variance is nothing but the rounding of these terms: those are known.
pub(super) fn settled(mut p: DMatrix<f64>, terms: &DVector<f64>, count: usize) -> DMatrix<f64> {
    for i in 0..p.nrows() {
        if is_rounding(p[(i, i)], terms[i], count) {
            p.row_mut(i).fill(0.0);
            p.column_mut(i).fill(0.0);
        }
    }
    p
}

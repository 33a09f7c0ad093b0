//! What counts as zero: the one place where forms decide on ranks.
//!
//! A number that a sum of terms t₁ + … + t_k leaves is zero where it is no more than the rounding of those terms could have
//! made it: |t₁ + … + t_k| ≤ 8kε(|t₁| + … + |t_k|), ε = 2⁻⁵². The terms are what it was computed from, so the decision is the same in
//! all units, also where each state and each sensor has one of its own; nothing is compared with a fixed number.
//!
//! Where sums are made of sums, as in a chain of reflections, the terms of each entry are carried along with it: what an earlier
//! step rounded off a large number is still there after the number itself has cancelled.
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
    let terms = a.abs() * b.abs();
    ((a * b).zip_map(&terms, |sum, terms| rounded_off(sum, terms, a.ncols())), terms)
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

//! The units of a wrong answer.

use crate::judge::Scale;
use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar as _, ratio};
use crate::trace::{Quantity, Values};

/// The scale of a quantity of a wrong answer: the magnitudes of its own variances; those of the truth where its own are
/// zero, or nothing beside them.
pub(super) fn own_scale(quantity: Quantity, wrong: &Values<Rational>, truth: &Scale) -> Scale {
    let covariance = match quantity {
        Quantity::FilteredMean => Quantity::FilteredCovariance,
        Quantity::PredictedMean => Quantity::PredictedCovariance,
        Quantity::Innovation => Quantity::InnovationCovariance,
        other => other,
    };
    match wrong.get(&covariance) {
        Some(own) => truth.with(|i, theirs| magnitude(own, i, theirs)),
        None => truth.clone(),
    }
}

fn magnitude(own: &Matrix<Rational>, i: usize, theirs: &Rational) -> Rational {
    let zero = Rational::zero();
    let own = if own[(i, i)] < zero { own[(i, i)].negated() } else { own[(i, i)].clone() };
    // 512 bits leave 2⁻³⁰⁰ of what is zero.
    if own <= theirs.times(&ratio(1, 1 << 60).pow(5)) { theirs.clone() } else { own }
}

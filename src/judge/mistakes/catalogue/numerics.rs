//! What is added, ignored or kept for the sake of arithmetic.

use super::super::fault::Fault;
use super::super::problem::{Covariance, on_noise};
use super::super::real::Real;
use super::{Entry, Kind, Ways, entry};
use crate::matrix::Matrix;
use crate::scalar::{Rational, exact_value, ratio};

/// 10^−power, as the double that a program has.
fn small(power: i32) -> Rational {
    let value = format!("1e-{power}").parse().ok().and_then(exact_value);
    value.unwrap_or_else(|| ratio(0, 1))
}

/// Something added to the diagonal, in several sizes.
fn raised(covariance: Covariance) -> Ways {
    Ways::fading((3..=12).map(|power| {
        let change = move |matrix: &Matrix<Rational>| matrix + Matrix::identity(matrix.rows()).scaled(&small(power));
        (format!("10^-{power}"), on_noise(covariance, change))
    }))
}

fn sizes(powers: impl IntoIterator<Item = i32>, fault: impl Fn(Real) -> Fault) -> Vec<(String, Fault)> {
    powers.into_iter().map(|power| (format!("10^-{power}"), fault(Real::from(&small(power))))).collect()
}

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry(
            "innovation-covariance-raised",
            Kind::Mistake,
            [
                "you add a small number to the diagonal of the innovation covariance",
                "It is to be made invertible: psd_solve, jitter, a nugget.",
                "As many digits are lost as the number is large beside S; in small units all.",
                "Factorise S as it is, and decide its rank relative to its size.",
            ],
            raised(Covariance::Observation),
        ),
        entry(
            "process-noise-raised",
            Kind::Mistake,
            [
                "you add a small number to the diagonal of the process noise",
                "P is to be kept positive definite.",
                "States without noise are forgotten; in small units all.",
                "Use Joseph's form or a square root instead.",
            ],
            raised(Covariance::Process),
        ),
        entry(
            "filtered-covariance-raised",
            Kind::Mistake,
            [
                "you add a small number to the diagonal of the covariance after each update",
                "P is to be kept positive definite.",
                "What is known exactly is doubted; in small units all.",
                "Use Joseph's form or a square root instead.",
            ],
            Ways::fading(sizes(3..=12, Fault::FilteredCovarianceRaised)),
        ),
        entry(
            "covariance-rests-too-early",
            Kind::Mistake,
            [
                "you keep the predicted covariance from where its change is below an absolute tolerance",
                "A shortcut for steady filters whose tolerance knows no units.",
                "In small units the covariance rests at once, and gain and estimate are wrong for good.",
                "Set the tolerance to zero, or make it relative.",
            ],
            Ways::fading(sizes([4, 5, 6, 7, 8, 9, 10, 12], Fault::CovarianceRests)).and(Ways::fading(
                sizes([8, 10, 12, 16, 19], Fault::AllRest)
                    .into_iter()
                    .map(|(size, fault)| (format!("{size} for the sum of squares, and all covariances kept"), fault)),
            )),
        ),
        entry(
            "small-variances-ignored",
            Kind::Mistake,
            [
                "you do not use readings whose innovation has a variance below a tolerance",
                "It is taken for zero: a tolerance like the root of the machine's epsilon, absolute, or relative to a sensor in other units.",
                "Data in small units are ignored entirely.",
                "Decide what is zero relative to the size of the data.",
            ],
            Ways::fading(sizes([6, 7, 8, 9, 10, 12, 14, 19], Fault::SmallVariancesIgnored)).and(Ways::named([(
                "the root of a double's epsilon",
                Fault::SmallVariancesIgnored(Real::from(&ratio(1, 1 << 26))),
            )])),
        ),
    ]
}

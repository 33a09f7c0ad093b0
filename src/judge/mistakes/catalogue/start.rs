//! Initial laws that are not those of the case.

use super::super::problem::{Start, started};
use super::{Entry, Kind, Ways, entry};
use crate::scalar::ratio;

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry(
            "initial-mean-zero",
            Kind::Mistake,
            [
                "you begin with a mean of zero",
                "The default of a library was kept.",
                "Means are biased at first; covariances are right.",
                "Set the initial mean of the case.",
            ],
            Ways::one(started(Start::MeanZero)),
        ),
        entry(
            "initial-covariance-identity",
            Kind::Mistake,
            [
                "you begin with the identity as covariance",
                "The default of a library was kept.",
                "Too little or too much is believed of the start.",
                "Set the initial covariance of the case.",
            ],
            Ways::one(started(Start::CovarianceIdentity)),
        ),
        entry(
            "initial-covariance-zero",
            Kind::Mistake,
            [
                "you begin with a covariance of zero",
                "The initial state is taken as known.",
                "First readings are not believed, or hardly.",
                "Set the initial covariance of the case.",
            ],
            Ways::one(started(Start::CovarianceZero)),
        ),
        entry(
            "diffuse-part-ignored",
            Kind::Mistake,
            [
                "you leave out the diffuse part of the initial law",
                "The field `diffuse` was not read.",
                "What is unknown is taken as known: first readings are not believed.",
                "Treat the diffuse part exactly, or say that it is unsupported.",
            ],
            Ways::one(started(Start::WithoutDiffuse)),
        ),
        entry(
            "large-number-for-diffuse",
            Kind::Mistake,
            [
                "you put a large number in place of a diffuse start",
                "An initial variance of 10⁶, 10⁷ or the like is the customary way out.",
                "As many digits are lost as the number has zeros, once in what the start should not weigh, and once in rounding.",
                "Start from the first readings that determine the state, or carry the diffuse part beside the covariance.",
            ],
            Ways::named((0..=10).map(|power| {
                let factor = ratio(10_i64.pow(power), 1);
                (format!("10^{power} times it"), started(Start::DiffuseTimes(factor)))
            })),
        ),
    ]
}

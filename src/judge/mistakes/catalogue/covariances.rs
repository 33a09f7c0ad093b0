//! Covariances that are dropped, changed, or taken for each other.

use super::super::problem::{Covariance, noises_swapped, on_noise, root};
use super::{Entry, Kind, Ways, entry};
use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar as _, ratio};

fn nothing(matrix: &Matrix<Rational>) -> Matrix<Rational> {
    Matrix::zeros(matrix.rows(), matrix.columns())
}

fn diagonal(matrix: &Matrix<Rational>) -> Matrix<Rational> {
    let n = matrix.rows();
    Matrix::from_fn(n, n, |i, j| if i == j { matrix[(i, i)].clone() } else { Rational::zero() })
}

fn squares(matrix: &Matrix<Rational>) -> Matrix<Rational> {
    matrix.map(|entry| entry.times(entry))
}

fn roots(matrix: &Matrix<Rational>) -> Matrix<Rational> {
    matrix.map(root)
}

fn twice(matrix: &Matrix<Rational>) -> Matrix<Rational> {
    matrix.scaled(&ratio(2, 1))
}

const UNITS: &str =
    "The argument of a library is a standard deviation, and a variance is given, or the other way round.";

#[expect(clippy::too_many_lines, reason = "a list")]
pub(super) fn entries() -> Vec<Entry> {
    use Covariance::{Initial, Observation, Process};
    vec![
        entry(
            "process-noise-dropped",
            Kind::Mistake,
            [
                "you leave out the process noise",
                "The prediction of the covariance lacks + Q.",
                "Variances shrink without end, and the filter stops to listen.",
                "P becomes APAᵀ + Q.",
            ],
            Ways::one(on_noise(Process, nothing)),
        ),
        entry(
            "process-noise-twice",
            Kind::Mistake,
            [
                "you add the process noise twice",
                "Both the prediction and the update, or the start of the loop, add Q.",
                "Variances are too large, and estimates too restless.",
                "Add Q once in each transition.",
            ],
            Ways::one(on_noise(Process, twice)),
        ),
        entry(
            "observation-noise-dropped",
            Kind::Mistake,
            [
                "you leave out the observation noise",
                "The innovation covariance lacks + R.",
                "Readings are believed to the last digit.",
                "S is CPCᵀ + R.",
            ],
            Ways::one(on_noise(Observation, nothing)),
        ),
        entry(
            "process-noise-in-other-units",
            Kind::Mistake,
            [
                "you take the process noise squared, or its root",
                UNITS,
                "Variances of the state are wrong unless they are near 1.",
                "Give what is asked: here Q is a covariance.",
            ],
            Ways::named([("squared", on_noise(Process, squares)), ("its root", on_noise(Process, roots))]),
        ),
        entry(
            "observation-noise-in-other-units",
            Kind::Mistake,
            [
                "you take the observation noise squared, or its root",
                UNITS,
                "Readings get too much or too little weight.",
                "Give what is asked: here R is a covariance.",
            ],
            Ways::named([("squared", on_noise(Observation, squares)), ("its root", on_noise(Observation, roots))]),
        ),
        entry(
            "initial-covariance-in-other-units",
            Kind::Mistake,
            [
                "you take the initial covariance squared, or its root",
                UNITS,
                "Too little or too much is believed of the start.",
                "Give what is asked: here the initial law has a covariance.",
            ],
            Ways::named([("squared", on_noise(Initial, squares)), ("its root", on_noise(Initial, roots))]),
        ),
        entry(
            "noises-exchanged",
            Kind::Mistake,
            [
                "you take process and observation noise for each other",
                "Q and R are exchanged: some books use the one letter for the other.",
                "The filter trusts readings as much as it should trust the model.",
                "Exchange the two. It is seen only where both have one size.",
            ],
            Ways::one(noises_swapped()),
        ),
        entry(
            "process-noise-diagonal",
            Kind::Mistake,
            [
                "you use only the diagonal of the process noise",
                "The library takes a vector of variances.",
                "Position and velocity are taken to be disturbed independently.",
                "Give the whole matrix.",
            ],
            Ways::one(on_noise(Process, diagonal)),
        ),
        entry(
            "observation-noise-diagonal",
            Kind::Mistake,
            [
                "you use only the diagonal of the observation noise",
                "The library takes a vector of variances, or treats one sensor after the other.",
                "What sensors have in common is counted twice.",
                "Give the whole matrix, or decorrelate the sensors before they are treated one by one.",
            ],
            Ways::one(on_noise(Observation, diagonal)),
        ),
        entry(
            "initial-covariance-diagonal",
            Kind::Mistake,
            [
                "you use only the diagonal of the initial covariance",
                "The library takes a vector of variances.",
                "What is known of combinations of the first state is lost.",
                "Give the whole matrix.",
            ],
            Ways::one(on_noise(Initial, diagonal)),
        ),
    ]
}

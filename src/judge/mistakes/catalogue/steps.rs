//! Coefficients of another step than their own.

use super::super::problem::{Part, frozen, of_another_step, transposed};
use super::{Entry, Kind, Ways, entry};

/// The index of a coefficient, shifted.
fn shifted(name: &'static str, part: Part, text: [&'static str; 4]) -> Entry {
    let ways =
        [("of the step before", of_another_step(part, false)), ("of the next step", of_another_step(part, true))];
    entry(name, Kind::Mistake, text, Ways::named(ways))
}

/// A coefficient that is kept.
fn kept(name: &'static str, part: Part, text: [&'static str; 4]) -> Entry {
    let ways = [("the first", frozen(part, true)), ("the last", frozen(part, false))];
    entry(name, Kind::Mistake, text, Ways::named(ways))
}

const OFF_BY_ONE: &str = "An index that is off by one; constant models do not show it.";
const SETUP: &str = "The filter is set up once, before the loop.";

#[expect(clippy::too_many_lines, reason = "a list")]
pub(super) fn entries() -> Vec<Entry> {
    vec![
        shifted(
            "transition-of-another-step",
            Part::Transition,
            [
                "you use the transition matrix of another step than its own",
                OFF_BY_ONE,
                "With irregular sampling each interval is used for its neighbour.",
                "Transition k leads out of k if the timing is departing, into k if it is arriving.",
            ],
        ),
        shifted(
            "observation-matrix-of-another-step",
            Part::Observation,
            [
                "you use the observation matrix of another step than its own",
                OFF_BY_ONE,
                "Readings are taken for those of other sensors.",
                "The observation matrix with index k belongs to y_k.",
            ],
        ),
        shifted(
            "process-noise-of-another-step",
            Part::ProcessNoise,
            [
                "you use the process noise of another step than its own",
                OFF_BY_ONE,
                "Variances grow too early or too late.",
                "The process noise has the index of its transition.",
            ],
        ),
        shifted(
            "observation-noise-of-another-step",
            Part::ObservationNoise,
            [
                "you use the observation noise of another step than its own",
                OFF_BY_ONE,
                "Good readings get the weight of bad ones.",
                "The observation noise with index k belongs to y_k.",
            ],
        ),
        shifted(
            "input-of-another-step",
            Part::Input,
            [
                "you use the known input of another step than its own",
                OFF_BY_ONE,
                "The state is moved too early or too late.",
                "The input has the index of its transition.",
            ],
        ),
        kept(
            "transition-frozen",
            Part::Transition,
            [
                "you use one transition matrix for all steps",
                SETUP,
                "Irregular sampling is taken for regular.",
                "Take the matrix of each step.",
            ],
        ),
        kept(
            "observation-matrix-frozen",
            Part::Observation,
            [
                "you use one observation matrix for all steps",
                SETUP,
                "Readings are taken for those of other sensors.",
                "Take the matrix of each step.",
            ],
        ),
        kept(
            "process-noise-frozen",
            Part::ProcessNoise,
            [
                "you use one process noise for all steps",
                "Only the first covariance of a list is used; published packages did so for years.",
                "Variances and gains are wrong wherever the noise varies.",
                "Take the covariance of each step.",
            ],
        ),
        kept(
            "observation-noise-frozen",
            Part::ObservationNoise,
            [
                "you use one observation noise for all steps",
                "Only the first covariance of a list is used; published packages did so for years.",
                "Good readings get the weight of bad ones.",
                "Take the covariance of each step.",
            ],
        ),
        kept(
            "input-frozen",
            Part::Input,
            [
                "you use one known input for all steps",
                SETUP,
                "The state is moved by what was true at another time.",
                "Take the input of each step.",
            ],
        ),
        entry(
            "transition-transposed",
            Kind::Mistake,
            [
                "you use the transition matrix transposed",
                "Matrices stored by columns are read by rows, or x is a row in the formulas that were copied.",
                "Position drives velocity instead of the other way round.",
                "Rows of the matrix belong to the new state.",
            ],
            Ways::one(transposed(Part::Transition)),
        ),
        entry(
            "observation-matrix-transposed",
            Kind::Mistake,
            [
                "you use a square observation matrix transposed",
                "Matrices stored by columns are read by rows.",
                "Seen only where there are as many sensors as states; elsewhere the shapes do not fit.",
                "Rows of the matrix belong to sensors.",
            ],
            Ways::one(transposed(Part::Observation)),
        ),
    ]
}

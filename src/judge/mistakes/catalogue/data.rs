//! Inputs that are left out, and gaps in the data.

use super::super::problem::{Gap, gaps, negated, without};
use super::{Entry, Kind, Ways, entry};

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry(
            "input-dropped",
            Kind::Mistake,
            [
                "you leave out the known input of the state",
                "The field was not read, or the library has no argument for it.",
                "Means lag behind every manoeuvre; covariances are right.",
                "Add Bu to the predicted mean.",
            ],
            Ways::one(without(true)),
        ),
        entry(
            "input-of-the-other-sign",
            Kind::Mistake,
            [
                "you take the known input of the state with the other sign",
                "It was subtracted, as feedback often is.",
                "Means move the wrong way; covariances are right.",
                "Add Bu to the predicted mean.",
            ],
            Ways::one(negated(true)),
        ),
        entry(
            "observation-input-dropped",
            Kind::Mistake,
            [
                "you leave out the known input of the observation",
                "The field was not read, or the library has no argument for it.",
                "Means are biased by the offset; covariances are right.",
                "Subtract Gv from the reading, or add it to its prediction.",
            ],
            Ways::one(without(false)),
        ),
        entry(
            "observation-input-of-the-other-sign",
            Kind::Mistake,
            [
                "you take the known input of the observation with the other sign",
                "It was added to the reading instead of subtracted.",
                "Means are biased by twice the offset; covariances are right.",
                "Subtract Gv from the reading, or add it to its prediction.",
            ],
            Ways::one(negated(false)),
        ),
        entry(
            "missing-as-zero",
            Kind::Mistake,
            [
                "you read missing entries as zeros",
                "null became 0 on the way, or an array was filled with zeros.",
                "The estimate is pulled towards zero, and believes it.",
                "Leave out the rows of entries that are missing.",
            ],
            Ways::one(gaps(Gap::Zero)),
        ),
        entry(
            "missing-as-last-reading",
            Kind::Mistake,
            [
                "you read missing entries as the last reading of their sensor",
                "Data were filled forward before they were filtered.",
                "One reading is used many times: variances shrink that should grow.",
                "Leave out the rows of entries that are missing.",
            ],
            Ways::one(gaps(Gap::LastReading)),
        ),
        entry(
            "missing-entry-drops-the-reading",
            Kind::Mistake,
            [
                "you drop a whole reading where one of its entries is missing",
                "A mask over the whole vector: any missing entry makes the update be skipped.",
                "What the other sensors said is lost.",
                "Leave out the rows of the missing entries alone.",
            ],
            Ways::one(gaps(Gap::WholeReading)),
        ),
        entry(
            "no-prediction-in-gaps",
            Kind::Mistake,
            [
                "you let no time pass where nothing is read",
                "Steps without a reading are skipped, the prediction with them.",
                "The state stands still in gaps, and its variance too.",
                "Predict at every step; update where there is a reading.",
            ],
            Ways::one(gaps(Gap::NoTime)),
        ),
    ]
}

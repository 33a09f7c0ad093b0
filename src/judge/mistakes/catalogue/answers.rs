//! What is done with a right answer before it is handed out.

use super::super::rearrangement::Rearrangement;
use super::{Entry, Kind, Ways, Wrong, entry};

#[expect(clippy::too_many_lines, reason = "a list")]
pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry(
            "predicted-for-filtered",
            Kind::Mistake,
            [
                "you return the predicted moments where the filtered ones are asked",
                "The state is recorded before the reading is used, or the names of a library were misread.",
                "Each answer lacks its newest reading: estimates lag, and variances are too large.",
                "Record the state after the update with y_k as filtered.",
            ],
            Ways::one(Rearrangement::PredictedForFiltered),
        ),
        entry(
            "filtered-for-predicted",
            Kind::Mistake,
            [
                "you return the filtered moments where the predicted ones are asked",
                "The state is recorded after the reading is used, or one variable serves for both.",
                "What is said before y_k already knows it: one-step errors look too small, and so do variances.",
                "Record the state before the update with y_k as predicted.",
            ],
            Ways::one(Rearrangement::FilteredForPredicted),
        ),
        entry(
            "filtered-and-predicted-exchanged",
            Kind::Mistake,
            [
                "you return filtered and predicted moments each under the name of the other",
                "Prior and posterior, or a-priori and a-posteriori, taken for each other.",
                "The filtered estimate lacks its newest reading, and the predicted one already has it.",
                "Exchange the names.",
            ],
            Ways::one(Rearrangement::Exchanged),
        ),
        entry(
            "next-prediction-for-filtered",
            Kind::Mistake,
            [
                "you return the prediction of the next step where the filtered moments of this one are asked",
                "The loop updates, then predicts, and records its state at the end.",
                "The answer is about the next moment; variances hold one step of process noise too much.",
                "Record the state between update and prediction.",
            ],
            Ways::one(Rearrangement::NextPredictionForFiltered),
        ),
        entry(
            "next-prediction-for-predicted",
            Kind::Reading,
            [
                "you count the prediction that is made at step k as that of step k; it is that of step k + 1",
                "Libraries that store x(k+1|k) under index k, beside the filtered state.",
                "Predictions come one step early. Their numbers are right.",
                "Give with y_k what was predicted of x_k before it was read: shift the list by one.",
            ],
            Ways::one(Rearrangement::NextPredictionForPredicted),
        ),
        entry(
            "steps-late",
            Kind::Reading,
            [
                "you return with each step what belongs to the step before it",
                "A list that begins with the initial state, or an index that begins at 1.",
                "Right numbers, one step late.",
                "Begin the answer with the step of the first reading.",
            ],
            Ways::one(Rearrangement::Late),
        ),
        entry(
            "steps-early",
            Kind::Reading,
            [
                "you return with each step what belongs to the step after it",
                "A list that lacks its first entry, taken to be the initial state.",
                "Right numbers, one step early.",
                "Begin the answer with the step of the first reading.",
            ],
            Ways::one(Rearrangement::Early),
        ),
        entry(
            "standard-deviations-for-variances",
            Kind::Mistake,
            [
                "you return standard deviations where variances are asked",
                "A plotting variable handed out, or a library whose field is a standard deviation.",
                "Where variances are below 1 they seem larger than they are, above 1 smaller.",
                "Return the covariance matrix itself.",
            ],
            Ways::one(Rearrangement::Roots),
        ),
        entry(
            "factor-for-covariance",
            Kind::Mistake,
            [
                "you return a triangular factor where the covariance is asked",
                "A square-root filter hands out its factor S of P = SSᵀ.",
                "Entries have the wrong units, and the matrix is not symmetric.",
                "Return SSᵀ.",
            ],
            Ways::named([
                ("lower", Rearrangement::Factor { upper: false }),
                ("upper", Rearrangement::Factor { upper: true }),
            ]),
        ),
        entry(
            "inverse-for-covariance",
            Kind::Mistake,
            [
                "you return the inverse of the covariance",
                "An information filter hands out its information matrix.",
                "Large where it should be small.",
                "Return the inverse of the information matrix.",
            ],
            Ways::one(Rearrangement::Inverse),
        ),
        entry(
            "covariances-without-off-diagonals",
            Kind::Mistake,
            [
                "you return the variances alone, with zeros in place of the covariances",
                "Only the diagonal was stored, and a matrix was made of it again.",
                "Whoever combines components of the estimate takes them for independent.",
                "Return the whole matrix.",
            ],
            Ways::one(Rearrangement::Diagonals),
        ),
        entry(
            "innovation-of-the-other-sign",
            Kind::Reading,
            [
                "you return the innovation as prediction less reading; here it is reading less prediction",
                "Residuals are defined both ways.",
                "None on the estimate; tests for a bias have the other sign.",
                "Return y_k less its prediction.",
            ],
            Ways::one(Rearrangement::InnovationNegated),
        ),
        entry(
            "residual-for-innovation",
            Kind::Mistake,
            [
                "you return what the filtered state leaves of the reading where the innovation is asked",
                "The residual is computed after the update.",
                "Residuals after the update are smaller than innovations: tests of consistency pass that should not.",
                "Compute y_k − Cx − Gv with the predicted state.",
            ],
            Ways::one(Rearrangement::Residual),
        ),
        entry(
            "innovation-covariance-without-noise",
            Kind::Reading,
            [
                "you return the covariance of the predicted signal, without that of the sensors' noise, as that of the innovation",
                "Libraries hand out CPCᵀ as the variance of a prediction of the mean.",
                "Intervals for the next reading are too narrow by R.",
                "Return CPCᵀ + R.",
            ],
            Ways::one(Rearrangement::InnovationCovarianceWithoutNoise),
        ),
        entry(
            "few-digits",
            Kind::Mistake,
            [
                "you print numbers with too few digits",
                "A default format: six significant digits, or a fixed number of decimals.",
                "What was computed is lost in printing; small variances become zero.",
                "Print seventeen significant digits, or the shortest text that names the double.",
            ],
            Ways::fading((3..=10).map(|d| (format!("{d} significant digits"), Rearrangement::Significant(d))))
                .and(Ways::fading((3..=10).map(|d| (format!("{d} decimals"), Rearrangement::Decimals(d))))),
        ),
        entry(
            "single-precision",
            Kind::Mistake,
            [
                "you compute, or hand out, in single precision",
                "An array library whose default type has 32 bits.",
                "Seven digits at best, and far fewer where a covariance is a small difference.",
                "Ask for doubles (for instance a float64 type, or a switch that allows 64 bits).",
            ],
            Ways::one(Wrong::SinglePrecision),
        ),
    ]
}

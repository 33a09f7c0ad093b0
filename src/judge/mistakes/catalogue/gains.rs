//! Wrong lines of update and prediction.

use super::super::fault::Fault;
use super::{Entry, Kind, Ways, entry};

fn line(name: &'static str, text: [&'static str; 4], fault: Fault) -> Entry {
    entry(name, Kind::Mistake, text, Ways::one(fault))
}

const ONE_LINE: &str = "One line of the filter is missing, or was lost when it was rewritten.";

#[expect(clippy::too_many_lines, reason = "a list")]
pub(super) fn entries() -> Vec<Entry> {
    vec![
        line(
            "joseph-without-noise",
            [
                "you update the covariance by Joseph's form without its term KRKᵀ",
                "The form is copied without its second half; requests for it have been written so.",
                "Variances are too small, and the filter is too sure of itself.",
                "P⁺ = (I − KC)P(I − KC)ᵀ + KRKᵀ.",
            ],
            Fault::JosephWithoutNoise,
        ),
        line(
            "joseph-with-unit-noise",
            [
                "you update the covariance by Joseph's form with KKᵀ in place of KRKᵀ",
                "R was 1 in the example that it was tested with.",
                "Variances have the wrong size unless R is the identity.",
                "P⁺ = (I − KC)P(I − KC)ᵀ + KRKᵀ.",
            ],
            Fault::JosephWithUnitNoise,
        ),
        line(
            "covariance-not-updated",
            [
                "you leave the covariance as it is when a reading is used",
                ONE_LINE,
                "Variances grow without end, and the gain tends to that of an unknown state.",
                "P⁺ = P − KSKᵀ, or Joseph's form.",
            ],
            Fault::CovarianceNotUpdated,
        ),
        line(
            "mean-not-updated",
            [
                "you leave the mean as it is when a reading is used",
                ONE_LINE,
                "Readings change the covariance, and nothing else.",
                "x⁺ = x + Kν.",
            ],
            Fault::MeanNotUpdated,
        ),
        line(
            "covariance-update-adds",
            [
                "you add KSKᵀ to the covariance where it should be subtracted",
                "A slip of sign.",
                "Each reading makes the filter less sure.",
                "P⁺ = P − KSKᵀ.",
            ],
            Fault::CovarianceUpdateAdds,
        ),
        entry(
            "predictor-gain-for-filtered",
            Kind::Mistake,
            [
                "you use the gain AK of the predictor for the filtered moments",
                "Control toolboxes return the gain of the one-step predictor.",
                "The correction is moved by one transition too much.",
                "K = PCᵀS⁻¹ for the filtered state; AK is for the next one.",
            ],
            Ways::named([
                ("for the mean", Fault::PredictorGainForTheMean),
                ("for mean and covariance", Fault::PredictorGainForBoth),
            ]),
        ),
        line(
            "filter-gain-in-the-predictor",
            [
                "you use the gain K of the filter in the predictor, where AK is needed",
                "Formulas of filter and predictor are mixed.",
                "The correction is not moved with the state.",
                "x(k+1|k) = Ax(k|k−1) + Bu + AKν.",
            ],
            Fault::FilterGainInThePredictor,
        ),
        line(
            "gain-without-noise",
            [
                "you leave R out of the gain",
                "S in the gain is CPCᵀ, though what is handed out may be right.",
                "Readings are believed to the last digit.",
                "K = PCᵀ(CPCᵀ + R)⁻¹.",
            ],
            Fault::GainWithoutNoise,
        ),
        line(
            "gain-without-inverse",
            [
                "you correct the mean by PCᵀSν, with the innovation covariance in place of its inverse",
                "The inverse was forgotten in one of two formulas. Statistics of consistency are spoiled so, too.",
                "The noisier the sensor, the larger the correction.",
                "x⁺ = x + PCᵀS⁻¹ν.",
            ],
            Fault::GainWithoutInverse,
        ),
        line(
            "gain-of-the-diagonal",
            [
                "you divide by the diagonal of the innovation covariance where its inverse is needed",
                "An elementwise division stands for the inverse.",
                "What sensors have in common is counted twice.",
                "K = PCᵀS⁻¹, by a Cholesky factor of S or the like.",
            ],
            Fault::GainOfTheDiagonal,
        ),
        line(
            "gain-of-the-first-step",
            [
                "you keep the gain of the first step",
                "The gain is computed before the loop.",
                "Good only where the first covariance is already the steady one.",
                "Compute the gain at each step, or use the steady gain knowingly.",
            ],
            Fault::GainOfTheFirstStep,
        ),
        line(
            "innovation-of-the-state-before",
            [
                "you compute the innovation with the state before its prediction",
                "Prediction and update are in the wrong order, or two variables were exchanged.",
                "Motion since the last reading is taken for news.",
                "ν = y − Cx − Gv with the predicted mean x.",
            ],
            Fault::InnovationOfTheStepBefore,
        ),
        line(
            "mean-not-moved",
            [
                "you predict the covariance, but not the mean",
                ONE_LINE,
                "The mean follows readings only.",
                "x becomes Ax + Bu.",
            ],
            Fault::MeanNotMoved,
        ),
        line(
            "covariance-not-moved",
            [
                "you add Q to the covariance, but do not move it by the transition",
                "P + Q is right for a random walk, and was copied from one.",
                "Covariances between components do not arise.",
                "P becomes APAᵀ + Q.",
            ],
            Fault::CovarianceNotMoved,
        ),
        line(
            "transition-without-transpose",
            [
                "you predict the covariance as APA + Q, without a transpose",
                "Right for scalars, where it was tested.",
                "The covariance is no longer symmetric.",
                "P becomes APAᵀ + Q.",
            ],
            Fault::WithoutTranspose,
        ),
        line(
            "transition-on-one-side",
            [
                "you predict the covariance as AP + Q",
                "The second factor Aᵀ was forgotten.",
                "Wrong unless A is the identity.",
                "P becomes APAᵀ + Q.",
            ],
            Fault::OneSided,
        ),
        line(
            "process-noise-through-the-transition",
            [
                "you add Q before the transition: A(P + Q)Aᵀ",
                "The noise is added to the state before it is moved.",
                "The noise is moved, too. In some books it is, and Q means another thing.",
                "P becomes APAᵀ + Q.",
            ],
            Fault::NoiseThroughTransition,
        ),
    ]
}

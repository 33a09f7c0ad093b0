//! What goes wrong inside a recursion.

use super::real::Real;
use crate::matrix::Matrix;
use crate::model::{Path, Step};
use crate::scalar::Rational;

/// One wrong line of a recursion; everything else in it is right.
#[derive(Clone, Debug)]
pub(super) enum Fault {
    /// Nothing is wrong.
    None,
    /// P⁺ = (I − KC)P(I − KC)ᵀ
    JosephWithoutNoise,
    /// P⁺ = (I − KC)P(I − KC)ᵀ + KKᵀ
    JosephWithUnitNoise,
    /// P⁺ = P
    CovarianceNotUpdated,
    /// x⁺ = x
    MeanNotUpdated,
    /// P⁺ = P + KSKᵀ
    CovarianceUpdateAdds,
    /// x⁺ = x + AKν
    PredictorGainForTheMean,
    /// x⁺ = x + AKν, P⁺ = (I − AKC)P
    PredictorGainForBoth,
    /// The next mean is Ax + Bu + Kν.
    FilterGainInThePredictor,
    /// K = PCᵀ(CPCᵀ)⁺
    GainWithoutNoise,
    /// x⁺ = x + PCᵀSν
    GainWithoutInverse,
    /// K = PCᵀ diag(S)⁻¹
    GainOfTheDiagonal,
    /// K of the first reading, for good; P⁺ = (I − KC)P.
    GainOfTheFirstStep,
    /// The predicted covariance is kept from where two of them differ by less, entry by entry.
    CovarianceRests(Real),
    /// On a system that never changes: once the sum of squares of the change of the predicted covariance is less, from the
    /// second step on, all covariances of that step are kept but one: that of the prediction made there stands once.
    AllRest(Real),
    /// An entry of a reading whose innovation has a smaller variance is not used.
    SmallVariancesIgnored(Real),
    /// The next covariance is APA + Q.
    WithoutTranspose,
    /// The next covariance is AP + Q.
    OneSided,
    /// The next covariance is A(P + Q)Aᵀ.
    NoiseThroughTransition,
    /// ν = y − C x⁺ of the step before.
    InnovationOfTheStepBefore,
    /// The next mean is x⁺ + Bu.
    MeanNotMoved,
    /// The next covariance is P + Q.
    CovarianceNotMoved,
    /// P⁺ + εI
    FilteredCovarianceRaised(Real),
}

impl Fault {
    /// Whether it cannot change anything along a path: nothing moves there, or one sensor is all.
    pub(super) fn is_silent(&self, path: &Path<Rational>) -> bool {
        let rests = |step: &Step<Rational>| {
            step.transition.as_ref().is_none_or(|transition| transition.matrix == Matrix::identity(path.states()))
        };
        match self {
            Self::PredictorGainForTheMean
            | Self::PredictorGainForBoth
            | Self::FilterGainInThePredictor
            | Self::WithoutTranspose
            | Self::OneSided
            | Self::NoiseThroughTransition
            | Self::MeanNotMoved
            | Self::CovarianceNotMoved => path.steps().iter().all(rests),
            Self::GainOfTheDiagonal => path.sensors() == 1,
            Self::AllRest(_) => !is_constant(path),
            _ => false,
        }
    }
}

/// Whether all steps are alike, and nothing is missing.
fn is_constant(path: &Path<Rational>) -> bool {
    let Some(first) = path.steps().first() else { return true };
    let transition = path.steps().iter().find_map(|step| step.transition.as_ref());
    path.steps().iter().all(|step| {
        step.observation == first.observation
            && step.observation_input == first.observation_input
            && step.observation_noise == first.observation_noise
            && step.reading.entries().iter().all(Option::is_some)
            && (step.transition.is_none() || step.transition.as_ref() == transition)
    })
}

//! Whether the measures ℙ̄ of all horizons have a limit with a density, for constant systems.

use super::initial_law::InitialLaw;
use super::statistics::{StatisticsError, inverse};
use crate::matrix::{Echelon, Matrix, Undecided};
use crate::model::{Coefficient, Field, ModelError, Noise, Observation, System, Timing};
use crate::scalar::{OrderedField, Scalar};

/// How the limit ℙ̄ of the measures of all horizons lies to ℙ, on everything that ξ and all noises generate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LimitMeasure<S> {
    /// They have the same null sets.
    Equivalent,
    /// Some event has the probability 0 under ℙ and 1 under ℙ̄.
    Singular {
        /// A value z of ξ in the support of F for which zᵀM(t)z grows beyond all bounds.
        witness: Matrix<S>,
    },
    /// Neither: ℙ̄ has a part with a density and a part that ℙ does not see.
    Mixed {
        /// The mass of the part with a density, between 0 and 1.
        with_density: S,
        /// A value z of ξ in the support of F for which zᵀM(t)z grows beyond all bounds.
        witness: Matrix<S>,
    },
}

/// Why nothing is decided.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HorizonError<S: Scalar> {
    /// A matrix is not given as one constant.
    #[error("the {0} is not constant; an infinite horizon is decided for constant systems")]
    NotConstant(Field),
    /// The matrices make no system.
    #[error(transparent)]
    Model(#[from] ModelError<S>),
    /// Σᵛ is singular, or the timing is the other one.
    #[error(transparent)]
    Statistics(#[from] StatisticsError<S>),
}

/// A constant system seen from the value z of ξ: zᵀM(t)z = ∑ ‖Σᵛ^(−½)HDˢz‖² over s < t, with D = A − ΣʷᵛΣᵛ⁻¹H.
///
/// SM-horizon: `∫_A L(T+1) dℙ = ∫_A L(T) dℙ for A ∈ ℱ(T); a measure on ⋁ ℱ(T) that extends all of these need not be absolutely continuous with respect to ℙ`
///
/// Given ξ = z, log L(T) is N(−½v, v) under ℙ and N(½v, v) under ℙ̄, v = zᵀM(T)z. If v stays bounded, so does E L² = exp(v), L(T)
/// converges in the mean and its limit, which is positive, is the density. If v → ∞, the event log L(T) > 0 tends to probability 0 under
/// ℙ and 1 under ℙ̄: singular (Kakutani 1948 for products of measures). Which of the two it is, is decided exactly: what no
/// reading sees of z, the kernel of (H, HD, …, HDⁿ⁻¹), is divided out; of the rest, z₁, the sum is finite exactly if D₁ʲz₁
/// tends to 0, that is if D₁ restricted to the span of z₁, D₁z₁, D₁²z₁, … has its eigenvalues inside the unit circle.
///
/// # Examples
///
/// The start ξ = 1 of a random walk is seen for ever, that of a system with A = 1/2 fades.
///
/// ```
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Before, Initial, Noise, System, Timing};
/// use exact_kalman::nongaussian::{InfiniteHorizon, InitialLaw, LimitMeasure};
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let one = Matrix::<Rational>::identity(1);
/// let start = InitialLaw::atoms([(ratio(1, 1), one.clone())])?;
/// let of = |a: Rational| InfiniteHorizon::of(&System {
///     timing: Timing::Departing,
///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), Matrix::zeros(1, 1)),
///     transition: one.scaled(&a).into(),
///     observation: one.clone().into(),
///     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.clone().into() },
///     input: None,
///     observation_input: None,
/// });
/// assert_eq!(of(ratio(1, 1))?.limit_measure(&start), LimitMeasure::Singular { witness: one.clone() });
/// assert_eq!(of(ratio(1, 2))?.limit_measure(&start), LimitMeasure::Equivalent);
/// assert_eq!(of(ratio(1, 2))?.information(&one), Some(ratio(4, 3)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InfiniteHorizon<S> {
    /// Rows that span those of (H, HD, …, HDⁿ⁻¹): z₁ = `seen` z.
    seen: Matrix<S>,
    /// D₁, with `seen` D = D₁ `seen`.
    dynamics: Matrix<S>,
    /// H₁ᵀΣᵛ⁻¹H₁
    information: Matrix<S>,
}

impl<S: OrderedField> InfiniteHorizon<S> {
    /// The system read at every step, with no entry missing. Its initial belief, inputs and plant noise do not matter.
    ///
    /// # Errors
    ///
    /// [`HorizonError`]: a coefficient that is not constant, or what is wrong with the system.
    pub fn of(system: &System<S>) -> Result<Self, HorizonError<S>> {
        if system.timing != Timing::Departing {
            return Err(StatisticsError::Arriving.into());
        }
        let a = constant(&system.transition, Field::Transition)?;
        let h = constant(&system.observation, Field::Observation)?;
        match &system.noise {
            Noise::Factors { process, observation } => {
                constant(process, Field::ProcessFactor)?;
                constant(observation, Field::ObservationFactor)?;
            }
            Noise::Covariances { process, cross, observation } => {
                constant(process, Field::ProcessNoise)?;
                cross.as_ref().map(|cross| constant(cross, Field::CrossNoise)).transpose()?;
                constant(observation, Field::ObservationNoise)?;
            }
        }
        // One step, for the checks of the model and for the covariances.
        let without_inputs = System { input: None, observation_input: None, ..system.clone() };
        let reading = Observation::complete(vec![S::zero(); h.rows()]);
        let path = without_inputs.realised(&[reading])?;
        let step = &path.steps()[0];
        let v_inverse = inverse(&step.observation_noise).map_err(|reason| reason.at(0))?;
        let n = a.rows();
        let cross = step.transition.as_ref().map_or_else(|| Matrix::zeros(n, h.rows()), |one| one.cross_noise.clone());
        Ok(Self::observable(&(a - cross * &v_inverse * h), h, &v_inverse))
    }

    /// What the readings see of the pair (H, D).
    fn observable(d: &Matrix<S>, h: &Matrix<S>, v_inverse: &Matrix<S>) -> Self {
        let mut rows = h.clone();
        let mut last = h.clone();
        for _ in 1..d.rows() {
            last = last * d;
            rows = rows.above(&last);
        }
        let seen = rows.select_rows(&pivots(&rows.transpose()));
        // Rows that are independent have a right inverse.
        let right = seen.transpose() * regular_inverse(&(&seen * seen.transpose()));
        let h = h * &right;
        Self { dynamics: &seen * d * &right, information: h.transpose().congruence(v_inverse), seen }
    }

    /// The limit of zᵀM(t)z, or nothing if it grows beyond all bounds.
    ///
    /// The finite limit is `e₁ᵀXe₁` where X − CᵀXC = G solves the equation of Stein on the span of z₁, D₁z₁, …
    ///
    /// # Panics
    ///
    /// If z is not n×1.
    pub fn information(&self, z: &Matrix<S>) -> Option<S> {
        let (basis, step) = self.invariant(&(&self.seen * z));
        if basis.columns() == 0 {
            return Some(S::zero());
        }
        if !step.spectral_radius_lt(&S::one()) {
            return None;
        }
        match step.transpose().stein_solution(&basis.transpose().congruence(&self.information)) {
            // z₁ is the first vector of the basis.
            Ok(sum) => Some(sum[(0, 0)].clone()),
            Err(error) => unreachable!("no two eigenvalues inside the unit circle have product one, but {error}"),
        }
    }

    /// How the limit of the measures ℙ̄ lies to ℙ for ξ ~ F.
    ///
    /// The values z with a bounded sum make a linear space. An atom lies in it or not; a Gaussian component lies in it if its
    /// mean and the columns of its covariance do, and is outside almost surely if not.
    ///
    /// # Panics
    ///
    /// If the law has another dimension.
    pub fn limit_measure(&self, initial: &InitialLaw<S>) -> LimitMeasure<S> {
        let (mut with_density, mut escaping) = (S::zero(), None);
        for component in initial.components() {
            match self.unbounded(component.law.mean(), component.law.covariance()) {
                None => with_density = with_density.plus(&component.weight),
                Some(witness) => escaping = escaping.or(Some(witness)),
            }
        }
        match escaping {
            None => LimitMeasure::Equivalent,
            Some(witness) if with_density.is_zero() => LimitMeasure::Singular { witness },
            Some(witness) => LimitMeasure::Mixed { with_density, witness },
        }
    }

    /// A value of N(mean, covariance) whose sum is infinite, if there is one.
    fn unbounded(&self, mean: &Matrix<S>, covariance: &Matrix<S>) -> Option<Matrix<S>> {
        let columns = (0..covariance.columns()).map(|j| mean + covariance.select_columns(&[j]));
        std::iter::once(mean.clone()).chain(columns).find(|z| self.information(z).is_none())
    }

    /// A basis of the span of z₁, D₁z₁, D₁²z₁, … that begins with z₁, and the matrix of D₁ in it; nothing for z₁ = 0.
    fn invariant(&self, start: &Matrix<S>) -> (Matrix<S>, Matrix<S>) {
        let (mut span, mut last) = (start.clone(), start.clone());
        for _ in 1..start.rows() {
            last = &self.dynamics * last;
            span = span.beside(&last);
        }
        let basis = span.select_columns(&pivots(&span));
        let left = regular_inverse(&(basis.transpose() * &basis)) * basis.transpose();
        let step = left * &self.dynamics * &basis;
        (basis, step)
    }
}

fn constant<S: OrderedField>(coefficient: &Coefficient<S>, field: Field) -> Result<&Matrix<S>, HorizonError<S>> {
    match coefficient {
        Coefficient::Constant(matrix) => Ok(matrix),
        _ => Err(HorizonError::NotConstant(field)),
    }
}

/// The first columns that span all columns.
fn pivots<S: OrderedField>(matrix: &Matrix<S>) -> Vec<usize> {
    match Echelon::of(matrix, matrix.columns()) {
        Ok(echelon) => echelon.pivots().to_vec(),
        Err(Undecided { .. }) => unreachable!("a field decides zero"),
    }
}

/// The inverse of a Gram matrix of independent vectors.
fn regular_inverse<S: OrderedField>(gram: &Matrix<S>) -> Matrix<S> {
    match gram.inverse() {
        Ok(inverse) => inverse,
        Err(error) => unreachable!("a Gram matrix of independent vectors is regular, but {error}"),
    }
}

//! The state as a part of the noise and a part of the start, in every way that the change of measure allows.

use super::girsanov::product;
use super::posterior::half;
use super::statistics::{StatisticsError, inverse};
use super::{LogDensity, Shift};
use crate::matrix::Matrix;
use crate::model::{Path, Timing};
use crate::scalar::OrderedField;

/// `slope · z + offset`, z being the value of ξ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Affine<S> {
    /// As many columns as z has rows.
    pub slope: Matrix<S>,
    /// One column.
    pub offset: Matrix<S>,
}

impl<S: OrderedField> Affine<S> {
    /// The vector 0 of dimension n, for n states.
    pub fn zero(n: usize) -> Self {
        Self { slope: Matrix::zeros(n, n), offset: Matrix::zeros(n, 1) }
    }

    /// Its value at z.
    ///
    /// # Panics
    ///
    /// If z has another dimension.
    pub fn at(&self, z: &Matrix<S>) -> Matrix<S> {
        &self.slope * z + &self.offset
    }

    fn mapped(&self, matrix: &Matrix<S>) -> Self {
        Self { slope: matrix * &self.slope, offset: matrix * &self.offset }
    }

    fn plus(&self, other: &Self) -> Self {
        Self { slope: &self.slope + &other.slope, offset: &self.offset + &other.offset }
    }
}

/// What (2.20) leaves free: φ and π for each step, and ζ, all known once ξ is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice<S> {
    /// φ(t), n rows, for t = 0, 1, …
    pub drift: Vec<Affine<S>>,
    /// π(t), n rows, for t = 0, 1, …: what is moved from the noise part to the initial part.
    pub moved: Vec<Affine<S>>,
    /// ζ, n rows: where the noise part starts.
    pub start: Affine<S>,
}

impl<S: OrderedField> Choice<S> {
    /// The choice of the paper, for n states.
    ///
    /// SM-3.10: `φ(t) = 0,  π(t) = 0,  ζ = 0`
    pub fn of_the_paper(n: usize, steps: usize) -> Self {
        let zeros = vec![Affine::zero(n); steps];
        Self { drift: zeros.clone(), moved: zeros, start: Affine::zero(n) }
    }
}

/// What a step needs, with the rows of the entries that are there.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Part<S> {
    a: Matrix<S>,
    h: Matrix<S>,
    input: Matrix<S>,
    gamma: Matrix<S>,
    v_inverse: Matrix<S>,
    /// ΣʷᵛΣᵛ⁻¹
    regression: Matrix<S>,
    /// Σʷ − ΣʷᵛΣᵛ⁻¹Σᵛʷ
    rest: Matrix<S>,
}

/// A decomposition X°(t) = X(t) + Z(t), with the measure that makes (W, V) white noise.
///
/// SM-B3: `ℙ̄ has the null sets of ℙ, ℙ̄ = ℙ on ℱ(0), and (W(t+1), V(t+1)), t = 0, …, T, is white Gaussian noise for (ℱ(t), ℙ̄) with covariance Γ(t+1)`
///
/// Noises are columns (W°(t+1), V°(t+1)), with the rows of V° for the entries of Y(t) that are there.
///
/// # Examples
///
/// A = H = Σʷ = 1, Σᵛ = 2 and ξ = 1: the density is exp(−V°/2 − 1/4); with +½ in (3.6) its mean would be exp(1/2).
///
/// ```
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
/// use exact_kalman::nongaussian::{as_printed, Choice, Decomposition};
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let one = Matrix::<Rational>::identity(1);
/// let system = System {
///     timing: Timing::Departing,
///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), Matrix::zeros(1, 1)),
///     transition: one.clone().into(),
///     observation: one.clone().into(),
///     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.scaled(&ratio(2, 1)).into() },
///     input: None,
///     observation_input: None,
/// };
/// let path = system.realised(&[Observation::complete([ratio(1, 1)])])?;
/// let parts = Decomposition::new(&path, Choice::of_the_paper(1, 1))?;
/// let density = parts.log_density(&one);
/// assert_eq!((density.constant.clone(), density.log_moment(&ratio(1, 1))), (ratio(-1, 4), ratio(0, 1)));
/// let printed = as_printed::log_density(&parts, &one);
/// assert_eq!(printed.log_moment(&ratio(1, 1)), ratio(1, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decomposition<S> {
    parts: Vec<Part<S>>,
    choice: Choice<S>,
    /// Z(0), Z(1), …
    initial: Vec<Affine<S>>,
}

impl<S: OrderedField> Decomposition<S> {
    /// The decomposition that a choice makes along a path, over all steps that have a transition.
    ///
    /// SM-3.9: `Z(t+1) = [A(t) − Σʷᵛ(t+1)Σᵛ(t+1)⁻¹H(t)]Z(t) + π(t),  Z(0) = ξ − ζ`
    ///
    /// # Errors
    ///
    /// [`StatisticsError`]: a singular Σᵛ with its witness, or the other timing.
    ///
    /// # Panics
    ///
    /// If the choice is for another number of steps or states.
    pub fn new(path: &Path<S>, choice: Choice<S>) -> Result<Self, StatisticsError<S>> {
        if path.timing() != Timing::Departing {
            return Err(StatisticsError::Arriving);
        }
        let mut parts = Vec::new();
        for (step, at) in path.steps().iter().enumerate() {
            let Some(transition) = &at.transition else { break };
            let observed = at.reading.present();
            let (w, wv) = (&transition.noise, transition.cross_noise.select_columns(&observed));
            let v = at.observation_noise.select(&observed, &observed);
            let v_inverse = inverse(&v).map_err(|reason| reason.at(step))?;
            let regression = &wv * &v_inverse;
            parts.push(Part {
                a: transition.matrix.clone(),
                h: at.observation.select_rows(&observed),
                input: transition.input.clone(),
                gamma: w.beside(&wv).above(&wv.transpose().beside(&v)),
                rest: w - &regression * wv.transpose(),
                v_inverse,
                regression,
            });
        }
        assert!(choice.drift.len() == parts.len() && choice.moved.len() == parts.len(), "φ and π for each step");
        let n = path.states();
        let identity = Affine { slope: Matrix::identity(n), offset: Matrix::zeros(n, 1) };
        let mut initial = vec![identity.plus(&choice.start.mapped(&-&Matrix::identity(n)))];
        for (t, part) in parts.iter().enumerate() {
            let step = &part.a - &part.regression * &part.h;
            initial.push(initial[t].mapped(&step).plus(&choice.moved[t]));
        }
        Ok(Self { parts, choice, initial })
    }

    /// Z(0), Z(1), …, as functions of z; with the choice of the paper Z(t) = Ψ(t,0)z.
    pub fn initial_part(&self) -> &[Affine<S>] {
        &self.initial
    }

    /// The shift (φʷ(t), φᵛ(t)) of each step given ξ = z; the noise has the covariance Γ(t+1).
    ///
    /// SM-3.4: `φʷ(t) = φ(t),  φᵛ(t) = −Σᵛ(t+1)⁻¹[Σᵛʷ(t+1)φ(t) + H(t)Z(t)]`
    ///
    /// SM-3.3: `(W(t+1), V(t+1)) = (W°(t+1), V°(t+1)) − Γ(t+1) (φʷ(t), φᵛ(t))`
    ///
    /// So under ℙ̄ and given ξ = z the old noises are independent N(Γχ, Γ), χ being the shift ([`Shift::law_of_noise`]): that
    /// is Proposition 1 (SM-P1).
    ///
    /// # Panics
    ///
    /// If z is not n×1; so with all methods that take it.
    pub fn shifts(&self, z: &Matrix<S>) -> Vec<Shift<S>> {
        let of = |(t, part): (usize, &Part<S>)| {
            let phi = self.choice.drift[t].at(z);
            let seen = &part.v_inverse * &part.h * self.initial[t].at(z);
            let of_sensors = -&(part.regression.transpose() * &phi + seen);
            Shift::new(part.gamma.clone(), phi.above(&of_sensors))
        };
        self.parts.iter().enumerate().map(of).collect()
    }

    /// The new noise (W(t+1), V(t+1)) of each step given ξ = z, for values of the old one.
    ///
    /// SM-3.5: `W(t+1) = W°(t+1) + Σʷᵛ(t+1)Σᵛ(t+1)⁻¹H(t)Z(t) − [Σʷ(t+1) − Σʷᵛ(t+1)Σᵛ(t+1)⁻¹Σᵛʷ(t+1)]φ(t)`
    ///
    /// SM-2.20: `V(t+1) = V°(t+1) + H(t)Z(t)`
    ///
    /// # Panics
    ///
    /// If there are not as many values as steps, or one has another dimension.
    pub fn new_noise(&self, z: &Matrix<S>, noise: &[Matrix<S>]) -> Vec<Matrix<S>> {
        let minus = S::one().negated();
        self.shifted(z, noise, &minus)
    }

    /// The new noise with this factor before the bracket of (3.5).
    pub(super) fn shifted(&self, z: &Matrix<S>, noise: &[Matrix<S>], sign: &S) -> Vec<Matrix<S>> {
        assert!(noise.len() == self.parts.len(), "one value for each step");
        let of = |(t, (part, old)): (usize, (&Part<S>, &Matrix<S>))| {
            let seen = &part.h * self.initial[t].at(z);
            let drift = (&part.rest * self.choice.drift[t].at(z)).scaled(sign);
            old + (&part.regression * &seen + drift).above(&seen)
        };
        self.parts.iter().zip(noise).enumerate().map(of).collect()
    }

    /// The noise part X(0), X(1), … given ξ = z, for values of the old noise; known inputs enter it.
    ///
    /// SM-3.8: `X(t+1) = A(t)X(t) + W(t+1) + [Σʷ(t+1) − Σʷᵛ(t+1)Σᵛ(t+1)⁻¹Σᵛʷ(t+1)]φ(t) − π(t),  X(0) = ζ`
    ///
    /// # Panics
    ///
    /// As for [`Decomposition::new_noise`].
    pub fn noise_part(&self, z: &Matrix<S>, noise: &[Matrix<S>]) -> Vec<Matrix<S>> {
        let mut all = vec![self.choice.start.at(z)];
        for (t, (part, new)) in self.parts.iter().zip(self.new_noise(z, noise)).enumerate() {
            let w = new.block(0..part.a.rows(), 0..1);
            let drift = &part.rest * self.choice.drift[t].at(z);
            all.push(&part.a * &all[t] + w + drift - self.choice.moved[t].at(z) + &part.input);
        }
        all
    }

    /// The logarithm of dℙ̄/dℙ over all steps given ξ = z, in the old noises.
    ///
    /// SM-3.6: `dℙ̄/dℙ = exp(∑[s=0..T] {φᵀ(s)[W°(s+1) − Σʷᵛ(s+1)Σᵛ(s+1)⁻¹V°(s+1)] − Zᵀ(s)Hᵀ(s)Σᵛ(s+1)⁻¹V°(s+1)} − ½ ∑[s=0..T] {φᵀ(s)[Σʷ(s+1) − Σʷᵛ(s+1)Σᵛ(s+1)⁻¹Σᵛʷ(s+1)]φ(s) + Zᵀ(s)Hᵀ(s)Σᵛ(s+1)⁻¹H(s)Z(s)})`
    ///
    /// With the choice of the paper it is
    ///
    /// SM-3.14: `dℙ̄/dℙ = exp(−∑[s=0..T] Zᵀ(s)Hᵀ(s)Σᵛ(s+1)⁻¹V°(s+1) − ½ ∑[s=0..T] Zᵀ(s)Hᵀ(s)Σᵛ(s+1)⁻¹H(s)Z(s))`
    pub fn log_density(&self, z: &Matrix<S>) -> LogDensity<S> {
        self.density_with(z, &S::one().negated())
    }

    /// The exponent of (3.6) with this sign before its half.
    pub(super) fn density_with(&self, z: &Matrix<S>, sign: &S) -> LogDensity<S> {
        let (mut coefficients, mut quadratic) = (Vec::new(), S::zero());
        for (t, part) in self.parts.iter().enumerate() {
            let phi = self.choice.drift[t].at(z);
            let seen = &part.h * self.initial[t].at(z);
            let weighed = &part.v_inverse * &seen;
            coefficients.push(phi.above(&-&(part.regression.transpose() * &phi + &weighed)));
            quadratic = quadratic.plus(&product(&phi, &(&part.rest * &phi))).plus(&product(&seen, &weighed));
        }
        let covariances = self.parts.iter().map(|part| part.gamma.clone()).collect();
        LogDensity { coefficients, covariances, constant: half(&quadratic).times(sign) }
    }
}

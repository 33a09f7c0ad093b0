//! Products of numbers in [0, 1] that depend on the mode: the class S⁰(λ), decided with certificates.

use crate::matrix::Matrix;
use crate::scalar::OrderedField;
use crate::stability::ModeProcess;
use crate::stability::classes::classes;

/// Proof that `E ∏[j=i+1..k] (1 − a(j)) ≤ M λ^(k−i)` for all k ≥ i ≥ 0.
///
/// x > 0 with Bx ≤ λx on reachable modes, where B(u, v) = T(u, v)(1 − a(v)): then Bⁿ1 ≤ Bⁿx/min x ≤ λⁿ x/min x.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decay<S> {
    /// λ.
    pub rate: S,
    /// M = max x/min x.
    pub constant: S,
    /// x, one number for each mode; zero for modes never reached.
    pub weights: Vec<S>,
}

/// Whether a sequence is in S⁰(λ).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DecayVerdict<S> {
    /// It is: with proof.
    Certified(Decay<S>),
    /// It is not: λ is below the spectral radius of B, and so every M fails.
    Refuted,
    /// λ is the spectral radius of B itself, and no x > 0 with Bx ≤ λx was found. Every greater rate is certified, every lesser one refuted.
    Critical,
}

impl<S: OrderedField> ModeProcess<S> {
    /// E ∏[j=i+1..i+n] (1 − a(j)) for each mode of time i, where a(j) depends on the mode of time j: Bⁿ1.
    ///
    /// # Panics
    ///
    /// If there is not one a for each mode.
    pub fn expected_products(&self, a: &[S], steps: usize) -> Vec<S> {
        let matrix = self.decay_matrix(a);
        let ones = Matrix::column(vec![S::one(); a.len()]);
        (0..steps).fold(ones, |products, _| &matrix * products).entries().to_vec()
    }

    /// Whether the sequence a(σ(k)) is in S⁰(λ), where each a is in [0, 1].
    ///
    /// WG-54: `S⁰(λ) = {a : a(k) ∈ [0,1], E ∏[j=i+1..k] (1 − a(j)) ≤ M λ^(k−i) for all k ≥ i ≥ 0 and some M > 0}`
    ///
    /// Decided by the spectral radius of B over reachable modes: x = (λI − B)⁻¹1 is the certificate if it is below λ. One characteristic
    /// polynomial and one linear system of the order of the number of modes.
    ///
    /// # Errors
    ///
    /// [`OutsideUnitInterval`] with the first mode whose a is not in [0, 1].
    ///
    /// # Panics
    ///
    /// If there is not one a for each mode.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{DecayVerdict, Mode, ModeProcess}};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
    /// let mode = || Mode::new(scalar(ratio(1, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)));
    /// let coin = ModeProcess::independent(vec![mode()?, mode()?], vec![ratio(1, 2), ratio(1, 2)])?;
    /// // E(1 − a) = 3/4
    /// let a = [ratio(0, 1), ratio(1, 2)];
    /// let DecayVerdict::Certified(decay) = coin.decay(&a, &ratio(3, 4))? else { panic!("λ = E(1 − a)") };
    /// assert_eq!(decay.constant, ratio(1, 1));
    /// assert_eq!(coin.decay(&a, &ratio(2, 3))?, DecayVerdict::Refuted);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn decay(&self, a: &[S], rate: &S) -> Result<DecayVerdict<S>, OutsideUnitInterval<S>> {
        if let Some((mode, value)) = a.iter().enumerate().find(|(_, value)| **value < S::zero() || **value > S::one()) {
            return Err(OutsideUnitInterval { mode, value: value.clone() });
        }
        let modes = self.reachable();
        let matrix = self.decay_matrix(a).select(&modes, &modes);
        let certified = |x: Matrix<S>| DecayVerdict::Certified(self.certificate(&modes, &x, rate));
        let shifted = Matrix::identity(modes.len()).scaled(rate) - &matrix;
        let ones = Matrix::column(vec![S::one(); modes.len()]);
        if matrix.spectral_radius_lt(rate) {
            let Ok(x) = shifted.solve(&ones) else { unreachable!("the spectral radius is below the rate") };
            return Ok(certified(x));
        }
        // A nonnegative matrix has its spectral radius as an eigenvalue; an irreducible one has a positive vector there.
        let kernel = shifted.kernel();
        let positive = |x: &Matrix<S>| x.entries().iter().all(|entry| *entry > S::zero());
        let candidates = std::iter::once(ones).chain((0..kernel.columns()).flat_map(|column| {
            let x = kernel.select_columns(&[column]);
            [-&x, x]
        }));
        let bounds = |x: &Matrix<S>| positive(x) && (&shifted * x).entries().iter().all(|entry| *entry >= S::zero());
        Ok(match candidates.into_iter().find(bounds) {
            Some(x) => certified(x),
            None if kernel.columns() == 0 || exceeds(&matrix, rate) => DecayVerdict::Refuted,
            None => DecayVerdict::Critical,
        })
    }

    /// B(u, v) = T(u, v)(1 − a(v)).
    fn decay_matrix(&self, a: &[S]) -> Matrix<S> {
        assert!(a.len() == self.modes().len(), "{} numbers for {} modes", a.len(), self.modes().len());
        Matrix::from_fn(a.len(), a.len(), |u, v| self.transition()[(u, v)].times(&S::one().minus(&a[v])))
    }

    fn certificate(&self, modes: &[usize], x: &Matrix<S>, rate: &S) -> Decay<S> {
        let mut weights = vec![S::zero(); self.modes().len()];
        for (place, &mode) in modes.iter().enumerate() {
            weights[mode] = x[(place, 0)].clone();
        }
        let (least, largest) = (x.entries().iter().min(), x.entries().iter().max());
        let constant = least.zip(largest).map(|(least, largest)| largest.over(least));
        let Some(Ok(constant)) = constant else { unreachable!("some mode is reached, and x > 0") };
        Decay { rate: rate.clone(), constant, weights }
    }
}

/// Whether the spectral radius of a matrix with no negative entry is above a number that it is not below: whether it is for one of the
/// irreducible blocks. Of such a block it is the one eigenvalue with a positive vector (Perron, Frobenius).
fn exceeds<S: OrderedField>(matrix: &Matrix<S>, rate: &S) -> bool {
    let all: Vec<usize> = (0..matrix.rows()).collect();
    classes(&all, |from, to| matrix[(from, to)] > S::zero()).iter().any(|class| {
        let block = matrix.select(class, class);
        let kernel = (Matrix::identity(class.len()).scaled(rate) - &block).kernel();
        let zero = S::zero();
        let of_one_sign = |x: Matrix<S>| x.entries().iter().all(|e| *e > zero) || x.entries().iter().all(|e| *e < zero);
        !(block.spectral_radius_lt(rate) || kernel.columns() == 1 && of_one_sign(kernel))
    })
}

/// A number that is not in [0, 1].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the number of mode {mode} is not between 0 and 1")]
pub struct OutsideUnitInterval<S> {
    /// The mode.
    pub mode: usize,
    /// Its number.
    pub value: S,
}

//! Products of the closed loop F(I − LH) along a path, and what bounds them.

use crate::matrix::{Matrix, SolveError};
use crate::scalar::OrderedField;
use crate::stability::{Bracket, Mode, RiccatiStep};

/// The steps of the equation along a path from P(0), one for each mode.
///
/// # Panics
///
/// If shapes do not fit.
pub fn riccati_path<S: OrderedField>(path: &[Mode<S>], initial: &Matrix<S>) -> Vec<RiccatiStep<S>> {
    let mut steps: Vec<RiccatiStep<S>> = Vec::with_capacity(path.len());
    for mode in path {
        let step = mode.step(steps.last().map_or(initial, |step| &step.next));
        steps.push(step);
    }
    steps
}

/// Which number stands for Q̄⁻¹(k)P(k+1) in the factor of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// `1 − 1/(1 + ‖Q̄⁻¹(k)P(k+1)‖)`, as in Lemma 2.2.
    Printed,
    /// `1 − 1/λ_max(Q̄⁻¹(k)P(k+1))`, no larger: equality for d = 1, P(m) and P(n) included.
    Sharp,
}

/// Lemma 2.2 for the steps of one path: their product, and the parts of its bound.
///
/// WG-L2.2: `F(k), Q̄(k) > 0 and P(k) of the Lyapunov form, P(m) > 0: the bound (55) holds for all n > m`
///
/// The steps are m, …, n − 1; each part of the bound is enclosed between two fractions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClosedLoopBound<S> {
    /// `F(n−1)(I − L(n−1)H(n−1))⋯F(m)(I − L(m)H(m))`, d×d.
    pub product: Matrix<S>,
    /// The factor of each step; it lies in [0, 1).
    pub factors: Vec<Bracket<S>>,
    /// ‖P(n)‖.
    pub last: Bracket<S>,
    /// ‖P⁻¹(m)‖.
    pub first_inverse: Bracket<S>,
}

/// Why the bound has no meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ClosedLoopError {
    /// P(m) is singular.
    #[error("the covariance before the first step is singular: {0}")]
    Start(SolveError),
    /// Q̄(k) is singular.
    #[error("the closed-loop noise of step {step} is singular: {source}")]
    Noise {
        /// k − m.
        step: usize,
        /// Its rank.
        source: SolveError,
    },
}

impl<S: OrderedField> ClosedLoopBound<S> {
    /// The product over the given steps and its bound, from P(m) = `initial`; irrational parts to within `width` (see [`Bracket`]).
    ///
    /// WG-55: `‖∏[k=m..n−1] F(k)(I − L(k)H(k))‖² ≤ ∏[k=m..n−1] (1 − 1/(1 + ‖Q̄⁻¹(k)P(k+1)‖)) ‖P(n)‖ ‖P⁻¹(m)‖`
    ///
    /// # Errors
    ///
    /// [`ClosedLoopError`] if P(m) or a Q̄(k) is singular.
    ///
    /// # Panics
    ///
    /// If shapes do not fit or the width is not positive.
    ///
    /// # Examples
    ///
    /// For d = 1 the sharp bound is no bound but the square itself:
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{ClosedLoopBound, Factor, Mode, riccati_path}};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[ratio(value, 1)]);
    /// let mode = Mode::new(scalar(2), scalar(1), scalar(1), scalar(1))?;
    /// let steps = riccati_path(&[mode.clone(), mode], &scalar(1));
    /// let bound = ClosedLoopBound::new(&steps, &scalar(1), Factor::Sharp, &ratio(1, 100))?;
    /// assert_eq!(bound.product[(0, 0)], ratio(1, 2));
    /// assert_eq!(bound.upper(), ratio(1, 4));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        steps: &[RiccatiStep<S>],
        initial: &Matrix<S>,
        factor: Factor,
        width: &S,
    ) -> Result<Self, ClosedLoopError> {
        let d = initial.rows();
        let largest = |matrix: &Matrix<S>| Bracket::largest_eigenvalue(matrix, &Matrix::identity(d), width);
        let inverse = initial.inverse().map_err(ClosedLoopError::Start)?;
        let first_inverse = largest(&inverse).map_err(ClosedLoopError::Start)?;
        let last = largest(steps.last().map_or(initial, |step| &step.next)).map_err(ClosedLoopError::Start)?;
        let mut product = Matrix::identity(d);
        let mut factors = Vec::with_capacity(steps.len());
        for (index, step) in steps.iter().enumerate() {
            let singular = |source| ClosedLoopError::Noise { step: index, source };
            let ratio = match factor {
                Factor::Printed => Bracket::norm(&step.noise.solve(&step.next).map_err(singular)?, width).plus_one(),
                Factor::Sharp => Bracket::largest_eigenvalue(&step.next, &step.noise, width).map_err(singular)?,
            };
            factors.push(ratio.one_minus_reciprocal());
            product = &step.closed_loop * product;
        }
        Ok(Self { product, factors, last, first_inverse })
    }

    /// A fraction that the square of the norm of the product does not exceed.
    pub fn upper(&self) -> S {
        self.ends(|bracket| &bracket.upper)
    }

    /// A fraction that the right side is not below.
    pub fn lower(&self) -> S {
        self.ends(|bracket| &bracket.lower)
    }

    fn ends<'a>(&'a self, end: impl Fn(&'a Bracket<S>) -> &'a S) -> S {
        let ends = self.factors.iter().chain([&self.last, &self.first_inverse]).map(end);
        ends.fold(S::one(), |product, end| product.times(end))
    }
}

impl<S: OrderedField> Bracket<S> {
    fn plus_one(self) -> Self {
        Self { lower: self.lower.plus(&S::one()), upper: self.upper.plus(&S::one()) }
    }

    /// For values of 1 or more; `Q̄⁻¹P₊` has none less, as P₊ ≥ Q̄.
    fn one_minus_reciprocal(self) -> Self {
        let image = |t: S| {
            let reciprocal = S::one().over(&t.max(S::one()));
            S::one().minus(&reciprocal.unwrap_or_else(|error| unreachable!("t ≥ 1: {error}")))
        };
        Self { lower: image(self.lower), upper: image(self.upper) }
    }
}

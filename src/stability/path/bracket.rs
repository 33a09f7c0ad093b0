//! Norms and eigenvalues that are no fractions, between two fractions.

use crate::matrix::{Matrix, SolveError};
use crate::scalar::OrderedField;

/// `lower ≤ value ≤ upper`; equal if the value was met.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bracket<S> {
    /// The lower end.
    pub lower: S,
    /// The upper end.
    pub upper: S,
}

/// How a candidate lies to the value that is sought.
enum Side {
    Below,
    Met,
    Above,
}

impl<S: OrderedField> Bracket<S> {
    /// The least t ≥ 0 with `A ≤ tB`, which is `λ_max(B⁻¹A)` where it is not negative: to within `width` of itself if it is
    /// below one, else relatively.
    ///
    /// By bisection with LDLᵀ as the test; a value that bisection meets is returned alone, and so is every value of
    /// order 1. Cost: log(1/width) factorisations.
    ///
    /// # Errors
    ///
    /// [`SolveError::Singular`] if B is singular.
    ///
    /// # Panics
    ///
    /// If the matrices are not symmetric, `B ≥ 0` is false, shapes differ, or the width is not positive.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{Rational, ratio}, stability::Bracket};
    ///
    /// // (3 + √5)/2 = 2.618…
    /// let a = Matrix::<Rational>::from_integers(&[[2, 1], [1, 1]]);
    /// let found = Bracket::largest_eigenvalue(&a, &Matrix::identity(2), &ratio(1, 1000))?;
    /// assert!(ratio(2615, 1000) < found.lower && found.upper < ratio(2622, 1000));
    /// # Ok::<(), exact_kalman::matrix::SolveError>(())
    /// ```
    pub fn largest_eigenvalue(a: &Matrix<S>, b: &Matrix<S>, width: &S) -> Result<Self, SolveError> {
        let order = b.rows();
        let rank = b.ldl().unwrap_or_else(|error| panic!("B: {error}")).rank();
        if rank < order {
            return Err(SolveError::Singular { rank, order });
        }
        if order == 1 {
            let value = quotient(&a[(0, 0)], &b[(0, 0)]).max(S::zero());
            return Ok(Self { lower: value.clone(), upper: value });
        }
        assert!(a.asymmetry().is_none(), "A is not symmetric");
        Ok(Self::least(width, |t| side(a, &b.scaled(t))))
    }

    /// The largest singular value ‖X‖, likewise.
    ///
    /// # Panics
    ///
    /// If the width is not positive.
    pub fn norm(matrix: &Matrix<S>, width: &S) -> Self {
        if let [entry] = matrix.entries() {
            let value = entry.clone().max(entry.negated());
            return Self { lower: value.clone(), upper: value };
        }
        let square = matrix * matrix.transpose();
        let identity = Matrix::identity(matrix.rows());
        Self::least(width, |t| side(&square, &identity.scaled(&t.times(t))))
    }

    fn least(width: &S, side: impl Fn(&S) -> Side) -> Self {
        assert!(*width > S::zero(), "the width is not positive");
        let one = |value: S| Self { lower: value.clone(), upper: value };
        let two = S::one().plus(&S::one());
        let (mut lower, mut upper) = (S::zero(), S::one());
        match side(&lower) {
            Side::Below => (),
            Side::Met | Side::Above => return one(lower),
        }
        loop {
            match side(&upper) {
                Side::Below => (lower, upper) = (upper.clone(), upper.times(&two)),
                Side::Met => return one(upper),
                Side::Above => break,
            }
        }
        while upper.minus(&lower) > width.times(&lower.clone().max(S::one())) {
            let middle = quotient(&lower.plus(&upper), &two);
            match side(&middle) {
                Side::Below => lower = middle,
                Side::Met => return one(middle),
                Side::Above => upper = middle,
            }
        }
        Self { lower, upper }
    }
}

/// Where tB lies to A.
fn side<S: OrderedField>(a: &Matrix<S>, scaled: &Matrix<S>) -> Side {
    match (scaled - a).ldl() {
        Err(_) => Side::Below,
        Ok(ldl) if ldl.is_positive_definite() => Side::Above,
        Ok(_) => Side::Met,
    }
}

fn quotient<S: OrderedField>(a: &S, b: &S) -> S {
    a.over(b).unwrap_or_else(|error| unreachable!("a positive divisor: {error}"))
}

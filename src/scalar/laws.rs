//! The promises of the traits as callable functions: a new scalar is tested the day it is written.
//!
//! Each function checks its laws at the given values and names the first one that fails. Draw the values
//! as you like (exhaustively for a small field, with a property-testing crate for the rationals).
//!
//! # Examples
//!
//! ```
//! use exact_kalman::scalar::{laws, ratio};
//!
//! assert_eq!(laws::ordered_field(&ratio(1, 3), &ratio(-2, 5), &ratio(7, 1)), Ok(()));
//! ```

use super::{Field, OrderedField, Undefined, ZeroTest};

/// The name of a law that does not hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the law «{0}» does not hold")]
pub struct Broken(pub &'static str);

fn law(holds: bool, name: &'static str) -> Result<(), Broken> {
    if holds { Ok(()) } else { Err(Broken(name)) }
}

/// The axioms of a field at three values, with the agreement of the derived operations.
///
/// # Errors
///
/// The first law that fails.
pub fn field<S: Field>(a: &S, b: &S, c: &S) -> Result<(), Broken> {
    let (zero, one) = (S::zero(), S::one());
    law(zero != one, "zero and one differ")?;
    law(a.plus(&b.plus(c)) == a.plus(b).plus(c), "addition is associative")?;
    law(a.plus(b) == b.plus(a), "addition commutes")?;
    law(a.plus(&zero) == *a, "zero is neutral")?;
    law(a.plus(&a.negated()) == zero, "negation inverts addition")?;
    law(a.minus(b) == a.plus(&b.negated()), "subtraction adds the negative")?;
    law(a.times(&b.times(c)) == a.times(b).times(c), "multiplication is associative")?;
    law(a.times(b) == b.times(a), "multiplication commutes")?;
    law(a.times(&one) == *a, "one is neutral")?;
    law(a.times(&b.plus(c)) == a.times(b).plus(&a.times(c)), "multiplication distributes")?;
    law(a.times(&zero) == zero, "zero absorbs")?;
    law((a.zero_test() == ZeroTest::Zero) == (*a == zero), "the zero test agrees with equality")?;
    law(a.zero_test() != ZeroTest::Undecided, "a field decides zero")?;
    law(a.is_zero() == (*a == zero), "is_zero agrees with equality")?;
    match a.over(b) {
        Ok(quotient) => {
            law(!b.is_zero(), "nothing is divided by zero")?;
            law(quotient.times(b) == *a, "division inverts multiplication")
        }
        Err(Undefined::DivisionByZero) => law(b.is_zero(), "only division by zero fails"),
        Err(_) => Err(Broken("a field decides division and contains every quotient")),
    }
}

/// The image of the integers is a homomorphism.
///
/// # Errors
///
/// The first law that fails.
pub fn integers<S: Field>(a: i32, b: i32) -> Result<(), Broken> {
    let (a, b) = (i64::from(a), i64::from(b));
    let (x, y) = (S::from_integer(a), S::from_integer(b));
    law(S::from_integer(0) == S::zero() && S::from_integer(1) == S::one(), "0 and 1 map to zero and one")?;
    law(S::from_integer(a + b) == x.plus(&y), "integers add")?;
    law(S::from_integer(a - b) == x.minus(&y), "integers subtract")?;
    law(S::from_integer(a * b) == x.times(&y), "integers multiply")
}

/// The axioms of an ordered field at three values.
///
/// # Errors
///
/// The first law that fails.
pub fn ordered_field<S: OrderedField>(a: &S, b: &S, c: &S) -> Result<(), Broken> {
    field(a, b, c)?;
    let zero = S::zero();
    law((a <= b) == (a.minus(b) <= zero), "the order is that of the difference")?;
    law(a > b || a.plus(c) <= b.plus(c), "addition keeps the order")?;
    law(*a < zero || *b < zero || a.times(b) >= zero, "products of nonnegatives are nonnegative")?;
    law(a.times(a) >= zero, "squares are nonnegative")?;
    law(a <= b || b <= a, "the order is total")?;
    law(!(a <= b && b <= a) || a == b, "the order is antisymmetric")?;
    law(!(a <= b && b <= c) || a <= c, "the order is transitive")
}

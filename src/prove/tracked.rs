//! Values at a random point, with bounds of the degrees of the rational functions that have them.

use std::cell::RefCell;

use crate::scalar::{Field, Mersenne61, Scalar, Undefined, ZeroTest};

/// The value of a rational function at a point modulo 2⁶¹ − 1, with bounds of the total degrees of a numerator and a denominator.
///
/// Bounds follow from the operations alone: `a/b ± c/d` has the numerator `ad ± cb` and the denominator `bd`, and nothing is
/// cancelled. So they are far above the true degrees, and never below. Bounds that do not fit stay at the largest number.
#[derive(Clone, Copy, Debug)]
pub struct Tracked {
    value: Mersenne61,
    above: u128,
    below: u128,
}

/// The questions "is this zero?" that were asked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    /// The answers, in the order of the questions.
    pub(super) answers: Vec<bool>,
    /// The largest degree bound of a numerator asked about.
    pub(super) degree: u128,
}

thread_local! {
    static TALLY: RefCell<Tally> = RefCell::default();
}

/// What `work` returns, with the questions it asked.
pub(super) fn tallied<T>(work: impl FnOnce() -> T) -> (T, Tally) {
    TALLY.take();
    let result = work();
    (result, TALLY.take())
}

impl Tracked {
    /// A variable that has this value.
    pub fn variable(value: Mersenne61) -> Self {
        Self { value, above: 1, below: 0 }
    }

    /// The value at the point.
    pub fn value(&self) -> Mersenne61 {
        self.value
    }

    /// The bounds of the degrees of numerator and denominator.
    pub fn degrees(&self) -> (u128, u128) {
        (self.above, self.below)
    }

    fn constant(value: Mersenne61) -> Self {
        Self { value, above: 0, below: 0 }
    }

    /// The answer for the value, entered into the tally.
    fn asked(self) -> bool {
        let is_zero = self.value.is_zero();
        TALLY.with_borrow_mut(|tally| {
            tally.answers.push(is_zero);
            tally.degree = tally.degree.max(self.above);
        });
        is_zero
    }

    fn joined(&self, other: &Self, value: Mersenne61) -> Self {
        let above = self.above.saturating_add(other.below).max(other.above.saturating_add(self.below));
        Self { value, above, below: self.below.saturating_add(other.below) }
    }
}

impl Scalar for Tracked {
    fn zero() -> Self {
        Self::constant(Mersenne61::zero())
    }

    fn one() -> Self {
        Self::constant(Mersenne61::one())
    }

    fn plus(&self, other: &Self) -> Self {
        self.joined(other, self.value.plus(&other.value))
    }

    fn minus(&self, other: &Self) -> Self {
        self.joined(other, self.value.minus(&other.value))
    }

    fn times(&self, other: &Self) -> Self {
        Self {
            value: self.value.times(&other.value),
            above: self.above.saturating_add(other.above),
            below: self.below.saturating_add(other.below),
        }
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        if divisor.asked() {
            return Err(Undefined::DivisionByZero);
        }
        Ok(Self {
            value: self.value.over(&divisor.value)?,
            above: self.above.saturating_add(divisor.below),
            below: self.below.saturating_add(divisor.above),
        })
    }

    fn zero_test(&self) -> ZeroTest {
        if self.asked() { ZeroTest::Zero } else { ZeroTest::Nonzero }
    }

    fn from_integer(value: i64) -> Self {
        Self::constant(Mersenne61::from_integer(value))
    }
}

impl PartialEq for Tracked {
    fn eq(&self, other: &Self) -> bool {
        self.minus(other).asked()
    }
}

impl Eq for Tracked {}
impl Field for Tracked {}

//! The interval scalar: an algorithm run on enclosures encloses what it gives on fractions.

use exact_kalman::scalar::{Dyadic, Interval, Rational, Scalar, Undefined, ZeroTest};

use super::commuting::{Algorithm, Drawn, counted};
use super::inputs::Input;

const BITS: u64 = 200;

/// An interval as a scalar of three-valued zero tests, at a fixed precision.
#[derive(Clone, Debug)]
pub struct Ball(Interval);

impl Ball {
    /// An interval around a fraction that is no dyadic number; the value itself where it is one.
    fn of(value: &Rational) -> Self {
        Self(Interval::of(value, BITS))
    }

    fn contains(&self, value: &Rational) -> bool {
        let end = |dyadic: &Dyadic| dyadic.value().expect("no number here is that long");
        end(self.0.lower()) <= *value && *value <= end(self.0.upper())
    }
}

impl Scalar for Ball {
    fn zero() -> Self {
        Self(Interval::zero())
    }

    fn one() -> Self {
        Self(Interval::between(Dyadic::one(), Dyadic::one()))
    }

    fn plus(&self, other: &Self) -> Self {
        Self(self.0.plus(&other.0, BITS))
    }

    fn minus(&self, other: &Self) -> Self {
        Self(self.0.minus(&other.0, BITS))
    }

    fn times(&self, other: &Self) -> Self {
        Self(self.0.times(&other.0, BITS))
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        self.0.over(&divisor.0, BITS).map(Self)
    }

    fn zero_test(&self) -> ZeroTest {
        let (lower, upper) = (self.0.lower(), self.0.upper());
        if lower.is_zero() && upper.is_zero() {
            ZeroTest::Zero
        } else if *lower > Dyadic::zero() || upper.is_negative() {
            ZeroTest::Nonzero
        } else {
            ZeroTest::Undecided
        }
    }
}

/// The exact answer lies in the answer on enclosures, where that is decided.
pub fn is_enclosed<A: Algorithm<Rational> + Algorithm<Ball>>() {
    let what = format!("{} in enclosures", A::NAME);
    let counts = counted(&what, |tape| {
        let input = Input::drawn(&tape, Drawn::drawn);
        let balls = input.try_map(|value| Some(Ball::of(value))).expect("total");
        let enclosed = <A as Algorithm<Ball>>::run(&balls);
        if enclosed.undecided {
            return Ok(false);
        }
        let exact = <A as Algorithm<Rational>>::run(&input);
        proptest::prop_assert_eq!(&enclosed.plain, &exact.plain);
        proptest::prop_assert_eq!(enclosed.numbers.len(), exact.numbers.len());
        for (ball, value) in enclosed.numbers.iter().zip(&exact.numbers) {
            proptest::prop_assert!(ball.contains(value), "{} is not in {:?}", value, ball);
        }
        Ok(true)
    });
    println!("{what:<58} inside {:>3} undecided {:>3}", counts.equal, counts.vanished);
    assert!(counts.equal > 0, "{what}: nothing was decided");
}

macro_rules! enclosed {
    ($($algorithm:ident),+ $(,)?) => {$( $crate::ball::is_enclosed::<$algorithm>(); )+};
}
pub(crate) use enclosed;

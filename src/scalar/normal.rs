//! The distribution function of the standard normal law, enclosed.
//!
//! Near zero by `Φ(z) = ½ + φ(z) Σ z^(2k+1)/(2k+1)!!`, all terms of one sign. Far out by the continued fraction of Laplace:
//! with `J_n = ∫ tⁿ/n! exp(−t²/2 − zt) dt` over t > 0, integration by parts gives `J_{n−1} = zJ_n + (n + 1)J_{n+1}` (J_{−1} standing for 1), so that
//! `U_n = J_{n−2}/J_{n−1}` is positive, `U_n = z + n/U_{n+1}`, hence `z ≤ U_n ≤ z + n/z`, and `Φ(−z) = φ(z) J_0 = φ(z)/U_1`.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::dyadic::{Dyadic, Toward};
use super::{Interval, Overflow, Rational, ratio};

impl Interval {
    /// Φ(x), the probability that a standard normal variable is at most x, with a relative width of about 2^−bits even where
    /// it is tiny.
    ///
    /// # Errors
    ///
    /// [`Overflow`] where exp(−x²/2) has no exponent.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::scalar::{Interval, ratio};
    ///
    /// let found = Interval::normal_distribution(&ratio(1, 1), 40)?;
    /// assert!(found.lower().value() > Some(ratio(84_134_474, 100_000_000)));
    /// assert!(found.upper().value() < Some(ratio(84_134_475, 100_000_000)));
    /// # Ok::<(), exact_kalman::scalar::Overflow>(())
    /// ```
    pub fn normal_distribution(x: &Rational, bits: u64) -> Result<Self, Overflow> {
        Self::normal_distribution_of_root(x.is_negative(), &(x * x), bits)
    }

    /// Φ(√s), or Φ(−√s) if so wished, for a fraction s ≥ 0: as [`Interval::normal_distribution`], where x² is a fraction and x may be
    /// none.
    ///
    /// # Errors
    ///
    /// As there.
    ///
    /// # Panics
    ///
    /// If s is negative.
    pub fn normal_distribution_of_root(negative: bool, square: &Rational, bits: u64) -> Result<Self, Overflow> {
        assert!(!square.is_negative(), "the root of a negative number");
        let one = Self::of(&Rational::one(), 1);
        if square.is_zero() {
            return Ok(Self::of(&ratio(1, 2), 1));
        }
        let far = *square > Rational::from(BigInt::from(bits.max(16)));
        let tail = |bits| if far { fraction(square, bits) } else { near(square, bits) };
        let tail = tail(bits.saturating_add(8))?;
        Ok(if negative { tail } else { one.minus(&tail, bits.saturating_add(8)) })
    }
}

/// Φ(−√s) by the series, for an s of no more than about as many as the bits: what the difference ½ − … cancels are some
/// s/(2 ln 2) + log₂(2πs)/2 bits.
fn near(square: &Rational, bits: u64) -> Result<Interval, Overflow> {
    let lost = u64::try_from(square.ceil().to_integer()).unwrap_or(u64::MAX / 4);
    let work = bits.saturating_add(lost).saturating_add(16);
    let step = Interval::of(square, work);
    let mut term = Interval::of(&Rational::one(), 1);
    let mut sum = term.clone();
    let mut odd = 1_u64;
    let least = -i64::try_from(work).unwrap_or(i64::MAX);
    loop {
        odd += 2;
        let divisor = Interval::of(&Rational::from(BigInt::from(odd)), 64);
        term = quotient(&term.times(&step, work), &divisor, work);
        sum = sum.plus(&term, work);
        // From here on each term is at most half of the one before, and the rest no more than the last.
        let halves = step.upper().times(&Dyadic::new(BigInt::one(), 1), 64, Toward::Above)
            <= Dyadic::new(BigInt::from(odd + 2), 0);
        if halves && term.upper().magnitude().is_none_or(|size| size < least) {
            break;
        }
    }
    let sum = sum.plus(&term.joined(&Interval::zero()), work);
    let of_root = Interval::square_root(square, work).unwrap_or_else(|error| unreachable!("positive, but {error}"));
    let above = sum.times(&of_root, work).times(&density(square, work)?, work);
    let tail = Interval::of(&ratio(1, 2), 1).minus(&above, work);
    Ok(Interval::between(tail.lower().clone().max(Dyadic::zero()), tail.upper().clone()))
}

/// Φ(−√s) by the continued fraction.
fn fraction(square: &Rational, bits: u64) -> Result<Interval, Overflow> {
    let work = bits + 16;
    let z = Interval::square_root(square, work).unwrap_or_else(|error| unreachable!("positive, but {error}"));
    let mut depth = 8_u64;
    loop {
        let level = |n: u64| Interval::of(&Rational::from(BigInt::from(n)), 64);
        let mut tail = z.plus(&Interval::zero().joined(&quotient(&level(depth), &z, work)), work);
        for n in (1..depth).rev() {
            tail = z.plus(&quotient(&level(n), &tail, work), work);
        }
        let width = tail.upper().plus(&tail.lower().negated(), 64, Toward::Above);
        // Rounding alone makes it wider than 2^(6 − work) of itself at no depth that is needed here.
        let sharp = width.magnitude().is_none_or(|size| {
            size <= tail.lower().magnitude().unwrap_or_default() - i64::try_from(bits).unwrap_or(i64::MAX)
        });
        if sharp || depth > 64 * bits {
            return Ok(quotient(&density(square, work)?, &tail, work));
        }
        depth *= 2;
    }
}

/// exp(−s/2)/√(2π)
fn density(square: &Rational, work: u64) -> Result<Interval, Overflow> {
    let pi = Interval::pi(work + 8);
    let two_pi = pi.plus(&pi, work + 8);
    let root = |end: &Dyadic| {
        let value = end.value().unwrap_or_else(|| unreachable!("π is short"));
        Interval::square_root(&value, work).unwrap_or_else(|error| unreachable!("positive, but {error}"))
    };
    let root = root(two_pi.lower()).joined(&root(two_pi.upper()));
    Ok(quotient(&Interval::exponential(&(square * ratio(-1, 2)), work)?, &root, work))
}

/// By a positive divisor.
fn quotient(dividend: &Interval, divisor: &Interval, bits: u64) -> Interval {
    dividend.over(divisor, bits).unwrap_or_else(|error| unreachable!("positive, but {error}"))
}

//! Quotients of polynomials: the field in which an identity that holds is proved.

use std::fmt;
use std::rc::Rc;

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::gcd::common_divisor;
use super::polynomial::{Polynomial, TooLarge, VARIABLES};
use super::{Field, Rational, Scalar, Undefined, ZeroTest};

/// An element of ℚ(x₀, x₁, …): what a computation yields when its inputs are left open.
///
/// If two computations agree here, they agree wherever both are defined and decide as they do here (whether an entry is zero). The numerator is a polynomial with integer coefficients,
/// the denominator a product of polynomials that were divisors once. No greatest common divisor is taken: the numerator is divided
/// by each factor as long as that leaves no rest, and a factor is split where another divides it. So a value may have several
/// forms; zero has one, and equality is that of the difference with zero.
///
/// Work is bounded. A value that would need more than 400 000 terms, a power above 255 or more than 64 variables is *too large*: it
/// answers no zero test and divides nothing, every result from it is too large, and only there the promise of [`Field`] to decide is
/// not kept.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{RationalFunction, Scalar};
///
/// let (x, y) = (RationalFunction::variable(0), RationalFunction::variable(1));
/// let left = x.times(&x).minus(&y.times(&y)).over(&x.minus(&y))?;
/// assert_eq!(left, x.plus(&y));
/// # Ok::<(), exact_kalman::scalar::Undefined>(())
/// ```
#[derive(Clone)]
pub struct RationalFunction(Option<Fraction>);

/// `numerator / (integer · Π factor^power)`; integer > 0, and prime to the numerator's content.
#[derive(Clone)]
struct Fraction {
    numerator: Polynomial,
    integer: BigInt,
    /// Primitive, not constant, the leading coefficient positive; no two the same.
    factors: Vec<(Rc<Factor>, u32)>,
}

/// A divisor, with its value at one point: an integer that must divide that of whatever the divisor divides.
struct Factor {
    polynomial: Polynomial,
    value: BigInt,
}

thread_local! {
    /// Where divisors are tried first: one integer for each variable.
    static TRIAL: Vec<BigInt> = (0..VARIABLES as u64).map(|i| BigInt::from(10_007 + (i + 3) * (i * 7919 + 1_299_709) % 65_521)).collect();
}

fn trial_value(polynomial: &Polynomial) -> BigInt {
    TRIAL.with(|point| polynomial.value(point))
}

impl Factor {
    fn new(polynomial: Polynomial) -> Rc<Self> {
        Rc::new(Self { value: trial_value(&polynomial), polynomial })
    }

    fn may_divide(&self, value: &BigInt) -> bool {
        self.value.is_zero() || (value % &self.value).is_zero()
    }
}

/// Takes a power of a factor into a list of which none divides another; factors are split where that needs it.
fn refined(list: &mut Vec<(Rc<Factor>, u32)>, factor: Rc<Factor>, power: u32) {
    if power == 0 || factor.polynomial.as_constant().is_some() {
        return;
    }
    for place in 0..list.len() {
        let (own, times) = list[place].clone();
        if own.value == factor.value && own.polynomial == factor.polynomial {
            list[place].1 += power;
            return;
        }
        if own.may_divide(&factor.value)
            && let Some(quotient) = factor.polynomial.quotient(&own.polynomial)
        {
            list[place].1 += power;
            return refined(list, Factor::new(quotient), power);
        }
        if factor.may_divide(&own.value)
            && let Some(quotient) = own.polynomial.quotient(&factor.polynomial)
        {
            list.swap_remove(place);
            refined(list, factor, power + times);
            return refined(list, Factor::new(quotient), times);
        }
    }
    list.push((factor, power));
}

/// How often each factor of `base` is in a list of factors, if they are products of them as far as division in this order shows: none
/// of the base divides another, but they may have divisors in common.
fn powers_in(list: &[(Rc<Factor>, u32)], base: &[(Rc<Factor>, u32)]) -> Option<Vec<u32>> {
    let mut powers = vec![0; base.len()];
    for (factor, power) in list {
        let mut rest = Rc::clone(factor);
        for (place, (prime, _)) in base.iter().enumerate() {
            while prime.may_divide(&rest.value)
                && let Some(quotient) = rest.polynomial.quotient(&prime.polynomial)
            {
                powers[place] += power;
                rest = Factor::new(quotient);
            }
        }
        // Primitive and positive: one, if it is constant.
        rest.polynomial.as_constant()?;
    }
    Some(powers)
}

/// A base of both lists, with how often each of it is in either.
fn common_base(own: &[(Rc<Factor>, u32)], others: &[(Rc<Factor>, u32)]) -> (Vec<Rc<Factor>>, Vec<u32>, Vec<u32>) {
    let mut base = Vec::new();
    for (factor, power) in own.iter().chain(others) {
        refined(&mut base, Rc::clone(factor), *power);
    }
    if let (Some(in_own), Some(in_others)) = (powers_in(own, &base), powers_in(others, &base)) {
        return (base.into_iter().map(|(factor, _)| factor).collect(), in_own, in_others);
    }
    // The factors as they are: each is one of the base.
    let mut base: Vec<Rc<Factor>> = own.iter().map(|(factor, _)| Rc::clone(factor)).collect();
    for (factor, _) in others {
        if base.iter().all(|known| known.polynomial != factor.polynomial) {
            base.push(Rc::clone(factor));
        }
    }
    let power = |list: &[(Rc<Factor>, u32)], factor: &Factor| {
        list.iter().find(|(known, _)| known.polynomial == factor.polynomial).map_or(0, |(_, power)| *power)
    };
    let powers = |list: &[(Rc<Factor>, u32)]| base.iter().map(|factor| power(list, factor)).collect();
    let (in_own, in_others) = (powers(own), powers(others));
    (base, in_own, in_others)
}

fn power(factor: &Polynomial, exponent: u32) -> Result<Polynomial, TooLarge> {
    (0..exponent).try_fold(Polynomial::constant(<BigInt as One>::one()), |product, _| product.product(factor))
}

/// Takes out of a numerator what the factors hold too.
fn cancelled(numerator: &mut Polynomial, factors: &mut Vec<(Rc<Factor>, u32)>) {
    if factors.is_empty() || numerator.is_zero() {
        factors.clear();
        return;
    }
    let mut value = trial_value(numerator);
    for (factor, power) in factors.iter_mut() {
        while *power > 0
            && factor.may_divide(&value)
            && let Some(quotient) = numerator.quotient(&factor.polynomial)
        {
            *numerator = quotient;
            value = trial_value(numerator);
            *power -= 1;
        }
    }
    factors.retain(|(_, power)| *power > 0);
}

impl Fraction {
    fn polynomial(numerator: Polynomial) -> Self {
        Self { numerator, integer: <BigInt as One>::one(), factors: Vec::new() }
    }

    /// With the numerator prime to each factor, as far as exact division shows.
    fn reduced(mut self) -> Self {
        cancelled(&mut self.numerator, &mut self.factors);
        self.without_content()
    }

    fn without_content(mut self) -> Self {
        if self.numerator.is_zero() {
            return Self::polynomial(self.numerator);
        }
        if !self.integer.is_one() {
            let shared = common_divisor(&self.numerator.content(), &self.integer);
            self.numerator = self.numerator.divided_by_integer(&shared);
            self.integer /= shared;
        }
        self
    }

    fn sum(&self, other: &Self, subtract: bool) -> Result<Self, TooLarge> {
        if self.factors.is_empty() && other.factors.is_empty() && self.integer == other.integer {
            let numerator = self.numerator.sum(&other.numerator, subtract)?;
            return Ok(Self { numerator, integer: self.integer.clone(), factors: Vec::new() }.without_content());
        }
        let (base, own, others) = common_base(&self.factors, &other.factors);
        let shared = common_divisor(&self.integer, &other.integer);
        let mut left = self.numerator.scaled(&(&other.integer / &shared));
        let mut right = other.numerator.scaled(&(&self.integer / &shared));
        let mut factors = Vec::with_capacity(base.len());
        for ((factor, own), others) in base.into_iter().zip(own).zip(others) {
            let most = own.max(others);
            left = left.product(&power(&factor.polynomial, most - own)?)?;
            right = right.product(&power(&factor.polynomial, most - others)?)?;
            factors.push((factor, most));
        }
        let numerator = left.sum(&right, subtract)?;
        Ok(Self { numerator, integer: &self.integer / shared * &other.integer, factors }.reduced())
    }

    fn product(&self, other: &Self) -> Result<Self, TooLarge> {
        let (mut left, mut right) = (self.numerator.clone(), other.numerator.clone());
        let (mut own, mut others) = (self.factors.clone(), other.factors.clone());
        cancelled(&mut left, &mut others);
        cancelled(&mut right, &mut own);
        for (factor, power) in others {
            refined(&mut own, factor, power);
        }
        let product = Self { numerator: left.product(&right)?, integer: &self.integer * &other.integer, factors: own };
        Ok(product.without_content())
    }

    /// One over a fraction that is not zero.
    fn inverse(&self) -> Result<Self, TooLarge> {
        let mut numerator = Polynomial::constant(self.integer.clone());
        for (factor, times) in &self.factors {
            numerator = numerator.product(&power(&factor.polynomial, *times)?)?;
        }
        let content = self.numerator.content();
        if content.is_negative() {
            numerator = numerator.scaled(&-<BigInt as One>::one());
        }
        let (variables, rest) = self.numerator.divided_by_integer(&content).without_variables();
        let mut factors = Vec::new();
        for (number, power) in variables {
            refined(&mut factors, Factor::new(Polynomial::variable(number)), power);
        }
        refined(&mut factors, Factor::new(rest), 1);
        Ok(Self { numerator, integer: content.abs(), factors }.without_content())
    }
}

impl RationalFunction {
    /// The variable xₙ; too large for n ≥ 64.
    pub fn variable(number: usize) -> Self {
        Self((number < VARIABLES).then(|| Fraction::polynomial(Polynomial::variable(number))))
    }

    /// Whether the bound of work was met, so that nothing is known of the value.
    pub fn is_too_large(&self) -> bool {
        self.0.is_none()
    }

    /// The number of terms of the numerator, zero for zero; nothing if the value is too large.
    pub fn terms(&self) -> Option<usize> {
        self.0.as_ref().map(|fraction| fraction.numerator.terms())
    }

    /// The total degrees of numerator and denominator, in the form at hand; nothing if the value is too large.
    pub fn degrees(&self) -> Option<(u32, u32)> {
        let fraction = self.0.as_ref()?;
        let below = fraction.factors.iter().map(|(factor, power)| factor.polynomial.degree() * power).sum();
        Some((fraction.numerator.degree(), below))
    }

    /// The value at a point of integers, of which there must be one for each variable used (others count as zero).
    ///
    /// Nothing if the denominator vanishes there, or the value is too large.
    pub fn value_at(&self, point: &[BigInt]) -> Option<Rational> {
        let fraction = self.0.as_ref()?;
        let factors = fraction.factors.iter().map(|(factor, power)| factor.polynomial.value(point).pow(*power));
        let below = factors.fold(fraction.integer.clone(), |product, value| product * value);
        (!below.is_zero()).then(|| Rational::new(fraction.numerator.value(point), below))
    }

    fn of(value: Result<Fraction, TooLarge>) -> Self {
        Self(value.ok())
    }
}

impl From<Rational> for RationalFunction {
    fn from(value: Rational) -> Self {
        let (numerator, integer) = value.into_raw();
        Self(Some(Fraction { numerator: Polynomial::constant(numerator), integer, factors: Vec::new() }))
    }
}

impl Scalar for RationalFunction {
    fn zero() -> Self {
        Self::from_integer(0)
    }

    fn one() -> Self {
        Self::from_integer(1)
    }

    fn plus(&self, other: &Self) -> Self {
        let (Some(left), Some(right)) = (&self.0, &other.0) else { return Self(None) };
        if left.numerator.is_zero() {
            return other.clone();
        }
        if right.numerator.is_zero() {
            return self.clone();
        }
        Self::of(left.sum(right, false))
    }

    fn minus(&self, other: &Self) -> Self {
        let (Some(left), Some(right)) = (&self.0, &other.0) else { return Self(None) };
        if right.numerator.is_zero() {
            return self.clone();
        }
        Self::of(left.sum(right, true))
    }

    fn times(&self, other: &Self) -> Self {
        let (Some(left), Some(right)) = (&self.0, &other.0) else { return Self(None) };
        if left.numerator.is_zero() || right.numerator.is_zero() {
            return Self::zero();
        }
        Self::of(left.product(right))
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        let below = divisor.0.as_ref().ok_or(Undefined::Undecided)?;
        if below.numerator.is_zero() {
            return Err(Undefined::DivisionByZero);
        }
        let Some(above) = &self.0 else { return Ok(Self(None)) };
        // Elimination divides by what it multiplied with.
        if below.numerator.as_constant().is_none()
            && let Some(numerator) = above.numerator.quotient(&below.numerator)
        {
            let rest = Fraction { numerator, ..above.clone() };
            let factors = Fraction { numerator: Polynomial::constant(<BigInt as One>::one()), ..below.clone() };
            return Ok(Self::of(factors.inverse().and_then(|inverse| rest.product(&inverse))));
        }
        Ok(Self::of(below.inverse().and_then(|inverse| above.product(&inverse))))
    }

    fn zero_test(&self) -> ZeroTest {
        match &self.0 {
            None => ZeroTest::Undecided,
            Some(fraction) if fraction.numerator.is_zero() => ZeroTest::Zero,
            Some(_) => ZeroTest::Nonzero,
        }
    }

    fn from_integer(value: i64) -> Self {
        Self(Some(Fraction::polynomial(Polynomial::constant(value.into()))))
    }
}

/// Values that are too large equal one another, as `==` must be reflexive, and nothing else.
impl PartialEq for RationalFunction {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (None, None) => true,
            (Some(left), Some(right)) => {
                if left.factors.is_empty() && right.factors.is_empty() {
                    return left.numerator == right.numerator && left.integer == right.integer;
                }
                left.sum(right, true).is_ok_and(|difference| difference.numerator.is_zero())
            }
            _ => false,
        }
    }
}

impl Eq for RationalFunction {}
impl Field for RationalFunction {}

impl fmt::Display for RationalFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(fraction) = &self.0 else { return f.write_str("too large") };
        if fraction.integer.is_one() && fraction.factors.is_empty() {
            return write!(f, "{}", fraction.numerator);
        }
        write!(f, "({})/({}", fraction.numerator, fraction.integer)?;
        for (factor, power) in &fraction.factors {
            write!(f, "·({})^{power}", factor.polynomial)?;
        }
        f.write_str(")")
    }
}

impl fmt::Debug for RationalFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

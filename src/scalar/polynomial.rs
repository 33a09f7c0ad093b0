//! Polynomials in several variables with integer coefficients, few of which are nonzero.

use std::collections::{BTreeMap, HashMap};
use std::fmt;

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::gcd::common_divisor;

/// The most variables there are.
pub(super) const VARIABLES: usize = 64;

/// What a polynomial may hold, and products of terms that one operation may take: a bound of work, so that nothing hangs.
const MOST_TERMS: usize = 400_000;
const MOST_PRODUCTS: usize = 60_000_000;

/// A polynomial would have too many terms, or a power too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TooLarge;

/// The exponents of a product of powers; the order is lexicographic, which products respect.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Monomial([u8; VARIABLES]);

impl Monomial {
    const ONE: Self = Self([0; VARIABLES]);

    fn times(&self, other: &Self) -> Option<Self> {
        let mut product = self.0;
        for (own, power) in product.iter_mut().zip(other.0) {
            *own = own.checked_add(power)?;
        }
        Some(Self(product))
    }

    fn over(&self, other: &Self) -> Option<Self> {
        let mut quotient = self.0;
        for (own, power) in quotient.iter_mut().zip(other.0) {
            *own = own.checked_sub(power)?;
        }
        Some(Self(quotient))
    }

    fn powers(&self) -> impl Iterator<Item = (usize, u8)> + '_ {
        self.0.iter().copied().enumerate().filter(|(_, power)| *power > 0)
    }
}

/// A sum of multiples of monomials, the largest first, none with the coefficient zero.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Polynomial(Vec<(Monomial, BigInt)>);

impl Polynomial {
    pub(super) fn constant(value: BigInt) -> Self {
        Self(if value.is_zero() { Vec::new() } else { vec![(Monomial::ONE, value)] })
    }

    /// The variable with this number, which is below [`VARIABLES`].
    pub(super) fn variable(number: usize) -> Self {
        let mut powers = [0; VARIABLES];
        powers[number] = 1;
        Self(vec![(Monomial(powers), <BigInt as One>::one())])
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn terms(&self) -> usize {
        self.0.len()
    }

    /// The value, if there is no variable.
    pub(super) fn as_constant(&self) -> Option<BigInt> {
        match self.0.as_slice() {
            [] => Some(BigInt::zero()),
            [(monomial, value)] if *monomial == Monomial::ONE => Some(value.clone()),
            _ => None,
        }
    }

    /// The largest sum of powers in a term.
    pub(super) fn degree(&self) -> u32 {
        self.0.iter().map(|(monomial, _)| monomial.0.iter().map(|&power| u32::from(power)).sum()).max().unwrap_or(0)
    }

    pub(super) fn scaled(&self, factor: &BigInt) -> Self {
        if factor.is_one() {
            return self.clone();
        }
        let terms = self.0.iter().map(|(monomial, value)| (*monomial, value * factor));
        Self(if factor.is_zero() { Vec::new() } else { terms.collect() })
    }

    /// `self + sign · other`
    pub(super) fn sum(&self, other: &Self, subtract: bool) -> Result<Self, TooLarge> {
        let (mut left, mut right) = (self.0.iter().peekable(), other.0.iter().peekable());
        let signed = |value: &BigInt| if subtract { -value } else { value.clone() };
        let mut terms = Vec::with_capacity(self.0.len().max(other.0.len()));
        loop {
            match (left.peek(), right.peek()) {
                (None, None) => break,
                (Some((a, x)), Some((b, y))) if a == b => {
                    let value = if subtract { x - y } else { x + y };
                    if !value.is_zero() {
                        terms.push((*a, value));
                    }
                    left.next();
                    right.next();
                }
                (Some((a, x)), b) if b.is_none_or(|(b, _)| a > b) => {
                    terms.push((*a, x.clone()));
                    left.next();
                }
                (_, Some((b, y))) => {
                    terms.push((*b, signed(y)));
                    right.next();
                }
                (Some(_), None) => unreachable!("the guard above holds"),
            }
        }
        Self(terms).bounded()
    }

    pub(super) fn product(&self, other: &Self) -> Result<Self, TooLarge> {
        let (short, long) = if self.terms() <= other.terms() { (self, other) } else { (other, self) };
        if let [(monomial, factor)] = short.0.as_slice() {
            let term = |(m, value): &(Monomial, BigInt)| Some((m.times(monomial)?, value * factor));
            return long.0.iter().map(term).collect::<Option<_>>().map(Self).ok_or(TooLarge);
        }
        if short.terms().saturating_mul(long.terms()) > MOST_PRODUCTS {
            return Err(TooLarge);
        }
        let mut sums: HashMap<Monomial, BigInt> = HashMap::new();
        for (a, x) in &short.0 {
            for (b, y) in &long.0 {
                *sums.entry(a.times(b).ok_or(TooLarge)?).or_default() += x * y;
            }
            if sums.len() > MOST_TERMS {
                return Err(TooLarge);
            }
        }
        let mut terms: Vec<_> = sums.into_iter().filter(|(_, value)| !value.is_zero()).collect();
        terms.sort_unstable_by(|(a, _), (b, _)| b.cmp(a));
        Ok(Self(terms))
    }

    /// The quotient, if the division leaves nothing and needs no fraction.
    pub(super) fn quotient(&self, divisor: &Self) -> Option<Self> {
        let (first, leading) = divisor.0.first()?;
        if self.is_zero() {
            return Some(self.clone());
        }
        // The least terms must divide as the largest do.
        let least = |polynomial: &Self| polynomial.0.last().map(|(monomial, _)| *monomial);
        least(self)?.over(&least(divisor)?)?;
        let mut rest: BTreeMap<Monomial, BigInt> = self.0.iter().cloned().collect();
        let (mut terms, mut products) = (Vec::new(), 0_usize);
        while let Some((monomial, value)) = rest.pop_last() {
            let monomial = monomial.over(first)?;
            let factor = &value / leading;
            products += divisor.terms();
            if &factor * leading != value || products > MOST_PRODUCTS {
                return None;
            }
            for (power, coefficient) in divisor.0.iter().skip(1) {
                let place = monomial.times(power)?;
                let entry = rest.entry(place).or_default();
                *entry -= coefficient * &factor;
                if entry.is_zero() {
                    rest.remove(&place);
                }
            }
            terms.push((monomial, factor));
        }
        Some(Self(terms))
    }

    /// The greatest common divisor of the coefficients with the sign of the first one; one for zero.
    pub(super) fn content(&self) -> BigInt {
        let Some((_, leading)) = self.0.first() else { return <BigInt as One>::one() };
        let mut content = leading.abs();
        for (_, value) in &self.0 {
            if content.is_one() {
                break;
            }
            content = common_divisor(&content, value);
        }
        if leading.is_negative() { -content } else { content }
    }

    pub(super) fn divided_by_integer(&self, divisor: &BigInt) -> Self {
        if divisor.is_one() {
            return self.clone();
        }
        Self(self.0.iter().map(|(monomial, value)| (*monomial, value / divisor)).collect())
    }

    /// The variables that divide every term, with their powers, and what is left.
    pub(super) fn without_variables(&self) -> (Vec<(usize, u32)>, Self) {
        let mut least = Monomial([u8::MAX; VARIABLES]);
        for (monomial, _) in &self.0 {
            for (own, power) in least.0.iter_mut().zip(monomial.0) {
                *own = (*own).min(power);
            }
        }
        if self.is_zero() {
            return (Vec::new(), self.clone());
        }
        let rest = self.0.iter().filter_map(|(monomial, value)| Some((monomial.over(&least)?, value.clone())));
        (least.powers().map(|(number, power)| (number, u32::from(power))).collect(), Self(rest.collect()))
    }

    /// The value at a point; variables beyond its length are zero.
    pub(super) fn value(&self, point: &[BigInt]) -> BigInt {
        let zero = BigInt::zero();
        let mut table: Vec<Vec<BigInt>> = vec![Vec::new(); VARIABLES];
        let mut sum = BigInt::zero();
        for (monomial, coefficient) in &self.0 {
            let mut product = coefficient.clone();
            for (number, power) in monomial.powers() {
                let powers = &mut table[number];
                let base = point.get(number).unwrap_or(&zero);
                while powers.len() <= usize::from(power) {
                    powers.push(powers.last().map_or_else(BigInt::one, |last| last * base));
                }
                product *= &powers[usize::from(power)];
            }
            sum += product;
        }
        sum
    }

    /// The terms with their powers, the largest first.
    pub(super) fn parts(&self) -> impl Iterator<Item = (Vec<(usize, u8)>, &BigInt)> {
        self.0.iter().map(|(monomial, value)| (monomial.powers().collect(), value))
    }

    fn bounded(self) -> Result<Self, TooLarge> {
        if self.terms() > MOST_TERMS { Err(TooLarge) } else { Ok(self) }
    }
}

impl fmt::Display for Polynomial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (place, (powers, value)) in self.parts().enumerate() {
            let sign = if value.is_negative() { "-" } else { "+" };
            match (place, value.is_negative()) {
                (0, false) => {}
                (0, true) => f.write_str(sign)?,
                _ => write!(f, " {sign} ")?,
            }
            let size = value.abs();
            let named = size.to_i8() != Some(1) || powers.is_empty();
            if named {
                write!(f, "{size}")?;
            }
            for (rank, (number, power)) in powers.iter().enumerate() {
                let product = if named || rank > 0 { "·" } else { "" };
                let exponent = if *power > 1 { format!("^{power}") } else { String::new() };
                write!(f, "{product}x{number}{exponent}")?;
            }
        }
        Ok(())
    }
}

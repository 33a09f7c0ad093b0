//! Rationals in a few decimal digits.

use exact_kalman::protocol::Decimal;
use exact_kalman::scalar::{Dyadic, Interval, Quotient, Rational, ratio};
use num_bigint::BigInt;
use proptest::prelude::*;

#[test]
fn known_decimals() {
    for (value, digits, text) in [
        (ratio(0, 1), 3, "0"),
        (ratio(1, 3), 3, "0.333"),
        (ratio(-9_996, 1000), 3, "-10"),
        (ratio(1, 1000), 1, "0.001"),
        (ratio(1, 1_000_000), 1, "1e-6"),
        (ratio(314_159, 100_000), 4, "3.142"),
        (ratio(1_234_567, 1), 3, "1.23e6"),
        (ratio(25, 2), 17, "12.5"),
        (ratio(5, 100_000), 2, "0.00005"),
        (ratio(120, 1), 2, "120"),
    ] {
        assert_eq!(Decimal::rounded(&value, digits).to_string(), text);
    }
}

/// Digits of exponentials far beyond what can be written out, by mpmath with 100 digits.
#[test]
fn decimals_of_huge_and_tiny_intervals() {
    let (billion, last) = (ratio(1_000_000_000, 1), ratio(1 << 62, 1));
    for (x, text) in [
        (-billion.clone(), "1.249534271921013280924378499014991e-434294482"),
        (billion, "8.002981770660972533041909374365001e434294481"),
        (-last.clone(), "2.233295821253955161126914384678474e-2002829790073392691"),
        (last, "4.47768714956229179208990880883461e2002829790073392690"),
    ] {
        let found = Interval::exponential(&x, 200).expect("within reach");
        assert_eq!(Decimal::of_interval(&found, 34).expect("narrow").to_string(), text);
        let negative = Decimal::of_interval(&found.negated(), 34).expect("narrow").to_string();
        assert_eq!(negative, format!("-{text}"));
    }
    let zero = Interval::between(Dyadic::zero(), Dyadic::one());
    assert_eq!(Decimal::of_interval(&zero, 3), None);
    assert_eq!(Decimal::of_interval(&zero.minus(&Interval::between(Dyadic::one(), Dyadic::one()), 9), 3), None);
    // 0.4999 to 0.5001 to one digit, and 9.9996 up to 10.
    let between = |a: Rational, b: Rational| Interval::of(&a, 90).joined(&Interval::of(&b, 90));
    assert_eq!(Decimal::of_interval(&between(ratio(2499, 1000), ratio(2501, 1000)), 1), None);
    let carried = Decimal::of_interval(&between(ratio(99_996, 10_000), ratio(99_999, 10_000)), 4);
    assert_eq!(carried.expect("alike").to_string(), "10");
}

proptest! {
    /// Against the fraction, rounded exactly: numbers of more than 2¹⁶ bits.
    #[test]
    fn decimals_of_intervals_are_those_of_fractions(n in any::<i64>(), up in any::<bool>(), digits in 1_u32..20) {
        prop_assume!(n != 0);
        let power = Rational::from(BigInt::from(10).pow(22_000));
        let value = Rational::from(BigInt::from(n)) * if up { power } else { power.recip() };
        let found = Decimal::of_interval(&Interval::of(&value, 200), digits);
        // An interval around a tie has no decimal; no tie has the digits of n and more.
        prop_assert!(found.is_some() || digits < 19);
        prop_assert!(found.is_none_or(|found| found == Decimal::rounded(&value, digits)));
    }

    /// Against the decimal of the short value: multiples of both integers, long enough to be looked at by leading bits.
    #[test]
    fn decimals_of_quotients_are_those_of_fractions(
        n in any::<i64>(), d in 1..=i64::MAX, factor in any::<u64>(), shift in -320_i32..320, digits in 1_u32..20,
    ) {
        let ten = Rational::from(BigInt::from(10)).pow(shift);
        let value = Rational::new(n.into(), d.into()) * ten;
        let factor = BigInt::from(7).pow(2000) + factor;
        let (numerator, denominator) = (value.numer() * &factor, value.denom() * &factor);
        let found = Decimal::of_quotient(Quotient::new(&numerator, &denominator), digits);
        prop_assert_eq!(found, Decimal::of_quotient((&value).into(), digits));
    }

    /// Numbers in the middle of two decimals, and a little beside it, whatever their size: the digits are known.
    #[test]
    fn decimals_next_to_ties(
        significand in 100_u64..1000, up in any::<bool>(), shift in 0_u32..3000, off in -1_i32..=1, negative in any::<bool>(),
    ) {
        let (deep, power) = (BigInt::from(10).pow(4000), BigInt::from(10).pow(shift));
        let numerator: BigInt = (BigInt::from(significand) * 10 + 5) * &deep + off;
        let numerator = if negative { -numerator } else { numerator };
        let (numerator, denominator) = if up { (numerator * power, deep) } else { (numerator, deep * power) };
        let found = Decimal::of_quotient(Quotient::new(&numerator, &denominator), 3).value();
        let away = i64::try_from(significand).expect("few digits") + i64::from(off >= 0);
        let places = i32::try_from(shift).expect("a small shift");
        let scale = Rational::from(BigInt::from(10)).pow(1 + if up { places } else { -places });
        prop_assert_eq!(found, scale * ratio(if negative { -away } else { away }, 1));
    }

    #[test]
    fn rounding_moves_by_half_a_unit_at_most(n in any::<i64>(), d in 1..=i64::MAX, shift in -30_i32..30, digits in 1_u32..20) {
        prop_assume!(n != 0);
        let ten = Rational::from(BigInt::from(10)).pow(shift);
        let value = Rational::new(n.into(), d.into()) * ten;
        let decimal = Decimal::rounded(&value, digits);
        let absolute = |x: Rational| if x < ratio(0, 1) { -x } else { x };
        let error = absolute(decimal.value() - &value) / absolute(value);
        // A unit in the last of `digits` places is at most 10^(1−digits) of the value.
        prop_assert!(error * ratio(2, 1) <= Rational::from(BigInt::from(10)).pow(1 - i32::try_from(digits).expect("small")));
    }

    #[test]
    fn the_text_is_the_value(n in any::<i64>(), d in 1..=i64::MAX, digits in 1_u32..18) {
        let decimal = Decimal::rounded(&Rational::new(n.into(), d.into()), digits);
        // The standard library's reader of decimals, and one rounding of the exact value.
        let text = decimal.to_string();
        let expected = exact_kalman::scalar::nearest_double(&decimal.value());
        prop_assert_eq!(text.parse::<f64>().expect("a number").to_bits(), expected.to_bits(), "{}", text);
    }
}

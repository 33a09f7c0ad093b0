//! Rationals in a few decimal digits.

use exact_kalman::protocol::Decimal;
use exact_kalman::scalar::{Rational, ratio};
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

proptest! {
    #[test]
    fn rounding_moves_by_half_a_unit_at_most(n in any::<i64>(), d in 1..=i64::MAX, shift in -30_i32..30, digits in 1_u32..20) {
        prop_assume!(n != 0);
        let ten = Rational::from(BigInt::from(10)).pow(shift);
        let value = Rational::new(n.into(), d.into()) * ten;
        let decimal = Decimal::rounded(&value, digits);
        let absolute = |x: Rational| if x < ratio(0, 1) { -x } else { x };
        let error = absolute(decimal.value() - &value) / absolute(value);
        // A unit in the last of `digits` places is at most 10^(1−digits) of the value.
        prop_assert!(error * ratio(2, 1) <= Rational::from(BigInt::from(10)).pow(1 - i32::try_from(digits).unwrap()));
    }

    #[test]
    fn the_text_is_the_value(n in any::<i64>(), d in 1..=i64::MAX, digits in 1_u32..18) {
        let decimal = Decimal::rounded(&Rational::new(n.into(), d.into()), digits);
        // The standard library's reader of decimals, and one rounding of the exact value.
        let text = decimal.to_string();
        let expected = exact_kalman::scalar::nearest_double(&decimal.value());
        prop_assert_eq!(text.parse::<f64>().unwrap().to_bits(), expected.to_bits(), "{}", text);
    }
}

//! Literals: every double survives, the nearest double is the nearest, nonsense is refused at once.

use std::time::{Duration, Instant};

use exact_kalman::protocol::{Number, NumberError, Numbers, shortest_double};
use exact_kalman::scalar::{Rational, exact_value, nearest_double, nearest_single, ratio};
use num_bigint::BigInt;
use proptest::prelude::*;

/// `m · 2^e`, by the definition.
fn dyadic(m: i64, e: i32) -> Rational {
    let power = BigInt::from(2).pow(e.unsigned_abs());
    if e < 0 { Rational::new(m.into(), power) } else { Rational::from(BigInt::from(m) * power) }
}

/// The nearest double by search: the candidates around a rough guess, ordered by exact distance, ties to even.
fn nearest_by_search(value: &Rational) -> f64 {
    let (mut low, mut high) = (0_u64, 0x7fef_ffff_ffff_ffff_u64);
    let magnitude = if *value < ratio(0, 1) { -value } else { value.clone() };
    let exact = |bits: u64| decoded(f64::from_bits(bits));
    // The largest double that is not above the magnitude: patterns of positive doubles are in their order.
    while low < high {
        let middle = low + (high - low).div_ceil(2);
        if exact(middle) <= magnitude { low = middle } else { high = middle - 1 }
    }
    let bits = if low == 0x7fef_ffff_ffff_ffff {
        let half_beyond = exact(low) + dyadic(1, 970);
        if magnitude >= half_beyond { low + 1 } else { low }
    } else {
        let (below, above) = (&magnitude - exact(low), exact(low + 1) - &magnitude);
        if below < above || (below == above && low % 2 == 0) { low } else { low + 1 }
    };
    if *value < ratio(0, 1) { -f64::from_bits(bits) } else { f64::from_bits(bits) }
}

/// The value of a positive double, from the halves of a decimal-free definition: repeated exact doubling.
fn decoded(value: f64) -> Rational {
    let (bits, one) = (value.to_bits(), 1_i64 << 52);
    let field = i32::try_from(bits >> 52 & 0x7ff).expect("eleven bits");
    let fraction = i64::try_from(bits & ((1 << 52) - 1)).expect("52 bits");
    if field == 0 { dyadic(fraction, -1074) } else { dyadic(one + fraction, field - 1075) }
}

fn any_finite() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |value| value.is_finite())
}

/// Rationals of every magnitude around and beyond the range of doubles, many of them near ties.
fn any_rational() -> impl Strategy<Value = Rational> {
    let tie = (any_finite(), -2_i64..=2).prop_map(|(value, nudge)| {
        let next = f64::from_bits((value.to_bits() & !(1 << 63)).min(0x7fef_ffff_ffff_fffe) + 1);
        let middle = (decoded(value.abs().min(f64::from_bits(next.to_bits() - 1))) + decoded(next)) / ratio(2, 1);
        middle + dyadic(nudge, -1200)
    });
    let fraction = (any::<i64>(), 1_i64..=i64::MAX, -1150_i32..1100)
        .prop_map(|(numerator, denominator, e)| Rational::new(numerator.into(), denominator.into()) * dyadic(1, e));
    prop_oneof![tie, fraction]
}

proptest! {
    #[test]
    fn a_double_is_what_its_bits_say(value in any_finite()) {
        let expected = if value < 0.0 { -decoded(-value) } else { decoded(value.abs()) };
        prop_assert_eq!(exact_value(value), Some(expected));
    }

    #[test]
    fn every_double_survives_as_text(value in any_finite()) {
        let text = shortest_double(value);
        prop_assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
        prop_assert_eq!(Numbers::Binary64.read(&text), Ok(Number::Finite(exact_value(value).expect("finite"))));
        prop_assert_eq!(Numbers::Binary64.write(&exact_value(value).expect("finite")).parse::<f64>(), Ok(value));
        prop_assert!(text.len() <= 25, "{}", text);
    }

    #[test]
    fn every_single_survives_as_text(bits in any::<u32>()) {
        let value = f32::from_bits(bits);
        prop_assume!(value.is_finite());
        let exact = exact_value(f64::from(value)).expect("finite");
        prop_assert_eq!(nearest_single(&exact).abs().to_bits(), value.abs().to_bits());
        prop_assert_eq!(Numbers::Binary32.read(&Numbers::Binary32.write(&exact)), Ok(Number::Finite(exact)));
    }

    #[test]
    fn the_nearest_double_is_the_nearest(value in any_rational()) {
        prop_assert_eq!(nearest_double(&value).to_bits(), nearest_by_search(&value).to_bits());
    }

    #[test]
    fn singles_are_rounded_once(m in any::<i64>(), e in -160_i32..90) {
        // A decimal parser rounds to single precision once, too; hexadecimal digits say the same number exactly.
        let value = dyadic(m, e);
        let digits = (value.numer() * BigInt::from(10).pow(200)) / value.denom();
        let text = format!("{digits}e-200");
        let exact = Rational::new(digits, BigInt::from(10).pow(200));
        prop_assert_eq!(nearest_single(&exact).abs().to_bits(), text.parse::<f32>().expect("a number").abs().to_bits());
    }

    #[test]
    fn hexadecimal_literals_mean_their_bits(value in any_finite()) {
        let (bits, sign) = (value.to_bits(), if value.is_sign_negative() { "-" } else { "" });
        let field = i64::try_from(bits >> 52 & 0x7ff).expect("small");
        let (lead, exponent) = if field == 0 { (0, -1022) } else { (1, field - 1023) };
        let text = format!("{sign}0x{lead}.{:013x}p{exponent}", bits & ((1 << 52) - 1));
        prop_assert_eq!(Numbers::Binary64.read(&text), Ok(Number::Finite(exact_value(value).expect("finite"))));
    }

    #[test]
    fn hexadecimal_digits_beyond_the_precision_round_once(m in any::<u128>(), e in -1250_i64..1000) {
        let exact = dyadic(1, i32::try_from(e).expect("small")) * Rational::from(BigInt::from(m));
        let expected = nearest_by_search(&exact);
        let read = Numbers::Binary64.read(&format!("0x{m:X}P{e:+}")).expect("a number");
        let expected = if expected.is_infinite() { Number::Infinite { negative: false } } else { Number::Finite(exact_value(expected).expect("finite")) };
        prop_assert_eq!(read, expected);
    }

    #[test]
    fn exact_literals_mean_themselves(n in any::<i64>(), d in 1..=i64::MAX, places in 0_u32..30) {
        let value = Rational::new(n.into(), d.into());
        prop_assert_eq!(Numbers::Exact.read(&format!("{n}/{d}")), Ok(Number::Finite(value.clone())));
        prop_assert_eq!(Numbers::Exact.read(&Numbers::Exact.write(&value)), Ok(Number::Finite(value)));
        let decimal = Rational::new(n.into(), BigInt::from(10).pow(places));
        prop_assert_eq!(Numbers::Exact.read(&format!("{n}e-{places}")), Ok(Number::Finite(decimal)));
    }

    #[test]
    fn no_text_panics(text in "[-+0-9a-fA-FxXpPeEnN./_ é]{0,40}") {
        for numbers in [Numbers::Binary64, Numbers::Binary32, Numbers::Exact] {
            let _any = numbers.read(&text);
        }
    }
}

#[test]
fn names_and_shapes_of_literals() {
    let read = |text| Numbers::Binary64.read(text);
    for text in ["NaN", "nan", "-nan"] {
        assert_eq!(read(text), Ok(Number::NotANumber));
    }
    for text in ["Infinity", "inf", "+inf", "INF"] {
        assert_eq!(read(text), Ok(Number::Infinite { negative: false }));
    }
    assert_eq!(read("-Infinity"), Ok(Number::Infinite { negative: true }));
    assert_eq!(read("-1e999"), Ok(Number::Infinite { negative: true }));
    assert_eq!(read("1e-999"), Ok(Number::Finite(ratio(0, 1))));
    assert_eq!(read("0x1p-99999999999999999999"), Ok(Number::Finite(ratio(0, 1))));
    for (text, value) in [(".5", ratio(1, 2)), ("5.", ratio(5, 1)), ("+2E1", ratio(20, 1)), ("0X.8P1", ratio(1, 1))] {
        assert_eq!(read(text), Ok(Number::Finite(value)), "{text}");
    }
    for text in ["", " 1", "1 ", "1_0", "1e", "e1", ".", "0x", "0x.p1", "--1", "1.2.3", "1,5", "٣", "1/2/3", "infinit"]
    {
        assert!(matches!(read(text), Err(NumberError::Syntax { .. } | NumberError::Fraction { .. })), "{text:?}");
        assert!(Numbers::Exact.read(text).is_err(), "{text:?}");
    }
    assert!(read("1/3").unwrap_err().to_string().contains("\"exact\""));
    assert!(Numbers::Exact.read("1/0").unwrap_err().to_string().contains("denominator 0"));
    // 0.1 as a single differs from 0.1 as a double, and both from a tenth.
    assert_eq!(Numbers::Binary32.read("0.1"), Ok(Number::Finite(ratio(13_421_773, 1 << 27))));
    assert_eq!(Numbers::Binary64.read("0.1"), Ok(Number::Finite(ratio(3_602_879_701_896_397, 1 << 55))));
    assert_eq!(Numbers::Exact.read("0.1"), Ok(Number::Finite(ratio(1, 10))));
}

#[test]
fn nonsense_is_refused_at_once() {
    let start = Instant::now();
    let long = "7".repeat(10_000_000);
    for numbers in [Numbers::Binary64, Numbers::Binary32, Numbers::Exact] {
        let message = numbers.read_finite(&long).unwrap_err().to_string();
        assert!(message.contains("10000000 characters") && message.contains("4096"), "{message}");
        for text in ["1e999999999", "-1e99999999999999999999999", "0x1p99999999999", "1e999"] {
            match numbers {
                Numbers::Exact if text == "1e999" => assert!(numbers.read_finite(text).is_ok()),
                Numbers::Exact => {
                    let message = numbers.read_finite(text).unwrap_err().to_string();
                    assert!(message.contains("exponent") && message.contains("4096"), "{message}");
                }
                _ => {
                    let message = numbers.read_finite(text).unwrap_err().to_string();
                    assert!(message.contains("not a finite number") && message.contains(numbers.name()), "{message}");
                }
            }
        }
    }
    assert!(start.elapsed() < Duration::from_secs(1));
}

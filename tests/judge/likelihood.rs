//! The log likelihood: its digits, where it is judged, and in what unit.

use exact_kalman::judge::{Reference, Verdict};
use exact_kalman::protocol::{Answer, Case, Number};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::{Quantity, Values};
use num_bigint::BigInt;
use serde_json::json;

use crate::samples::{judge, of_suite, path, score};

fn reference(case: &Case) -> Reference {
    Reference::of(&path(case)).expect("short numbers")
}

fn values(case: &Case) -> Vec<Option<Rational>> {
    let value = |values: &Values<Rational>| values.get(&Quantity::LogLikelihood).map(|matrix| matrix[(0, 0)].clone());
    reference(case).values.iter().map(value).collect()
}

/// A decimal with its point left out, and how many digits stand behind the point.
fn decimal(digits: &str, places: u32) -> Rational {
    Rational::new(digits.parse::<BigInt>().expect("digits"), BigInt::from(10).pow(places))
}

fn is_near(value: &Rational, other: &Rational, places: u32) -> bool {
    let error = value - other;
    &error * &error < decimal("1", 2 * places)
}

fn case(
    initial: &serde_json::Value,
    rows: &[[&str; 2]],
    noise: &serde_json::Value,
    readings: &serde_json::Value,
) -> Case {
    let unit = json!([["1", "0"], ["0", "1"]]);
    let case = json!({"format": "exact-kalman/case/1", "id": "two", "numbers": "exact", "timing": "departing",
        "initial": {"before": "observation", "mean": ["0", "0"], "covariance": initial},
        "transition": unit, "observation": rows,
        "noise": {"process": [["0", "0"], ["0", "0"]], "observation": noise}, "observations": readings});
    Case::parse(&case.to_string()).expect("a case")
}

/// All by mpmath with 40 digits: −½(1/2 + ln 2 + ln 2π), and so on.
#[test]
fn digits_of_an_outside_program() {
    // By hand: 1, then 2: ν = 1, S = 2; x̂ = 1/2, P = 1/2, so ν = 3/2, S = 3/2 and νᵀS⁻¹ν = 3/2.
    let found = values(&of_suite("basic/constant"));
    let expected = [decimal("-1515512123484645396488945797134705923899", 39), second_reading()];
    for (found, expected) in found.iter().zip(&expected) {
        assert!(is_near(found.as_ref().expect("a regular reading"), expected, 30), "{found:?}");
    }
    // S = [3 1; 1 2], ν = (1, −2).
    let two = case(
        &json!([["2", "1"], ["1", "1"]]),
        &[["1", "0"], ["0", "1"]],
        &json!([["1", "0"], ["0", "1"]]),
        &json!([["1", "-2"]]),
    );
    let expected = decimal("-4442596022626395670861039139424329099486", 39);
    assert!(is_near(values(&two)[0].as_ref().expect("regular"), &expected, 30));
}

/// mpmath: −(mpf(3)/2 + log(mpf(3)/2) + log(2*pi))/2.
fn second_reading() -> Rational {
    decimal("-1871671087258754932769336294137792208147", 39)
}

/// The hundred years of the Nile but the first, which the diffuse start leaves without a likelihood; by the textbook's scalar
/// recursion in mpmath with 40 digits. (Durbin and Koopman print −632.54 for the diffuse likelihood.)
#[test]
fn the_nile_with_a_diffuse_start() {
    let found = values(&of_suite("nile/diffuse"));
    assert_eq!(found[0], None);
    let total: Rational = found.iter().skip(1).map(|value| value.clone().expect("regular")).sum();
    assert!(is_near(&total, &decimal("-6325456251156736985354990264201301508139", 37), 28), "{total}");
}

#[test]
fn it_is_asked_only_where_there_is_one() {
    // Nothing is read at some steps; two sensors read the same without noise.
    let gaps = of_suite("missing/whole-steps");
    for (value, reading) in values(&gaps).iter().zip(&gaps.observations) {
        // Nothing read has the likelihood one.
        assert!(value.is_some() && (reading.is_some() || *value == Some(ratio(0, 1))));
    }
    assert!(values(&of_suite("singular/equal-sensors")).iter().all(Option::is_none));
    assert!(values(&of_suite("missing/one-of-two-sensors")).iter().all(Option::is_some));
}

fn answer(case: &Case, change: impl Fn(&Rational) -> Rational) -> Answer {
    let step = |value: &Option<Rational>| {
        let number = |value: &Rational| exact_kalman::matrix::Matrix::column(vec![Number::Finite(change(value))]);
        value.iter().map(|value| (Quantity::LogLikelihood, number(value))).collect()
    };
    Answer::answered(&case.id, values(case).iter().map(step).collect())
}

/// Errors are counted in units of max(|ℓ|, 1): one of 10⁻⁶ where ℓ = −1.5… leaves six digits, and without ln 2π none are left.
#[test]
fn it_is_judged_like_the_other_quantities() {
    let case = of_suite("basic/constant");
    assert_eq!(judge(&case, answer(&case, Clone::clone)).verdict, Verdict::Agrees);
    let off = judge(&case, answer(&case, |value| value + decimal("1", 6)));
    assert!(matches!(off.verdict, Verdict::Loses { .. }), "{}", off.verdict);
    let digits = score(&off, Quantity::LogLikelihood).fewest.value();
    assert!((6.1..6.3).contains(&digits), "−log₁₀(10⁻⁶/1.5155): {digits}");
    let half_of_two_pi = decimal("9189385332046727417803297", 25);
    let without = judge(&case, answer(&case, |value| value + &half_of_two_pi));
    assert_eq!(without.verdict, Verdict::Wrong);
    // A likelihood of about one has a logarithm of about zero: with ν = 0 and S = 1/(2π), ℓ = 0; an error of 2⁻⁵⁰ there is no loss.
    let near_zero = case_of_about_zero();
    let value = values(&near_zero)[0].clone().expect("regular");
    assert!(is_near(&value, &ratio(0, 1), 15) && value != ratio(0, 1), "{value}");
    let judged = judge(&near_zero, answer(&near_zero, |value| value + ratio(1, 1 << 50)));
    assert_eq!(score(&judged, Quantity::LogLikelihood).verdict, Verdict::Agrees);
}

/// A reading 0 with variance 1/(2π), to twenty digits.
fn case_of_about_zero() -> Case {
    let case = json!({"format": "exact-kalman/case/1", "id": "zero", "numbers": "exact", "timing": "departing",
        "initial": {"before": "observation", "mean": ["0"], "covariance": [["0"]]},
        "transition": [["1"]], "observation": [["1"]],
        "noise": {"process": [["0"]], "observation": [["0.15915494309189533577"]]}, "observations": [["0"]]});
    Case::parse(&case.to_string()).expect("a case")
}

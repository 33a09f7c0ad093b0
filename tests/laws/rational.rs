//! The rationals: the laws, num-rational's own operators, and the normal form by Euclid.

use std::cell::Cell;

use exact_kalman::scalar::{Rational, Scalar, Undefined, laws, ratio};
use num_bigint::{BigInt, Sign};
use quickcheck::QuickCheck;

use super::fractions::Triple;

/// The greatest common divisor by Euclid's algorithm, with nothing but remainders.
fn euclid(a: &BigInt, b: &BigInt) -> BigInt {
    let (mut a, mut b) = (a.clone(), b.clone());
    while b.sign() != Sign::NoSign {
        (a, b) = (b.clone(), a % b);
    }
    BigInt::from(a.magnitude().clone())
}

fn is_normal(value: &Rational) -> bool {
    value.denom().sign() == Sign::Plus && euclid(value.numer(), value.denom()) == BigInt::from(1)
}

/// The very same numerator and denominator: equality of fractions alone would let 2/4 pass for 1/2.
fn is(found: &Rational, expected: &Rational) -> bool {
    is_normal(found) && found.numer() == expected.numer() && found.denom() == expected.denom()
}

/// The four operations against num-rational's, which reduce by a code of their own.
fn agrees(a: &Rational, b: &Rational) -> bool {
    let quotient = match a.over(b) {
        Ok(quotient) => *b != ratio(0, 1) && is(&quotient, &(a / b)),
        Err(error) => *b == ratio(0, 1) && error == Undefined::DivisionByZero,
    };
    quotient && is(&a.plus(b), &(a + b)) && is(&a.minus(b), &(a - b)) && is(&a.times(b), &(a * b))
}

thread_local! {
    /// How often the denominators were equal and not one, how often a sum was reduced, how long numbers became.
    static MET: Cell<(u32, u32, u64)> = const { Cell::new((0, 0, 0)) };
}

#[expect(clippy::needless_pass_by_value, reason = "quickcheck hands its values over")]
fn holds(triple: Triple) -> bool {
    let Triple(a, b, c) = &triple;
    let (mut equal, mut reduced, mut longest) = MET.get();
    equal += u32::from(a.denom() == b.denom() && *a.denom() != BigInt::from(1));
    let plain = a.denom() * (b.denom() / euclid(a.denom(), b.denom()));
    reduced += u32::from(*(a + b).denom() != plain);
    longest = longest.max(a.denom().bits());
    MET.set((equal, reduced, longest));
    let pairs = [(a, b), (b, a), (b, c), (a, a)].iter().all(|(a, b)| agrees(a, b));
    pairs && laws::ordered_field(a, b, c) == Ok(())
}

#[test]
fn random_fractions_obey_the_laws_and_agree_with_num_rational() {
    MET.set((0, 0, 0));
    let passed = QuickCheck::new().tests(3_000).quicktest(holds as fn(Triple) -> bool).ok();
    assert_eq!(passed, Some(3_000));
    let (equal, reduced, longest) = MET.get();
    assert!(equal >= 250, "only {equal} pairs over one denominator");
    assert!(reduced >= 150, "only {reduced} sums with a factor to cancel");
    assert!(longest >= 1000, "no long number: {longest} bits at most");
}

/// Every pair of fractions with numerators −6, …, 6 and denominators 1, …, 6; triples of a smaller world.
#[test]
fn small_fractions_are_exhausted() {
    let world = |bound: i64| -> Vec<Rational> {
        let all = (-bound..=bound).flat_map(|a| (1..=bound).map(move |b| ratio(a, b)));
        let mut all: Vec<Rational> = all.collect();
        all.sort();
        all.dedup();
        all
    };
    let pairs = world(6);
    // 23 positive ones, their negatives and zero.
    assert_eq!(pairs.len(), 47);
    assert!(pairs.iter().all(|a| pairs.iter().all(|b| agrees(a, b))));
    let triples = world(3);
    assert_eq!(triples.len(), 15);
    for a in &triples {
        for b in &triples {
            for c in &triples {
                assert_eq!(laws::ordered_field(a, b, c), Ok(()), "{a}, {b}, {c}");
            }
        }
    }
}

/// The check of the normal form is one.
#[test]
fn fractions_that_are_not_reduced_are_told() {
    let raw = |numerator: i64, denominator: i64| Rational::new_raw(numerator.into(), denominator.into());
    assert!(is_normal(&raw(-3, 4)) && is_normal(&raw(0, 1)));
    assert!(!is_normal(&raw(2, 4)) && !is_normal(&raw(1, -2)) && !is_normal(&raw(0, 5)));
    assert!(raw(2, 4) == ratio(1, 2) && !is(&raw(2, 4), &ratio(1, 2)));
}

//! The laws of fields on the rationals and on residues, of rings on the integers, by quickcheck. (Those of rational functions are in
//! `tests/prove/scalar.rs`.)
//!
//! A new scalar is one line in `every_scalar_obeys_the_laws`: its type, and how it is made of four small integers.

use exact_kalman::scalar::{Field, OrderedField, Rational, Residue, Scalar, laws, ratio};
use num_bigint::BigInt;
use quickcheck::QuickCheck;

type Words = (i8, i8, i16, u64);

/// A fraction of the first words, with a denominator that is seldom one.
fn fraction((a, b, c, _): Words) -> Rational {
    ratio(i64::from(a) * i64::from(c), 1 + i64::from(b).abs())
}

/// A residue near both ends of the range, where sums wrap, or anywhere.
fn residue<const P: u64>((a, _, _, word): Words) -> Residue<P> {
    match a.rem_euclid(4) {
        0 => Residue::new(word % 3),
        1 => Residue::new(P - 1 - word % 2),
        _ => Residue::new(word),
    }
}

fn field<S: Field>(of: fn(Words) -> S) {
    let holds = move |a: Words, b: Words, c: Words| laws::field(&of(a), &of(b), &of(c)) == Ok(());
    check(holds, std::any::type_name::<S>());
}

fn ordered_field<S: OrderedField>(of: fn(Words) -> S) {
    let holds = move |a: Words, b: Words, c: Words| laws::ordered_field(&of(a), &of(b), &of(c)) == Ok(());
    check(holds, std::any::type_name::<S>());
}

/// A property of three draws, with what it captures.
struct Law<F>(F);

impl<F: Fn(Words, Words, Words) -> bool + 'static> quickcheck::Testable for Law<F> {
    fn result(&self, g: &mut quickcheck::Gen) -> quickcheck::TestResult {
        let mut draw = || <Words as quickcheck::Arbitrary>::arbitrary(g);
        let (a, b, c) = (draw(), draw(), draw());
        if (self.0)(a, b, c) {
            quickcheck::TestResult::passed()
        } else {
            quickcheck::TestResult::error(format!("the laws fail at {a:?}, {b:?}, {c:?}"))
        }
    }
}

fn check(holds: impl Fn(Words, Words, Words) -> bool + 'static, scalar: &str) {
    let verdict = QuickCheck::new().tests(1_000).quicktest(Law(holds));
    assert!(matches!(verdict, Ok(1_000)), "{scalar}: {verdict:?}");
}

#[test]
fn every_scalar_obeys_the_laws() {
    ordered_field(fraction);
    field(residue::<2>);
    field(residue::<11>);
    field(residue::<101>);
    field(residue::<65_537>);
    field(residue::<{ (1 << 31) - 1 }>);
    field(residue::<{ (1 << 61) - 1 }>);
    // The largest prime below 2⁶³, where sums of two residues have 64 bits.
    field(residue::<9_223_372_036_854_775_783>);
}

/// The harness itself: a composite modulus is found out, so the laws are run.
#[test]
fn a_scalar_that_is_none_is_found_out() {
    assert!(std::panic::catch_unwind(|| field(residue::<15>)).is_err());
}

/// The integers: a ring, in which a quotient is the exact one or an error.
#[test]
fn integers_are_a_ring_with_exact_quotients() {
    fn holds(a: i64, b: i64, c: i64) -> bool {
        let [a, b, c]: [BigInt; 3] = [a, b, c].map(|value| BigInt::from(value) * (BigInt::from(1) << 70) + value);
        let quotient = match Scalar::over(&a, &b) {
            Ok(quotient) => quotient.times(&b) == a,
            Err(_) => b == BigInt::ZERO || &a % &b != BigInt::ZERO,
        };
        let multiple = b == BigInt::ZERO || Scalar::over(&a.times(&b), &b) == Ok(a.clone());
        quotient
            && multiple
            && a.plus(&b.plus(&c)) == a.plus(&b).plus(&c)
            && a.plus(&b) == b.plus(&a)
            && a.minus(&b) == a.plus(&b.negated())
            && a.times(&b.times(&c)) == a.times(&b).times(&c)
            && a.times(&b) == b.times(&a)
            && a.times(&b.plus(&c)) == a.times(&b).plus(&a.times(&c))
            && a.times(&BigInt::one()) == a
            && a.plus(&BigInt::zero()) == a
    }
    let passed = QuickCheck::new().tests(2_000).quicktest(holds as fn(i64, i64, i64) -> bool).ok();
    assert_eq!(passed, Some(2_000));
    let small = |a: i8, b: i8| holds(a.into(), b.into(), 1);
    assert_eq!(QuickCheck::new().tests(2_000).quicktest(small as fn(i8, i8) -> bool).ok(), Some(2_000));
}

//! Matrices over one denominator: every entry in lowest terms, by num-rational's own reduction and by construction.

use exact_kalman::matrix::{Fractions, Matrix};
use exact_kalman::scalar::{Precision, Rational, exact_value, nearest_double, ratio};
use num_bigint::BigInt;
use proptest::prelude::*;

/// Each entry by num-rational, which reduces by a code of its own; numerators and denominators are compared, not values.
fn is_reduced(fractions: &Fractions, found: &Matrix<Rational>) -> bool {
    let expected =
        fractions.numerators.map(|numerator| Rational::new(numerator.clone(), fractions.denominator.clone()));
    let parts = |matrix: &Matrix<Rational>| matrix.map(|entry| (entry.numer().clone(), entry.denom().clone()));
    parts(found) == parts(&expected)
}

fn holds(numerators: &[BigInt], denominator: &BigInt) -> bool {
    let row = Matrix::from_fn(1, numerators.len(), |_, j| numerators[j].clone());
    let row = Fractions { numerators: row, denominator: denominator.clone() };
    // A symmetric matrix with these numbers on and beside the diagonal.
    let n = numerators.len();
    let square = Matrix::from_fn(n, n, |i, j| numerators[(i + j) % n].clone());
    let square = Fractions { numerators: square, denominator: denominator.clone() };
    is_reduced(&row, &row.entrywise(Precision::Exact)) && is_reduced(&square, &square.symmetric(Precision::Exact))
}

/// Products of powers of few primes, small and not small, so that every way of sharing occurs.
fn product() -> impl Strategy<Value = BigInt> {
    let primes: [u64; 8] = [2, 3, 7, 97, 101, 4_294_967_311, 18_446_744_073_709_551_557, (1 << 61) - 1];
    let exponents = prop::collection::vec(prop_oneof![3 => Just(0_u32), 3 => 1_u32..4, 1 => 5_u32..70], 8);
    exponents.prop_map(move |exponents| {
        let powers = primes.iter().zip(exponents).map(|(prime, exponent)| BigInt::from(*prime).pow(exponent));
        powers.product()
    })
}

fn numerator() -> impl Strategy<Value = BigInt> {
    (product(), -3_i64..=3).prop_map(|(product, factor)| product * factor)
}

#[test]
fn small_pairs_are_exhausted() {
    for denominator in 1..=36_i64 {
        for a in -36..=36_i64 {
            let numerators = [a, 12, 0, a + 1].map(BigInt::from);
            assert!(holds(&numerators, &denominator.into()), "{a}, {denominator}");
        }
    }
}

/// The first entry shares much with the denominator and the others do not, or all do, or all but the last.
#[test]
fn contents_of_some_entries() {
    let long = BigInt::from(101).pow(300);
    let denominator = &long * BigInt::from(103).pow(50) * 720;
    for shared in 0_u32..16 {
        let entry = |k: u32| if shared >> k & 1 == 1 { &long * (k + 5) } else { BigInt::from(103).pow(7 * k) * 6 };
        assert!(holds(&[entry(0), entry(1), entry(2), entry(3)], &denominator), "{shared}");
    }
    let zero = BigInt::from(0);
    assert!(holds(&[zero.clone(), zero.clone()], &denominator) && holds(std::slice::from_ref(&zero), &denominator));
    assert!(holds(&[zero.clone(), &denominator * 5, -&denominator], &denominator));
    assert!(holds(&[zero, BigInt::from(1)], &denominator));
    let none = Fractions { numerators: Matrix::zeros(0, 0), denominator };
    assert_eq!(none.symmetric(Precision::Exact).rows(), 0);
}

#[test]
fn doubles_and_quotients_of_entries() {
    let numerators = Matrix::from_fn(2, 2, |i, j| BigInt::from([[1, -7], [0, 22]][i][j]) * BigInt::from(3).pow(900));
    let fractions = Fractions { numerators, denominator: BigInt::from(7) * BigInt::from(3).pow(900) };
    assert_eq!(fractions.doubles(), Matrix::from_fn(2, 2, |i, j| [[1.0 / 7.0, -1.0], [0.0, 22.0 / 7.0]][i][j]));
    assert_eq!(fractions.quotient(1, 1).handed_out(Precision::Exact), ratio(22, 7));
    let rounded = fractions.entrywise(Precision::Rounded { bits: 53 });
    assert_eq!(rounded[(1, 1)], exact_value(22.0 / 7.0).unwrap_or_default());
}

proptest! {
    #[test]
    fn every_entry_is_in_lowest_terms(
        numerators in prop::collection::vec(numerator(), 1..5), denominator in product(), shared in product(),
    ) {
        prop_assert!(holds(&numerators, &denominator));
        let multiples: Vec<BigInt> = numerators.iter().map(|numerator| numerator * &shared).collect();
        prop_assert!(holds(&multiples, &(&denominator * &shared)));
        let row = Matrix::from_fn(1, numerators.len(), |_, j| numerators[j].clone());
        let doubles = Fractions { numerators: row.clone(), denominator: denominator.clone() }.doubles();
        prop_assert_eq!(doubles, row.map(|entry| nearest_double(&Rational::new(entry.clone(), denominator.clone()))));
    }
}

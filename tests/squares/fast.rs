//! The rational filter and integer matrices over one denominator: the image of what they say is what the generic code
//! says of the image.

use exact_kalman::filter::{Effort, Route, filter, filter_rational};
use exact_kalman::matrix::{Echelon, Fractions};
use exact_kalman::scalar::{Mersenne61, Precision, Rational};
use exact_kalman::trace::Quantity;
use num_bigint::BigInt;
use proptest::prelude::*;

use super::algebra::{CharacteristicPolynomials, Determinants, Products, SymmetricPowers, Traces};
use super::commuting::{Algorithm, Drawn, counted};
use super::inputs::Input;

fn image(value: &Rational) -> Result<Mersenne61, ()> {
    Mersenne61::image(value).ok_or(())
}

/// CKS-T: every quantity of every step but the gain, which is not handed out, by both routes of the rational filter, against the
/// recursion modulo 2⁶¹ − 1. What one refuses, the other refuses at the same step.
#[test]
fn rational_filter_commutes_with_residues() {
    for route in [Route::FractionFree, Route::Multimodular, Route::Fastest] {
        let compared = std::cell::Cell::new(0);
        let counts = counted("the rational filter", |tape| {
            let input = Input::drawn(&tape, Drawn::drawn);
            let images = input.path().try_map(image).map_err(|()| TestCaseError::fail("a denominator vanishes"))?;
            let found = filter_rational(input.path(), Effort { route, ..Effort::default() });
            let (steps, modular) = match (found, filter(&images)) {
                (Ok(steps), Ok(modular)) => (steps, modular),
                (Err(one), Err(other)) => {
                    prop_assert_eq!(one.step, other.step);
                    return Ok(false);
                }
                (one, other) => {
                    let refused = [one.is_err(), other.is_err()];
                    return Err(TestCaseError::fail(format!(
                        "refused by the rational and by the modular filter: {refused:?}"
                    )));
                }
            };
            prop_assert_eq!(steps.len(), modular.records.len());
            for (step, record) in steps.iter().zip(&modular.records) {
                let residues = record.values();
                for quantity in Quantity::ALL.into_iter().filter(|quantity| *quantity != Quantity::Gain) {
                    let (value, residue) = match (step.exactly(quantity), residues.get(&quantity)) {
                        (Some(value), Some(residue)) => (value, residue),
                        (None, None) => continue,
                        (value, residue) => {
                            let found = [value.is_some(), residue.is_some()];
                            return Err(TestCaseError::fail(format!("{quantity:?} is there: {found:?}")));
                        }
                    };
                    let value = value.try_map(image).map_err(|()| TestCaseError::fail("a denominator vanishes"))?;
                    prop_assert_eq!(&value, residue);
                    compared.set(compared.get() + 1);
                }
            }
            Ok(true)
        });
        println!("rational filter, {route:?}: equal {}, not compared {}", counts.equal, counts.vanished);
        assert!(counts.equal > 30 && compared.get() > 200, "{counts:?}");
    }
}

/// A matrix over one denominator stands for the same fractions.
#[test]
fn integers_over_one_denominator_are_the_fractions() {
    let counts = counted("fractions", |tape| {
        let input = Input::drawn(&tape, |first, second| first + second / Rational::from_integer(7.into()));
        for matrix in [&input.a, &input.wide, &input.p] {
            let fractions = Fractions::of(matrix);
            prop_assert_eq!(&fractions.entrywise(Precision::Exact), matrix);
            for i in 0..matrix.rows() {
                for j in 0..matrix.columns() {
                    let quotient = fractions.quotient(i, j);
                    let value = Rational::new(quotient.numerator().clone(), quotient.denominator().clone());
                    prop_assert_eq!(&value, &matrix[(i, j)]);
                }
            }
        }
        prop_assert_eq!(&Fractions::of(&input.p).symmetric(Precision::Exact), &input.p);
        Ok(true)
    });
    assert_eq!(counts.vanished, 0);
}

/// Matrices of integers, as fractions and as integers. (The path is not used, and means nothing as integers.)
fn of_integers(tape: &[i8]) -> (Input<Rational>, Input<BigInt>) {
    let input = Input::drawn(tape, |first, _| first * Rational::from_integer(6.into()));
    let integers = input.try_map(|value| Some(value.numer().clone())).expect("total");
    (input, integers)
}

fn included(values: &[BigInt]) -> Vec<Rational> {
    values.iter().cloned().map(Rational::from_integer).collect()
}

/// ℤ → ℚ
fn commutes_on_integers<A: Algorithm<Rational> + Algorithm<BigInt>>() {
    let counts = counted(A::NAME, |tape| {
        let (fractions, integers) = of_integers(&tape);
        let (over, within) = (<A as Algorithm<Rational>>::run(&fractions), <A as Algorithm<BigInt>>::run(&integers));
        prop_assert!(!within.undecided, "a quotient is no integer");
        prop_assert_eq!(over.plain, within.plain);
        prop_assert_eq!(over.numbers, included(&within.numbers));
        Ok(true)
    });
    println!("{:<58} equal {:>3}", format!("{} on integers", A::NAME), counts.equal);
    assert_eq!(counts.vanished, 0);
}

/// Elimination stays within the integers, and says what it says over the fractions.
#[test]
fn integers_commute() {
    commutes_on_integers::<Products>();
    commutes_on_integers::<Traces>();
    commutes_on_integers::<Determinants>();
    commutes_on_integers::<CharacteristicPolynomials>();
    commutes_on_integers::<SymmetricPowers>();
    let counts = counted("elimination on integers", |tape| {
        let (fractions, integers) = of_integers(&tape);
        let over = Echelon::of(&fractions.wide, fractions.wide.columns()).expect("a field decides");
        let within = Echelon::of(&integers.wide, integers.wide.columns()).expect("divisions are exact");
        prop_assert_eq!(over.pivots(), within.pivots());
        prop_assert_eq!(over.undivided().entries(), &included(within.undivided().entries())[..]);
        prop_assert_eq!(over.divisor(), &Rational::from_integer(within.divisor().clone()));
        Ok(within.rank() > 0)
    });
    assert!(counts.equal > 20);
}

//! The numbers of 512 bits against exact ones, by other routes.

use super::fault::Fault;
use super::recursion::Recursion;
use super::{Wrong, hypotheses};
use crate::filter::{Effort, Records, filter_rational};
use crate::judge::suite;
use crate::model::Path;
use crate::protocol::Expect;
use crate::scalar::{Precision, Rational, Scalar as _, ratio};
use crate::trace::{Quantity, Values};

/// The problems of the suite that are short.
fn paths() -> Vec<(String, Path<Rational>)> {
    let cases = suite().into_iter().filter(|case| case.expect == Expect::Estimate && case.observations.len() <= 30);
    cases
        .filter(|case| case.initial.mean.len() <= 4)
        .map(|case| {
            (case.id.clone(), case.problem().and_then(|problem| problem.realised()).expect("a case of the suite"))
        })
        .collect()
}

/// Every entry is right but for 2⁻¹⁵⁰ of the largest that its quantity has in the run.
fn agree(id: &str, theirs: &[Values<Rational>], exact: &[Values<Rational>]) {
    let unit = ratio(1, 1 << 50).pow(3);
    for quantity in Quantity::ALL.into_iter().filter(|quantity| *quantity != Quantity::Gain) {
        let of = |values: &Values<Rational>| values.get(&quantity).cloned();
        let entries = exact.iter().filter_map(of).flat_map(|matrix| matrix.entries().to_vec());
        let magnitude = |x: Rational| if x < Rational::zero() { x.negated() } else { x };
        let Some(largest) = entries.map(magnitude).max() else { continue };
        for (step, (theirs, exact)) in theirs.iter().zip(exact).enumerate() {
            let (Some(theirs), Some(exact)) = (of(theirs), of(exact)) else { continue };
            for (a, b) in theirs.entries().iter().zip(exact.entries()) {
                assert!(magnitude(a.minus(b)) <= largest.times(&unit), "{id}: {quantity} at step {step}: {a} and {b}");
            }
        }
    }
}

#[test]
fn without_a_fault_the_recursion_is_the_filter() {
    for (id, path) in paths() {
        let theirs: Vec<_> = Recursion::new(&path, &Fault::None).into_iter().flatten().collect();
        let exact = filter_rational(&path, Effort::default()).expect("data as a model makes them");
        let exact: Vec<_> = exact.iter().map(|step| step.fractions(Precision::Rounded { bits: 256 }).values).collect();
        assert_eq!(theirs.len(), exact.len(), "{id}");
        agree(&id, &theirs, &exact);
    }
}

/// The readable recursion on fractions, which carries exact numbers, for as long as they are short.
#[test]
fn other_problems_are_solved_as_the_readable_recursion_solves_them() {
    let mut seen = 0;
    for (id, path) in paths() {
        for hypothesis in hypotheses() {
            let Wrong::Problem(change) = &hypothesis.wrong else { continue };
            let Some(other) = change(&path).filter(|other| *other != path) else { continue };
            let exact: Vec<_> =
                Records::new(&other).take(3).map_while(Result::ok).map(|record| record.values()).collect();
            let theirs: Vec<_> = Recursion::new(&other, &Fault::None).into_iter().flatten().take(exact.len()).collect();
            assert_eq!(theirs.len(), exact.len(), "{id}");
            agree(&id, &theirs, &exact);
            seen += 1;
        }
    }
    assert!(seen >= 500, "{seen}");
}

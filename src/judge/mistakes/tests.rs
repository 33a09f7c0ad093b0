//! The numbers of 512 bits against exact ones, by other routes.

use super::fault::Fault;
use super::recursion::Recursion;
use super::{Wrong, hypotheses};
use crate::filter::{Effort, Records, filter_rational};
use crate::judge::suite;
use crate::matrix::Matrix;
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

fn magnitude(x: &Rational) -> Rational {
    if *x < Rational::zero() { x.negated() } else { x.clone() }
}

/// The largest entry of some quantities in a run.
fn largest(values: &[Values<Rational>], wanted: impl Fn(Quantity) -> bool) -> Rational {
    let matrices = values.iter().flatten().filter(|(name, _)| wanted(**name));
    matrices.flat_map(|(_, matrix)| matrix.entries()).map(magnitude).max().unwrap_or_else(Rational::zero)
}

/// Every entry is right but for 2⁻¹⁵⁰ of the largest that its quantity has in the run, or 2⁻⁴⁰⁰ of the largest that there
/// is, where all of a quantity is zero.
fn agree(id: &str, theirs: &[Values<Rational>], exact: &[Values<Rational>]) {
    let unit = ratio(1, 1 << 50).pow(3);
    let nothing = largest(exact, |_| true).times(&ratio(1, 1 << 50).pow(8));
    for quantity in Quantity::ALL.into_iter().filter(|quantity| *quantity != Quantity::Gain) {
        let allowed = largest(exact, |name| name == quantity).times(&unit).max(nothing.clone());
        for (step, (theirs, exact)) in theirs.iter().zip(exact).enumerate() {
            let (Some(theirs), Some(exact)) = (theirs.get(&quantity), exact.get(&quantity)) else { continue };
            for (a, b) in theirs.entries().iter().zip(exact.entries()) {
                assert!(magnitude(&a.minus(b)) <= allowed, "{id}: {quantity} at step {step}: {a} and {b}");
            }
        }
    }
}

/// Whether the entries of all covariances lie within 2¹⁰⁰ of each other: what lies farther apart may be lost in 512 bits. A
/// mistake is then missed, at worst.
fn is_within_reach(path: &Path<Rational>) -> bool {
    let noises = path.steps().iter().flat_map(|step| {
        let process = step.transition.as_ref().map(|transition| &transition.noise);
        process.into_iter().chain([&step.observation_noise])
    });
    let entries = noises.chain([&path.initial().covariance]).flat_map(Matrix::entries);
    let sizes: Vec<Rational> = entries.map(magnitude).filter(|size| *size != Rational::zero()).collect();
    let (Some(least), Some(most)) = (sizes.iter().min(), sizes.iter().max()) else { return true };
    most.times(&ratio(1, 1 << 50).pow(2)) <= *least
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
            let Some(other) = change(&path).filter(|other| *other != path && is_within_reach(other)) else { continue };
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

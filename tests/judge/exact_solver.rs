//! A program that answers exactly is told so on every case.

use exact_kalman::judge::{Judgement, Truth, Verdict};
use exact_kalman::protocol::{Answer, Case, Expect, Reply};

use crate::samples::{TRUTHS, exact_answer, rounded_answer};

/// Cases that the readable recursion solves soon, with a judgement on an answer to each.
fn judged(answer: fn(&Case) -> Answer, steps: usize) -> impl Iterator<Item = (&'static Case, Judgement)> {
    let soon = move |case: &Case| case.expect == Expect::Estimate && case.observations.len() <= steps;
    let few = |case: &Case| case.initial.mean.len() <= 8;
    TRUTHS.iter().filter(move |(case, _)| soon(case) && few(case)).map(move |(case, truth): &(Case, Truth)| {
        (case, Judgement::of(case.expect, truth, &Reply::Answer(answer(case))))
    })
}

#[test]
fn an_exact_solver_has_seventeen_digits_everywhere() {
    let mut seen = 0;
    for (case, judgement) in judged(exact_answer, 40) {
        assert_eq!(judgement.verdict, Verdict::Agrees, "{}: {:?}", case.id, judgement.remarks);
        assert!(judgement.remarks.is_empty() && judgement.scores.len() >= 4, "{}", case.id);
        for score in &judgement.scores {
            assert_eq!(score.fewest.value().to_bits(), 17.0_f64.to_bits(), "{}: {}", case.id, score.quantity);
        }
        assert!(judgement.asymmetric.is_none() && judgement.indefinite.is_none(), "{}", case.id);
        seen += 1;
    }
    assert!(seen >= 270, "{seen}");
}

/// A perfect program in doubles; its rounded covariances may be indefinite, but only by rounding.
#[test]
fn the_nearest_doubles_agree_everywhere() {
    for (case, judgement) in judged(rounded_answer, 30) {
        assert_eq!(judgement.verdict, Verdict::Agrees, "{}: {:?}", case.id, judgement.remarks);
        for score in &judgement.scores {
            assert!(score.fewest.value() >= 15.5, "{}: {} {}", case.id, score.quantity, score.fewest.value());
        }
    }
}

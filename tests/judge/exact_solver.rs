//! A program that answers exactly is told so on every case.

use exact_kalman::judge::{Verdict, suite};
use exact_kalman::protocol::Expect;

use crate::samples::{exact_answer, judge, rounded_answer};

#[test]
fn an_exact_solver_has_seventeen_digits_everywhere() {
    let mut seen = 0;
    for case in suite().iter().filter(|case| case.expect == Expect::Estimate) {
        let judgement = judge(case, exact_answer(case));
        assert_eq!(judgement.verdict, Verdict::Agrees, "{}: {:?}", case.id, judgement.remarks);
        assert!(judgement.remarks.is_empty() && judgement.scores.len() >= 4, "{}", case.id);
        for score in &judgement.scores {
            assert_eq!(score.fewest.value().to_bits(), 17.0_f64.to_bits(), "{}: {}", case.id, score.quantity);
        }
        assert!(judgement.asymmetric.is_none() && judgement.indefinite.is_none(), "{}", case.id);
        seen += 1;
    }
    assert!(seen >= 50, "{seen}");
}

/// A perfect program in doubles; its rounded covariances may be indefinite, but only by rounding.
#[test]
fn the_nearest_doubles_agree_everywhere() {
    for case in suite().iter().filter(|case| case.expect == Expect::Estimate && case.observations.len() <= 30) {
        let judgement = judge(case, rounded_answer(case));
        assert_eq!(judgement.verdict, Verdict::Agrees, "{}: {:?}", case.id, judgement.remarks);
        for score in &judgement.scores {
            assert!(score.fewest.value() >= 15.5, "{}: {} {}", case.id, score.quantity, score.fewest.value());
        }
    }
}

//! One worked example for each row of the table of verdicts.

use std::time::Duration;

use exact_kalman::judge::{Judgement, Truth, Verdict};
use exact_kalman::matrix::Matrix;
use exact_kalman::protocol::{Case, Expect, Number, Outcome, Reply};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::Quantity;
use serde_json::json;

use crate::samples::{add, exact_answer, judge, of_suite, outcome, rounded_answer, score};

/// The verdict when the variance 1/2 of `basic/constant` at step 0 is wrong by a relative 10^−digits. Attainable are
/// 52 log₁₀ 2 = 15.65 digits (worked out by hand in `attainable.rs`).
fn variance_with(digits: f64) -> Verdict {
    let case = of_suite("basic/constant");
    let mut answer = exact_answer(&case);
    let error = Rational::from_float(0.5 * 10.0_f64.powf(-digits)).expect("finite");
    add(&mut answer, (0, Quantity::FilteredCovariance, 0, 0), &error);
    judge(&case, answer).verdict
}

#[test]
fn agrees_or_loses_digits() {
    assert_eq!(variance_with(16.5), Verdict::Agrees);
    assert_eq!(variance_with(13.66), Verdict::Agrees, "1.99 digits behind");
    assert_eq!(variance_with(13.64), Verdict::Loses { digits: 3 }, "2.01 digits behind, rounded up");
    assert_eq!(variance_with(10.0), Verdict::Loses { digits: 6 }, "5.65 digits behind");
    assert_eq!(variance_with(4.01), Verdict::Loses { digits: 12 }, "11.64 digits behind");
}

#[test]
fn wrong_below_four_digits() {
    assert_eq!(variance_with(3.99), Verdict::Wrong);
    assert_eq!(variance_with(0.0), Verdict::Wrong);
    assert_eq!(variance_with(-200.0), Verdict::Wrong);
}

#[test]
fn where_little_is_attainable_little_is_asked() {
    // The innovation is the difference of two numbers near 10¹⁵ and is 1, in units of √2: about half a digit is left.
    let text = json!({"format": "exact-kalman/case/1", "id": "far", "timing": "departing",
        "initial": {"before": "observation", "mean": ["1e15"], "covariance": [["1"]]},
        "transition": [["1"]], "observation": [["1"]],
        "noise": {"process": [["0"]], "observation": [["1"]]}, "observations": [["1000000000000001"]]});
    let case = Case::parse(&text.to_string()).expect("a sound case");
    let verdict = |innovation: Rational| {
        let mut answer = exact_answer(&case);
        answer.steps[0].insert(Quantity::Innovation, Matrix::column(vec![Number::Finite(innovation)]));
        let judgement = judge(&case, answer);
        score(&judgement, Quantity::Innovation).verdict
    };
    assert_eq!(verdict(ratio(1, 1)), Verdict::Agrees);
    assert_eq!(verdict(ratio(2, 1)), Verdict::Agrees, "no digit is right, and hardly one could be");
    assert!(matches!(verdict(ratio(1000, 1)), Verdict::Loses { .. }), "three orders of magnitude are too much");
}

#[test]
fn asymmetric() {
    let case = of_suite("basic/constant-velocity");
    let place = (4, Quantity::FilteredCovariance, 0, 1);
    let with = |error: Rational| {
        let mut answer = exact_answer(&case);
        add(&mut answer, place, &error);
        judge(&case, answer)
    };
    // The variances at step 4 lie between 0.1 and 10: errors relative to them are within a power of ten of these.
    let judgement = with(ratio(1, 10_000_000_000));
    assert_eq!(judgement.verdict, Verdict::Asymmetric);
    let (quantity, step, found) = judgement.asymmetric.expect("it is asymmetric");
    assert_eq!((quantity, step, found.row, found.column), (place.1, place.0, 0, 1));
    assert!(found.beyond_rounding);
    // The last bit is a remark, no finding.
    let judgement = with(ratio(1, 1 << 53));
    assert_eq!(judgement.verdict, Verdict::Agrees);
    assert!(!judgement.asymmetric.expect("it is asymmetric").2.beyond_rounding);
}

/// vᵀPv by the double sum.
fn form(matrix: &[[Rational; 2]; 2], v: &[Rational]) -> Rational {
    let mut sum = ratio(0, 1);
    for (i, row) in matrix.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            sum += entry * &v[i] * &v[j];
        }
    }
    sum
}

/// The prior of `singular/prior-of-rank-one` is [[1, 2], [2, 4]]; with 2 + ε for 2 it is indefinite.
fn rank_one_with(error: &Rational) -> Judgement {
    let case = of_suite("singular/prior-of-rank-one");
    let mut answer = exact_answer(&case);
    for (row, column) in [(0, 1), (1, 0)] {
        add(&mut answer, (0, Quantity::PredictedCovariance, row, column), error);
    }
    judge(&case, answer)
}

#[test]
fn not_psd_with_a_witness() {
    let error = ratio(1, 100_000_000);
    let judgement = rank_one_with(&error);
    assert_eq!(judgement.verdict, Verdict::NotPositiveSemidefinite);
    let (quantity, step, found) = judgement.indefinite.expect("it is indefinite");
    assert_eq!((quantity, step, found.beyond_rounding), (Quantity::PredictedCovariance, 0, true));
    let off = ratio(2, 1) + error;
    let matrix = [[ratio(1, 1), off.clone()], [off, ratio(4, 1)]];
    let value = form(&matrix, found.proof.witness.entries());
    assert!(value < ratio(0, 1) && value == found.proof.value);
}

#[test]
fn indefinite_by_rounding_is_no_finding() {
    // 2⁻⁵² of 2 is the last bit but one of a double.
    let judgement = rank_one_with(&ratio(1, 1 << 51));
    assert_eq!(judgement.verdict, Verdict::Agrees);
    let (.., found) = judgement.indefinite.expect("it is indefinite");
    assert!(!found.beyond_rounding && found.proof.value < ratio(0, 1));
}

#[test]
fn refused_valid_input_unsupported_and_error() {
    let case = of_suite("basic/random-walk");
    for (said, verdict) in [
        (Outcome::Refused, Verdict::RefusedValidInput),
        (Outcome::Flagged, Verdict::RefusedValidInput),
        (Outcome::Unsupported, Verdict::Unsupported),
        (Outcome::Error, Verdict::Error),
    ] {
        let mut answer = outcome(&case, said, Some(3));
        answer.message = Some("because\n\u{1b}[31m of this".into());
        let judgement = judge(&case, answer);
        assert_eq!(judgement.verdict, verdict);
        let remark = &judgement.remarks[0];
        assert!(remark.contains(&said.to_string()) && remark.contains("step 3"), "{remark}");
        assert!(remark.contains("because") && !remark.contains(char::is_control), "{remark:?}");
    }
}

#[test]
fn bad_input_is_refused_or_accepted() {
    let case = of_suite("refuse/indefinite-prior");
    for said in [Outcome::Refused, Outcome::Error, Outcome::Flagged] {
        assert_eq!(judge(&case, outcome(&case, said, None)).verdict, Verdict::Agrees);
    }
    assert_eq!(judge(&case, outcome(&case, Outcome::Unsupported, None)).verdict, Verdict::Unsupported);
    let accepted = judge(&case, outcome(&case, Outcome::Answered, None));
    assert_eq!(accepted.verdict, Verdict::AcceptedBadInput);
    assert!(accepted.remarks[0].contains("not positive semidefinite"), "{:?}", accepted.remarks);
}

#[test]
fn contradictions_are_reported_at_their_step() {
    // At step 2 a known constant 2 is read as 2.125.
    let case = of_suite("singular/known-state-contradicted");
    let verdict = |said, step| judge(&case, outcome(&case, said, step)).verdict;
    for said in [Outcome::Flagged, Outcome::Refused, Outcome::Error] {
        assert_eq!(verdict(said, Some(2)), Verdict::Agrees, "{said}");
    }
    assert_eq!(verdict(Outcome::Flagged, None), Verdict::Agrees);
    assert_eq!(verdict(Outcome::Flagged, Some(1)), Verdict::Wrong);
    assert_eq!(verdict(Outcome::Refused, Some(3)), Verdict::Wrong);
    assert_eq!(verdict(Outcome::Error, Some(0)), Verdict::Error);
    assert_eq!(verdict(Outcome::Error, None), Verdict::Error);
    // What is answered before the contradiction is judged as well.
    let step = |mean: &str| json!({"filtered_mean": [mean], "filtered_covariance": [["0"]]});
    let with = |outcome: &str, mean: &str| {
        let line = json!({"id": case.id, "outcome": outcome, "step": 2,
            "steps": [step("2"), step(mean), step("2"), step("2")]});
        judge(&case, exact_kalman::protocol::Answer::parse(&line.to_string()).expect("a sound answer")).verdict
    };
    assert_eq!(with("flagged", "2"), Verdict::Agrees);
    assert_eq!(with("flagged", "3"), Verdict::Wrong);
    assert_eq!(with("answered", "2"), Verdict::AcceptedBadInput);
}

#[test]
fn no_answer() {
    let case = of_suite("basic/constant");
    let truth = Truth::of(&case);
    let verdict = |reply: &Reply| Judgement::of(Expect::Estimate, &truth, reply).verdict;
    assert_eq!(verdict(&Reply::TimedOut { limit: Duration::from_secs(1) }), Verdict::TimedOut);
    assert_eq!(verdict(&Reply::Died { status: "signal 11".into(), stderr: String::new() }), Verdict::Died);
    assert_eq!(verdict(&Reply::NotStarted { detail: String::new() }), Verdict::Died);
    assert_eq!(verdict(&Reply::Malformed { detail: String::new(), line: String::new() }), Verdict::Malformed);
    assert_eq!(verdict(&Reply::Flooded { limit: 1 }), Verdict::Malformed);
    assert_eq!(Judgement::unanswered("nothing").verdict, Verdict::Malformed);
}

#[test]
fn undecided_where_the_truth_is_too_long() {
    // Numbers of 4000 digits, 13,000 bits: their products pass any limit within a few steps. Both states and both sensors are
    // moved by one source, so the innovation covariance is singular, and no enclosure can decide that.
    let long = format!("0.{}1", "7".repeat(4000));
    let one_source = [[&long, &long], [&long, &long]];
    let text = json!({"format": "exact-kalman/case/1", "id": "long", "numbers": "exact", "timing": "departing",
        "initial": {"before": "observation", "mean": ["0", "0"], "covariance": one_source},
        "transition": [[long, "0"], ["0", long]], "observation": [["1", "0"], ["0", "1"]],
        "noise": {"process": one_source, "observation": one_source}, "observations": vec![["1", "1"]; 40]});
    let case = Case::parse(&text.to_string()).expect("a sound case");
    let answer = outcome(&case, Outcome::Answered, None);
    let judgement = judge(&case, answer);
    assert_eq!(judgement.verdict, Verdict::Undecided);
    assert!(judgement.remarks[0].contains("bits"), "{:?}", judgement.remarks);
    // Two hundred states would take hours: that is said at once.
    let unit: Vec<Vec<&str>> = (0..200).map(|i| (0..200).map(|j| if i == j { "1" } else { "0" }).collect()).collect();
    let text = json!({"format": "exact-kalman/case/1", "id": "wide", "timing": "departing",
        "initial": {"before": "observation", "mean": vec!["0"; 200], "covariance": unit},
        "transition": unit, "observation": [vec!["1"; 200]],
        "noise": {"process": unit, "observation": [["1"]]}, "observations": [["1"], ["1"]]});
    let wide = Case::parse(&text.to_string()).expect("a sound case");
    let judgement = judge(&wide, outcome(&wide, Outcome::Answered, None));
    assert_eq!(judgement.verdict, Verdict::Undecided);
    assert!(judgement.remarks[0].contains("2 steps of 200 states and 1 sensors"), "{:?}", judgement.remarks);
    // A subject that does not answer is a finding all the same.
    let died = Reply::Died { status: "signal 11".into(), stderr: String::new() };
    assert_eq!(Judgement::of(Expect::Estimate, &Truth::Unknown("too long".into()), &died).verdict, Verdict::Died);
}

#[test]
fn a_case_that_expects_the_opposite_is_undecided() {
    let refuse = of_suite("refuse/negative-variance");
    let estimate = Case { expect: Expect::Estimate, ..refuse.clone() };
    assert_eq!(judge(&estimate, outcome(&refuse, Outcome::Answered, None)).verdict, Verdict::Undecided);
    let valid = of_suite("basic/constant");
    let refuse = Case { expect: Expect::Refuse, ..valid.clone() };
    assert_eq!(judge(&refuse, exact_answer(&valid)).verdict, Verdict::Undecided);
}

#[test]
fn too_few_and_too_many_steps() {
    let case = of_suite("basic/random-walk");
    let mut short = exact_answer(&case);
    short.steps.pop();
    let mut long = exact_answer(&case);
    long.steps.push(long.steps[0].clone());
    for (answer, count) in [(short, 19), (long, 21)] {
        let judgement = judge(&case, answer);
        assert_eq!(judgement.verdict, Verdict::Wrong);
        assert_eq!(judgement.remarks, [format!("{count} steps are answered, there are 20 observations")]);
    }
    let empty = judge(&case, outcome(&case, Outcome::Answered, None));
    assert_eq!(empty.verdict, Verdict::Wrong);
}

#[test]
fn steps_without_anything_are_wrong() {
    let case = of_suite("basic/constant");
    let mut answer = exact_answer(&case);
    answer.steps.iter_mut().for_each(std::collections::BTreeMap::clear);
    let judgement = judge(&case, answer);
    assert_eq!(judgement.verdict, Verdict::Wrong);
    assert!(judgement.remarks[0].contains("nothing that is judged"), "{:?}", judgement.remarks);
}

#[test]
fn what_was_done_before_a_failure_is_judged() {
    let case = of_suite("basic/random-walk");
    let mut answer = exact_answer(&case);
    answer.steps.truncate(5);
    (answer.outcome, answer.step) = (Outcome::Error, Some(5));
    let judgement = judge(&case, answer.clone());
    assert_eq!(judgement.verdict, Verdict::Error);
    assert!(judgement.scores.iter().all(|score| score.fewest.value() >= 17.0) && judgement.scores.len() >= 4);
    add(&mut answer, (4, Quantity::FilteredMean, 0, 0), &ratio(1000, 1));
    let judgement = judge(&case, answer);
    assert_eq!(judgement.verdict, Verdict::Wrong);
    assert_eq!(score(&judgement, Quantity::FilteredMean).step, 4);
}

/// The nearest doubles everywhere, but for the last two digits of one entry.
#[test]
fn a_small_lie_is_located() {
    let case = of_suite("basic/two-sensors");
    for place in [
        (7, Quantity::FilteredMean, 1, 0),
        (11, Quantity::PredictedCovariance, 1, 1),
        (0, Quantity::FilteredCovariance, 0, 0),
    ] {
        let mut answer = rounded_answer(&case);
        let Number::Finite(value) = &answer.steps[place.0][&place.1][(place.2, place.3)] else { panic!("finite") };
        // 2⁻⁴⁷ is 7·10⁻¹⁵: the sixteenth digit and the one before it.
        let lie = value * ratio(1, 1 << 47);
        add(&mut answer, place, &lie);
        let judgement = judge(&case, answer);
        assert_eq!(judgement.verdict, Verdict::Agrees, "two digits are within what is allowed");
        let score = score(&judgement, place.1);
        assert_eq!((score.step, score.worst.row, score.worst.column), (place.0, place.2, place.3));
        for other in judgement.scores.iter().filter(|other| other.quantity != place.1) {
            assert!(other.fewest > score.fewest);
        }
    }
}

#[test]
fn the_worst_verdict_is_the_verdict() {
    let case = of_suite("basic/constant-velocity");
    let mut answer = exact_answer(&case);
    add(&mut answer, (3, Quantity::FilteredMean, 0, 0), &ratio(1, 1_000_000));
    add(&mut answer, (9, Quantity::PredictedMean, 1, 0), &ratio(1_000, 1));
    let judgement = judge(&case, answer);
    assert_eq!(judgement.verdict, Verdict::Wrong);
    assert!(matches!(score(&judgement, Quantity::FilteredMean).verdict, Verdict::Loses { .. }));
    assert_eq!(score(&judgement, Quantity::PredictedMean).step, 9);
}

#[test]
fn from_best_to_worst() {
    let order = [
        Verdict::Agrees,
        Verdict::Unsupported,
        Verdict::Undecided,
        Verdict::Loses { digits: 3 },
        Verdict::Loses { digits: 12 },
        Verdict::Asymmetric,
        Verdict::NotPositiveSemidefinite,
        Verdict::RefusedValidInput,
        Verdict::Error,
        Verdict::AcceptedBadInput,
        Verdict::Wrong,
        Verdict::TimedOut,
        Verdict::Died,
        Verdict::Malformed,
    ];
    assert!(order.is_sorted());
    assert_eq!(order.iter().filter(|verdict| verdict.is_finding()).count(), 11);
    assert_eq!(Verdict::Loses { digits: 3 }.to_string(), "loses 3 digits");
}

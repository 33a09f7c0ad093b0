//! The search for a model at which a claim fails.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};

/// How many models are tried.
const TRIED: u32 = 20_000;

/// At how many models a claim must hold.
const HELD: u32 = 500;

/// The simplest model found at which the claim fails, always the same.
///
/// # Panics
///
/// If none is found: then the hypothesis left out was not needed, or the models are too tame.
pub fn counterexample<T: std::fmt::Debug>(models: impl Strategy<Value = T>, claim: impl Fn(&T) -> bool) -> T {
    let config = Config { cases: TRIED, failure_persistence: None, max_global_rejects: 200_000, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let failing = |model: T| if claim(&model) { Ok(()) } else { Err(TestCaseError::fail("the claim fails")) };
    match runner.run(&models, failing) {
        Err(TestError::Fail(_, model)) => model,
        Err(TestError::Abort(reason)) => panic!("no model was drawn: {reason}"),
        Ok(()) => panic!("the claim holds in all of {TRIED} models without the hypothesis"),
    }
}

/// The claim holds at every model drawn: a hypothesis that is not needed.
///
/// # Panics
///
/// If it fails at one.
pub fn holds_without<T: std::fmt::Debug>(models: impl Strategy<Value = T>, claim: impl Fn(&T) -> bool) {
    holds_where(models, |_| true, claim);
}

/// The claim holds at every model drawn that satisfies the hypothesis. The others do not count, and are drawn again.
///
/// # Panics
///
/// If it fails at one, or if there are too few of them.
pub fn holds_where<T: std::fmt::Debug>(
    models: impl Strategy<Value = T>,
    hypothesis: impl Fn(&T) -> bool,
    claim: impl Fn(&T) -> bool,
) {
    let config = Config { cases: HELD, failure_persistence: None, max_global_rejects: 100 * HELD, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let failing = |model: T| match (hypothesis(&model), claim(&model)) {
        (false, _) => Err(TestCaseError::reject("the hypothesis")),
        (true, true) => Ok(()),
        (true, false) => Err(TestCaseError::fail("the claim fails")),
    };
    match runner.run(&models, failing) {
        Ok(()) => {}
        Err(TestError::Abort(reason)) => panic!("fewer than {HELD} models have the hypothesis: {reason}"),
        Err(TestError::Fail(_, model)) => panic!("the claim fails at {model:?}"),
    }
}

/// A search that cannot find is no search; one that finds always the same.
#[test]
fn a_search_finds_the_simplest_of_what_there_is() {
    assert_eq!(counterexample(0_i64..1000, |&x| x < 17), 17);
    assert!(std::panic::catch_unwind(|| counterexample(0_i64..1000, |&x| x < 1000)).is_err());
    assert!(std::panic::catch_unwind(|| holds_without(0_i64..1000, |&x| x < 500)).is_err());
    holds_where(0_i64..1000, |&x| x < 500, |&x| x < 500);
    assert!(std::panic::catch_unwind(|| holds_where(0_i64..1000, |&x| x < 501, |&x| x < 500)).is_err());
    // No model has the hypothesis: nothing was checked.
    assert!(std::panic::catch_unwind(|| holds_where(0_i64..1000, |&x| x > 999, |_| true)).is_err());
}

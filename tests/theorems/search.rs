//! The search for a model at which a claim fails.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};

/// How many models are tried.
const TRIED: u32 = 20_000;

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
    let config = Config { cases: 500, failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let failing = |model: T| if claim(&model) { Ok(()) } else { Err(TestCaseError::fail("the claim fails")) };
    if let Err(error) = runner.run(&models, failing) {
        panic!("the hypothesis is needed: {error}");
    }
}

/// A search that cannot find is no search; one that finds always the same.
#[test]
fn a_search_finds_the_simplest_of_what_there_is() {
    assert_eq!(counterexample(0_i64..1000, |&x| x < 17), 17);
    assert!(std::panic::catch_unwind(|| counterexample(0_i64..1000, |&x| x < 1000)).is_err());
    assert!(std::panic::catch_unwind(|| holds_without(0_i64..1000, |&x| x < 500)).is_err());
}

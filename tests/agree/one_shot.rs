//! CKS-T: the recursion equals the joint Gaussian of (x_0, w_1, …, w_T) conditioned once.

use exact_kalman::filter::{filter, one_shot};
use exact_kalman::scalar::Rational;
use exact_kalman::trace::{Moments, Trace};
use proptest::test_runner::{Config, TestCaseError, TestRunner};

use super::draws::draws;
use super::systems::{Draw, Kind};

const KIND: Kind = Kind { states: 4, sensors: 3, steps: 4, adapted: true, gaps: true };

/// CKS-1a, CKS-1b, CKS-T, CKS-3, CKS-4, CKS-8, CKS-K, CKS-R; HV-3 for d = 1; at least a third of the systems have a singular innovation.
#[test]
fn filter_eq_one_shot_conditioning() -> Result<(), Box<dyn std::error::Error>> {
    let mut runner = TestRunner::new(Config { cases: 3000, failure_persistence: None, ..Config::default() });
    let counts = std::cell::Cell::new((0, 0));
    runner.run(&draws(KIND), |draw| {
        let singular = compare(&draw).map_err(TestCaseError::fail)?;
        let (all, some) = counts.get();
        counts.set((all + 1, some + usize::from(singular)));
        Ok(())
    })?;
    let (all, singular) = counts.get();
    assert!(singular * 3 >= all, "only {singular} of {all} systems have a singular innovation");
    Ok(())
}

/// Whether some innovation was singular; or what differs.
fn compare(draw: &Draw) -> Result<bool, String> {
    let path = draw.system().realised(&draw.data()).map_err(|error| error.to_string())?;
    let trace = filter(&path).map_err(|error| error.to_string())?;
    let laws = one_shot(&path).map_err(|error| error.to_string())?;
    if (trace.records.len(), laws.len()) != (path.steps().len(), path.steps().len()) {
        return Err("a step is missing".into());
    }
    for (k, (record, law)) in trace.records.iter().zip(&laws).enumerate() {
        for (name, recursive, joint) in
            [("predicted", &record.predicted, &law.predicted), ("filtered", &record.filtered, &law.filtered)]
        {
            let Moments { mean, covariance, diffuse } = recursive;
            if mean != joint.mean() || covariance != joint.covariance() || diffuse.is_some() {
                return Err(format!("{name} at step {k}: {mean} {covariance}, jointly {joint:?}"));
            }
        }
    }
    Ok(has_singular_innovation(&trace))
}

fn has_singular_innovation(trace: &Trace<Rational>) -> bool {
    trace.records.iter().any(|record| record.innovation_covariance.rank() < record.observed.len())
}

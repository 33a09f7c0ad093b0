//! Every exact route to the filter's numbers gives the same numbers.
//!
//! The bytes are the tape from which the property tests draw their systems; a byte is the number that it is above the
//! digit 0, so that a seed is a line of digits.

#[path = "../../tests/agree/systems.rs"]
#[allow(dead_code, reason = "the property tests use more of it")]
mod systems;

use exact_kalman::filter::{Effort, Route, filter, filter_rational, one_shot};
use exact_kalman::model::{Path, Timing};
use exact_kalman::scalar::{Mersenne61, Precision, Rational};
use exact_kalman::trace::{Quantity, Trace};

use systems::Kind;

const KIND: Kind = Kind { states: 2, sensors: 2, steps: 3, adapted: true, gaps: true };

/// What kind of system was met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Met {
    /// Which transition shares noise with which observation.
    pub timing: Timing,
    /// Whether some innovation covariance was singular.
    pub singular: bool,
    /// Whether some entry was missing.
    pub gap: bool,
    /// Whether the routes were compared modulo 2⁶¹ − 1 as well.
    pub modular: bool,
}

/// Draws a system with data that it can produce, and compares.
///
/// # Panics
///
/// If two routes differ, or one refuses.
pub fn run(bytes: &[u8]) -> Met {
    let tape = bytes.iter().map(|byte| byte.wrapping_sub(b'0').cast_signed()).collect();
    let draw = systems::draw(KIND, tape);
    let path = match draw.system().realised(&draw.data()) {
        Ok(path) => path,
        Err(error) => panic!("{draw:?} is a system: {error}"),
    };
    let trace = match filter(&path) {
        Ok(trace) => trace,
        Err(error) => panic!("{draw:?} can produce its data: {error}"),
    };
    compare_with_joint_law(&path, &trace);
    compare_with_integers(&path, &trace);
    let singular = |record: &exact_kalman::trace::Record<Rational>| record.innovation_rank < record.observed.len();
    Met {
        timing: path.timing(),
        singular: trace.records.iter().any(singular),
        gap: trace.records.iter().any(|record| record.observed.len() < path.sensors()),
        modular: compare_with_residues(&path, &trace).is_some(),
    }
}

fn compare_with_joint_law(path: &Path<Rational>, trace: &Trace<Rational>) {
    let laws = one_shot(path).unwrap_or_else(|error| panic!("the joint law is conditioned: {error}"));
    assert_eq!((trace.records.len(), laws.len()), (path.steps().len(), path.steps().len()));
    for (record, law) in trace.records.iter().zip(&laws) {
        for (moments, law) in [(&record.predicted, &law.predicted), (&record.filtered, &law.filtered)] {
            assert_eq!((&moments.mean, &moments.covariance), (law.mean(), law.covariance()));
        }
    }
}

fn compare_with_integers(path: &Path<Rational>, trace: &Trace<Rational>) {
    for route in [Route::FractionFree, Route::Multimodular] {
        compare_with_route(path, trace, Effort { route, ..Effort::default() });
    }
}

fn compare_with_route(path: &Path<Rational>, trace: &Trace<Rational>, effort: Effort) {
    let steps = filter_rational(path, effort).unwrap_or_else(|error| panic!("integers: {error}"));
    assert_eq!(steps.len(), trace.records.len());
    for (step, record) in steps.iter().zip(&trace.records) {
        let step = step.fractions(Precision::Exact);
        let mut values = record.values();
        values.remove(&Quantity::Gain);
        assert_eq!((&step.values, step.innovation_rank), (&values, record.innovation_rank));
    }
}

/// Nothing where the prime divides a denominator.
fn compare_with_residues(path: &Path<Rational>, trace: &Trace<Rational>) -> Option<()> {
    let image = |value: &Rational| Mersenne61::image(value).ok_or(());
    let residues = filter(&path.try_map(image).ok()?).unwrap_or_else(|error| panic!("residues: {error}"));
    assert_eq!(residues.records.len(), trace.records.len());
    for (residues, record) in residues.records.iter().zip(&trace.records) {
        let (residues, values) = (residues.values(), record.values());
        assert!(residues.keys().eq(values.keys()));
        for (residues, values) in residues.values().zip(values.values()) {
            assert_eq!(residues, &values.try_map(image).ok()?);
        }
    }
    Some(())
}

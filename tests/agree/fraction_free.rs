//! The integer kernel equals the recursion, value by value.

use exact_kalman::filter::{Effort, RationalFilterError, Route, StepValues, StopReason, filter, filter_rational};
use exact_kalman::model::Path;
use exact_kalman::scalar::{Precision, Rational, Scalar, ratio};
use exact_kalman::trace::{Quantity, Values};
use proptest::prelude::*;

use super::draws::draws;
use super::systems::Kind;

const KIND: Kind = Kind { states: 4, sensors: 3, steps: 6, adapted: true, gaps: true };

fn without_gain(mut values: Values<Rational>) -> Values<Rational> {
    values.remove(&Quantity::Gain);
    values
}

fn solved(path: &Path<Rational>, precision: Precision) -> Result<Vec<StepValues>, RationalFilterError> {
    let effort = Effort { route: Route::FractionFree, ..Effort::default() };
    Ok(filter_rational(path, effort)?.iter().map(|step| step.fractions(precision)).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    /// CKS-3, CKS-4
    #[test]
    fn fraction_free_eq_recursion(draw in draws(KIND)) {
        let path = draw.system().realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let trace = filter(&path).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let fast = solved(&path, Precision::Exact).map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(fast.len(), trace.records.len());
        for (fast, record) in fast.into_iter().zip(&trace.records) {
            prop_assert_eq!(fast.values, without_gain(record.values()));
            prop_assert_eq!(fast.innovation_rank, record.innovation_covariance.rank());
        }
    }

    /// Rounding keeps every entry within half a unit of its last bit.
    #[test]
    fn rounded_is_near_exact(draw in draws(KIND), bits in 2u32..80) {
        let path = draw.system().realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let rounded = Precision::Rounded { bits };
        let exact = solved(&path, Precision::Exact).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let near = solved(&path, rounded).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let unit = ratio(1, 2).pow(i32::try_from(bits).unwrap_or(80));
        for (exact, near) in exact.iter().zip(&near) {
            prop_assert!(exact.values.keys().eq(near.values.keys()));
            for (exact, near) in exact.values.values().zip(near.values.values()) {
                for (exact, near) in exact.entries().iter().zip(near.entries()) {
                    let error = exact.minus(near);
                    let bound = exact.times(&unit);
                    prop_assert!(error.times(&error) <= bound.times(&bound), "{exact} became {near}");
                }
            }
        }
    }

    /// Data of probability zero stop both at the same step with the same witness.
    #[test]
    fn contradictions_are_found_by_both(draw in draws(Kind { gaps: false, ..KIND }), step in 0usize..6, shift in 1i64..4) {
        let mut readings = draw.simulated(&draw.initial_source, &draw.sources).1;
        let step = step % readings.len();
        let last = readings[step].rows() - 1;
        readings[step][(last, 0)] = readings[step][(last, 0)].plus(&ratio(shift, 7));
        let path = draw.system().realised(&draw.observations(&readings));
        let path = path.map_err(|error| TestCaseError::fail(error.to_string()))?;
        match (filter(&path), solved(&path, Precision::Exact)) {
            (Ok(trace), Ok(values)) => prop_assert_eq!(trace.records.len(), values.len()),
            (Err(slow), Err(fast)) => {
                let RationalFilterError { step, reason, computed } = fast;
                prop_assert_eq!((slow.step, StopReason::from(slow.source)), (step, reason));
                prop_assert_eq!(slow.computed.len(), computed.len());
            }
            (slow, fast) => prop_assert!(false, "recursion {slow:?}, integers {fast:?}"),
        }
    }
}

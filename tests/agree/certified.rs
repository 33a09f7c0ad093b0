//! Enclosures contain the exact answer, whatever the bits; and stay narrow.

use exact_kalman::certify::CertifiedFilter;
use exact_kalman::filter::filter;
use exact_kalman::model::Path;
use exact_kalman::scalar::{Dyadic, Interval, Rational, Toward};
use exact_kalman::trace::Quantity;
use proptest::prelude::*;

use super::draws::draws;
use super::systems::Kind;

const KIND: Kind = Kind { states: 4, sensors: 3, steps: 6, adapted: true, gaps: true };

fn contains(interval: &Interval, value: &Rational) -> bool {
    let below = Dyadic::rounded(value, 4000, Toward::Below);
    let above = Dyadic::rounded(value, 4000, Toward::Above);
    *interval.lower() <= above && below <= *interval.upper()
}

/// The steps that were enclosed; or the first value that is not where it should be.
fn enclosed(path: &Path<Rational>, bits: u64) -> Result<usize, String> {
    let trace = filter(path).map_err(|error| error.to_string())?;
    let mut steps = 0;
    for (step, record) in CertifiedFilter::new(path, bits).zip(&trace.records) {
        let Ok(step) = step else {
            // Readings that enter the coefficients may grow doubly exponentially, and conditions with them.
            return match bits {
                _ if is_singular(record) => Ok(steps),
                4096.. => Err(format!("step {steps} undecided")),
                _ => enclosed(path, 8 * bits.max(64)),
            };
        };
        if is_singular(record) {
            return Err(format!("step {steps} has a singular innovation"));
        }
        let exact = record.values();
        for (quantity, intervals) in &step.values {
            let exact = &exact[quantity];
            if exact.shape() != intervals.shape() {
                return Err(format!("{quantity} at step {steps}"));
            }
            for (interval, value) in intervals.entries().iter().zip(exact.entries()) {
                if !contains(interval, value) {
                    return Err(format!("{quantity} at step {steps}: {interval:?} without {value}"));
                }
            }
        }
        if step.values.len() + usize::from(exact.contains_key(&Quantity::Gain)) != exact.len() {
            return Err(format!("step {steps} lacks a quantity"));
        }
        steps += 1;
    }
    Ok(steps)
}

fn is_singular(record: &exact_kalman::trace::Record<Rational>) -> bool {
    record.innovation_rank < record.observed.len()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_value_lies_in_its_interval(draw in draws(KIND), bits in prop_oneof![Just(128_u64), Just(53), 12_u64..40]) {
        let path = draw.system().realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        enclosed(&path, bits).map_err(TestCaseError::fail)?;
    }
}

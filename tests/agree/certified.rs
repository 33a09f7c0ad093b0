//! Enclosures contain the exact answer, whatever the bits; and stay narrow.

use exact_kalman::certify::{CertifiedFilter, CertifiedStep, NotEnclosed, TieredFilter, TieredStep, Tiers};
use exact_kalman::filter::{StopReason, filter};
use exact_kalman::gaussian::ConditionError;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Dyadic, Interval, Rational, Toward};
use exact_kalman::trace::{Quantity, Record};
use num_bigint::BigInt;
use proptest::prelude::*;

use super::draws::draws;
use super::systems::Kind;

const KIND: Kind = Kind { states: 4, sensors: 3, steps: 6, adapted: true, gaps: true };

fn contains(interval: &Interval, value: &Rational) -> bool {
    let below = Dyadic::rounded(value, 4000, Toward::Below);
    let above = Dyadic::rounded(value, 4000, Toward::Above);
    *interval.lower() <= above && below <= *interval.upper()
}

/// Whether every exact value lies in its interval, and none is left out.
fn surrounds(step: &CertifiedStep, record: &Record<Rational>) -> Result<(), String> {
    let exact = record.values();
    for (quantity, intervals) in &step.values {
        let exact = exact.get(quantity).ok_or_else(|| format!("{quantity} does not exist"))?;
        if exact.shape() != intervals.shape() {
            return Err(format!("{quantity} is {}", intervals.shape()));
        }
        for (interval, value) in intervals.entries().iter().zip(exact.entries()) {
            if !contains(interval, value) {
                return Err(format!("{quantity}: {interval:?} without {value}"));
            }
        }
    }
    if step.innovation_rank != record.innovation_rank {
        return Err(format!("rank {} for {}", step.innovation_rank, record.innovation_rank));
    }
    let all = step.values.len() + usize::from(exact.contains_key(&Quantity::Gain));
    if all == exact.len() { Ok(()) } else { Err("a quantity is missing".into()) }
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
        surrounds(&step, record).map_err(|why| format!("{why} at step {steps}"))?;
        steps += 1;
    }
    Ok(steps)
}

fn is_singular(record: &Record<Rational>) -> bool {
    record.innovation_rank < record.observed.len()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 250, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_value_lies_in_its_interval(draw in draws(KIND), bits in prop_oneof![Just(128_u64), Just(53), 12_u64..40]) {
        let path = draw.system().realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        enclosed(&path, bits).map_err(TestCaseError::fail)?;
    }

    /// Exact where it must be, enclosed where it may be: no step is lost or shifted, and contradictions are found.
    #[test]
    fn tiers_follow_each_other(
        draw in draws(Kind { steps: 10, ..KIND }),
        exact_bits in prop_oneof![Just(0_u64), 4_u64..60],
        contradicted in any::<bool>(),
    ) {
        let mut readings = draw.simulated(&draw.initial_source, &draw.sources).1;
        if contradicted {
            let last = readings.len() - 1;
            readings[last][(0, 0)] += Rational::new(1.into(), 7.into());
        }
        let path = draw.system().realised(&draw.observations(&readings));
        let path = path.map_err(|error| TestCaseError::fail(error.to_string()))?;
        let tiers = Tiers { exact_bits, bits: 64, most_bits: 512, accuracy: 20, maximal_bits: None };
        let (records, reason) = match filter(&path) {
            Ok(trace) => (trace.records, None),
            Err(error) => (error.computed, Some(error.source)),
        };
        let mut steps = TieredFilter::new(&path, tiers);
        for (k, record) in records.iter().enumerate() {
            match steps.next() {
                Some(Ok(TieredStep::Exact(step))) => {
                    for (quantity, values) in &record.values() {
                        prop_assert!(*quantity == Quantity::Gain || step.exactly(*quantity).as_ref() == Some(values));
                    }
                }
                Some(Ok(TieredStep::Certified(step))) => {
                    surrounds(&step, record).map_err(|why| TestCaseError::fail(format!("{why} at step {k}")))?;
                }
                // Coefficients that follow the readings may leave the range of doubles by far.
                Some(Err(StopReason::TooLong { .. })) => return Ok(()),
                other => return Err(TestCaseError::fail(format!("step {k}: {other:?}"))),
            }
        }
        match (steps.next(), reason) {
            (None, None) | (Some(Err(StopReason::TooLong { .. })), _) => {}
            (Some(Err(StopReason::Condition(found))), Some(reason)) => prop_assert_eq!(found, reason),
            (other, reason) => return Err(TestCaseError::fail(format!("{other:?}, {reason:?}"))),
        }
    }
}

/// Two sensors that repeat each other, noise included, and a third that is their sum: enclosed all the same, with the exact
/// rank, from the first step to the last.
#[test]
fn sensors_that_repeat_others_are_left_out() {
    let matrix = |rows: &[[i64; 2]]| {
        Matrix::from_rows(
            rows.iter().map(|row| row.map(|entry| Rational::from(BigInt::from(entry))).to_vec()).collect(),
        )
        .expect("rows of one length")
    };
    let factor = matrix(&[[1, 0], [1, 0], [2, 0]]);
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(2, 1), Matrix::identity(2)),
        transition: matrix(&[[1, 1], [0, 1]]).into(),
        observation: matrix(&[[1, 0], [1, 0], [2, 0]]).into(),
        noise: Noise::Covariances {
            process: Matrix::identity(2).into(),
            cross: None,
            observation: (&factor * factor.transpose()).into(),
        },
        input: None,
        observation_input: None,
    };
    let readings = [3, -1, 4, 1].map(|y| Observation::complete([y, y, 2 * y].map(|y| Rational::from(BigInt::from(y)))));
    let path = system.realised(&readings).expect("a sound system");
    assert_eq!(enclosed(&path, 128), Ok(4));
    let contradiction =
        [3, -1].map(|y| Observation::complete([y, y, 2 * y + 1].map(|y| Rational::from(BigInt::from(y)))));
    let path = system.realised(&contradiction).expect("a sound system");
    assert_eq!(first_refusal(&path), filter(&path).err().map(|error| error.source));
}

/// What ends the enclosed filter, as the exact one would say it.
fn first_refusal(path: &Path<Rational>) -> Option<ConditionError<Rational>> {
    match CertifiedFilter::new(path, 128).find_map(Result::err)? {
        NotEnclosed::Contradiction(proof) => Some(ConditionError::Inconsistent(proof)),
        NotEnclosed::Undecided(_) => None,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Sensors L (C x + v): whatever the readings are, enclosures end at the step where the exact filter ends, with its proof.
    #[test]
    fn contradictions_are_proved_as_exact_numbers_prove_them(
        more in proptest::collection::vec(-2_i64..3, 4),
        readings in proptest::collection::vec((-3_i64..4, -3_i64..4, 0_i64..8, 0_i64..8), 5),
        arriving in any::<bool>(),
    ) {
        let whole = |entry: i64| Rational::from(BigInt::from(entry));
        let identity = Matrix::<Rational>::identity(2);
        let combination = identity.above(&Matrix::from_fn(2, 2, |i, j| whole(more[2 * i + j])));
        let system = System {
            timing: if arriving { Timing::Arriving } else { Timing::Departing },
            initial: Initial::new(Before::Observation, Matrix::zeros(2, 1), identity.clone()),
            transition: Matrix::from_fn(2, 2, |i, j| whole(i64::from(i <= j))).into(),
            observation: combination.clone().into(),
            noise: Noise::Covariances {
                process: identity.into(),
                cross: None,
                observation: (&combination * combination.transpose()).into(),
            },
            input: None,
            observation_input: None,
        };
        // Three quarters of them agree.
        let observed = readings.iter().map(|&(a, b, c, d)| {
            let wrong = [0, 0, i64::from(c == 1), i64::from(d == 1)].map(whole);
            let all = &combination * Matrix::column(vec![whole(a), whole(b)]) + Matrix::column(wrong.to_vec());
            Observation::complete(all.entries().to_vec())
        });
        let path = system.realised(&observed.collect::<Vec<_>>()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let (expected, steps) = match filter(&path) {
            Ok(trace) => (None, trace.records.len()),
            Err(error) => (Some(error.source), error.computed.len()),
        };
        prop_assert_eq!(first_refusal(&path), expected);
        prop_assert_eq!(CertifiedFilter::new(&path, 128).take_while(Result::is_ok).count(), steps);
    }
}

fn scalar(transition: &Rational, noise: [Rational; 2], readings: &[Observation<Rational>]) -> Path<Rational> {
    let [process, observation] = noise.map(|variance| Matrix::column(vec![variance]));
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), Matrix::identity(1)),
        transition: Matrix::column(vec![transition.clone()]).into(),
        observation: Matrix::<Rational>::identity(1).into(),
        noise: Noise::Covariances { process: process.into(), cross: None, observation: observation.into() },
        input: None,
        observation_input: None,
    };
    system.realised(readings).expect("a sound system")
}

/// A sensor without noise leaves a variance of zero, which no enclosure can tell from a tiny one: it counts as zero where it is
/// smaller than doubles can make it, and no exact number is needed for that.
#[test]
fn a_sensor_without_noise_needs_no_exact_numbers() {
    let double = |value: f64| exact_kalman::scalar::exact_value(value).expect("finite");
    let readings: Vec<_> = (0..60).map(|k| Observation::complete([double(f64::from(k % 7) * 0.3)])).collect();
    let path = scalar(&double(0.6666), [double(0.142), double(0.0)], &readings);
    let tiers = Tiers { exact_bits: 256, ..Tiers::default() };
    let records = filter(&path).expect("regular").records;
    let mut certified = 0;
    for (step, record) in TieredFilter::new(&path, tiers).zip(&records) {
        let step = step.expect("a step");
        certified += usize::from(matches!(step, TieredStep::Certified(_)));
        let values = step.fractions(256).values;
        assert_eq!(values[&Quantity::FilteredCovariance], record.filtered.covariance);
        let error = &values[&Quantity::FilteredMean] - &record.filtered.mean;
        assert!(error.squared_norm() < Rational::new(1.into(), BigInt::from(1) << 200));
    }
    assert!(certified > 50, "{certified}");
}

/// Numbers that leave the range of doubles by far end a run before they fill the memory.
#[test]
fn what_no_double_holds_ends_the_run() {
    for (transition, noise) in [("1e300", 1), ("1e-300", 0)] {
        let huge = Rational::from(BigInt::from(10).pow(300));
        let transition = if transition == "1e300" { huge } else { huge.recip() };
        let noise = [noise, 1].map(|variance| Rational::from(BigInt::from(variance)));
        let path = scalar(&transition, noise, &vec![Observation::missing(1); 300]);
        let steps: Vec<_> = TieredFilter::new(&path, Tiers::default()).collect();
        assert!(steps.len() < 20, "{}", steps.len());
        assert!(matches!(steps.last(), Some(Err(StopReason::TooLong { .. }))));
    }
}

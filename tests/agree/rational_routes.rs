//! The fast routes equal the recursion, value by value.

use exact_kalman::filter::{
    Effort, RationalFilterError, Route, StepValues, StopReason, Wanted, filter, filter_rational,
};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Precision, Rational, Scalar, ratio};
use exact_kalman::trace::{Quantity, Values};
use num_bigint::BigInt;
use num_integer::Integer;
use proptest::prelude::*;

use super::draws::draws;
use super::systems::Kind;

const KIND: Kind = Kind { states: 4, sensors: 3, steps: 6, adapted: true, gaps: true };

fn without_gain(mut values: Values<Rational>) -> Values<Rational> {
    values.remove(&Quantity::Gain);
    values
}

const ROUTES: [Route; 3] = [Route::FractionFree, Route::Multimodular, Route::Fastest];

fn solved(path: &Path<Rational>, route: Route, precision: Precision) -> Result<Vec<StepValues>, RationalFilterError> {
    let effort = Effort { route, ..Effort::default() };
    Ok(filter_rational(path, effort)?.iter().map(|step| step.fractions(precision)).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    /// CKS-3, CKS-4
    #[test]
    fn fast_routes_eq_recursion(draw in draws(KIND)) {
        let path = draw.system().realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let trace = filter(&path).map_err(|error| TestCaseError::fail(error.to_string()))?;
        for route in ROUTES {
            let fast = solved(&path, route, Precision::Exact).map_err(|error| TestCaseError::fail(error.to_string()))?;
            prop_assert_eq!(fast.len(), trace.records.len());
            for (fast, record) in fast.into_iter().zip(&trace.records) {
                prop_assert_eq!(fast.values, without_gain(record.values()));
                prop_assert_eq!(fast.innovation_rank, record.innovation_covariance.rank());
            }
        }
    }

    /// Rounding keeps every entry within half a unit of its last bit.
    #[test]
    fn rounded_is_near_exact(draw in draws(KIND), bits in 2u32..80) {
        let path = draw.system().realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let rounded = Precision::Rounded { bits };
        let exact = solved(&path, Route::Fastest, Precision::Exact).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let near = solved(&path, Route::Fastest, rounded).map_err(|error| TestCaseError::fail(error.to_string()))?;
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
    fn contradictions_are_found_by_all(draw in draws(Kind { gaps: false, ..KIND }), step in 0usize..6, shift in 1i64..4) {
        let mut readings = draw.simulated(&draw.initial_source, &draw.sources).1;
        let step = step % readings.len();
        let last = readings[step].rows() - 1;
        readings[step][(last, 0)] = readings[step][(last, 0)].plus(&ratio(shift, 7));
        let path = draw.system().realised(&draw.observations(&readings));
        let path = path.map_err(|error| TestCaseError::fail(error.to_string()))?;
        let slow = filter(&path);
        for route in ROUTES {
            match (&slow, solved(&path, route, Precision::Exact)) {
                (Ok(trace), Ok(values)) => prop_assert_eq!(trace.records.len(), values.len()),
                (Err(slow), Err(fast)) => {
                    let RationalFilterError { step, reason, computed } = fast;
                    prop_assert_eq!((slow.step, StopReason::from(slow.source.clone())), (step, reason));
                    prop_assert_eq!(slow.computed.len(), computed.len());
                }
                (slow, fast) => prop_assert!(false, "recursion {slow:?}, integers {fast:?}"),
            }
        }
    }
}

/// Entries that are all different and rarely zero, from a linear congruence.
pub struct Dense {
    state: u64,
    entry: fn(u64) -> Rational,
}

/// Small integers over 1, …, 10.
fn small(drawn: u64) -> Rational {
    over(drawn, 1 + i64::try_from(drawn / 21 % 10).unwrap_or(0))
}

/// Doubles in (−1, 1).
pub fn double(drawn: u64) -> Rational {
    let half = i64::try_from(drawn % (1 << 53)).unwrap_or(0) - (1 << 52);
    ratio(half, 1 << 52)
}

fn over(drawn: u64, denominator: i64) -> Rational {
    ratio(i64::try_from(drawn % 21).unwrap_or(0) - 10, denominator)
}

impl Dense {
    pub fn new(entry: fn(u64) -> Rational) -> Self {
        Self { state: 1, entry }
    }

    pub fn matrix(&mut self, rows: usize, columns: usize) -> Matrix<Rational> {
        Matrix::from_fn(rows, columns, |_, _| {
            self.state = self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.entry)(self.state >> 11)
        })
    }

    pub fn system(&mut self, timing: Timing, n: usize, m: usize) -> System<Rational> {
        let before = if timing == Timing::Arriving { Before::Transition } else { Before::Observation };
        System {
            timing,
            initial: Initial::new(before, self.matrix(n, 1), Matrix::identity(n)),
            transition: self.matrix(n, n).into(),
            observation: self.matrix(m, n).into(),
            noise: Noise::Factors { process: self.matrix(n, n + m).into(), observation: self.matrix(m, n + m).into() },
            input: None,
            observation_input: None,
        }
    }

    /// A path whose last sensor repeats the first one, with gaps.
    fn path_with_gaps(&mut self, timing: Timing, steps: usize, contradiction: Option<usize>) -> Path<Rational> {
        let (n, m) = (3, 2);
        let repeated = |matrix: Matrix<Rational>| matrix.above(&matrix.select_rows(&[0]));
        let mut system = self.system(timing, n, m);
        system.observation = repeated(self.matrix(m, n)).into();
        system.noise = Noise::Factors {
            process: self.matrix(n, n + m).into(),
            observation: repeated(self.matrix(m, n + m)).into(),
        };
        let readings: Vec<_> = (0..steps)
            .map(|k| {
                let mut reading = repeated(self.matrix(m, 1));
                if contradiction == Some(k) {
                    reading[(m, 0)] = reading[(m, 0)].plus(&ratio(1, 1 << 40));
                }
                let seen = |i: usize| match k % 7 {
                    2 => i != 0,
                    4 => i != 1,
                    5 => false,
                    _ => true,
                };
                Observation::new((0..=m).map(|i| seen(i).then(|| reading[(i, 0)].clone())).collect())
            })
            .collect();
        system.realised(&readings).expect("shapes that fit")
    }
}

const TIMINGS: [Timing; 2] = [Timing::Arriving, Timing::Departing];

/// CKS-3, CKS-4: also where numbers are so long that quotients are worked out modulo powers of two, with innovations
/// that are singular and readings that are missing.
#[test]
fn long_numbers_eq_recursion() {
    for (entry, steps) in [(small as fn(u64) -> Rational, 24), (double, 8), (|drawn| over(drawn, 7), 48)] {
        for timing in TIMINGS {
            let path = Dense::new(entry).path_with_gaps(timing, steps, None);
            let trace = filter(&path).expect("data as the system makes them");
            for route in ROUTES {
                let fast = solved(&path, route, Precision::Exact).expect("data as the system makes them");
                assert_eq!(fast.len(), steps);
                for (fast, record) in fast.into_iter().zip(&trace.records) {
                    assert!(fast.values == without_gain(record.values()), "{route:?} differs");
                    assert_eq!(fast.innovation_rank, record.innovation_covariance.rank());
                }
            }
            let bits = trace.records[steps - 1].filtered.covariance[(0, 0)].denom().bits();
            assert!(bits > 1_200, "the numbers have {bits} bits only");
        }
    }
}

/// A contradiction of 2⁻⁴⁰ is seen among long numbers.
#[test]
fn late_contradictions_are_found_by_all() {
    for timing in TIMINGS {
        let path = Dense::new(small).path_with_gaps(timing, 40, Some(36));
        let slow = filter(&path).expect_err("a contradiction");
        for route in ROUTES {
            let fast = solved(&path, route, Precision::Exact).expect_err("a contradiction");
            assert_eq!((slow.step, fast.step), (36, 36));
            assert_eq!(StopReason::from(slow.source.clone()), fast.reason);
        }
    }
}

/// The least common denominator.
fn in_lowest_terms(matrix: &Matrix<Rational>) -> u64 {
    matrix.entries().iter().fold(BigInt::from(1), |all, entry| all.lcm(entry.denom())).bits()
}

/// Whatever the denominators of the data, those of the states stay next to lowest terms, and so grow linearly.
#[test]
fn denominators_are_next_to_those_in_lowest_terms() {
    let entries: [fn(u64) -> Rational; 7] = [
        |drawn| over(drawn, 3),
        |drawn| over(drawn, 5),
        |drawn| over(drawn, 7),
        |drawn| over(drawn, 10),
        |drawn| over(drawn, 10_007),
        small,
        double,
    ];
    let steps = 16;
    for (kind, entry) in entries.into_iter().enumerate() {
        for (timing, n) in TIMINGS.into_iter().zip([2, 4]) {
            let mut dense = Dense::new(entry);
            let system = dense.system(timing, n, n / 2);
            let readings: Vec<_> =
                (0..steps).map(|_| Observation::complete(dense.matrix(n / 2, 1).entries().to_vec())).collect();
            let path = system.realised(&readings).expect("shapes that fit");
            let effort = Effort { route: Route::FractionFree, ..Effort::default() };
            let values = filter_rational(&path, effort).expect("noise on every sensor");
            for quantity in [Quantity::FilteredMean, Quantity::FilteredCovariance] {
                let bits = |k: usize| values[k].values[&quantity].denominator.bits();
                let least = in_lowest_terms(&values[steps - 1].exactly(quantity).expect("handed out at every step"));
                let all = bits(steps - 1);
                assert!(100 * all <= 102 * least, "kind {kind}, {timing:?}: {all} bits instead of {least}");
                let half = bits(steps / 2 - 1);
                assert!(10 * all <= 23 * half, "kind {kind}, {timing:?}: {half} bits became {all}");
            }
        }
    }
}

/// The recursion, which an indefinite start goes through, hands out no more than was asked for either.
#[test]
fn what_is_not_wanted_is_not_handed_out() {
    for allow_indefinite in [false, true] {
        let mut dense = Dense::new(small);
        let mut system = dense.system(Timing::Arriving, 2, 1);
        system.initial.allow_indefinite = allow_indefinite;
        let path = system.realised(&[Observation::complete([ratio(1, 1)])]).expect("shapes that fit");
        let effort = Effort { wanted: Wanted::Filtered, ..Effort::default() };
        let steps = filter_rational(&path, effort).expect("noise on every sensor");
        assert!(steps[0].values.keys().eq(&[Quantity::FilteredMean, Quantity::FilteredCovariance]));
    }
}

/// Equal steps make equal paths, though an image is not known to be semidefinite.
#[test]
fn paths_are_equal_if_their_steps_are() {
    let path = Dense::new(small).path_with_gaps(Timing::Departing, 3, None);
    let image = path.try_map(|entry| Ok::<_, ()>(entry.clone())).expect("nothing fails");
    assert_eq!(path, image);
}

//! The multi-modular route where primes do not suit the data, and where numbers are long.

use exact_kalman::filter::{Effort, RationalStep, Route, filter, filter_rational};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::modular::Primes;
use exact_kalman::scalar::{Precision, Rational, ratio};
use exact_kalman::trace::Quantity;
use num_bigint::BigInt;

use super::rational_routes::{Dense, double};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The k-th of the primes that the route uses.
fn prime(k: usize) -> Rational {
    let field = Primes::default().nth(k).expect("primes go on");
    Rational::from(BigInt::from(field.modulus()))
}

fn by(path: &Path<Rational>, route: Route) -> Result<Vec<RationalStep>, Box<dyn std::error::Error>> {
    Ok(filter_rational(path, Effort { route, ..Effort::default() })?)
}

fn assert_equal(left: &[RationalStep], right: &[RationalStep]) {
    assert_eq!(left.len(), right.len());
    for (step, (left, right)) in left.iter().zip(right).enumerate() {
        let (left, right) = (left.fractions(Precision::Exact), right.fractions(Precision::Exact));
        assert_eq!(left.innovation_rank, right.innovation_rank, "step {step}");
        for (quantity, matrix) in &left.values {
            // Not shown: these are thousands of digits.
            assert!(right.values.get(quantity) == Some(matrix), "{quantity} at step {step}");
        }
        assert_eq!(left.values.len(), right.values.len());
    }
}

/// Dense systems with noise on everything, n = 1, …, 5 and m = 1, …, 4, long enough for several hundred primes, where fractions
/// in lowest terms would take minutes.
#[test]
fn long_numbers_agree_with_elimination_on_integers() -> Outcome {
    for (n, m, steps) in [(1, 1, 40), (2, 1, 40), (3, 2, 20), (4, 4, 10), (5, 3, 10)] {
        for timing in [Timing::Arriving, Timing::Departing] {
            let mut dense = Dense::new(double);
            let system = dense.system(timing, n, m);
            let readings: Vec<_> =
                (0..steps).map(|_| Observation::complete(dense.matrix(m, 1).entries().to_vec())).collect();
            let path = system.realised(&readings)?;
            let modular = by(&path, Route::Multimodular)?;
            let last = &modular[steps - 1].values[&Quantity::FilteredCovariance].denominator;
            assert!(last.bits() > 2000, "{n}, {m}: {} bits", last.bits());
            assert_equal(&modular, &by(&path, Route::FractionFree)?);
        }
    }
    Ok(())
}

/// A system of two states that are read through `noise` and moved by `transition`, step by step.
fn awkward(
    noise: &[Rational],
    transition: &[Rational],
    readings: &[Rational],
) -> Result<Path<Rational>, Box<dyn std::error::Error>> {
    let mut draw = Dense::new(double);
    let base = draw.matrix(2, 2);
    let process = draw.matrix(2, 2);
    let moved = |factor: &Rational| base.scaled(factor);
    let system = System {
        timing: Timing::Arriving,
        // Nothing is known to vary at first: the first innovation covariance is the noise.
        initial: Initial::new(Before::Observation, Matrix::zeros(2, 1), Matrix::zeros(2, 2)),
        transition: Coefficient::per_step(transition.iter().map(moved)),
        observation: draw.matrix(1, 2).into(),
        noise: Noise::Covariances {
            process: process.congruence(&Matrix::identity(2)).into(),
            cross: None,
            observation: Coefficient::per_step(noise.iter().map(|noise| Matrix::column(vec![noise.clone()]))),
        },
        input: None,
        observation_input: None,
    };
    let readings: Vec<_> = readings.iter().map(|y| Observation::complete([y.clone()])).collect();
    Ok(system.realised(&readings)?)
}

/// Pivots, transitions and readings with primes that the route uses, or will use, in numerators or denominators.
#[test]
fn primes_that_do_not_suit_the_data_are_passed_over() -> Outcome {
    const STEPS: usize = 16;
    let plain = || vec![ratio(1, 1); STEPS];
    let at = |step: usize, value: Rational| {
        let mut values = plain();
        values[step] = value;
        values
    };
    // The first one is in use from the beginning, the twentieth only later.
    for k in [0, 1, 20] {
        let p = prime(k);
        let cases = [
            awkward(&at(0, p.clone()), &plain(), &plain())?,
            awkward(&at(0, p.recip()), &plain(), &plain())?,
            awkward(&plain(), &at(1, p.recip()), &plain())?,
            awkward(&plain(), &at(9, p.recip()), &plain())?,
            awkward(&plain(), &at(9, p.clone()), &plain())?,
            awkward(&plain(), &plain(), &at(9, p.recip()))?,
            awkward(&at(0, &p * prime(k + 1)), &at(5, (&p * prime(k + 2)).recip()), &at(6, p.recip()))?,
        ];
        for path in &cases {
            let trace = filter(path)?;
            let modular = by(path, Route::Multimodular)?;
            assert_eq!(modular.len(), STEPS);
            for (step, record) in modular.iter().zip(&trace.records) {
                assert_eq!(step.exactly(Quantity::FilteredMean).as_ref(), Some(&record.filtered.mean));
                assert_eq!(step.exactly(Quantity::FilteredCovariance).as_ref(), Some(&record.filtered.covariance));
            }
        }
    }
    Ok(())
}

/// An innovation that must vanish and is a multiple of the first prime.
#[test]
fn contradictions_that_a_prime_does_not_see_are_found() -> Outcome {
    for reading in [prime(0), prime(1), prime(0) * prime(1)] {
        let path = awkward(&[ratio(0, 1), ratio(1, 1)], &[ratio(1, 1), ratio(1, 1)], &[reading, ratio(1, 1)])?;
        assert!(filter(&path).is_err_and(|error| error.step == 0));
        let effort = Effort { route: Route::Multimodular, ..Effort::default() };
        assert!(filter_rational(&path, effort).is_err_and(|error| error.step == 0));
    }
    Ok(())
}

/// Steps that differ in the noise that both equations share, and in nothing else.
#[test]
fn noise_is_shared_as_each_step_says() -> Outcome {
    for timing in [Timing::Arriving, Timing::Departing] {
        let one = Matrix::<Rational>::identity(1);
        let shared = (0..8).map(|k| Matrix::column(vec![ratio(k % 3, 4)]));
        let system = System {
            timing,
            initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
            transition: one.clone().into(),
            observation: one.clone().into(),
            noise: Noise::Covariances {
                process: one.clone().into(),
                cross: Some(Coefficient::per_step(shared)),
                observation: one.into(),
            },
            input: None,
            observation_input: None,
        };
        let readings: Vec<_> = (0..8).map(|k| Observation::complete([ratio(k * k, 3)])).collect();
        let path = system.realised(&readings)?;
        let trace = filter(&path)?;
        for route in [Route::Multimodular, Route::FractionFree] {
            for (step, record) in by(&path, route)?.iter().zip(&trace.records) {
                assert_eq!(step.exactly(Quantity::FilteredMean).as_ref(), Some(&record.filtered.mean));
                assert_eq!(step.exactly(Quantity::FilteredCovariance).as_ref(), Some(&record.filtered.covariance));
            }
        }
    }
    Ok(())
}

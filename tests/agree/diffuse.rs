//! The diffuse start against least squares, and against large finite variances.

use exact_kalman::filter::{Effort, FilterError, RationalFilterError, StopReason, filter, filter_rational, one_shot};
use exact_kalman::gaussian::{ConditionError, Gaussian};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, ModelError, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::trace::{Moments, Trace};
use proptest::collection::vec;
use proptest::prelude::*;

use super::draws::draws;
use super::systems::{Draw, Kind, Q};

const KIND: Kind = Kind { states: 3, sensors: 2, steps: 4, adapted: true, gaps: true };

/// A system whose initial covariance has the diffuse part G Gᵀ, with data that it can produce.
#[derive(Clone, Debug)]
struct Diffuse {
    draw: Draw,
    factor: Q,
}

fn diffuse_draws() -> impl Strategy<Value = Diffuse> {
    (draws(KIND), vec(-2i64..=2, 6), 1usize..=2).prop_map(|(mut draw, entries, rank)| {
        let factor = Matrix::from_fn(draw.mean.rows(), rank, |i, j| ratio(entries[2 * i + j], 1));
        draw.mean = &draw.mean + &factor * Matrix::column(vec![ratio(3, 2); rank]);
        Diffuse { draw, factor }
    })
}

impl Diffuse {
    fn system(&self) -> System<Rational> {
        let mut system = self.draw.system();
        system.initial.diffuse = Some(&self.factor * self.factor.transpose());
        system
    }

    /// κ as a number.
    fn finite(&self, kappa: &Rational) -> System<Rational> {
        let mut system = self.draw.system();
        let part = (&self.factor * self.factor.transpose()).scaled(kappa);
        system.initial.covariance = system.initial.covariance + part;
        system
    }
}

fn traced(system: &System<Rational>, draw: &Draw) -> Result<(Path<Rational>, Trace<Rational>), TestCaseError> {
    let path = system.realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
    let trace = filter(&path).map_err(|error| TestCaseError::fail(error.to_string()))?;
    Ok((path, trace))
}

/// What is left of a finite start's moments when the two leading orders in κ are taken away.
fn remainders(finite: &Moments<Rational>, limit: &Moments<Rational>, kappa: &Rational) -> Vec<Rational> {
    let n = limit.mean.rows();
    let part = limit.diffuse.clone().unwrap_or_else(|| Matrix::zeros(n, n));
    let covariance = &finite.covariance - &limit.covariance - part.scaled(kappa);
    let mean = &finite.mean - &limit.mean;
    mean.entries().iter().chain(covariance.entries()).cloned().collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    /// The mean and both orders of the covariance are limits: what remains falls at least like 1/κ.
    #[test]
    fn remainder_falls_like_one_over_kappa(diffuse in diffuse_draws()) {
        let (small, large) = (ratio(10, 1).pow(12), ratio(10, 1).pow(15));
        let (_, limit) = traced(&diffuse.system(), &diffuse.draw)?;
        let (_, at_small) = traced(&diffuse.finite(&small), &diffuse.draw)?;
        let (_, at_large) = traced(&diffuse.finite(&large), &diffuse.draw)?;
        let square = |x: &Rational| x.times(x);
        for ((limit, first), second) in limit.records.iter().zip(&at_small.records).zip(&at_large.records) {
            for (limit, first, second) in [
                (&limit.predicted, &first.predicted, &second.predicted),
                (&limit.filtered, &first.filtered, &second.filtered),
            ] {
                let rests = remainders(first, limit, &small).into_iter().zip(remainders(second, limit, &large));
                for (first, second) in rests {
                    // 1/1000 of it is left, up to the next order.
                    prop_assert!(square(&second).times(&square(&ratio(900, 1))) <= square(&first), "{first} then {second}");
                }
            }
        }
    }

    /// Where the data determine the diffuse coordinates δ, the filter is generalised least squares for them.
    #[test]
    fn filter_eq_least_squares(diffuse in diffuse_draws()) {
        let (path, trace) = traced(&diffuse.system(), &diffuse.draw)?;
        for (k, record) in trace.records.iter().enumerate() {
            let Some((mean, covariance)) = least_squares(&path, &diffuse.factor, k) else { continue };
            prop_assert_eq!(&record.filtered.diffuse, &None);
            prop_assert_eq!(&record.filtered.mean, &mean);
            prop_assert_eq!(&record.filtered.covariance, &covariance);
        }
    }
}

/// The law of x_k and its observations up to k, given δ: affine in δ with a covariance that does not depend on it.
struct GivenDelta {
    state: Gaussian<Rational>,
    slope: Q,
    readings: Vec<(Q, Q)>,
}

/// Estimates x_k from y_0, …, y_k with x_0 = mean + G δ + …, δ unknown; nothing if they do not determine δ.
fn least_squares(path: &Path<Rational>, factor: &Q, last: usize) -> Option<(Q, Q)> {
    let initial = path.initial();
    let (n, r) = (path.states(), factor.columns());
    // Components: δ-slopes are carried beside; the joint Gaussian grows by each reading at its end.
    let start = Gaussian::new(initial.mean.clone(), initial.covariance.clone()).ok()?;
    let mut law = GivenDelta { state: start, slope: factor.clone(), readings: Vec::new() };
    for (k, step) in path.steps().iter().enumerate().take(last + 1) {
        let m = step.reading.dimension();
        let (process, cross) = step.transition.as_ref().map_or_else(
            || (Matrix::zeros(n, n), Matrix::zeros(n, m)),
            |transition| (transition.noise.clone(), transition.cross_noise.clone()),
        );
        let noise = process.beside(&cross).above(&cross.transpose().beside(&step.observation_noise));
        let noise = Gaussian::new(Matrix::zeros(n + m, 1), noise).ok()?;
        // (state, earlier readings, process noise, observation noise)
        let all = law.state.joined(&noise);
        let size = law.state.dimension();
        let moves = step.transition.as_ref().filter(|_| match path.timing() {
            Timing::Arriving => k > 0 || initial.before == Before::Transition,
            Timing::Departing => false,
        });
        let (a, b, w) = match moves {
            Some(transition) => (transition.matrix.clone(), transition.input.clone(), Matrix::identity(n)),
            None => (Matrix::identity(n), Matrix::zeros(n, 1), Matrix::zeros(n, n)),
        };
        let mut map = Matrix::zeros(size + m, size + n + m);
        let mut shift = Matrix::zeros(size + m, 1);
        put(&mut map, 0, 0, &a);
        put(&mut map, 0, size, &w);
        put(&mut shift, 0, 0, &b);
        put(&mut map, n, n, &Matrix::identity(size - n));
        put(&mut map, size, 0, &(&step.observation * &a));
        put(&mut map, size, size, &(&step.observation * &w));
        put(&mut map, size, size + n, &Matrix::identity(m));
        put(&mut shift, size, 0, &(&step.observation * &b + &step.observation_input));
        law.slope = a * &law.slope;
        let present = step.reading.present();
        law.readings.push(((&step.observation * &law.slope).select_rows(&present), step.reading.values()));
        let kept: Vec<usize> = (0..size).chain(present.iter().map(|i| size + i)).collect();
        // A departing transition uses the same noise as this reading: move the state along with it afterwards.
        let departs = step.transition.as_ref().filter(|_| path.timing() == Timing::Departing && k < last);
        if let Some(transition) = departs {
            let mut onward = map.clone();
            put(&mut onward, 0, 0, &transition.matrix);
            put(&mut onward, 0, size, &Matrix::identity(n));
            let mut onward_shift = shift.clone();
            put(&mut onward_shift, 0, 0, &transition.input);
            law.state = all.affine(&onward, &onward_shift).marginal(&kept);
            law.slope = &transition.matrix * &law.slope;
        } else {
            law.state = all.affine(&map, &shift).marginal(&kept);
        }
    }
    estimated(&law, n, r)
}

fn put(target: &mut Q, row: usize, column: usize, block: &Q) {
    for i in 0..block.rows() {
        for j in 0..block.columns() {
            target[(row + i, column + j)] = block[(i, j)].clone();
        }
    }
}

/// δ̂ = (HᵀV⁻¹H)⁻¹HᵀV⁻¹r, then x_k given the data and δ, with the uncertainty of δ̂ added.
fn estimated(law: &GivenDelta, n: usize, r: usize) -> Option<(Q, Q)> {
    let observed: Vec<usize> = (n..law.state.dimension()).collect();
    let hidden: Vec<usize> = (0..n).collect();
    let (mut h, mut values) = (Matrix::zeros(0, r), Matrix::zeros(0, 1));
    for (rows, reading) in &law.readings {
        h = h.above(rows);
        values = values.above(reading);
    }
    let readings = law.state.marginal(&observed);
    let precision = readings.covariance().inverse().ok()?;
    let residual = values - readings.mean();
    let information = h.transpose() * &precision * &h;
    let uncertainty = information.inverse().ok()?;
    let delta = &uncertainty * h.transpose() * &precision * &residual;
    let cross = law.state.covariance().select(&hidden, &observed);
    let gain = &cross * &precision;
    let state = law.state.marginal(&hidden);
    let slope = &law.slope - &gain * &h;
    let mean = state.mean() + &gain * residual + &slope * delta;
    let covariance = state.covariance() - &gain * cross.transpose() + slope.congruence(&uncertainty);
    Some((mean, covariance))
}

fn scalar(diffuse: bool, variance: i64, observed: bool) -> System<Rational> {
    let one = Matrix::<Rational>::identity(1);
    let number = |value: i64| Matrix::column(vec![ratio(value, 1)]);
    System {
        timing: Timing::Departing,
        initial: Initial {
            diffuse: diffuse.then(|| one.clone()),
            allow_indefinite: true,
            ..Initial::new(Before::Observation, number(0), number(variance))
        },
        transition: Matrix::column(vec![ratio(7, 5)]).into(),
        observation: number(i64::from(observed)).into(),
        noise: Noise::Covariances {
            process: Matrix::column(vec![ratio(1, 3)]).into(),
            cross: None,
            observation: one.into(),
        },
        input: None,
        observation_input: None,
    }
}

fn ones(count: usize) -> Vec<Observation<Rational>> {
    (0..count).map(|_| Observation::complete([ratio(1, 1)])).collect()
}

/// The series rest on semidefiniteness, so the override does not reach them.
#[test]
fn indefinite_and_diffuse_is_refused() {
    assert!(scalar(false, -1, true).realised(&ones(1)).is_ok());
    assert!(scalar(true, 1, true).realised(&ones(1)).is_ok());
    assert_eq!(scalar(true, -1, true).realised(&ones(1)), Err(ModelError::IndefiniteAndDiffuse));
}

/// What has no covariance is not conditioned at one go.
#[test]
fn one_shot_refuses_a_diffuse_start() -> Result<(), Box<dyn std::error::Error>> {
    let path = scalar(true, 0, true).realised(&ones(2))?;
    match one_shot(&path) {
        Err(FilterError { step: 0, source: ConditionError::Diffuse, .. }) => Ok(()),
        other => panic!("{other:?}"),
    }
}

/// A diffuse start that no reading resolves, and an indefinite one, stop at the limit like all others.
#[test]
fn limits_hold_on_the_recursion_too() -> Result<(), Box<dyn std::error::Error>> {
    let effort = Effort { maximal_bits: Some(16 * 64), ..Effort::default() };
    for system in [scalar(true, 0, false), scalar(false, -3, true)] {
        let path = system.realised(&ones(400))?;
        match filter_rational(&path, effort) {
            Err(RationalFilterError { step, reason: StopReason::TooLong { bits, limit: 64 }, computed }) => {
                assert!(bits > 64 && (1..100).contains(&step) && computed.len() == step, "{bits} bits at step {step}");
            }
            other => panic!("{other:?}"),
        }
    }
    Ok(())
}

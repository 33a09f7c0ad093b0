//! Chen, Kumar, van Schuppen 1989: assumptions, consequences of the Theorem, and its limits.

mod conditional_expectation;
mod errata;
mod proof;

use std::sync::{Arc, Mutex};

use exact_kalman::filter::{FilterError, filter, one_shot};
use exact_kalman::gaussian::{ConditionError, Gaussian};
use exact_kalman::matrix::{LdlError, Matrix};
use exact_kalman::model::{
    Before, Coefficient, Field, Initial, Input, ModelError, Noise, Observation, Past, Path, Place, System, Timing,
};
use exact_kalman::scalar::{Rational, Scalar, Undefined, ratio};
use exact_kalman::trace::Record;

type Q = Matrix<Rational>;

fn integers<const C: usize>(rows: &[[i64; C]]) -> Q {
    Matrix::from_integers(rows)
}

fn readings(values: &[&[i64]]) -> Vec<Observation<Rational>> {
    values.iter().map(|entries| Observation::complete(entries.iter().map(|&y| ratio(y, 1)))).collect()
}

/// CKS (1) as printed: arriving, from x̂(0), P(0).
fn system(p0: Q, a: Q, c: Q, d: Q, f: Q) -> System<Rational> {
    let n = a.rows();
    System {
        timing: Timing::Arriving,
        initial: Initial::new(Before::Transition, Matrix::zeros(n, 1), p0),
        transition: a.into(),
        observation: c.into(),
        noise: Noise::Factors { process: d.into(), observation: f.into() },
        input: None,
        observation_input: None,
    }
}

fn path(system: &System<Rational>, data: &[Observation<Rational>]) -> Path<Rational> {
    system.realised(data).unwrap_or_else(|error| panic!("a valid system: {error}"))
}

fn records(system: &System<Rational>, data: &[Observation<Rational>]) -> Vec<Record<Rational>> {
    filter(&path(system, data)).unwrap_or_else(|error| panic!("consistent data: {error}")).records
}

/// A system with two states, two sensors and noise that both share.
fn example() -> System<Rational> {
    system(
        integers(&[[2, 1], [1, 3]]),
        integers(&[[1, 1], [-1, 2]]),
        integers(&[[1, 0], [1, 1]]),
        integers(&[[1, 0, 2], [0, 1, 1]]),
        integers(&[[1, 1, 0], [0, 2, 1]]),
    )
}

/// CKS-A1, CKS-A2: covariances that no random vector has are refused, with v such that vᵀPv < 0.
#[test]
fn indefinite_covariances_are_refused_with_a_witness() {
    let joint = |cross: i64| System {
        noise: Noise::Covariances {
            process: integers(&[[4]]).into(),
            cross: Some(integers(&[[cross]]).into()),
            observation: integers(&[[1]]).into(),
        },
        ..system(integers(&[[1]]), integers(&[[1]]), integers(&[[1]]), integers(&[[0]]), integers(&[[0]]))
    };
    assert!(joint(2).realised(&readings(&[&[1]])).is_ok(), "correlation one is allowed");
    let prior = system(integers(&[[-1]]), integers(&[[1]]), integers(&[[1]]), integers(&[[0]]), integers(&[[0]]));
    for (system, field) in [(joint(3), Field::JointNoise), (prior.clone(), Field::InitialCovariance)] {
        match system.realised(&readings(&[&[1]])) {
            Err(ModelError::Indefinite { place: Place { field: found, .. }, matrix, proof }) => {
                let value = proof.witness.transpose().congruence(&matrix)[(0, 0)].clone();
                assert_eq!((found, &value), (field, &proof.value));
                assert!(value < ratio(0, 1));
            }
            other => panic!("{other:?}"),
        }
    }
    let mut allowed = prior;
    allowed.initial.allow_indefinite = true;
    assert!(allowed.realised(&readings(&[&[1]])).is_ok());
}

/// CKS-A3: a rule is shown the observations before its index, and those of its index only where the transition
/// departs from it.
#[test]
fn rules_see_the_past_only() {
    for (timing, before, seen_by_transition) in
        [(Timing::Arriving, Before::Transition, vec![0, 1, 2]), (Timing::Departing, Before::Observation, vec![1, 2, 3])]
    {
        let logs = [Arc::new(Mutex::new(Vec::new())), Arc::new(Mutex::new(Vec::new()))];
        let [transition, observation] = logs.clone().map(|log| {
            Coefficient::adapted(move |past: Past<'_, Rational>| {
                log.lock().map_err(|_| Undefined::Undecided)?.push(past.len());
                assert_eq!(past.entry(past.len(), 0), None, "the future is hidden");
                Ok(Matrix::identity(1))
            })
        });
        let one = Matrix::identity(1);
        let mut system = system(one.clone(), one.clone(), one.clone(), one.clone(), one);
        system.timing = timing;
        system.initial.before = before;
        system.transition = transition;
        system.observation = observation;
        path(&system, &readings(&[&[1], &[2], &[3]]));
        let [transition, observation] = logs.map(|log| log.lock().map(|log| log.clone()).unwrap_or_default());
        assert_eq!(transition, seen_by_transition, "{timing:?}");
        assert_eq!(observation, [0, 1, 2], "{timing:?}");
    }
}

/// CKS-A4: u = 1/y is finite almost surely, and the path on which it is not is named.
#[test]
fn infinite_coefficients_are_reported_with_their_step() {
    let one = Matrix::<Rational>::identity(1);
    let mut system = system(one.clone(), one.clone(), one.clone(), one.clone(), one);
    let reciprocal = |past: Past<'_, Rational>| match past.last_entry(0) {
        Some(y) => Ok(Matrix::column(vec![ratio(1, 1).over(y)?])),
        None => Ok(Matrix::zeros(1, 1)),
    };
    system.input = Some(Input { matrix: None, vector: Coefficient::adapted(reciprocal) });
    assert!(system.realised(&readings(&[&[2], &[-1], &[0]])).is_ok(), "y_2 = 0 is not used");
    let error = system.realised(&readings(&[&[2], &[0], &[1]]));
    let place = Place { field: Field::Input, step: Some(2) };
    assert_eq!(error, Err(ModelError::Infinite { place, source: Undefined::DivisionByZero }));
}

/// CKS-T needs finiteness only, no moments: with u = y³ and A = 1/y the recursion equals one-shot conditioning.
#[test]
fn feedback_without_moments_is_exact() {
    let mut system = example();
    let cube = |past: Past<'_, Rational>| {
        let y = past.last_entry(0).cloned().unwrap_or_else(|| ratio(0, 1));
        Ok(Matrix::column(vec![y.times(&y).times(&y), y]))
    };
    let reciprocal = |past: Past<'_, Rational>| {
        let gain = past.last_entry(1).map_or(Ok(ratio(1, 1)), |y| ratio(1, 1).over(y))?;
        Ok(Matrix::identity(2).scaled(&gain))
    };
    system.input = Some(Input { matrix: None, vector: Coefficient::adapted(cube) });
    system.transition = Coefficient::adapted(reciprocal);
    let path = path(&system, &readings(&[&[1, 2], &[-3, 5], &[2, -1], &[7, 3]]));
    let laws = one_shot(&path).unwrap_or_else(|error| panic!("{error}"));
    let trace = filter(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(trace.records.len(), 4);
    for (record, law) in trace.records.iter().zip(&laws) {
        assert_eq!(
            (&record.filtered.mean, &record.filtered.covariance),
            (law.filtered.mean(), law.filtered.covariance())
        );
    }
}

/// CKS-ARX, CKS-ARX.sum, CKS-3: recursive least squares is the batch answer, whatever feedback made the inputs.
#[test]
fn recursive_least_squares_eq_batch() {
    let y = [3, -1, 4, 1, -5, 9, 2];
    // u_k = y_k² − 2, a feedback without an excuse.
    let u: Vec<i64> = y.iter().map(|y| y * y - 2).collect();
    let regressor = |k: usize| if k == 0 { [0, 0] } else { [y[k - 1], u[k - 1]] };
    let p0 = integers(&[[3, 1], [1, 2]]);
    let theta0 = integers(&[[1], [-2]]);
    let mut system =
        system(p0.clone(), Matrix::identity(2), Matrix::zeros(1, 2), Matrix::zeros(2, 1), Matrix::identity(1));
    system.initial.mean = theta0.clone();
    system.observation = Coefficient::adapted(|past: Past<'_, Rational>| {
        let y = past.last_entry(0).cloned();
        let row = y.map_or_else(|| vec![ratio(0, 1); 2], |y| vec![y.clone(), y.times(&y).minus(&ratio(2, 1))]);
        Ok(Matrix::column(row).transpose())
    });
    let data: Vec<_> = y.iter().map(|&y| Observation::complete([ratio(y, 1)])).collect();
    let trace = records(&system, &data);
    // (P₀⁻¹ + ΦᵀΦ)⁻¹ (P₀⁻¹θ₀ + Φᵀy), summed by hand over the regressors.
    let prior = p0.inverse().unwrap_or_else(|error| panic!("{error}"));
    let (mut information, mut vector) = (prior.clone(), &prior * &theta0);
    for (k, (&y, record)) in y.iter().zip(&trace).enumerate() {
        let phi = integers(&[regressor(k)]).transpose();
        information = information + &phi * phi.transpose();
        vector = vector + phi.scaled(&ratio(y, 1));
        let covariance = information.inverse().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(record.filtered.mean, &covariance * &vector);
        assert_eq!(record.filtered.covariance, covariance);
    }
}

/// CKS-K, CKS-4: without a sensor nothing is learnt; without noise and doubt nothing is to be learnt.
#[test]
fn blind_and_certain_systems() {
    let blind = system(
        integers(&[[2, 1], [1, 3]]),
        integers(&[[1, 1], [0, 2]]),
        Matrix::zeros(1, 2),
        integers(&[[1], [1]]),
        Matrix::zeros(1, 1),
    );
    for record in records(&blind, &readings(&[&[0], &[0]])) {
        assert_eq!(record.gain, Matrix::zeros(2, 1));
        assert_eq!(record.filtered.covariance, record.predicted.covariance);
    }
    let certain =
        system(Matrix::zeros(2, 2), Matrix::identity(2), integers(&[[1, 1]]), Matrix::zeros(2, 1), integers(&[[1]]));
    for record in records(&certain, &readings(&[&[5], &[-7]])) {
        assert_eq!(record.filtered.covariance, Matrix::zeros(2, 2));
        assert_eq!(record.filtered.mean, Matrix::zeros(2, 1));
    }
}

/// CKS-11 with F = −C D: the noise cancels in y(t+1), and its covariance is C A P Aᵀ Cᵀ.
#[test]
fn noise_that_cancels() {
    let (a, c, d) = (integers(&[[1, 1], [-1, 2]]), integers(&[[1, 2]]), integers(&[[1, 0], [3, 1]]));
    let p0 = integers(&[[2, 1], [1, 3]]);
    let system = system(p0.clone(), a.clone(), c.clone(), d.clone(), -(&c * d));
    let record = &records(&system, &readings(&[&[4]]))[0];
    assert_eq!(record.innovation_covariance, (&c * a).congruence(&p0));
}

/// CKS-4, CKS-R: P does not depend on the readings if the matrices do not; an input shifts the mean alone.
#[test]
fn covariance_does_not_depend_on_data() {
    let one = records(&example(), &readings(&[&[1, 2], &[3, -4], &[0, 6]]));
    let mut shifted = example();
    shifted.input = Some(Input { matrix: None, vector: integers(&[[5], [-3]]).into() });
    let two = records(&shifted, &readings(&[&[-7, 1], &[0, 0], &[9, 9]]));
    for (one, two) in one.iter().zip(&two) {
        assert_eq!(one.filtered.covariance, two.filtered.covariance);
        assert_ne!(one.filtered.mean, two.filtered.mean);
    }
}

/// CKS-T is invariant: sensors exchanged, repeated, or mixed by a regular matrix say the same.
#[test]
fn sensors_may_be_mixed_and_repeated() {
    let data = [[1, 2], [3, -4], [0, 6]];
    let plain = records(&example(), &readings(&data.each_ref().map(<[i64; 2]>::as_slice)));
    let mixings =
        [integers(&[[0, 1], [1, 0]]), integers(&[[2, 1], [1, 1]]), integers(&[[1, 0], [0, 1], [1, 0], [3, -2]])];
    for mixing in mixings {
        let mut mixed = example();
        let mix = |coefficient: &Coefficient<Rational>| match coefficient {
            Coefficient::Constant(matrix) => (&mixing * matrix).into(),
            other => other.clone(),
        };
        mixed.observation = mix(&mixed.observation);
        if let Noise::Factors { process, observation } = &mixed.noise {
            mixed.noise = Noise::Factors { process: process.clone(), observation: mix(observation) };
        }
        let read = data.map(|y| Observation::complete((&mixing * integers(&[y]).transpose()).entries().to_vec()));
        for (plain, mixed) in plain.iter().zip(records(&mixed, &read)) {
            assert_eq!(
                (&plain.filtered.mean, &plain.filtered.covariance),
                (&mixed.filtered.mean, &mixed.filtered.covariance)
            );
            // What the gain makes of the readings is the same, however it is split over repeated sensors.
            assert_eq!(plain.gain, &mixed.gain * &mixing);
        }
    }
}

/// CKS-4: 0 ≤ P(t+1) ≤ R(t) in the Loewner order.
#[test]
fn filtered_covariance_le_predicted() {
    for record in records(&example(), &readings(&[&[1, 2], &[3, -4], &[0, 6]])) {
        assert_eq!(Matrix::zeros(2, 2).loewner_le(&record.filtered.covariance), Ok(()));
        assert_eq!(record.filtered.covariance.loewner_le(&record.predicted.covariance), Ok(()));
        assert!(matches!(
            record.predicted.covariance.loewner_le(&record.filtered.covariance),
            Err(LdlError::Indefinite(_))
        ));
    }
}

/// The Theorem holds almost surely. For data of probability zero recursion and one-shot formula would differ (0 and
/// 1/2 for x ~ N(0,1) read twice without noise as 0 and 1), so both refuse, with the direction that proves it.
#[test]
fn data_of_probability_zero_are_refused() {
    let zero = Matrix::zeros(1, 1);
    let one = Matrix::identity(1);
    let constant = system(one.clone(), one.clone(), one, zero.clone(), zero);
    let path = path(&constant, &readings(&[&[0], &[1]]));
    match filter(&path) {
        Err(FilterError { step: 1, source: ConditionError::Inconsistent(proof), computed }) => {
            assert_eq!(computed.len(), 1);
            assert_eq!((proof.direction, proof.value), (integers(&[[1]]), ratio(1, 1)));
        }
        other => panic!("{other:?}"),
    }
    match one_shot(&path) {
        Err(FilterError { step: 1, source: ConditionError::Inconsistent(proof), .. }) => {
            let twice = integers(&[[1, 1], [1, 1]]);
            assert_eq!(twice * &proof.direction, Matrix::zeros(2, 1));
            assert_ne!(proof.value, ratio(0, 1));
        }
        other => panic!("{other:?}"),
    }
}

/// CKS-L3.function: the conditional law of X has the mean E(X | Z, Y) and the covariance of W = X − E(X|Z) − K(Y − E(Y|Z)), which is
/// an affine image of (X, Y), has the mean 0, and shares nothing with Y; P_yy is singular.
#[test]
fn the_conditional_law_is_that_of_the_residual_moved() {
    let covariance = integers(&[[3, 1, 1], [1, 2, 2], [1, 2, 2]]);
    let joint = Gaussian::new(integers(&[[5], [1], [1]]), covariance).unwrap_or_else(|error| panic!("{error}"));
    let given = joint.conditioned(&[1, 2], &integers(&[[4], [4]])).unwrap_or_else(|error| panic!("{error}"));
    // P_yy⁺ = [[1, 1], [1, 1]]/8, so K = (1/4, 1/4).
    let gain = Matrix::column(vec![ratio(1, 4); 2]).transpose();
    let residual = Matrix::identity(1).beside(&-&gain);
    let centred = &residual * joint.mean();
    let with_readings = residual.above(&Matrix::zeros(2, 1).beside(&Matrix::identity(2)));
    let law = joint.affine(&with_readings, &(-centred).above(&Matrix::zeros(2, 1)));
    assert!(law.are_independent(&[0], &[1, 2]));
    assert_eq!(law.marginal(&[0]).mean(), &Matrix::zeros(1, 1));
    assert_eq!(law.marginal(&[0]).covariance(), given.law.covariance());
    let lambda = integers(&[[3]]);
    let moved = law.marginal(&[0]).characteristic_exponent(&lambda);
    let exponent = given.law.characteristic_exponent(&lambda);
    // E(X | Y) = 5 + ¼·3 + ¼·3
    assert_eq!((exponent.linear, exponent.quadratic), (moved.linear + ratio(3 * 13, 2), moved.quadratic));
}

/// CKS-2: the exponent of the characteristic function holds the mean and the covariance.
#[test]
fn characteristic_exponent_holds_the_moments() {
    let law =
        Gaussian::new(integers(&[[1], [-2]]), integers(&[[2, 1], [1, 3]])).unwrap_or_else(|error| panic!("{error}"));
    // λ = (3, 5): λᵀm = 3 − 10, λᵀPλ = 9·2 + 2·15·1 + 25·3.
    let exponent = law.characteristic_exponent(&integers(&[[3], [5]]));
    assert_eq!((exponent.linear, exponent.quadratic), (ratio(-7, 1), ratio(123, 1)));
}

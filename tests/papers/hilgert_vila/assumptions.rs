//! The system, its conditions, and what happens without them.

use exact_kalman::filter::predict_ahead;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Coefficient, Field, Input, ModelError, Past, Place};
use exact_kalman::scalar::{Rational, Scalar, Undefined, ratio};

use super::{At, Q, expectation, integers, number, observations, predicted, realised, system, varying};

/// HV-1a, HV-1b: simulated as printed, with all coefficients varying. x(1) is known and F is regular, so y(k) tells w(k), and
/// what is predicted must be the state itself: A(k), B(k)u(k), D(k) act at k, C(k−1), G(k−1)v(k−1), F(k−1) on y(k).
///
/// HV-1b has no equation for k = 0: y(0) is what the initial law is given.
#[test]
fn what_is_simulated_is_predicted() {
    let at = |k: i64| At { f: integers(&[[1, k], [0, 2]]), d: integers(&[[1, k], [k, 1]]), ..super::at(k) };
    let mut known = varying(3, 1);
    let list = |entry: &dyn Fn(At) -> Q| Coefficient::per_step((1..=3).map(|k| entry(at(k))));
    known.noise = exact_kalman::model::Noise::Factors { process: list(&|at| at.d), observation: list(&|at| at.f) };
    known.initial.covariance = Matrix::zeros(2, 2);
    let mut state = known.initial.mean.clone();
    let (mut readings, mut states) = (Vec::new(), Vec::new());
    for (k, w) in (1..).zip([integers(&[[1], [-1]]), integers(&[[0], [2]]), integers(&[[-3], [1]])]) {
        let At { a, b_u, d, c, g_v, f } = at(k);
        readings.push(&c * &state + g_v + f * &w);
        state = a * &state + b_u + d * w;
        states.push(state.clone());
    }
    let trace = predicted(&known, &readings, 1);
    for (step, state) in trace.steps.iter().zip(&states) {
        assert_eq!(&step.ahead[0].mean, state);
        assert!(step.ahead[0].covariance.is_zero());
    }
    assert_eq!((trace.start.len(), trace.steps.len()), (1, 3));
    assert_eq!(trace.start[0].mean, known.initial.mean, "x(1) given y(0)");
}

/// HV-C1: p ≤ s is used nowhere. Two sensors on one state of variance 1, each with noise of variance 1: by hand the mean is
/// (y₁ + y₂)/3 and the variance 1/3, doubled by A = 2 and spread by D.
#[test]
fn more_sensors_than_states() {
    let pair = system(
        Matrix::identity(1),
        integers(&[[2]]),
        integers(&[[1], [1]]),
        integers(&[[0, 0, 5]]),
        integers(&[[1, 0, 0], [0, 1, 0]]),
    );
    let ahead = &predicted(&pair, &[integers(&[[4], [-1]])], 1).steps[0].ahead[0];
    assert_eq!(
        (ahead.mean[(0, 0)].clone(), ahead.covariance[(0, 0)].clone()),
        (ratio(2, 1), ratio(4, 3) + ratio(25, 1))
    );
}

/// HV-C3: without normality the recursion is still the best affine predictor, no longer the conditional mean. x(2) = w₁ and
/// y(1) = w₁ + 2w₂, where each w is ±2 with probability 1/8 and else 0: mean 0 and variance 1, as assumed.
#[test]
fn without_normality_the_predictor_is_affine_only() {
    let one = [(ratio(1, 8), -2), (ratio(3, 4), 0), (ratio(1, 8), 2)];
    let law: Vec<(Rational, [i64; 2])> =
        one.iter().flat_map(|(p, w)| one.iter().map(move |(q, v)| (p * q, [*w, *v]))).collect();
    let mean =
        |f: &dyn Fn(Rational, Rational) -> Rational| expectation(&law, |[w, v]| f(ratio(*w, 1), ratio(w + 2 * v, 1)));
    assert_eq!([mean(&|x, _| x.clone()), mean(&|x, _| &x * &x)], [ratio(0, 1), ratio(1, 1)]);
    let sensor =
        system(Matrix::zeros(1, 1), Matrix::zeros(1, 1), Matrix::zeros(1, 1), integers(&[[1, 0]]), integers(&[[1, 2]]));
    let predictor = |y: &Rational| predicted(&sensor, &[number(y.clone())], 1).steps[0].ahead[0].mean[(0, 0)].clone();
    // Best affine: the error is uncorrelated with 1 and y, and its variance is what the recursion says.
    assert_eq!(mean(&|x, y| x - predictor(&y)), ratio(0, 1));
    assert_eq!(mean(&|x, y| (x - predictor(&y)) * y), ratio(0, 1));
    let variance = predicted(&sensor, &[integers(&[[0]])], 1).steps[0].ahead[0].covariance[(0, 0)].clone();
    assert_eq!(mean(&|x, y| (&x - predictor(&y)).pow(2)), variance);
    // The conditional mean, by Bayes on the finite law, is another function, and better.
    let conditional = |y: &Rational| {
        let here = |x: &dyn Fn(Rational) -> Rational| mean(&|w, v| if v == *y { x(w) } else { ratio(0, 1) });
        here(&|x| x) / here(&|_| ratio(1, 1))
    };
    assert_eq!((predictor(&ratio(2, 1)), conditional(&ratio(2, 1))), (ratio(2, 5), ratio(10, 7)));
    assert!(mean(&|x, y| (&x - conditional(&y)).pow(2)) < variance);
}

/// HV-C4a: x(1) = w(1) with C = 1, F = −1 gives y(1) = 0 for certain, where the recursion, which takes them as independent, has
/// the variance 2.
#[test]
fn a_start_that_depends_on_the_noise() {
    let one: Q = Matrix::identity(1);
    let dependent = system(one.clone(), one.clone(), one.clone(), one.clone(), integers(&[[-1]]));
    let record = &predicted(&dependent, &[integers(&[[0]])], 1).steps[0].record;
    // (x(1), w(1)) = (1, 1)ᵀ z, so that y(1) = [1, −1] (1, 1)ᵀ z.
    let truth = (integers(&[[1, -1]]) * integers(&[[1], [1]])).congruence(&one);
    assert_eq!((truth, &record.innovation_covariance), (integers(&[[0]]), &integers(&[[2]])));
}

/// HV-C4b: a P(1|0) that is not positive semidefinite is refused with v such that vᵀPv < 0. The paper's own start is one:
/// HV-P1.SKP. And a law of x(1) that is not Gaussian leaves no conditional mean: x(1) = ±1, y(1) = x(1) + w(1).
#[test]
fn the_start_is_a_gaussian_law() {
    let indefinite = system(
        integers(&[[80, 500], [500, 80]]),
        Matrix::identity(2),
        integers(&[[0, 1]]),
        Matrix::zeros(2, 1),
        Matrix::zeros(1, 1),
    );
    match indefinite.realised(&observations(&[integers(&[[30]])])) {
        Err(ModelError::Indefinite { place: Place { field: Field::InitialCovariance, .. }, matrix, proof }) => {
            assert_eq!(proof.witness.transpose().congruence(&matrix)[(0, 0)], proof.value);
            assert!(proof.value < ratio(0, 1));
        }
        other => panic!("{other:?}"),
    }
    // Two points for x(1) and, exactly, for w(1): y = 0 says nothing and y = 2 says all; the predictor is y/2 with error 1/2.
    let one: Q = Matrix::identity(1);
    let sum = system(one.clone(), one.clone(), one.clone(), Matrix::zeros(1, 1), one);
    let ahead = &predicted(&sum, &[integers(&[[2]])], 1).steps[0].ahead[0];
    assert_eq!((ahead.mean[(0, 0)].clone(), ahead.covariance[(0, 0)].clone()), (ratio(1, 1), ratio(1, 2)));
    let signs: Vec<(Rational, (i64, i64))> =
        [(1, 1), (1, -1), (-1, 1), (-1, -1)].map(|pair| (ratio(1, 4), pair)).to_vec();
    let on_two =
        |f: &dyn Fn(i64) -> i64| expectation(&signs, |(x, w)| if x + w == 2 { ratio(f(*x), 1) } else { ratio(0, 1) });
    assert_eq!(on_two(&|x| (x - 1) * (x - 1)) / on_two(&|_| 1), ratio(0, 1), "the true variance given y = 2");
}

/// Erratum HV-C6: G belongs to the list. v = 1 and G(k) = 1/y(1), while C = 0 and F = 0 make y(1) = 0 for certain: each of the
/// printed coefficients is finite, and y(k+1) is not; with G in the list the system is refused, and named.
#[test]
fn the_matrix_of_the_observed_input_is_finite_too() {
    let (zero, one): (Q, Q) = (Matrix::zeros(1, 1), Matrix::identity(1));
    let mut silent = system(one.clone(), one.clone(), zero.clone(), one.clone(), zero);
    let reciprocal = |past: Past<'_, Rational>| match past.entry(0, 0) {
        Some(y) => Ok(number(ratio(1, 1).over(y)?)),
        None => Ok(Matrix::zeros(1, 1)),
    };
    let v = || Coefficient::from(Matrix::<Rational>::identity(1));
    silent.observation_input = Some(Input { matrix: Some(Coefficient::adapted(reciprocal)), vector: v() });
    let readings = observations(&[integers(&[[0]]), integers(&[[0]])]);
    // Right: a list that names G does not hold on this path, and no other path has a positive probability.
    let place = Place { field: Field::ObservationInputMatrix, step: Some(1) };
    assert_eq!(silent.realised(&readings), Err(ModelError::Infinite { place, source: Undefined::DivisionByZero }));
    // Printed: the list without G holds, as it does for the same system with a finite G.
    silent.observation_input = Some(Input { matrix: Some(one.into()), vector: v() });
    assert!(silent.realised(&readings).is_ok());
}

/// HV-C6 asks for no moment: with u = y³, A = 1/y and data on which they are finite the predictor is exact (HV-T1).
#[test]
fn coefficients_need_no_moments() {
    let mut wild = varying(3, 2);
    let cube = |past: Past<'_, Rational>| {
        let y = past.last_entry(0).cloned().unwrap_or_else(|| ratio(0, 1));
        Ok(Matrix::column(vec![y.pow(3), y]))
    };
    let reciprocal = |past: Past<'_, Rational>| {
        let gain = past.last_entry(1).map_or(Ok(ratio(1, 1)), |y| ratio(1, 1).over(y))?;
        Ok(Matrix::identity(2).scaled(&gain))
    };
    wild.input = Some(Input { matrix: None, vector: Coefficient::adapted(cube) });
    wild.transition = Coefficient::adapted(reciprocal);
    let readings = [integers(&[[1], [2]]), integers(&[[-3], [5]]), integers(&[[2], [-1]])];
    let path = realised(&wild, &readings, 2);
    let trace = predict_ahead(&path).expect("consistent data");
    let laws = exact_kalman::filter::one_shot_ahead(&path).expect("consistent data");
    for (step, laws) in trace.steps.iter().zip(&laws[1..]) {
        let moments = step.ahead.iter().map(|law| (&law.mean, &law.covariance));
        assert!(moments.eq(laws.iter().map(|law| (law.mean(), law.covariance()))));
        assert_eq!(step.ahead.len(), 2);
    }
}

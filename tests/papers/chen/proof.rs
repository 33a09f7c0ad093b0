//! The lines of the paper's proof.

use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::Input;
use exact_kalman::scalar::{Rational, ratio};

use super::{Q, example, integers, readings, records};

/// CKS-5, CKS-6, CKS-7, CKS-9, CKS-10, CKS-11, CKS-12: the lines of the proof, each from the law of the step before.
#[test]
fn every_line_of_the_proof() {
    let (a, c) = (integers(&[[1, 1], [-1, 2]]), integers(&[[1, 0], [1, 1]]));
    let (d, f) = (integers(&[[1, 0, 2], [0, 1, 1]]), integers(&[[1, 1, 0], [0, 2, 1]]));
    let data = [[1, 2], [3, -4], [0, 6]];
    let mut system = example();
    system.observation_input = Some(Input { matrix: None, vector: integers(&[[2], [-1]]).into() });
    let (mut mean, mut p) = (Matrix::zeros(2, 1), integers(&[[2, 1], [1, 3]]));
    for (record, y) in records(&system, &readings(&data.each_ref().map(<[i64; 2]>::as_slice))).iter().zip(data) {
        let total = &f + &c * &d;
        let cross = &a * &p * a.transpose() * c.transpose() + &d * total.transpose();
        let innovation_covariance = (&c * &a).congruence(&p) + &total * total.transpose();
        let expected_reading = &c * (&a * &mean) + integers(&[[2], [-1]]);
        let innovation = integers(&[y]).transpose() - &expected_reading;
        assert_eq!(record.predicted_observation, expected_reading);
        assert_eq!(record.innovation, innovation);
        assert_eq!(record.cross_covariance, cross);
        assert_eq!(record.innovation_covariance, innovation_covariance);
        // S is regular here, so its inverse is all that is needed.
        let inverse = innovation_covariance.inverse().unwrap_or_else(|error| panic!("{error}"));
        mean = &a * &mean + &cross * &inverse * innovation;
        p = a.congruence(&p) + &d * d.transpose() - &cross * inverse * cross.transpose();
        assert_eq!((&record.filtered.mean, &record.filtered.covariance), (&mean, &p));
    }
}

/// The matrices of [`example`]: A, C, D, F, P(0).
fn matrices() -> [Q; 5] {
    [
        integers(&[[1, 1], [-1, 2]]),
        integers(&[[1, 0], [1, 1]]),
        integers(&[[1, 0, 2], [0, 1, 1]]),
        integers(&[[1, 1, 0], [0, 2, 1]]),
        integers(&[[2, 1], [1, 3]]),
    ]
}

/// The law of (x(0), w(1)): the start and, independent of it, the noise.
fn start() -> Gaussian<Rational> {
    let [.., p0] = matrices();
    let x0 = Gaussian::new(integers(&[[3], [-1]]), p0).unwrap_or_else(|error| panic!("{error}"));
    x0.joined(&Gaussian::standard(3))
}

/// CKS-T.start: the exponent of the pair is the sum of the two exponents, λ = (2, 5) and μ = (1, −3, 4).
#[test]
fn start_and_noise_are_jointly_gaussian() {
    let exponent = start().characteristic_exponent(&integers(&[[2], [5], [1], [-3], [4]]));
    // λᵀx̂(0) = 6 − 5; λᵀP(0)λ = 4·2 + 2·10·1 + 25·3; μᵀμ = 1 + 9 + 16.
    assert_eq!((exponent.linear, exponent.quadratic), (ratio(1, 1), ratio(103 + 26, 1)));
}

/// CKS-T.stack: the law of (x(1), y(1)) is that of the stacked matrices applied to (x(0), w(1)), and it
/// holds the predictions, R, P_xy and P_yy of the filter.
#[test]
fn state_and_observation_are_an_affine_image() {
    let [a, c, d, f, p0] = matrices();
    let stacked = a.beside(&d).above(&(&c * &a).beside(&(&c * &d + &f)));
    let pair = start().affine(&stacked, &Matrix::zeros(4, 1));
    let mut system = example();
    system.initial.mean = integers(&[[3], [-1]]);
    assert_eq!(system.initial.covariance, p0);
    let record = &records(&system, &readings(&[&[1, 2]]))[0];
    let (covariance, states, sensors) = (pair.covariance(), [0, 1], [2, 3]);
    assert_eq!(record.predicted.mean, pair.marginal(&states).into_parts().0);
    assert_eq!(record.predicted_observation, pair.marginal(&sensors).into_parts().0);
    assert_eq!(record.predicted.covariance, covariance.select(&states, &states));
    assert_eq!(record.cross_covariance, covariance.select(&states, &sensors));
    assert_eq!(record.innovation_covariance, covariance.select(&sensors, &sensors));
}

/// CKS-6, CKS-7, CKS-10.cross, CKS-T.step: for t = 0, 1, 2 the joint law of x(t), w(t+1), x(t+1) and y(1), …, y(t+1) as an affine
/// image of x(0), w(1), …, w(3), conditioned on y(1), …, y(t) alone: x(t) and w(t+1) share nothing, w(t+1) is still N(0, I), and
/// the covariances of x(t+1) and y(t+1) are those of the filter.
#[test]
fn expectations_from_the_law_of_all_sources() {
    let [a, c, d, f, p0] = matrices();
    let data = [[1, 2], [3, -4], [0, 6]];
    let trace = records(&example(), &readings(&data.each_ref().map(<[i64; 2]>::as_slice)));
    let start = Gaussian::new(Matrix::zeros(2, 1), p0).unwrap_or_else(|error| panic!("{error}"));
    let sources = start.joined(&Gaussian::standard(9));
    // Each vector as a matrix applied to the eleven sources.
    let noise = |t: usize| Matrix::from_fn(3, 11, |i, j| ratio(i64::from(j == 2 + 3 * t + i), 1));
    let mut state = Matrix::identity(2).beside(&Matrix::zeros(2, 9));
    let (mut read, mut values) = (Matrix::zeros(0, 11), Matrix::zeros(0, 1));
    for (t, (record, y)) in trace.iter().zip(data).enumerate() {
        let next = &a * &state + &d * noise(t);
        let reading = &c * &next + &f * noise(t);
        let all = state.above(&noise(t)).above(&next).above(&reading).above(&read);
        let joint = sources.affine(&all, &Matrix::zeros(all.rows(), 1));
        let observed: Vec<usize> = (9..9 + read.rows()).collect();
        let law = joint.conditioned(&observed, &values).unwrap_or_else(|error| panic!("{error}")).law;
        let (x, w, x_next, y_next) = ([0, 1], [2, 3, 4], [5, 6], [7, 8]);
        assert!(law.are_independent(&x, &w), "t = {t}");
        assert_eq!(law.marginal(&w), Gaussian::standard(3));
        let covariance = law.covariance();
        assert_eq!(covariance.select(&x_next, &y_next), record.cross_covariance);
        assert_eq!(covariance.select(&y_next, &y_next), record.innovation_covariance);
        read = read.above(&reading);
        values = values.above(&integers(&[y]).transpose());
        state = next;
    }
}

/// CKS-10.cross: with x(0) = w(1), a start that depends on the noise, the term is D AᵀCᵀ and not 0.
#[test]
fn a_dependent_start_leaves_a_cross_term() {
    let (a, c, d) = (integers(&[[2]]), integers(&[[3]]), integers(&[[5]]));
    // (x(0), w(1)) = (w, w)
    let dependent = Gaussian::<Rational>::standard(1).affine(&integers(&[[1], [1]]), &Matrix::zeros(2, 1));
    let image = (&c * &a).block_diagonal(&d);
    let term = dependent.affine(&image, &Matrix::zeros(2, 1)).covariance()[(1, 0)].clone();
    assert_eq!(term, (d * a.transpose() * c.transpose())[(0, 0)]);
    assert_ne!(term, ratio(0, 1));
}

/// CKS-10.form, CKS-11, CKS-K: both forms of P_xy and of P_yy.
#[test]
fn two_forms_of_the_covariances() {
    let [a, c, d, f, p] = matrices();
    let r = a.congruence(&p) + &d * d.transpose();
    let total = &f + &c * &d;
    let cross = &a * &p * a.transpose() * c.transpose() + &d * total.transpose();
    assert_eq!(cross, &r * c.transpose() + &d * f.transpose());
    let mixed = &c * &d * f.transpose();
    let bracket = c.congruence(&r) + &f * f.transpose() + &mixed + mixed.transpose();
    assert_eq!((&c * &a).congruence(&p) + &total * total.transpose(), bracket);
}

//! What the paper prints beside what is right: each test computes both.

use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Coefficient, Field, Input, ModelError, Past, Place};
use exact_kalman::scalar::{Rational, Scalar, Undefined, ratio};

use super::{Q, integers, readings, records, system};

fn law(mean: Q, covariance: Q) -> Gaussian<Rational> {
    Gaussian::new(mean, covariance).unwrap_or_else(|error| panic!("{error}"))
}

/// Erratum CKS-A2: with A = C = 1, D = 0, F = −1 the variance of y(1) is 2 for an independent start and 0 for
/// x(0) = w(1), each by summing over signs; the filter says 2.
#[test]
fn the_start_is_independent_of_the_noise() {
    let (one, zero) = (Matrix::identity(1), Matrix::zeros(1, 1));
    let system = system(one.clone(), one.clone(), one, zero, integers(&[[-1]]));
    let filtered = records(&system, &readings(&[&[0]]))[0].innovation_covariance[(0, 0)].clone();
    let variance = |pairs: &[(i64, i64)]| {
        // y(1) = x(0) − w(1), of mean zero.
        let squares = pairs.iter().map(|(x, w)| (x - w) * (x - w)).sum::<i64>();
        ratio(squares, i64::try_from(pairs.len()).unwrap_or(1))
    };
    assert_eq!(filtered, variance(&[(1, 1), (1, -1), (-1, 1), (-1, -1)]));
    assert_ne!(filtered, variance(&[(1, 1), (-1, -1)]));
    assert_eq!(variance(&[(1, 1), (-1, -1)]), ratio(0, 1));
}

/// Erratum CKS-A4: C = F = 0 make y(1) = 0 for certain. Everything on the printed list is finite, and the system is accepted;
/// with G(1) = 1/y(1) it is refused, as y(2) has no value on any path.
#[test]
fn the_matrix_of_the_observation_input_must_be_finite() {
    let (one, zero) = (Matrix::<Rational>::identity(1), Matrix::zeros(1, 1));
    let mut system = system(one.clone(), one.clone(), zero.clone(), one.clone(), zero);
    let certain = readings(&[&[0], &[0]]);
    for record in records(&system, &certain) {
        assert_eq!((&record.predicted_observation[(0, 0)], record.innovation_rank), (&ratio(0, 1), 0), "y is certain");
    }
    let reciprocal = |past: Past<'_, Rational>| match past.last_entry(0) {
        Some(y) => Ok(Matrix::column(vec![ratio(1, 1).over(y)?])),
        None => Ok(Matrix::zeros(1, 1)),
    };
    system.observation_input = Some(Input { matrix: Some(Coefficient::adapted(reciprocal)), vector: one.into() });
    let place = Place { field: Field::ObservationInputMatrix, step: Some(1) };
    let error = system.realised(&certain);
    assert_eq!(error, Err(ModelError::Infinite { place, source: Undefined::DivisionByZero }));
}

/// Erratum CKS-L1.mean: X = 1 for certain, as the conditional law of a state that was read without noise; its mean is
/// the integral of x, 1, and not that of x⁻, 0.
#[test]
fn the_mean_is_no_integral_of_the_negative_part() {
    let joint = law(Matrix::zeros(2, 1), integers(&[[1, 1], [1, 1]]));
    let given = joint.conditioned(&[1], &integers(&[[1]])).unwrap_or_else(|error| panic!("{error}")).law;
    assert_eq!(given.covariance(), &Matrix::zeros(1, 1));
    // One atom of probability one.
    let atom = 1_i64;
    let (right, printed) = (atom, (-atom).max(0));
    assert_eq!(given.mean(), &integers(&[[right]]));
    assert_ne!(given.mean(), &integers(&[[printed]]));
}

/// Erratum CKS-L3i: X = Y ~ N(0, 1), Y = 5. With P_yy|z the mean is 5; with P_yy|x, which is 0, it stays 0.
#[test]
fn what_is_inverted_is_conditioned_on_z() {
    let joint = law(Matrix::zeros(2, 1), integers(&[[1, 1], [1, 1]]));
    let given = |observed: usize, value: i64| {
        joint.conditioned(&[observed], &integers(&[[value]])).unwrap_or_else(|error| panic!("{error}"))
    };
    let right = given(1, 5);
    assert_eq!(right.law.mean(), &integers(&[[5]]));
    let of_y_given_x = given(0, 7).law.covariance().clone();
    let inverse = of_y_given_x.pseudo_inverse().unwrap_or_else(|error| panic!("{error}"));
    let printed = &right.cross_covariance * inverse * &right.innovation;
    assert_ne!(&printed, right.law.mean());
    assert_eq!(printed, Matrix::zeros(1, 1));
}

/// CKS-L3ii: given Z = ±1, W ~ N(0, s) and Y ~ N(Z, 1) are independent, s = 1 or 4; unconditionally they are not:
/// E[W²Y] = −3/2, E[W²]E[Y] = 0.
#[test]
fn the_residual_is_independent_given_z_only() {
    let half = ratio(1, 2);
    let (mut product, mut square, mut mean) = (ratio(0, 1), ratio(0, 1), ratio(0, 1));
    for (z, s) in [(1, 1), (-1, 4)] {
        // (X, Y) given Z: X has no covariance with Y, so W = X − E(X | Z, Y) = X.
        let joint = law(integers(&[[0], [z]]), integers(&[[s, 0], [0, 1]]));
        let given = joint.conditioned(&[1], &integers(&[[9]])).unwrap_or_else(|error| panic!("{error}"));
        assert!(joint.are_independent(&[0], &[1]));
        assert_eq!((given.law.mean()[(0, 0)].clone(), given.law.covariance()), (ratio(0, 1), &integers(&[[s]])));
        product += &half * ratio(s * z, 1);
        square += &half * ratio(s, 1);
        mean += &half * ratio(z, 1);
    }
    assert_eq!(product, ratio(-3, 2));
    assert_ne!(product, square * mean);
}

/// Erratum CKS-T.start: A = C = D = 1, F = −1, x(0) = 0 and w = ±1. The printed pair (x(0), y(1)) is constant, hence
/// Gaussian; (x(1), y(1)) is not: the fourth moment of x(1) is 1, that of N(0, 1) is 3.
#[test]
fn the_noise_must_be_in_the_pair() {
    let (a, c, d, f, x0) = (1, 1, 1, -1, 0);
    let outcomes = [1, -1].map(|w: i64| {
        let x1 = a * x0 + d * w;
        (x1, c * x1 + f * w)
    });
    assert_eq!(outcomes.map(|(_, y1)| (x0, y1)), [(0, 0), (0, 0)]);
    let moment = |power: u32| ratio(outcomes.iter().map(|(x1, _)| x1.pow(power)).sum::<i64>(), 2);
    assert_eq!((moment(1), moment(2)), (ratio(0, 1), ratio(1, 1)));
    let gaussian_fourth = ratio(3, 1) * moment(2) * moment(2);
    assert_ne!(moment(4), gaussian_fourth);
}

/// Erratum CKS-11: C = D = 1, F = 0, P = 0: the innovation has the variance 1; (F + CD)(F + C + CD) is 2.
#[test]
fn the_innovation_covariance_has_no_third_term() {
    let (one, zero) = (Matrix::identity(1), Matrix::zeros(1, 1));
    let system = system(zero.clone(), one.clone(), one.clone(), one.clone(), zero.clone());
    let total = &zero + &one * &one;
    let (right, printed) = (&total * total.transpose(), &total * (&zero + &one + &one * &one).transpose());
    let found = &records(&system, &readings(&[&[3]]))[0].innovation_covariance;
    assert_eq!(found, &right);
    assert_ne!(found, &printed);
    assert_eq!(printed, integers(&[[2]]));
}

/// Erratum CKS-12: P_xy = [[0, 1], [0, 0]], P_yy = I. The first state becomes certain; with P_xy for the last factor it
/// would keep its variance.
#[test]
fn the_last_factor_is_transposed() {
    let cross = integers(&[[0, 1], [0, 0]]);
    let identity = Matrix::<Rational>::identity(2);
    let covariance = identity.beside(&cross).above(&cross.transpose().beside(&identity));
    let joint = law(Matrix::zeros(4, 1), covariance);
    let given = joint.conditioned(&[2, 3], &Matrix::zeros(2, 1)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(given.law.covariance(), &(&identity - &cross * cross.transpose()));
    assert_eq!(given.law.covariance(), &integers(&[[0, 0], [0, 1]]));
    assert_ne!(given.law.covariance(), &(&identity - &cross * &cross));
}

/// Erratum CKS-ARX: θ ~ N(0, 1), y(0) = θ and y(1) = y(0)θ + w(1). Given y(0) = 2, y(1) = 3 θ is 2 (one-shot, from the
/// moments of y(0) and, given it, of y(1)); the filter that starts from N(0, 1) says 6/5.
#[test]
fn first_readings_may_tell_about_the_parameter() {
    let (y0, y1) = (2, 3);
    let (one, zero) = (Matrix::identity(1), Matrix::zeros(1, 1));
    let regression = |p0: Q, mean: Q| {
        let mut system = system(p0, one.clone(), integers(&[[y0]]), zero.clone(), one.clone());
        system.initial.mean = mean;
        records(&system, &readings(&[&[y1]]))[0].filtered.mean.clone()
    };
    // θ given y(0): the joint law of (θ, y(0)) has all covariances 1.
    let joint = law(Matrix::zeros(2, 1), integers(&[[1, 1], [1, 1]]));
    let start = joint.conditioned(&[1], &integers(&[[y0]])).unwrap_or_else(|error| panic!("{error}")).law;
    let right = regression(start.covariance().clone(), start.mean().clone());
    let printed = regression(one.clone(), zero.clone());
    assert_eq!((right.clone(), printed.clone()), (integers(&[[2]]), Matrix::column(vec![ratio(6, 5)])));
    assert_ne!(right, printed);
}

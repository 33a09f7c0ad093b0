//! The conditionally Gaussian situation: definitions and lemmas.

use exact_kalman::filter::filter;
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::{FullRank, LdlError, Matrix};
use exact_kalman::scalar::{Rational, Scalar, ratio};

use super::quadrature::expected;
use super::{Q, expectation, integers, law, number, realised, system};

/// The moments E Xⁿ of N(m, v), n = 0, …, 8, by m Xⁿ⁻¹ + (n − 1) v Xⁿ⁻² (Stein): the power series of exp(iλm − ½λ²v).
fn moments(m: &Rational, v: &Rational) -> Vec<Rational> {
    let mut moments = vec![ratio(1, 1), m.clone()];
    for n in 2..=8 {
        let next = m * &moments[n - 1] + ratio(i64::try_from(n).expect("small") - 1, 1) * v * &moments[n - 2];
        moments.push(next);
    }
    moments
}

/// HV-D1: a law without a mean that has a conditional one. x = ±2ⁿ with probability 2⁻ⁿ⁻², n ≥ 0, and 𝒢 = σ(|x|): both
/// terms are finite given |x| and cancel, while the mean of either alone is a sum of quarters without end.
#[test]
fn a_conditional_expectation_without_an_integrable_variable() {
    let (mut positive, mut probability) = (ratio(0, 1), ratio(0, 1));
    for n in 0..30 {
        let (value, p) = (ratio(1 << n, 1), ratio(1, 1 << (n + 2)));
        let [up, down] = [1, -1].map(|sign| {
            let part = |x: &Rational| if *x > ratio(0, 1) { x.clone() } else { ratio(0, 1) };
            let given: Vec<(Rational, Rational)> =
                [1, -1].map(|side| (ratio(1, 2), &value * ratio(side * sign, 1))).to_vec();
            expectation(&given, part)
        });
        // E(max(x, 0) | |x|) − E(max(−x, 0) | |x|)
        assert_eq!(&up - &down, ratio(0, 1));
        assert_eq!(up, &value / ratio(2, 1));
        positive += &p * &value;
        probability += ratio(2, 1) * p;
        assert_eq!(positive, ratio(n + 1, 4));
    }
    assert!(probability < ratio(1, 1));
}

/// HV-D2, HV-L1: the exponent of a law holds its moments. X̂ is its linear part, P its quadratic part, and every E(λᵀX)ⁿ is what
/// the series of exp(iλᵀX̂ − ½ λᵀPλ) says, compared with expectations over standard sources. For X given Z with Z = ±1
/// and variance 1 or 4 each is Gaussian, and X itself is not.
#[test]
fn the_exponent_holds_every_moment() {
    let (mean, factor) = (integers(&[[1], [-2]]), integers(&[[1, 0], [2, 1]]));
    let x = Gaussian::standard(2).affine(&factor, &mean);
    let axis = |i: usize| Matrix::from_fn(2, 1, |j, _| ratio(i64::from(i == j), 1));
    for i in 0..2 {
        assert_eq!(x.characteristic_exponent(&axis(i)).linear, mean[(i, 0)]);
        for j in 0..2 {
            let form = |v: &Q| x.characteristic_exponent(v).quadratic;
            let mixed = form(&(axis(i) + axis(j))) - form(&axis(i)) - form(&axis(j));
            assert_eq!(mixed / ratio(2, 1), x.covariance()[(i, j)]);
            // HV-L1, over the sources.
            let second = expected(2, 2, |z| {
                let error = &factor * Matrix::column(z.to_vec());
                vec![&error[(i, 0)] * &error[(j, 0)]]
            });
            assert_eq!(second, [x.covariance()[(i, j)].clone()]);
        }
    }
    let lambda = integers(&[[3], [-1]]);
    let exponent = x.characteristic_exponent(&lambda);
    let found = expected(2, 4, |z| {
        let value = (lambda.transpose() * (&factor * Matrix::column(z.to_vec()) + &mean))[(0, 0)].clone();
        (0..=8).map(|n| value.pow(n)).collect()
    });
    assert_eq!(found, moments(&exponent.linear, &exponent.quadratic));
    assert_eq!(x.definiteness(), Ok(()));
    let given = [1, 4].map(|v| moments(&ratio(0, 1), &ratio(v, 1)));
    let mixed: Vec<Rational> = (0..=8).map(|n| (&given[0][n] + &given[1][n]) / ratio(2, 1)).collect();
    assert_eq!((&mixed[2], &mixed[4]), (&ratio(5, 2), &ratio(51, 2)));
    assert_ne!(mixed, moments(&mixed[1], &mixed[2]));
}

/// HV-L2i: A(Z)X + b(Z). B is the matrix of an input elsewhere; with an input of two components and one state the right
/// form gives the Gaussian of the stacked equations, the printed one a sum of a 1×1 and a 1×2 matrix.
///
/// HV-L2i fails where A depends on X: A = X makes X², whose third central moment is 8 and not 0.
#[test]
fn an_affine_image_is_gaussian() {
    let (a, input_matrix, u) = (integers(&[[3]]), integers(&[[1, 4]]), integers(&[[2], [-1]]));
    let x = law(&integers(&[[5]]), &integers(&[[2]]));
    let right = &input_matrix * &u;
    let image = x.affine(&a, &right);
    let exponent = image.characteristic_exponent(&integers(&[[1]]));
    // x = 5 + s with E s² = 2, which a sum of two standard sources has.
    let found = expected(2, 4, |z| {
        let value = ratio(3, 1) * (ratio(5, 1) + &z[0] + &z[1]) + &right[(0, 0)];
        (0..=8).map(|n| value.pow(n)).collect()
    });
    assert_eq!(found, moments(&exponent.linear, &exponent.quadratic));
    let shape = (&a * x.mean()).shape();
    assert_eq!(right.shape(), shape);
    assert_ne!(input_matrix.shape(), shape, "the printed B(Z)");
    let square = expected(1, 4, |z| {
        let centred = &z[0] * &z[0] - ratio(1, 1);
        vec![centred.clone(), centred.pow(2), centred.pow(3)]
    });
    assert_eq!(square, [0, 2, 8].map(|moment| ratio(moment, 1)));
    assert_ne!(square[2], moments(&square[0], &square[1])[3]);
}

/// HV-L2ii: for a jointly Gaussian pair no correlation is independence: E f(X)g(Y) = E f(X) E g(Y), and the law of X does not move
/// with Y. It fails for X ~ N(0, 1), Y = ±X with a fair sign: no correlation, and E X²Y² = 3.
#[test]
fn uncorrelated_parts_are_independent() {
    // X = z₁ + z₂ and Y = z₁ − z₂.
    let pair = Gaussian::standard(2).affine(&integers(&[[1, 1], [1, -1]]), &Matrix::zeros(2, 1));
    assert!(pair.are_independent(&[0], &[1]));
    let products = |n: i32, m: i32| {
        let value = |z: &[Rational]| ((&z[0] + &z[1]).pow(n), (&z[0] - &z[1]).pow(m));
        expected(2, 4, |z| {
            let (x, y) = value(z);
            vec![&x * &y, x, y]
        })
    };
    for (n, m) in (0..=4).flat_map(|n| (0..=4).map(move |m| (n, m))) {
        let found = products(n, m);
        assert_eq!(found[0], &found[1] * &found[2], "E X^{n} Y^{m}");
    }
    let given = |y: i64| pair.conditioned(&[1], &integers(&[[y]])).expect("data that are possible").law;
    assert_eq!(given(-3), given(7));
    let related = Gaussian::standard(2).affine(&integers(&[[1, 1], [1, 0]]), &Matrix::zeros(2, 1));
    assert!(!related.are_independent(&[0], &[1]));
    let found = expected(1, 2, |z| {
        let (same, other) = (&z[0] * &z[0], -(&z[0] * &z[0]));
        let half = ratio(1, 2);
        vec![(&same + &other) * &half, (same.pow(2) + other.pow(2)) * half, z[0].pow(2)]
    });
    assert_eq!(found, [0, 3, 1].map(|moment| ratio(moment, 1)));
    assert_ne!(found[1], &found[2] * &found[2]);
}

/// HV-L3-mean, HV-L3-cov: with P_yy regular, singular or zero, the residual has mean 0, the variance P, the third moment 0 and the
/// fourth 3P² on every function of Y that is tried: X is Gaussian given Y, with these moments.
#[test]
fn conditioning_gives_the_law() {
    // X and Y as functions of three sources; Y of rank two, of rank one (twice the same), and zero.
    let x = integers(&[[1, 2, -1]]);
    for y in [integers(&[[1, 0, 1], [0, 1, 0]]), integers(&[[1, 1, 0], [2, 2, 0]]), Matrix::zeros(2, 3)] {
        let shift = integers(&[[4], [1], [-2]]);
        let joint = Gaussian::standard(3).affine(&x.above(&y), &shift);
        let defects = expected(3, 3, |z| {
            let values = x.above(&y) * Matrix::column(z.to_vec()) + &shift;
            let reading = values.block(1..3, 0..1);
            let given = joint.conditioned(&[1, 2], &reading).expect("a reading of the support").law;
            let (error, p) = (&values[(0, 0)] - &given.mean()[(0, 0)], given.covariance()[(0, 0)].clone());
            let defects = [error.clone(), error.pow(2) - &p, error.pow(3), error.pow(4) - ratio(3, 1) * &p * &p];
            let functions =
                [ratio(1, 1), reading[(0, 0)].clone(), reading[(0, 0)].pow(2), &reading[(0, 0)] * &reading[(1, 0)]];
            functions.iter().flat_map(|g| defects.iter().map(move |defect| defect * g)).collect()
        });
        assert!(defects.iter().all(|defect| *defect == ratio(0, 1)), "{y}");
    }
}

/// HV-L3-cov needs a positive semidefinite joint covariance: with P_xx = P_yy = 0 and P_xy = 1 it gives 0 and takes no notice of
/// P_xy; no random vector has this covariance, and that is found.
#[test]
fn conditioning_needs_a_covariance() {
    let none = law(&Matrix::zeros(2, 1), &integers(&[[0, 1], [1, 0]]));
    let given = none.conditioned(&[1], &integers(&[[0]])).expect("data that are possible");
    assert_eq!((given.law.covariance(), &given.gain), (&integers(&[[0]]), &integers(&[[0]])));
    // What is left uncorrelated with Y where the lemma holds, P_xy(I − P_yy⁺P_yy) = 0, is 1 here.
    let rest = &given.cross_covariance * (Matrix::identity(1) - &given.pseudo_inverse * &given.innovation_covariance);
    assert_eq!(rest, integers(&[[1]]));
    assert!(matches!(none.definiteness(), Err(LdlError::Indefinite(_))));
}

/// HV-L3: `P⁺ = Vᵀ(VVᵀ)⁻¹(UᵀU)⁻¹Uᵀ where P = UV has full rank; 0⁺ = 0`, whatever the factorisation: (UM, M⁻¹V) gives the same. Rank 0 is
/// allowed by r ≤ p: the factors are empty, and the formula, read with empty products, gives 0. Without sensors and noise
/// (C = 0, F = 0) it is needed.
#[test]
fn any_full_rank_factorisation_will_do() {
    let formula = |u: &Q, v: &Q| {
        let (ut, vt) = (u.transpose(), v.transpose());
        &vt * (v * &vt).inverse().expect("regular") * (&ut * u).inverse().expect("regular") * ut
    };
    for p in [integers(&[[1, 2, 3], [2, 4, 6], [3, 6, 10]]), integers(&[[2, 1, 0], [1, 2, 0], [0, 0, 0]])] {
        let FullRank { left, right } = p.full_rank_factorisation().expect("fractions decide");
        assert_eq!((left.columns(), &left * &right), (2, p.clone()));
        let m = integers(&[[2, 1], [7, 3]]);
        let inverse = formula(&left, &right);
        assert_eq!(formula(&(&left * &m), &(m.inverse().expect("regular") * right)), inverse);
        assert_eq!(p.pseudo_inverse().expect("there is one over the fractions"), inverse);
        // The equations of Penrose, of which no other matrix solves all four.
        let (one, other) = (&p * &inverse, &inverse * &p);
        assert_eq!((&one * &p, &other * &inverse), (p, inverse));
        assert_eq!((one.transpose(), other.transpose()), (one, other));
    }
    let zero: Q = Matrix::zeros(2, 2);
    let FullRank { left, right } = zero.full_rank_factorisation().expect("fractions decide");
    assert_eq!((left.columns(), right.rows()), (0, 0));
    assert_eq!(
        (formula(&left, &right), zero.pseudo_inverse().expect("there is one over the fractions")),
        (zero.clone(), zero)
    );
    let blind =
        system(Matrix::identity(1), integers(&[[3]]), Matrix::zeros(1, 1), integers(&[[1]]), Matrix::zeros(1, 1));
    let path = realised(&blind, &[number(ratio(0, 1))], 1);
    let record = &filter(path.path()).expect("consistent data").records[0];
    assert_eq!((&record.innovation_covariance, &record.gain), (&integers(&[[0]]), &integers(&[[0]])));
    assert!(ratio(1, 1).over(&record.innovation_covariance[(0, 0)]).is_err());
}

//! Stein's identity for Gaussian vectors.

use exact_kalman::gaussian::{Gaussian, Polynomial};
use exact_kalman::matrix::{LdlError, Matrix};
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::draws::{Q, integers, matrices, semidefinite};

type Poly = Polynomial<Rational>;

fn expectation(law: &Gaussian<Rational>, polynomial: &Poly) -> Rational {
    law.expectation(polynomial).unwrap_or_else(|error| panic!("a covariance: {error}"))
}

/// E x_{i₁}⋯x_{iₘ}, by Isserlis: the sum over all ways to leave some factors alone and to pair the others, of the means of
/// those left and the covariances of the pairs.
fn paired(mean: &Q, covariance: &Q, factors: &[usize]) -> Rational {
    let Some((&first, rest)) = factors.split_first() else { return ratio(1, 1) };
    let alone = &mean[(first, 0)] * paired(mean, covariance, rest);
    (0..rest.len()).fold(alone, |sum, k| {
        let others: Vec<usize> = rest.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, i)| *i).collect();
        sum + &covariance[(first, rest[k])] * paired(mean, covariance, &others)
    })
}

/// Polynomials of up to four terms with exponents up to 3.
fn polynomials(n: usize) -> impl Strategy<Value = Poly> {
    vec((-4i64..=4, vec(0u32..=3, n)), 1..=4).prop_map(move |terms| {
        terms.into_iter().fold(Poly::zero(n), |sum, (c, exponents)| sum.plus(&Poly::term(ratio(c, 1), exponents)))
    })
}

fn laws(n: usize) -> impl Strategy<Value = Gaussian<Rational>> {
    (matrices(n, 1, 2), semidefinite(n))
        .prop_map(|(mean, p)| Gaussian::new(mean, p).unwrap_or_else(|error| panic!("{error}")))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    /// AK-Stein-Gauss: E[(X − μ)g(X)] = P E[∇g(X)], component by component, singular P included.
    #[test]
    fn stein_identity_holds((law, g) in (1usize..=3).prop_flat_map(|n| (laws(n), polynomials(n)))) {
        let n = law.dimension();
        let gradient = Matrix::from_fn(n, 1, |i, _| expectation(&law, &g.derivative(i)));
        let right = law.covariance() * gradient;
        for i in 0..n {
            let deviation = Poly::variable(n, i).plus(&Poly::constant(n, -law.mean()[(i, 0)].clone()));
            prop_assert_eq!(&expectation(&law, &deviation.times(&g)), &right[(i, 0)]);
        }
    }

    /// AK-Stein-Gauss: the expectations that go into it equal the sums over pairings.
    #[test]
    fn expectations_are_sums_over_pairings((law, g) in (1usize..=3).prop_flat_map(|n| (laws(n), polynomials(n)))) {
        let mut sum = ratio(0, 1);
        for (exponents, coefficient) in g.terms() {
            let repeated = exponents.iter().enumerate().flat_map(|(i, &e)| (0..e).map(move |_| i));
            sum += coefficient * paired(law.mean(), law.covariance(), &repeated.collect::<Vec<_>>());
        }
        prop_assert_eq!(expectation(&law, &g), sum);
    }
}

/// AK-Stein-Gauss: the identity belongs to Gaussian laws: for X = ±1 with equal odds and g(x) = x³ the left side is
/// E X⁴ = 1, the right one 3E X² = 3.
#[test]
fn stein_identity_fails_for_two_points() {
    let mean = |g: fn(i64) -> i64| ratio(g(1) + g(-1), 2);
    let (left, right) = (mean(|x| x * x * x * x), mean(|x| x * x) * mean(|x| 3 * x * x));
    assert_eq!((left, right), (ratio(1, 1), ratio(3, 1)));
}

/// AK-Stein-Gauss: moments known by heart.
#[test]
fn moments_of_small_laws() {
    let law =
        Gaussian::new(integers(&[[1], [0]]), integers(&[[2, 1], [1, 3]])).unwrap_or_else(|error| panic!("{error}"));
    let moment = |a: u32, b: u32| expectation(&law, &Poly::term(ratio(1, 1), vec![a, b]));
    assert_eq!([moment(0, 0), moment(1, 0), moment(2, 0), moment(1, 1)], [1, 1, 3, 1].map(|m| ratio(m, 1)));
    // E x³ = μ³ + 3μσ², E y⁴ = 3σ⁴, E (x − 1)²y² = 2·3 + 2·1²
    assert_eq!([moment(3, 0), moment(0, 4)], [7, 27].map(|m| ratio(m, 1)));
    assert_eq!(moment(2, 2) - ratio(2, 1) * moment(1, 2) + moment(0, 2), ratio(8, 1));
}

/// A covariance that no vector has gives no expectation.
#[test]
fn indefinite_laws_have_no_expectation() {
    let law = Gaussian::new(integers(&[[0]]), integers(&[[-1]])).unwrap_or_else(|error| panic!("{error}"));
    assert!(matches!(law.expectation(&Poly::variable(1, 0)), Err(LdlError::Indefinite(_))));
}

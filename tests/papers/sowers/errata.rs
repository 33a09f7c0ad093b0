//! What the paper prints beside what is right: each test computes both.

use exact_kalman::nongaussian::as_printed::{log_density, statistics_with_printed_error};
use exact_kalman::nongaussian::{Choice, Decomposition, Enclosed, InitialLaw, statistics};
use exact_kalman::scalar::{Rational, Scalar, ratio};
use num_traits::Signed;

use super::{number, scalar};

fn coin() -> InitialLaw<Rational> {
    let half = |value| (ratio(1, 2), number(ratio(value, 1)));
    InitialLaw::atoms([half(0), half(1)]).unwrap_or_else(|error| panic!("{error}"))
}

/// Erratum SM-2.4: without Σᵛ⁻¹ R(1) is 1/2 where it is 0, and the estimate of the smallest example 0.6225 (1/(1 + e^(−1/2)))
/// instead of 0.5622 (1/(1 + e^(−1/4)), which Bayes' rule gives).
#[test]
fn the_last_term_of_r_has_the_inverse_of_the_noise() {
    let path = scalar([1, 1, 1, 0, 2], &[1]);
    let (right, printed) = (statistics(&path), statistics_with_printed_error(&path));
    let [right, printed] = [right, printed].map(|all| all.unwrap_or_else(|error| panic!("{error}"))[1].clone());
    assert_eq!((&right.error, &printed.error), (&number(ratio(0, 1)), &number(ratio(1, 2))));
    let digits = |now: &exact_kalman::nongaussian::Statistics<Rational>| match &now.posterior(&coin()).mean(60) {
        Ok(entries) => match &entries[0] {
            Enclosed::Between(interval) => interval.lower().value().map(|x| (x * ratio(1_000_000, 1)).to_integer()),
            Enclosed::Exact(value) => panic!("{value} is a fraction"),
        },
        Err(error) => panic!("{error}"),
    };
    assert_eq!((digits(&right), digits(&printed)), (Some(562_176.into()), Some(622_459.into())));
    // (4.7) decides: R*(1) = H²/J.
    assert_eq!(right.precision(), number(ratio(1, 2)));
    assert_ne!(printed.precision(), number(ratio(1, 2)));
    // For Σᵛ = I the slip does not show.
    let unit = scalar([1, 1, 1, 0, 1], &[1, 3]);
    assert_eq!(statistics(&unit), statistics_with_printed_error(&unit));
}

/// Erratum SM-3.15, and likewise SM-3.14: with −½ E[L | ξ = z] is 1; with +½ its logarithm is zᵀMz, which is
/// 1/2 for H = 1, Σᵛ = 2, z = 1. The expectation is that of a log-normal variable, written out.
#[test]
fn the_density_has_minus_one_half() {
    let path = scalar([1, 1, 1, 0, 2], &[0]);
    let all = statistics(&path).unwrap_or_else(|error| panic!("{error}"));
    let parts = Decomposition::new(&path, Choice::of_the_paper(1, 1)).unwrap_or_else(|error| panic!("{error}"));
    let (one, z) = (ratio(1, 1), number(ratio(1, 1)));
    let (right, printed) = (parts.log_density(&z), log_density(&parts, &z));
    // L = exp(g + c), g = −zHV°/Σᵛ ~ N(0, z²H²/Σᵛ): log E L = c + z²H²/(2Σᵛ).
    let variance = ratio(1, 2);
    let log_mean = |c: Rational| c.plus(&variance.times(&ratio(1, 2)));
    let at_no_noise = [number(ratio(0, 1)).above(&number(ratio(0, 1)))];
    assert_eq!((right.at(&at_no_noise), printed.at(&at_no_noise)), (ratio(-1, 4), ratio(1, 4)));
    assert_eq!((log_mean(ratio(-1, 4)), log_mean(ratio(1, 4))), (ratio(0, 1), ratio(1, 2)));
    assert_eq!((right.log_moment(&one), printed.log_moment(&one)), (ratio(0, 1), ratio(1, 2)));
    assert_eq!(all[1].likelihood_ratio().log_moment(&one, &z), ratio(0, 1));
    assert_eq!(all[1].likelihood_ratio().quadratic(&z), variance);
}

/// SM-Girsanov-a, SM-3.15: log E[Lˢ | z] = ½(s² − s) zᵀMz, of the log-normal law for any s; negative between 0 and 1.
#[test]
fn moments_of_the_likelihood_ratio() {
    let all = statistics(&scalar([2, 1, 1, 1, 3], &[5, 1])).unwrap_or_else(|error| panic!("{error}"));
    let z = number(ratio(-3, 2));
    for now in &all[1..] {
        let likelihood_ratio = now.likelihood_ratio();
        let variance = likelihood_ratio.quadratic(&z);
        assert!(variance.is_positive());
        for s in [ratio(0, 1), ratio(1, 1), ratio(1, 2), ratio(-2, 1), ratio(5, 3)] {
            // Lˢ = exp(s g − s variance/2)
            let expected = s.times(&s).times(&variance).minus(&s.times(&variance)).times(&ratio(1, 2));
            assert_eq!(likelihood_ratio.log_moment(&s, &z), expected);
        }
        assert_eq!(likelihood_ratio.log_moment(&ratio(1, 2), &z), variance.times(&ratio(-1, 8)));
    }
}

/// Erratum SM-A3: with Δ the second moment 2 in place of the variance 1 the estimate of the model A = H = Σʷ = Σᵛ = 1, μ = 1,
/// Y(0) = 0 would be 1/3 where it is 1/2.
#[test]
fn delta_is_the_covariance() {
    let after = &statistics(&scalar([1, 1, 1, 0, 1], &[0])).unwrap_or_else(|error| panic!("{error}"))[1];
    // 0 or 2 with a fair coin: mean 1, variance 1, second moment 2.
    let start =
        InitialLaw::atoms([0, 2].map(|x| (ratio(1, 2), number(ratio(x, 1))))).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((start.mean(), start.covariance()), (number(ratio(1, 1)), number(ratio(1, 1))));
    let by_formula = |delta: Rational| {
        // X̄ + Q*(R* + 1/Δ)⁻¹(B̄ + μ/Δ), all numbers
        let inverse = ratio(1, 1) / &delta;
        let [x, q, r, b] =
            [&after.mean, &after.response(), &after.precision(), &after.linear].map(|m| m[(0, 0)].clone());
        x + q * (b + &inverse) / (r + inverse)
    };
    assert_eq!(after.linear(&start).estimate, number(by_formula(ratio(1, 1))));
    assert_eq!((by_formula(ratio(1, 1)), by_formula(ratio(2, 1))), (ratio(1, 2), ratio(1, 3)));
}

/// Erratum SM-LMMSE: X°(1) = ξ + W, Y(0) = ξ + V, E ξ = var ξ = 1: the best affine rule is 1/2 + y/2, the best strictly linear
/// one 2y/3, and its mean squared error is larger. Moments are written out.
#[test]
fn the_kalman_estimate_is_affine() {
    let start =
        InitialLaw::atoms([0, 2].map(|x| (ratio(1, 2), number(ratio(x, 1))))).unwrap_or_else(|error| panic!("{error}"));
    for y in [-3, 0, 4] {
        let all = statistics(&scalar([1, 1, 1, 0, 1], &[y])).unwrap_or_else(|error| panic!("{error}"));
        let found = all[1].linear(&start);
        assert_eq!(found.estimate, number(ratio(1 + y, 2)));
        assert_ne!(found.estimate, number(ratio(2 * y, 3)));
        // E(X − a − bY)² = E X² − 2aEX − 2bE XY + a² + 2abEY + b²E Y² with E X = E Y = 1, E X² = 3, E XY = 2, E Y² = 3.
        let error = |a: Rational, b: Rational| {
            let two = ratio(2, 1);
            ratio(3, 1) - &two * &a - ratio(4, 1) * &b + &a * &a + &two * &a * &b + ratio(3, 1) * &b * &b
        };
        let (affine, linear) = (error(ratio(1, 2), ratio(1, 2)), error(ratio(0, 1), ratio(2, 3)));
        assert_eq!(found.covariance, number(affine.clone()));
        assert!(affine < linear);
    }
}

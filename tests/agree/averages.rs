//! Which averages are fractions, on which side of a fraction they lie, and what is said where that is out of reach.

use std::cmp::Ordering;

use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::nongaussian::{Enclosed, Evidence, Posterior, PosteriorComponent};
use exact_kalman::scalar::{Rational, ratio};
use num_bigint::BigInt;

/// Components at fixed points, of sizes `weight · determinant^(−½) · exp(exponent)`.
fn posterior<const N: usize>(parts: &[([i64; 3], [Rational; N])]) -> Posterior<Rational> {
    let component = |([weight, determinant, exponent], at): &([i64; 3], [Rational; N])| {
        let mean = Matrix::from_fn(N, 1, |i, _| at[i].clone());
        let law = Gaussian::new(mean, Matrix::zeros(N, N)).expect("a law");
        let [weight, determinant, exponent] = [weight, determinant, exponent].map(|&x| ratio(x, 1));
        PosteriorComponent { evidence: Evidence { weight, determinant, exponent }, initial: law.clone(), state: law }
    };
    Posterior { components: parts.iter().map(component).collect() }
}

fn half(x: i64) -> Rational {
    ratio(x, 2)
}

/// The corners of a square with independent coordinates: sizes e^(−a − 2b). The covariance of the coordinates is 0, though each of
/// the ten terms is irrational; their variances are not fractions.
fn corners() -> Vec<([i64; 3], [Rational; 2])> {
    [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(a, b)| ([1, 1, -a - 2 * b], [a, b].map(|x| ratio(x, 1)))).into()
}

#[test]
fn independent_coordinates_have_covariance_zero() {
    let covariance = posterior(&corners()).covariance(60).expect("narrow");
    assert_eq!(covariance[(0, 1)], Enclosed::Exact(ratio(0, 1)));
    assert_eq!(covariance[(1, 0)], Enclosed::Exact(ratio(0, 1)));
    // e/(1 + e)² = 0.19661193324148185…
    let Enclosed::Between(found) = &covariance[(0, 0)] else { panic!("it is no fraction") };
    let digit = ratio(1, 10_000_000_000_000_000);
    let below = ratio(1_966_119_332_414_818, 10_000_000_000_000_000);
    assert!(found.lower().value().expect("short") > below && found.upper().value().expect("short") < below + digit);
}

/// Binomial weights 1, 2e^−1, e^−2 at 0, 1, 2, with the variances 1, 0, 1 there: the irrational 2p(1 − p) is the variance of the points and
/// the probability of the one in the middle, so that the sum of both is 1. The pairs (0, 2) and (1, 1) cancel each other.
#[test]
fn pairs_of_one_exponent_are_taken_together() {
    let at = |place: i64| [ratio(place, 1)];
    let mut binomial = posterior(&[([1, 1, 0], at(0)), ([2, 1, -1], at(1)), ([1, 1, -2], at(2))]);
    for place in [0, 2] {
        let mean = binomial.components[place].state.mean().clone();
        binomial.components[place].state = Gaussian::new(mean, Matrix::identity(1)).expect("a law");
    }
    assert_eq!(binomial.covariance(60).expect("exact")[(0, 0)], Enclosed::Exact(ratio(1, 1)));
    binomial.components[1].evidence.weight = ratio(3, 1);
    assert!(matches!(binomial.covariance(60).expect("narrow")[(0, 0)], Enclosed::Between(_)));
}

/// A fifth point far off, of size exp(−10⁶): now the covariance is p₅(1 − p₅)(10 − x̄)(10 − ȳ), where (x̄, ȳ) is the mean of the others and
/// p₅ is exp(−10⁶)/(1 + 1/e)/(1 + 1/e²) but for 10⁻⁴³⁴²⁹⁴ of it. All else cancels exactly.
#[test]
fn what_is_left_after_cancellation_is_enclosed() {
    let mut parts = corners();
    parts.push(([1, 1, -1_000_000], [10, 10].map(|x| ratio(x, 1))));
    let covariance = posterior(&parts).covariance(100).expect("narrow");
    let Enclosed::Between(found) = &covariance[(0, 1)] else { panic!("it is no fraction") };
    // log₂: −10⁶/ln 2 − log₂((1 + 1/e)(1 + 1/e²)) + log₂((10 − 0.2689…)(10 − 0.1192…)) = −1442689.06…
    assert_eq!((found.lower().magnitude(), found.upper().magnitude()), (Some(-1_442_689), Some(-1_442_689)));
}

/// Sizes with one exponent are rational multiples of each other iff their determinants differ by a square: s and 4s for all s
/// without square factors, with equal sizes and values 1 and −1, have the mean 0 in each class.
#[test]
fn determinants_are_told_apart_by_squares() {
    let is_free = |s: &i64| (2..=*s).all(|d| s % (d * d) != 0);
    let free: Vec<i64> = (1..400).filter(is_free).collect();
    let parts: Vec<_> =
        free.iter().flat_map(|&s| [([1, s, 0], [ratio(1, 1)]), ([2, 4 * s, 0], [ratio(-1, 1)])]).collect();
    assert_eq!(posterior(&parts).mean(60), Ok(vec![Enclosed::Exact(ratio(0, 1))]));
    // 9 · 2 for 4 · 2: no more than one class is disturbed, and the mean is irrational.
    let disturbed: Vec<_> =
        parts.into_iter().map(|([w, d, q], at)| if d == 8 { ([w, 18, q], at) } else { ([w, d, q], at) }).collect();
    assert!(matches!(posterior(&disturbed).mean(60).as_deref(), Ok([Enclosed::Between(_)])));
    // 1/1 : 1/√4 leaves fractions, 1/1 : 1/√2 does not.
    let weights = |d| posterior(&[([1, 1, 0], [ratio(0, 1)]), ([1, d, 0], [ratio(1, 1)])]).weights(60);
    assert_eq!(weights(4), Ok(vec![Enclosed::Exact(ratio(2, 3)), Enclosed::Exact(ratio(1, 3))]));
    assert!(matches!(weights(2).as_deref(), Ok([Enclosed::Between(_), Enclosed::Between(_)])));
    // 48473881 is no square, but one modulo each odd prime up to 59, so that only its root tells.
    assert!(6962_i64.pow(2) < 48_473_881 && 48_473_881 < 6963_i64.pow(2));
    assert!(matches!(weights(48_473_881).as_deref(), Ok([Enclosed::Between(_), Enclosed::Between(_)])));
    // √½ and √(1/8) are of one class, so their variance is a fraction: shares 2/3 and 1/3.
    let alike = posterior(&[([1, 2, 0], [ratio(0, 1)]), ([1, 8, 0], [ratio(1, 1)])]);
    assert_eq!(alike.covariance(60).expect("exact")[(0, 0)], Enclosed::Exact(ratio(2, 9)));
}

/// Values next to a fraction: 3/2 and, with a probability of exp(−10⁹) or less, another one.
#[test]
fn the_side_of_a_fraction_is_decided() {
    for exponent in [-1_000_000_000, i64::MIN] {
        for (other, expected) in [(4, Ordering::Greater), (2, Ordering::Less)] {
            let posterior = posterior(&[([1, 1, 0], [half(3)]), ([1, 1, exponent], [half(other)])]);
            let mut averages = posterior.averages();
            let mean = averages.mean().remove(0);
            assert_eq!(averages.compared(&mean, &half(3)), Ok(expected));
            assert_eq!(averages.compared(&mean, &ratio(1, 1)), Ok(Ordering::Greater));
            assert_eq!(averages.compared(&mean, &ratio(2, 1)), Ok(Ordering::Less));
        }
    }
    // A variance next to ¼: −1 and 0 or 1 with equal sizes, and a third value.
    let parts = |other| [([1, 1, 0], [ratio(0, 1)]), ([1, 1, 0], [ratio(1, 1)]), ([1, 1, -1_000_000_000], [other])];
    for (other, expected) in [(ratio(7, 1), Ordering::Greater), (half(1), Ordering::Less)] {
        let posterior = posterior(&parts(other));
        let mut averages = posterior.averages();
        let variance = averages.covariance()[(0, 0)].clone();
        assert_eq!(averages.compared(&variance, &ratio(1, 4)), Ok(expected));
    }
    // A fraction is compared as one.
    let posterior = posterior(&[([1, 1, 0], [half(3)]), ([1, 1, 0], [half(5)])]);
    let mut averages = posterior.averages();
    let mean = averages.mean().remove(0);
    assert_eq!(averages.compared(&mean, &ratio(2, 1)), Ok(Ordering::Equal));
}

/// What is out of reach is named, and told as far as it is known.
#[test]
fn what_is_too_wide_has_a_name() {
    let far = posterior(&[([1, 1, 0], [ratio(0, 1)]), ([1, 1, i64::MIN], [ratio(1, 1)])]);
    let wide = far.weights(50).expect_err("too small");
    assert!(wide.to_string().starts_with("the probability of component 1 is not enclosed to 50 bits"), "{wide}");
    let known = wide.known.expect("a bound");
    assert!(known.lower().is_zero() && known.upper().magnitude() < Some(-(1 << 61)));
    let text = |error: exact_kalman::nongaussian::TooWide| error.to_string();
    assert!(text(far.mean(50).expect_err("too small")).starts_with("entry 0 of the best estimate"));
    assert!(text(far.covariance(50).expect_err("too small")).starts_with("entry (0, 0) of the covariance"));
    // More bits than any number is worked on with, which a number of an ordinary size does not need to be told.
    let near = posterior(&[([1, 1, 0], [ratio(0, 1)]), ([1, 1, -1], [ratio(1, 1)])]);
    let wide = near.mean(1 << 40).expect_err("too many bits");
    // 1/(1 + e)
    let (lower, upper) =
        (wide.known.as_ref().map(|x| x.lower().value()), wide.known.as_ref().map(|x| x.upper().value()));
    assert!(lower > Some(Some(ratio(26_894, 100_000))) && upper < Some(Some(ratio(26_895, 100_000))));
}

/// Of a phase of 10^40, cos = −0.8218988919070239214425448…, and one beyond all bounds is refused, with its name.
#[test]
fn phases_of_any_size_are_turned_or_refused() {
    let at = |theta: BigInt| {
        let theta = Matrix::from_fn(1, 1, |_, _| Rational::from(theta.clone()));
        posterior(&[([1, 1, 0], [ratio(1, 1)])]).characteristic(&theta).value(60)
    };
    let [cosine, sine] = at(BigInt::from(10).pow(40)).expect("narrow");
    let holds = |found: &exact_kalman::scalar::Interval, digits: i64| {
        let (unit, below) = (ratio(1, 1_000_000_000_000_000), ratio(digits, 1_000_000_000_000_000));
        found.lower().value().expect("short") > below && found.upper().value().expect("short") < below + unit
    };
    assert!(holds(&cosine, -821_898_891_907_024) && holds(&sine, -569_633_400_953_637));
    let wide = at(BigInt::from(1) << 200_000).expect_err("too large");
    assert!(wide.to_string().starts_with("the characteristic function is not enclosed"), "{wide}");
}

/// Points on the line y = 0, all of different sizes: covariances with y are 0.
#[test]
fn covariances_with_a_constant_are_zero() {
    let on_the_line = |i: i64| ([1, 1, -i], [ratio(i, 1), ratio(0, 1)]);
    let posterior = posterior(&(0..300).map(on_the_line).collect::<Vec<_>>());
    let mut averages = posterior.averages();
    let covariance = averages.covariance();
    for place in [(0, 1), (1, 0), (1, 1)] {
        assert_eq!(averages.enclosed(&covariance[place], 10), Ok(Enclosed::Exact(ratio(0, 1))));
    }
}

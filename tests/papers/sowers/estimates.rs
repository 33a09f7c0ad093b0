//! Best and best affine estimates where everything is known by hand.

use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::{LdlError, Matrix};
use exact_kalman::nongaussian::{
    Component, Enclosed, InitialLaw, InitialLawError, StatisticsError, TooWide, statistics,
};
use exact_kalman::scalar::{Rational, ratio};
use num_bigint::BigInt;

use super::{number, scalar};

fn law(components: &[(Rational, Rational, Rational)]) -> InitialLaw<Rational> {
    let gaussian = |mean: &Rational, variance: &Rational| {
        Gaussian::new(number(mean.clone()), number(variance.clone())).unwrap_or_else(|error| panic!("{error}"))
    };
    let component = |(weight, mean, variance): &(Rational, Rational, Rational)| Component {
        weight: weight.clone(),
        law: gaussian(mean, variance),
    };
    InitialLaw::mixture(components.iter().map(component)).unwrap_or_else(|error| panic!("{error}"))
}

fn atoms(values: &[(i64, i64, i64)]) -> InitialLaw<Rational> {
    law(&values.iter().map(|&(n, d, x)| (ratio(n, d), ratio(x, 1), ratio(0, 1))).collect::<Vec<_>>())
}

/// The first so many decimals of an irrational number between 0 and 1.
fn decimals(found: &Enclosed, count: u32) -> String {
    let Enclosed::Between(interval) = found else { panic!("{found:?} is a fraction") };
    let digits = |x: Option<Rational>| {
        let scaled = x.unwrap_or_else(|| panic!("an end is too long")) * Rational::from(BigInt::from(10).pow(count));
        scaled.to_integer().to_string()
    };
    let (lower, upper) = (digits(interval.lower().value()), digits(interval.upper().value()));
    assert_eq!(lower, upper, "not proved");
    lower
}

/// SM-4.2, SM-MMSE: A = H = Σʷ = 1, Σᵛ = 2, ξ = 0 or 1 with a fair coin, Y(0) = 1. By Bayes' rule the state has the mean
/// 1/(1 + exp(−1/4)); its digits were computed without this crate.
#[test]
fn the_smallest_example_has_the_mean_of_bayes() {
    let after = &statistics(&scalar([1, 1, 1, 0, 2], &[1])).unwrap_or_else(|error| panic!("{error}"))[1];
    let posterior = after.posterior(&atoms(&[(1, 2, 0), (1, 2, 1)]));
    let mean = posterior.mean(200).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(decimals(&mean[0], 50), "56217650088579810402732363790294635383795939625766");
    let weights = posterior.weights(200).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(decimals(&weights[1], 50), decimals(&mean[0], 50));
}

/// SM-4.2, SM-4.3: for a Gaussian start, degenerate or not, best and best affine estimate are one fraction.
#[test]
fn a_gaussian_start_makes_the_estimates_equal() {
    for (mean, variance) in [(ratio(1, 3), ratio(2, 1)), (ratio(-5, 1), ratio(0, 1))] {
        let start = law(&[(ratio(1, 1), mean, variance)]);
        for now in statistics(&scalar([2, 3, 1, 1, 2], &[1, -4, 2])).unwrap_or_else(|error| panic!("{error}")) {
            let linear = now.linear(&start);
            let posterior = now.posterior(&start);
            assert_eq!(posterior.mean(10), Ok(vec![Enclosed::Exact(linear.estimate[(0, 0)].clone())]));
            let covariance = posterior.covariance(10).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(covariance[(0, 0)], Enclosed::Exact(linear.covariance[(0, 0)].clone()));
        }
    }
}

/// Which numbers are fractions is decided: by symmetry, by equal evidence, by determinants that differ by a square.
#[test]
fn fractions_are_told_from_irrational_numbers() {
    let after = |reading| {
        let all = statistics(&scalar([1, 1, 1, 0, 1], &[reading])).unwrap_or_else(|error| panic!("{error}"));
        all[1].clone()
    };
    let mean = |reading, start: &InitialLaw<Rational>| after(reading).posterior(start).mean(60);
    // ±1 at the reading 0: the evidence of both is the same.
    let signs = atoms(&[(1, 2, -1), (1, 2, 1)]);
    assert_eq!(mean(0, &signs), Ok(vec![Enclosed::Exact(ratio(0, 1))]));
    assert!(matches!(mean(1, &signs).as_deref(), Ok([Enclosed::Between(_)])));
    // 0 between them: its evidence differs, and the sum is 0 all the same.
    let three = atoms(&[(1, 4, -1), (1, 2, 0), (1, 4, 1)]);
    assert_eq!(mean(0, &three), Ok(vec![Enclosed::Exact(ratio(0, 1))]));
    assert!(matches!(after(0).posterior(&three).weights(60).as_deref(), Ok([Enclosed::Between(_), ..])));
    // A spike at 0 and a slab of variance 3 around it: det(I + ΔR*) = 4, so the weights are 1 and 1/2 of what they were.
    let slab = |variance| law(&[(ratio(1, 2), ratio(0, 1), ratio(0, 1)), (ratio(1, 2), ratio(0, 1), variance)]);
    let weights = |variance| after(0).posterior(&slab(variance)).weights(60);
    assert_eq!(weights(ratio(3, 1)), Ok(vec![Enclosed::Exact(ratio(2, 3)), Enclosed::Exact(ratio(1, 3))]));
    assert!(matches!(weights(ratio(2, 1)).as_deref(), Ok([Enclosed::Between(_), Enclosed::Between(_)])));
}

/// Evidence of any size: atoms 0 and 10⁶ read at 0 leave a mean of about 10⁶ exp(−10¹²/2), enclosed at once.
#[test]
fn huge_evidence_is_no_obstacle() {
    let all = statistics(&scalar([1, 1, 0, 0, 1], &[0])).unwrap_or_else(|error| panic!("{error}"));
    let far = atoms(&[(1, 2, 0), (1, 2, 1_000_000)]);
    let mean = all[1].posterior(&far).mean(100).unwrap_or_else(|error| panic!("{error}"));
    let [Enclosed::Between(interval)] = &mean[..] else { panic!("{mean:?}") };
    // log₂(10⁶) − 10¹²/(2 ln 2) = 19.93… − 721347520444.48…
    assert_eq!(interval.lower().magnitude(), Some(-721_347_520_424));
    let beyond = atoms(&[(1, 2, 0), (1, 2, 10_000_000_000)]);
    assert!(matches!(all[1].posterior(&beyond).mean(100), Err(TooWide { bits: 100, .. })));
}

/// SM-A2: a sensor without noise is refused with a vector that shows it.
#[test]
fn noiseless_observations_are_refused() {
    match statistics(&scalar([1, 1, 1, 0, 0], &[1])) {
        Err(StatisticsError::Noiseless { step: 0, witness }) => assert_eq!(witness, Matrix::identity(1)),
        other => panic!("{other:?}"),
    }
}

/// SM-A3: what is no law is refused, with the reason.
#[test]
fn what_is_no_law_is_refused() {
    let atoms = |weights: &[i64]| {
        InitialLaw::atoms(weights.iter().map(|&weight| (ratio(weight, 2), Matrix::<Rational>::identity(1))))
    };
    assert_eq!(atoms(&[]), Err(InitialLawError::Empty));
    assert_eq!(atoms(&[3, -1]), Err(InitialLawError::Weight { component: 1 }));
    assert_eq!(atoms(&[1, 2]), Err(InitialLawError::Sum { sum: ratio(3, 2) }));
    let indefinite = Gaussian::new(Matrix::<Rational>::zeros(2, 1), Matrix::from_integers(&[[1, 2], [2, 1]]));
    match indefinite.map(InitialLaw::gaussian) {
        Ok(Err(InitialLawError::Covariance { component: 0, source: LdlError::Indefinite(proof) })) => {
            assert!(proof.value < ratio(0, 1));
        }
        other => panic!("{other:?}"),
    }
    let mixed = [Matrix::<Rational>::identity(1), Matrix::zeros(2, 1)].map(|value| (ratio(1, 2), value));
    let expected = InitialLawError::Dimension { component: 1, expected: 1, found: 2 };
    assert_eq!(InitialLaw::atoms(mixed), Err(expected));
}

//! The proof of Theorem 2: the conditional characteristic function and its gradient.

use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::nongaussian::{Component, Enclosed, InitialLaw, statistics};
use exact_kalman::scalar::{Interval, Rational, ratio};
use num_bigint::BigInt;

use super::world::{Dice, Noises, World, form, half, integrated, product};
use super::{Q, number, scalar};

/// Two components of any covariance and an atom, as means and factors of the covariances.
fn parts(n: usize, dice: &mut Dice) -> Vec<(Rational, Q, Q)> {
    let mut part = |p: i64, rank: usize| {
        (ratio(p, 6), dice.matrix(n, 1), dice.matrix(n, rank).beside(&Matrix::zeros(n, 2 - rank)))
    };
    vec![part(1, 2), part(2, 1), part(3, 0)]
}

fn law(parts: &[(Rational, Q, Q)]) -> InitialLaw<Rational> {
    let component = |(weight, mean, factor): &(Rational, Q, Q)| Component {
        weight: weight.clone(),
        law: Gaussian::new(mean.clone(), factor * factor.transpose()).expect("symmetric"),
    };
    InitialLaw::mixture(parts.iter().map(component)).expect("a law")
}

/// SM-4.21, SM-4.22, SM-4.25, SM-4.26: the integrand of (4.25) with η for iθ, integrated over each component of F by completing squares, is an
/// exponent in η: its constant, linear and quadratic parts are the evidence, the phase and the damping of the code.
///
/// SM-4.23, SM-4.27: the gradient of the logarithm of each at η = 0 is X̄ + Q* times the mean of z weighted by exp(zᵀB̄ − ½ zᵀR*z), so
/// that the weighted sum of the gradients over that of the values is X̂.
#[test]
fn exponents_by_completing_squares() {
    for (world, mut dice) in World::all(&[Noises::Correlated, Noises::Standard]) {
        let n = world.n;
        let parts = parts(n, &mut dice);
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        let theta = dice.matrix(n, 1);
        for now in &world.statistics(&data)[1..] {
            let posterior = now.posterior(&law(&parts));
            let found = posterior.characteristic(&theta);
            for (((_, mean, factor), term), component) in parts.iter().zip(&found.terms).zip(&posterior.components) {
                // Variables (1, η, g), z = mean + factor g.
                let size = 1 + n + 2;
                let constant = |column: &Q| {
                    Matrix::from_fn(n, size, |i, j| if j == 0 { column[(i, 0)].clone() } else { ratio(0, 1) })
                };
                let select =
                    |rows: usize, from: usize| Matrix::from_fn(rows, size, |i, j| ratio(i64::from(from + i == j), 1));
                let (eta, z) = (select(n, 1), constant(mean) + factor * select(2, 1 + n));
                let exponent = product(&eta, &constant(&now.mean))
                    + half(&form(&eta, &now.covariance))
                    + product(&z, &(constant(&now.linear) + now.response().transpose() * &eta))
                    - half(&form(&z, &now.precision()));
                let (log, determinant) = integrated(&exponent, 1 + n..size).expect("finite");
                assert_eq!((&term.evidence.exponent, &term.evidence.determinant), (&log[(0, 0)], &determinant));
                let linear = log.block(0..1, 1..1 + n).scaled(&ratio(2, 1));
                assert_eq!(term.phase, (&linear * &theta)[(0, 0)]);
                assert_eq!(linear.transpose(), component.state.mean().clone());
                assert_eq!(component.state.mean(), &(&now.mean + now.response() * component.initial.mean()));
                let quadratic = theta.transpose().congruence(&log.block(1..1 + n, 1..1 + n));
                assert_eq!(term.damping, quadratic[(0, 0)]);
            }
        }
    }
}

fn value(found: &Interval) -> (Rational, Rational) {
    (found.lower().value().expect("short"), found.upper().value().expect("short"))
}

/// SM-4.22, SM-4.26: proved digits. A = H = Σʷ = Σᵛ = 1, ξ = ±1, Y(0) = 0: the state is 0 with variance 1 plus ±1, so that at θ = 1 the
/// function is exp(−½) cos 1 = 0.32770991402245986…, and its imaginary part is 0; at θ = 0 it is 1.
#[test]
fn the_coin_at_one() {
    let now = statistics(&scalar([1, 1, 1, 0, 1], &[0])).expect("noisy").pop().expect("some");
    let coin = InitialLaw::atoms([1, -1].map(|x| (ratio(1, 2), number(ratio(x, 1))))).expect("a law");
    let at = |theta: i64| now.posterior(&coin).characteristic(&number(ratio(theta, 1))).value(60).expect("few bits");
    let [real, imaginary] = at(1);
    let digits = ratio(32_770_991_402_245_986, 100_000_000_000_000_000);
    let (lower, upper) = value(&real);
    assert!(&digits - ratio(1, 10_000_000_000_000_000) < lower && upper < digits + ratio(1, 10_000_000_000_000_000));
    let around = |found: &Interval, target: Rational| {
        let (lower, upper) = value(found);
        lower <= target && target <= upper
    };
    assert!(around(&imaginary, ratio(0, 1)) && around(&at(0)[0], ratio(1, 1)) && around(&at(0)[1], ratio(0, 1)));
}

/// SM-4.23: |ψ(h) − 1 − ihX̂| ≤ ½h² E[X² | 𝒴] for every h, in digits that are proved; ψ′(0) is iX̂.
///
/// Erratum SM-4.26: the first exponent has X̄, not the state X̄° of print, which would have to be X̂ or X°: with X̂ for X̄ the same difference
/// quotient tends to X̂ + (X̂ − X̄), which is another number: A = H = Σʷ = Σᵛ = 1, ξ = 0 or 1, Y(0) = 1.
#[test]
fn the_mean_is_a_derivative() {
    let now = statistics(&scalar([1, 1, 1, 0, 1], &[1])).expect("noisy").pop().expect("some");
    let coin = InitialLaw::atoms([0, 1].map(|x| (ratio(1, 2), number(ratio(x, 1))))).expect("a law");
    let posterior = now.posterior(&coin);
    let step = Rational::new(BigInt::from(1), BigInt::from(1) << 30);
    let [_, imaginary] = posterior.characteristic(&number(step.clone())).value(100).expect("few bits");
    let (lower, upper) = value(&imaginary);
    let mean = match &posterior.mean(100).expect("not 0")[0] {
        Enclosed::Between(found) => value(found),
        Enclosed::Exact(value) => (value.clone(), value.clone()),
    };
    // X² has a conditional mean below 1 + 1 = 2.
    let slack = &step;
    assert!(&mean.0 - slack < &upper / &step && &lower / &step < &mean.1 + slack);
    let printed = &mean.0 + (&mean.0 - &now.mean[(0, 0)]);
    assert!(printed > &upper / &step + slack);
}

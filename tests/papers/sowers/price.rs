//! Theorem 3: how much the best affine estimate loses.

use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::nongaussian::{Component, Enclosed, InitialLaw, Posterior, Statistics, statistics};
use exact_kalman::scalar::{Dyadic, Interval, Rational, ratio};
use num_bigint::BigInt;

use super::measure::Changed;
use super::world::{Dice, Noises, World};
use super::{Q, number, scalar};

fn coin(a: i64, b: i64) -> InitialLaw<Rational> {
    InitialLaw::atoms([a, b].map(|x| (ratio(1, 2), number(ratio(x, 1))))).expect("a law")
}

fn after(model: [i64; 5], readings: &[i64]) -> Statistics<Rational> {
    statistics(&scalar(model, readings)).expect("noisy").pop().expect("the start at least")
}

fn end(dyadic: &Dyadic) -> Rational {
    dyadic.value().expect("short")
}

fn ends(found: &Enclosed) -> (Rational, Rational) {
    match found {
        Enclosed::Exact(value) => (value.clone(), value.clone()),
        Enclosed::Between(interval) => (end(interval.lower()), end(interval.upper())),
    }
}

fn decimals(found: &Enclosed, count: u32) -> String {
    let (lower, upper) = ends(found);
    let cut = |x: Rational| (x * Rational::from(BigInt::from(10).pow(count))).to_integer().to_string();
    assert_eq!(cut(lower.clone()), cut(upper), "not proved");
    cut(lower)
}

/// The trapezoidal rule in doubles for ξ = ±1, A = H = Σʷ = Σᵛ = 1, one reading: b ~ N(0, 1) under ℙ̄, X̂ = tanh b, X̂ᴷ = b/2.
/// The integrands are analytic for |Im b| < π/2, so that with steps of 1/32 the error of the rule is below 10⁻⁶⁰; what
/// is left is rounding, some 600 terms of at most 2⁻⁵³ each.
fn trapezoid(of: impl Fn(f64) -> f64) -> f64 {
    (-640..=640).map(|i| of(f64::from(i) / 32.0)).sum::<f64>() / 32.0
}

/// SM-epsilon, SM-T3, SM-4.30: ξ = ±1 with A = H = Σʷ = Σᵛ = 1 after one reading: ε = E(tanh Y − Y/2)² = 0.0504004907933….
///
/// Erratum SM-T3-proof: the square is on the numerator only: over the whole quotient under Ē the value is 0.0385890….
#[test]
fn the_price_of_a_coin() {
    let now = after([1, 1, 1, 0, 1], &[0]);
    let found = now.price_of_linearity(&coin(-1, 1), 60).expect("one direction");
    assert_eq!(decimals(&found, 13), "504004907933");
    // N = (tanh b − b/2) D, D = exp(−½) cosh b, b ~ N(0, 1) under ℙ̄.
    let normal = |b: f64| (-b * b / 2.0).exp() / std::f64::consts::TAU.sqrt();
    let quotient = |b: f64| b.tanh() - b / 2.0;
    let d = |b: f64| (-0.5_f64).exp() * b.cosh();
    let right = trapezoid(|b| quotient(b).powi(2) * d(b) * normal(b));
    let printed = trapezoid(|b| quotient(b).powi(2) * normal(b));
    let (lower, upper) = ends(&found);
    let near = |value: f64| {
        let value = exact_kalman::scalar::exact_value(value).expect("finite");
        let slack = ratio(1, 10_000_000_000_000);
        &lower - &slack < value && value < &upper + &slack
    };
    assert!(near(right) && !near(printed));
    assert!((0.038_588..0.038_590).contains(&printed), "{printed}");
    assert!(&upper - &lower <= Rational::new(BigInt::from(1), BigInt::from(1) << 60));
}

/// SM-T3, SM-G, SM-A4: for a Gaussian start, a point, and H = 0 (R* = 0 for ever, and G is the unit mass at 0) the price is 0 exactly, in any
/// dimension; for two atoms z₁, z₂ exactly if Q*(z₁ − z₂) = 0 or R*(z₁ − z₂) = 0.
#[test]
fn when_the_best_estimate_is_affine() {
    let zero = Ok(Enclosed::Exact(ratio(0, 1)));
    let blind = after([2, 0, 1, 0, 1], &[3, 4]);
    assert_eq!(blind.precision(), number(ratio(0, 1)));
    assert_eq!(blind.price_of_linearity(&coin(0, 1), 40), zero);
    let mut both = [0; 4];
    for mut changed in Changed::all(&[Noises::Correlated, Noises::Standard]) {
        let world = &mut changed.world;
        let n = world.n;
        let data = vec![Matrix::zeros(world.k, 1); world.steps.len()];
        for step in [0, 1] {
            // Forgetting a direction, or not seeing one, is rare: it is made.
            let last = world.steps.last_mut().expect("one");
            if step == 1 && n > 1 {
                last.a = Matrix::from_fn(n, n, |i, j| if j == 0 { ratio(0, 1) } else { last.a[(i, j)].clone() });
            }
            for now in &world.statistics(&data)[1..] {
                let (one, other) = (changed.dice.matrix(n, 1), changed.dice.matrix(n, 1));
                for other in [other, Matrix::from_fn(n, 1, |i, _| &one[(i, 0)] + ratio(i64::from(i == 0), 1))] {
                    let away = &one - &other;
                    let law = InitialLaw::atoms([(ratio(1, 3), one.clone()), (ratio(2, 3), other)]).expect("a law");
                    let (of_q, of_r) = ((now.response() * &away).is_zero(), (now.precision() * &away).is_zero());
                    assert_eq!(now.is_linear_best(&law), of_q || of_r);
                    both[usize::from(of_q) * 2 + usize::from(of_r)] += 1;
                }
                let factor = changed.dice.matrix(n, 2);
                let gaussian = Gaussian::new(one.clone(), &factor * factor.transpose()).expect("symmetric");
                assert_eq!(now.price_of_linearity(&InitialLaw::gaussian(gaussian).expect("a law"), 40), zero);
                assert_eq!(now.price_of_linearity(&InitialLaw::atoms([(ratio(1, 1), one)]).expect("a law"), 40), zero);
            }
        }
    }
    assert!(both[..3].iter().all(|&count| count > 0), "{both:?}");
}

/// Three parts, of which one is no atom.
fn mixed(n: usize, dice: &mut Dice) -> InitialLaw<Rational> {
    let slab = Gaussian::new(dice.matrix(n, 1), Matrix::identity(n)).expect("symmetric");
    let mut point = || Gaussian::new(dice.matrix(n, 1), Matrix::zeros(n, n)).expect("symmetric");
    let parts = [(ratio(1, 2), slab), (ratio(1, 4), point()), (ratio(1, 4), point())];
    InitialLaw::mixture(parts.map(|(weight, law)| Component { weight, law })).expect("a law")
}

const BITS: u64 = 200;

fn enclosure(value: &Enclosed) -> Interval {
    match value {
        Enclosed::Exact(value) => Interval::of(value, BITS + 100),
        Enclosed::Between(interval) => interval.clone(),
    }
}

fn meet(one: &Interval, other: &Interval) -> bool {
    one.lower() <= other.upper() && other.lower() <= one.upper()
}

/// Σ pᵢ vᵢ with the enclosed probabilities.
fn averaged(posterior: &Posterior<Rational>, of: impl Fn(usize) -> Rational) -> Interval {
    let weights = posterior.weights(BITS).expect("not too small");
    weights.iter().enumerate().fold(Interval::zero(), |sum, (i, weight)| {
        sum.plus(&enclosure(weight).times(&Interval::of(&of(i), BITS + 100), BITS + 100), BITS + 100)
    })
}

/// SM-epsilon, SM-4.31: given the readings, E‖X − X̂ᴷ‖² = E‖X − X̂‖² + ‖X̂ − X̂ᴷ‖² in digits that are proved, so ε is the difference of the mean
/// squared errors; and X̂ − X̂ᴷ is Q* times the weighted mean of z − (I + ΔR*)⁻¹(ΔB̄ + μ).
#[test]
fn pythagoras() {
    for (world, mut dice) in World::all(&[Noises::Correlated]) {
        let n = world.n;
        let law = mixed(n, &mut dice);
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        let now = world.statistics(&data).pop().expect("some");
        let (posterior, linear) = (now.posterior(&law), now.linear(&law).estimate);
        let difference = posterior.difference(&now.linear(&law), BITS).expect("far from 0");
        let (mean, covariance) =
            (posterior.mean(BITS).expect("far from 0"), posterior.covariance(BITS).expect("far from 0"));
        let start = (&law.covariance() * now.precision() + Matrix::identity(n)).inverse().expect("regular")
            * (law.covariance() * &now.linear + law.mean());
        for row in 0..n {
            let estimate = Interval::of(&linear[(row, 0)], BITS + 100);
            let away = enclosure(&mean[row]).minus(&estimate, BITS + 100);
            let state = |i: usize| &posterior.components[i].state;
            let whole = averaged(&posterior, |i| {
                let off = &state(i).mean()[(row, 0)] - &linear[(row, 0)];
                &off * &off + &state(i).covariance()[(row, row)]
            });
            let parts = enclosure(&covariance[(row, row)]).plus(&away.times(&away, BITS + 100), BITS + 100);
            assert!(meet(&whole, &parts));
            let slope = averaged(&posterior, |i| {
                (now.response() * (posterior.components[i].initial.mean() - &start))[(row, 0)].clone()
            });
            assert!(meet(&away, &slope));
            assert!(meet(&enclosure(&difference[row]), &slope));
        }
    }
}

/// SM-4.30: two states, one direction seen: A = I, H = (1, 2), one reading. ξ = (±1, 0) looks like the scalar coin with Y = ±1 + V.
#[test]
fn one_direction_of_two_states() {
    use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(2, 1), Matrix::zeros(2, 2)),
        transition: Matrix::<Rational>::identity(2).into(),
        observation: Matrix::from_integers(&[[1, 2]]).into(),
        noise: Noise::Covariances {
            process: Matrix::identity(2).into(),
            cross: None,
            observation: Matrix::identity(1).into(),
        },
        input: None,
        observation_input: None,
    };
    let path = system.realised(&[Observation::complete([ratio(5, 1)])]).expect("a model");
    let now = statistics(&path).expect("noisy").pop().expect("some");
    let atoms = [1, -1].map(|x| (ratio(1, 2), Matrix::column(vec![ratio(x, 1), ratio(0, 1)])));
    let found = now.price_of_linearity(&InitialLaw::atoms(atoms).expect("a law"), 50).expect("one direction");
    assert_eq!(decimals(&found, 13), "504004907933");
}

//! 𝒯, 𝒰 and the quotient of Theorem 1 for polynomials, exponentials and half-spaces.

use exact_kalman::gaussian::{Gaussian, Polynomial};
use exact_kalman::matrix::Matrix;
use exact_kalman::nongaussian::{
    Component, DomainError, Enclosed, ExponentialSum, Functional, HalfSpace, InitialLaw, JointLaw, Posterior,
    Statistics, statistics,
};
use exact_kalman::scalar::{Dyadic, Interval, Rational, ratio};
use num_bigint::BigInt;

use super::world::{Dice, Noises, World};
use super::{Q, number, scalar};

const BITS: u64 = 120;
const WORK: u64 = 300;

fn interval(found: &Enclosed) -> Interval {
    match found {
        Enclosed::Exact(value) => Interval::of(value, WORK),
        Enclosed::Between(interval) => interval.clone(),
    }
}

fn meet(one: &Interval, other: &Interval) -> bool {
    one.lower() <= other.upper() && other.lower() <= one.upper()
}

fn value(sum: &ExponentialSum) -> Interval {
    interval(&sum.value(BITS).expect("far from 0"))
}

fn exponential(x: &Rational) -> Interval {
    Interval::exponential(x, WORK).expect("small")
}

fn dot(one: &Q, other: &Q) -> Rational {
    (one.transpose() * other)[(0, 0)].clone()
}

fn form(middle: &Q, x: &Q) -> Rational {
    dot(x, &(middle * x))
}

fn mixture(parts: Vec<(Rational, Q, Q)>) -> InitialLaw<Rational> {
    let component =
        |(weight, mean, covariance)| Component { weight, law: Gaussian::new(mean, covariance).expect("symmetric") };
    InitialLaw::mixture(parts.into_iter().map(component)).expect("a law")
}

/// xᵀDx + dᵀx + 1 with small coefficients, and some cubic term.
fn polynomial(n: usize, dice: &mut Dice) -> Polynomial<Rational> {
    let variable = |i| Polynomial::<Rational>::variable(n, i);
    let coefficients = dice.matrix(n, n + 2);
    let mut sum = Polynomial::constant(n, ratio(1, 1));
    for i in 0..n {
        sum = sum.plus(&variable(i).scaled(&coefficients[(i, n)]));
        let cube = variable(i).times(&variable(i)).times(&variable(0));
        sum = sum.plus(&cube.scaled(&coefficients[(i, n + 1)]));
        for j in 0..n {
            sum = sum.plus(&variable(i).times(&variable(j)).scaled(&coefficients[(i, j)]));
        }
    }
    sum
}

fn half_space(n: usize, dice: &mut Dice) -> HalfSpace<Rational> {
    HalfSpace { normal: dice.matrix(n, 1), offset: dice.matrix(1, 1)[(0, 0)].clone() }
}

/// P(Z ≤ c) for aᵀx of a Gaussian x, here by Φ of a fraction that encloses the standardised offset.
fn probability(law: &Gaussian<Rational>, half: &HalfSpace<Rational>) -> Interval {
    let (mean, variance) = (dot(&half.normal, law.mean()), form(law.covariance(), &half.normal));
    let away = &half.offset - mean;
    if variance == ratio(0, 1) {
        return Interval::of(&ratio(i64::from(away >= ratio(0, 1)), 1), 1);
    }
    let deviation = Interval::square_root(&variance, WORK).expect("positive");
    let standard = Interval::of(&away, WORK).over(&deviation, WORK).expect("positive");
    let at = |end: &Dyadic| Interval::normal_distribution(&end.value().expect("short"), BITS + 20).expect("small");
    at(standard.lower()).joined(&at(standard.upper()))
}

/// SM-2.9, SM-T1, SM-1.5: over atoms, against direct enumeration: each atom z has the likelihood exp(zᵀB̄ − ½ zᵀR*z) and the state the law
/// N(X̄ + Q*z, P) (both by the tests of `world`). Polynomials, exponentials and half-spaces, in random systems.
#[test]
fn atoms_by_enumeration() {
    for (world, mut dice) in World::all(&[Noises::Correlated]) {
        let n = world.n;
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        let now = world.statistics(&data).pop().expect("some");
        let atoms: Vec<(Rational, Q)> =
            [ratio(1, 2), ratio(1, 3), ratio(1, 6)].map(|w| (w, dice.matrix(n, 1))).to_vec();
        let posterior = now.posterior(&InitialLaw::atoms(atoms.clone()).expect("a law"));
        let polynomial = polynomial(n, &mut dice);
        let theta = dice.matrix(n, 1);
        let half = half_space(n, &mut dice);
        let (mut whole, mut sums) = (Interval::zero(), [Interval::zero(), Interval::zero(), Interval::zero()]);
        for (weight, z) in &atoms {
            let likelihood = exponential(&(dot(z, &now.linear) - form(&now.precision(), z) * ratio(1, 2)));
            let mass = likelihood.times(&Interval::of(weight, WORK), WORK);
            let law = Gaussian::new(&now.mean + now.response() * z, now.covariance.clone()).expect("symmetric");
            let of_theta = dot(&theta, law.mean()) + form(law.covariance(), &theta) * ratio(1, 2);
            let values = [
                Interval::of(&law.expectation(&polynomial).expect("a law"), WORK),
                exponential(&of_theta),
                probability(&law, &half),
            ];
            whole = whole.plus(&mass, WORK);
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum = sum.plus(&mass.times(&value, WORK), WORK);
            }
        }
        let measure = now.functional().expect("of a system").over(&InitialLaw::atoms(atoms).expect("a law"));
        assert_eq!(measure, posterior.measure());
        assert!(meet(&value(&measure.total()), &whole));
        assert!(meet(&value(&measure.polynomial(&polynomial)), &sums[0]));
        assert!(meet(&value(&measure.exponential(&theta)), &sums[1]));
        assert!(meet(&measure.half_space(&half, BITS).expect("not tiny"), &sums[2]));
        let quotients = sums.map(|sum| sum.over(&whole, WORK).expect("positive"));
        assert!(meet(&interval(&posterior.expectation(&polynomial, BITS).expect("far from 0")), &quotients[0]));
        assert!(meet(&interval(&posterior.moment_generating(&theta, BITS).expect("small")), &quotients[1]));
        assert!(meet(&posterior.probability(&half, BITS).expect("not tiny"), &quotients[2]));
    }
}

fn random(n: usize, dice: &mut Dice) -> InitialLaw<Rational> {
    let factor = dice.matrix(n, n);
    let slab = &factor * factor.transpose();
    mixture(vec![
        (ratio(1, 2), dice.matrix(n, 1), slab),
        (ratio(1, 4), dice.matrix(n, 1), Matrix::zeros(n, n)),
        (ratio(1, 4), dice.matrix(n, 1), Matrix::identity(n)),
    ])
}

/// SM-T1: φ = 1 gives 1, φ = xᵢ the best estimate, products of them the covariance; linear in φ, positive; θ = 0 gives 1; a
/// half-space and the opposite one share everything, less a line that has no mass; and for a Gaussian start all is the Gaussian
/// law of the Kalman predictor.
#[test]
fn what_every_expectation_is() {
    for (world, mut dice) in World::all(&[Noises::Correlated]) {
        let n = world.n;
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        let now = world.statistics(&data).pop().expect("some");
        let posterior = now.posterior(&random(n, &mut dice));
        let one = Enclosed::Exact(ratio(1, 1));
        let expectation = |g: &Polynomial<Rational>| posterior.expectation(g, BITS).expect("far from 0");
        assert_eq!(expectation(&Polynomial::constant(n, ratio(1, 1))), one);
        assert_eq!(posterior.moment_generating(&Matrix::zeros(n, 1), BITS), Ok(one));
        let mean = posterior.mean(BITS).expect("far from 0");
        let covariance = posterior.covariance(BITS).expect("far from 0");
        let variable = |i| Polynomial::<Rational>::variable(n, i);
        for i in 0..n {
            assert!(meet(&interval(&expectation(&variable(i))), &interval(&mean[i])));
            let square = interval(&expectation(&variable(i).times(&variable(i))));
            let of_mean = interval(&mean[i]).times(&interval(&mean[i]), WORK);
            assert!(meet(&square.minus(&of_mean, WORK), &interval(&covariance[(i, i)])));
        }
        let (f, g) = (polynomial(n, &mut dice), polynomial(n, &mut dice));
        let both = f.plus(&g.scaled(&ratio(3, 1)));
        let sum = interval(&expectation(&f))
            .plus(&interval(&expectation(&g)).times(&Interval::of(&ratio(3, 1), 4), WORK), WORK);
        assert!(meet(&interval(&expectation(&both)), &sum));
        assert!(!interval(&expectation(&f.times(&f))).lower().is_negative());
        let half = half_space(n, &mut dice);
        let opposite = HalfSpace { normal: half.normal.scaled(&ratio(-1, 1)), offset: -&half.offset };
        let on_the_line = posterior.components.iter().any(|part| {
            form(part.state.covariance(), &half.normal) == ratio(0, 1)
                && dot(&half.normal, part.state.mean()) == half.offset
        });
        if !on_the_line {
            let sum = [&half, &opposite].map(|half| posterior.probability(half, BITS).expect("not tiny"));
            let sum = sum[0].plus(&sum[1], WORK);
            assert!(*sum.lower() <= Dyadic::one() && Dyadic::one() <= *sum.upper(), "{sum:?}");
        }
        let factor = dice.matrix(n, 2);
        let gaussian = Gaussian::new(dice.matrix(n, 1), &factor * factor.transpose()).expect("symmetric");
        let gaussian = InitialLaw::gaussian(gaussian).expect("a law");
        let linear = now.linear(&gaussian);
        let law = Gaussian::new(linear.estimate, linear.covariance).expect("symmetric");
        let posterior = now.posterior(&gaussian);
        let expected = Enclosed::Exact(law.expectation(&f).expect("a law"));
        assert_eq!(posterior.expectation(&f, BITS), Ok(expected));
        assert!(meet(&posterior.probability(&half, BITS).expect("not tiny"), &probability(&law, &half)));
    }
}

/// SM-1.4: 𝒯 against the joint moments of the pair: along b, 𝒯φ[x, sb; Σ] = Σ sᵏ E[φ(x + X)(bᵀB)ᵏ]/k!, and for a polynomial φ this is exp(½ s²bᵀRb) times a
/// polynomial in s, whose coefficients follow. For exponentials, the pair (X, B) has the transform exp(½ uᵀΣu).
#[test]
fn the_functional_of_a_pair() {
    let mut dice = Dice(11);
    for n in [1, 2] {
        for _ in 0..5 {
            let factor = dice.matrix(2 * n, 2);
            let sigma = &factor * factor.transpose();
            let pair = JointLaw::new(&sigma).expect("a covariance");
            let (x, b, theta) = (dice.matrix(n, 1), dice.matrix(n, 1), dice.matrix(n, 1));
            let found = pair.tilted(&x, &b).exponential(&theta);
            let expected = dot(&theta, &x) + form(&sigma, &theta.above(&b)) * ratio(1, 2);
            assert_eq!(found.terms().iter().map(|term| &term.exponent).collect::<Vec<_>>(), [&expected]);
            let g = polynomial(n, &mut dice);
            let joint = Gaussian::new(x.above(&Matrix::zeros(n, 1)), sigma.clone()).expect("symmetric");
            let (long, scaled) = (
                lifted(&g, 2 * n),
                (0..n).fold(Polynomial::zero(2 * n), |sum, i| {
                    sum.plus(&Polynomial::variable(2 * n, n + i).scaled(&b[(i, 0)]))
                }),
            );
            let r = form(&sigma.block(n..2 * n, n..2 * n), &b);
            let mut power = Polynomial::constant(2 * n, ratio(1, 1));
            let mut coefficients = Vec::new();
            let mut factorial = ratio(1, 1);
            for k in 0..=3 {
                coefficients.push(joint.expectation(&long.times(&power)).expect("a law") / &factorial);
                power = power.times(&scaled);
                factorial *= ratio(k + 1, 1);
            }
            // The polynomial has the degree of φ, which is 3 at most.
            let part = |s: i64| {
                let terms = pair.tilted(&x, &b.scaled(&ratio(s, 1))).polynomial(&g);
                terms.terms().first().map_or(ratio(0, 1), |term| term.weight.clone())
            };
            for s in [-2, -1, 1, 2, 3] {
                // Σ coefficients sᵏ = part(s) exp(½ r s²) as power series: multiply by exp(−½ r s²) up to s³.
                let [c0, c1, c2, c3] = [0, 1, 2, 3].map(|k| coefficients[k].clone());
                let half = &r * ratio(1, 2);
                let series = [c0.clone(), c1.clone(), c2 - &half * &c0, c3 - half * c1];
                let sum = series.iter().rev().fold(ratio(0, 1), |sum, c| sum * ratio(s, 1) + c);
                assert_eq!(part(s), sum);
            }
        }
    }
}

/// The same polynomial in the first of more variables.
fn lifted(g: &Polynomial<Rational>, variables: usize) -> Polynomial<Rational> {
    g.terms().fold(Polynomial::zero(variables), |sum, (exponents, coefficient)| {
        let mut long = exponents.to_vec();
        long.resize(variables, 0);
        sum.plus(&Polynomial::term(coefficient.clone(), long))
    })
}

/// SM-1.5: outside the domain the functional is refused with a witness, and rightly so: for n = 1, Λ = 1, R = 2, b = 0 an atom at z adds
/// exp(½ z²), more than any law with heavy tails takes away. For the statistics of systems it never is.
#[test]
fn where_the_functional_is_finite() {
    let [zero, one, two] = [0, 1, 2].map(|x| number(ratio(x, 1)));
    let sigma = zero.block_diagonal(&two);
    let at = |b: &Q, lambda: &Q| Functional::new(&zero, b, lambda, &one, &sigma);
    assert!(matches!(at(&zero, &one), Err(DomainError::Precision(_))));
    assert_eq!(at(&one, &two), Err(DomainError::Range { witness: one.clone() }));
    assert!(at(&zero, &two).is_ok() && at(&one, &number(ratio(3, 1))).is_ok());
    assert!(matches!(Functional::new(&zero, &zero, &one, &one, &one), Err(DomainError::Shape)));
    let negative = number(ratio(-1, 1)).block_diagonal(&two);
    assert!(matches!(Functional::new(&zero, &zero, &two, &one, &negative), Err(DomainError::Covariance(_))));
    // 𝒯1[z, z; Σ] exp(−½ z²) = exp(z² − ½ z²): with the masses c/(1 + z⁴) of a law the terms grow.
    let pair = JointLaw::new(&sigma).expect("a covariance");
    let term = |z: i64| {
        let mass = pair.tilted(&number(ratio(z, 1)), &number(ratio(z, 1))).total();
        let exponent = &mass.terms()[0].exponent - ratio(z * z, 2);
        assert_eq!(exponent, ratio(z * z, 2));
        exponential(&exponent).over(&Interval::of(&ratio(1 + z.pow(4), 1), WORK), WORK).expect("positive")
    };
    assert!((3..20).all(|z| term(z).upper() < term(z + 1).lower()));
    for (world, mut dice) in World::all(&[Noises::Correlated, Noises::Standard]) {
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        assert!(world.statistics(&data).iter().all(|now| now.functional().is_ok()));
    }
}

fn mixed() -> (Statistics<Rational>, Posterior<Rational>) {
    let now = statistics(&scalar([1, 1, 1, 0, 2], &[1, 3])).expect("noisy").pop().expect("some");
    let part = |weight, mean, variance| (weight, number(ratio(mean, 1)), number(ratio(variance, 1)));
    let law = mixture(vec![part(ratio(1, 4), -2, 5), part(ratio(1, 2), 1, 1), part(ratio(1, 4), 3, 0)]);
    let posterior = now.posterior(&law);
    (now, posterior)
}

/// SM-2.9: {¼ N(−2, 5), ½ N(1, 1), ¼ δ₃} with A = H = Σʷ = 1, Σᵛ = 2, y = (1, 3), the digits of `functional_digits.py`: for each component the joint Gaussian
/// law of (ξ, X°(2), Y(0), Y(1)) is conditioned.
#[test]
fn digits_of_an_outside_program() {
    let (_, posterior) = mixed();
    let near = |found: &Interval, digits: &str| {
        let (whole, rest) = digits.split_once('.').expect("a decimal");
        let unit = Rational::new(BigInt::from(1), BigInt::from(10).pow(u32::try_from(rest.len()).expect("small")));
        let value = Rational::from(format!("{whole}{rest}").parse::<BigInt>().expect("digits")) * &unit;
        let [lower, upper] = [found.lower(), found.upper()].map(|end| end.value().expect("short"));
        assert!(&value - &unit <= lower && upper <= value + unit, "{digits}");
    };
    let power =
        |exponent| posterior.expectation(&Polynomial::term(ratio(1, 1), vec![exponent]), BITS).expect("far from 0");
    near(&interval(&power(1)), "2.200101215158903618455298722178");
    near(&interval(&power(4)), "97.134546150994762399817679010233");
    near(
        &interval(&posterior.moment_generating(&number(ratio(1, 2)), BITS).expect("small")),
        "3.9018267214860783879781402261791",
    );
    for (offset, digits) in [
        (ratio(1, 1), "0.20484925204562296884055421769593"),
        (ratio(-9, 1), "0.0000000000000058462299497816546487761300209491"),
    ] {
        let half = HalfSpace { normal: number(ratio(1, 1)), offset };
        near(&posterior.probability(&half, BITS).expect("not tiny"), digits);
    }
    // cos X by the real part of the characteristic function at 1 (SM-4.26).
    let [cosine, _] = posterior.characteristic(&number(ratio(1, 1))).value(BITS).expect("short");
    near(&cosine, "-0.20678319762482377770136855035961");
}

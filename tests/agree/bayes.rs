//! Best and best affine prediction from a mixture by direct Bayes: one filter, and one joint Gaussian law, for each component. Every model
//! has up to three states, three sensors and ten readings, and belongs to some of the classes that are counted.

use exact_kalman::filter::filter;
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::nongaussian::{Component, Enclosed, Evidence, InitialLaw, Posterior, PosteriorComponent, statistics};
use exact_kalman::scalar::{Interval, Rational, ratio};

type Q = Matrix<Rational>;

const MODELS: usize = 210;

/// Small integers by a linear congruence.
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % count
    }

    fn entry(&mut self) -> Rational {
        ratio(i64::try_from(self.below(5)).expect("small") - 2, 1)
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> Q {
        Matrix::from_fn(rows, columns, |_, _| self.entry())
    }
}

/// A model with its factors, its readings and a law of the start.
struct Model {
    n: usize,
    k: usize,
    a: Vec<Q>,
    h: Vec<Q>,
    /// Rows of C for the plant and the sensors, Γ = CCᵀ.
    plant: Vec<Q>,
    sensors: Vec<Q>,
    readings: Vec<Observation<Rational>>,
    start: Vec<(Rational, Q, Q)>,
}

impl Model {
    /// The classes are dealt out by the remainders of the number, so that all combinations occur.
    fn new(number: usize) -> Self {
        let mut dice = Dice(u64::try_from(number).expect("small") + 77);
        let (n, k, count) = (1 + number % 3, 1 + number / 3 % 3, 1 + number * 7 % 10);
        let (singular, nilpotent, shared) = (number.is_multiple_of(2), number % 4 == 1, !number.is_multiple_of(5));
        let (blind, gaps, degenerate) = (number % 3 == 1, number % 7 < 3, number % 11 < 7);
        let own = if singular { n - 1 } else { n };
        let zero = |rows, columns| Matrix::zeros(rows, columns);
        let mut model =
            Self { n, k, a: vec![], h: vec![], plant: vec![], sensors: vec![], readings: vec![], start: vec![] };
        for t in 0..count {
            let upper = |i: usize, j: usize| !nilpotent || i < j;
            let drawn = dice.matrix(n, n);
            model.a.push(Matrix::from_fn(n, n, |i, j| if upper(i, j) { drawn[(i, j)].clone() } else { ratio(0, 1) }));
            let seen = dice.matrix(k, n);
            model.h.push(if blind && t % 3 == 1 { zero(k, n) } else { seen });
            // The sources: `own` of the plant, with a triangle, and k of the sensors, with a triangle.
            let triangle =
                Matrix::from_fn(n, own, |i, j| ratio(i64::from(i == j) + i64::from(i > j), if i == j { 1 } else { 2 }));
            let of_sensors = if shared && !singular { dice.matrix(n, k) } else { zero(n, k) };
            model.plant.push(triangle.beside(&of_sensors));
            let leaked = if shared { dice.matrix(k, own) } else { zero(k, own) };
            let diagonal = 1 + i64::try_from(dice.below(2)).expect("small");
            let own_noise = Matrix::from_fn(k, k, |i, j| ratio(if i == j { diagonal } else { i64::from(i > j) }, 1));
            model.sensors.push(leaked.beside(&own_noise));
            let entries = (0..k).map(|_| (!gaps || dice.below(3) > 0).then(|| dice.entry()));
            model.readings.push(Observation::new(entries.collect()));
        }
        let none = zero(n, n);
        let factor = dice.matrix(n, if degenerate { n - 1 } else { n });
        let atoms = [dice.matrix(n, 1), dice.matrix(n, 1)];
        let slab = (ratio(1, 6), dice.matrix(n, 1), &factor * factor.transpose());
        let [one, other] = atoms;
        model.start = match number % 13 {
            // One atom alone, and one direction only: Δ is degenerate as a whole.
            0 => vec![(ratio(1, 1), one, none)],
            1 | 2 => vec![(ratio(1, 3), one.clone(), none.clone()), (ratio(2, 3), one.scaled(&ratio(-1, 2)), none)],
            _ => vec![(ratio(1, 2), one, none.clone()), (ratio(1, 3), other, none), slab],
        };
        model
    }

    fn all() -> impl Iterator<Item = Self> {
        (0..MODELS).map(Self::new)
    }

    fn path(&self, mean: &Q, covariance: &Q) -> Path<Rational> {
        let system = System {
            timing: Timing::Departing,
            initial: Initial::new(Before::Observation, mean.clone(), covariance.clone()),
            transition: Coefficient::per_step(self.a.clone()),
            observation: Coefficient::per_step(self.h.clone()),
            noise: Noise::Factors {
                process: Coefficient::per_step(self.plant.clone()),
                observation: Coefficient::per_step(self.sensors.clone()),
            },
            input: None,
            observation_input: None,
        };
        system.realised(&self.readings).unwrap_or_else(|error| panic!("{error}"))
    }

    fn law(&self) -> InitialLaw<Rational> {
        let component = |(weight, mean, covariance): &(Rational, Q, Q)| Component {
            weight: weight.clone(),
            law: Gaussian::new(mean.clone(), covariance.clone()).expect("symmetric"),
        };
        InitialLaw::mixture(self.start.iter().map(component)).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// What is known of the next state and of the readings so far: mean, covariance, νᵀS⁻¹ν and det S of all readings.
struct Known {
    mean: Q,
    covariance: Q,
    quadratic: Rational,
    determinant: Rational,
}

/// By a filter started from this law, after each reading.
fn by_filter(model: &Model, mean: &Q, covariance: &Q) -> Vec<Known> {
    let trace = filter(&model.path(mean, covariance)).unwrap_or_else(|error| panic!("{error}"));
    let (mut quadratic, mut determinant) = (ratio(0, 1), ratio(1, 1));
    let mut sums = Vec::new();
    for record in &trace.records {
        let parts = record.likelihood.as_ref().expect("a regular innovation");
        quadratic += &parts.quadratic;
        determinant *= &parts.pseudo_determinant;
        sums.push((quadratic.clone(), determinant.clone()));
    }
    let predicted = trace.records.into_iter().skip(1).map(|record| record.predicted).chain(trace.ahead);
    let known = predicted.zip(sums).map(|(moments, (quadratic, determinant))| Known {
        mean: moments.mean,
        covariance: moments.covariance,
        quadratic,
        determinant,
    });
    known.collect()
}

/// By the joint law of the last state and all readings, which are affine in the start and the sources; no recursion over covariances.
fn by_joint_law(model: &Model, mean: &Q, covariance: &Q) -> Known {
    let (n, q) = (model.n, model.plant[0].columns());
    let size = n + q * model.a.len();
    let mut state = Matrix::identity(n).beside(&Matrix::zeros(n, size - n));
    let (mut rows, mut values) = (Matrix::zeros(0, size), Vec::new());
    for (t, reading) in model.readings.iter().enumerate() {
        let source = Matrix::from_fn(q, size, |i, j| ratio(i64::from(n + q * t + i == j), 1));
        let seen = &model.h[t] * &state + &model.sensors[t] * &source;
        rows = rows.above(&seen.select_rows(&reading.present()));
        values.extend(reading.entries().iter().flatten().cloned());
        state = &model.a[t] * &state + &model.plant[t] * &source;
    }
    let all = covariance.block_diagonal(&Matrix::identity(size - n));
    let centre = mean.above(&Matrix::zeros(size - n, 1));
    let innovation = Matrix::column(values) - &rows * &centre;
    let s = rows.congruence(&all);
    let inverse = s.inverse().expect("every sensor is noisy");
    let gain = &state * &all * rows.transpose() * &inverse;
    Known {
        mean: &state * &centre + &gain * &innovation,
        covariance: state.congruence(&all) - gain * (&rows * &all * state.transpose()),
        quadratic: innovation.transpose().congruence(&inverse)[(0, 0)].clone(),
        determinant: s.determinant().expect("decided"),
    }
}

/// Each component of a conditional law is what is known from it, and differences of exponents and ratios of determinants are those of the
/// likelihoods of the readings.
fn agrees(found: &Posterior<Rational>, known: &[&Known], weights: &[Rational]) {
    let first = (&found.components[0].evidence, known[0]);
    for ((part, known), weight) in found.components.iter().zip(known).zip(weights) {
        assert_eq!((part.state.mean(), part.state.covariance()), (&known.mean, &known.covariance));
        let gained = (&part.evidence.exponent - &first.0.exponent) * ratio(2, 1);
        assert_eq!(gained, &first.1.quadratic - &known.quadratic);
        let [one, other] =
            [&part.evidence.determinant * &first.1.determinant, &known.determinant * &first.0.determinant];
        assert_eq!(one, other);
        assert_eq!(&part.evidence.weight, weight);
    }
}

/// SM-T1, SM-2.9, SM-4.2, SM-4.29, SM-LMMSE, SM-4.3: after each reading, against a filter for each component, and for the best affine estimate a filter from
/// N(μ, Δ).
#[test]
fn one_filter_for_each_component() {
    let mut classes = [0; 8];
    for model in Model::all() {
        let law = model.law();
        let runs: Vec<Vec<Known>> =
            model.start.iter().map(|(_, mean, spread)| by_filter(&model, mean, spread)).collect();
        let affine = by_filter(&model, &law.mean(), &law.covariance());
        let weights: Vec<Rational> = model.start.iter().map(|part| part.0.clone()).collect();
        // The initial belief of the path is not used.
        let path = model.path(&Matrix::zeros(model.n, 1), &Matrix::zeros(model.n, model.n));
        let all = statistics(&path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(all.len(), affine.len() + 1);
        for (t, (now, affine)) in all[1..].iter().zip(&affine).enumerate() {
            agrees(&now.posterior(&law), &runs.iter().map(|run| &run[t]).collect::<Vec<_>>(), &weights);
            let linear = now.linear(&law);
            assert_eq!((&linear.estimate, &linear.covariance), (&affine.mean, &affine.covariance));
        }
        let singular = model.plant.iter().any(|plant| plant.rank() < model.n);
        let blind = model.h.iter().any(Matrix::is_zero);
        let power = model.a.iter().fold(Matrix::identity(model.n), |all, a| a * all);
        let nilpotent = model.a.iter().all(|a| (0..model.n).all(|i| (0..=i).all(|j| a[(i, j)] == ratio(0, 1))));
        let shared = (0..model.a.len()).any(|t| !(&model.plant[t] * model.sensors[t].transpose()).is_zero());
        let missing = model.readings.iter().any(|reading| reading.present().len() < model.k);
        let degenerate = law.covariance().rank() < model.n;
        let long = model.a.len() == 10;
        assert!(!nilpotent || model.a.len() < model.n || power.is_zero());
        for (class, is_in) in classes.iter_mut().zip([
            singular,
            blind,
            nilpotent,
            shared,
            missing,
            degenerate,
            long,
            model.n == 3 && model.k == 3,
        ]) {
            *class += usize::from(is_in);
        }
    }
    assert!(classes.iter().all(|&count| count >= 20), "{classes:?}");
}

/// SM-T1, SM-2.9, SM-4.2: after the last reading, against the joint Gaussian law of it all, for up to twelve readings of a sensor. By these, weights and estimates
/// are enclosed to a hundred bits and meet those of the code, which are as narrow; fractions are the same fractions.
#[test]
fn one_joint_law_for_each_component() {
    let (mut compared, mut exact) = (0, 0);
    for model in Model::all().filter(|model| model.k * model.a.len() <= 12) {
        let law = model.law();
        let known: Vec<Known> =
            model.start.iter().map(|(_, mean, spread)| by_joint_law(&model, mean, spread)).collect();
        let weights: Vec<Rational> = model.start.iter().map(|part| part.0.clone()).collect();
        let path = model.path(&Matrix::zeros(model.n, 1), &Matrix::zeros(model.n, model.n));
        let now = statistics(&path).unwrap_or_else(|error| panic!("{error}")).pop().expect("some");
        let posterior = now.posterior(&law);
        agrees(&posterior, &known.iter().collect::<Vec<_>>(), &weights);
        let bayes = Posterior {
            components: (known.iter().zip(&weights))
                .map(|(known, weight)| PosteriorComponent {
                    evidence: Evidence {
                        weight: weight.clone(),
                        determinant: known.determinant.clone(),
                        exponent: -&known.quadratic * ratio(1, 2),
                    },
                    initial: Gaussian::standard(model.n),
                    state: Gaussian::new(known.mean.clone(), known.covariance.clone()).expect("symmetric"),
                })
                .collect(),
        };
        let numbers = |of: &Posterior<Rational>| {
            let covariance = of.covariance(100).expect("not too small");
            let parts = [of.mean(100).expect("not too small"), of.weights(100).expect("not too small")];
            [parts.concat(), covariance.entries().to_vec()].concat()
        };
        for (one, other) in numbers(&posterior).iter().zip(&numbers(&bayes)) {
            match (one, other) {
                (Enclosed::Exact(one), Enclosed::Exact(other)) => {
                    assert_eq!(one, other);
                    exact += 1;
                }
                (Enclosed::Between(one), Enclosed::Between(other)) => assert!(meet(one, other)),
                other => panic!("{other:?}"),
            }
            compared += 1;
        }
    }
    assert!(compared > 1000 && exact > 100, "{compared}, {exact}");
}

fn meet(one: &Interval, other: &Interval) -> bool {
    one.lower() <= other.upper() && other.lower() <= one.upper()
}

//! The best estimate by Bayes' rule, one Kalman predictor for each component of the start, in an arithmetic of this file: to all digits.

use exact_kalman::filter::filter;
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
use exact_kalman::nongaussian::{Average, Averages, Component, Enclosed, InitialLaw, statistics};
use exact_kalman::scalar::{Rational, ratio};
use num_bigint::BigInt;
use proptest::prelude::*;

use super::draws::draws;
use super::systems::{Kind, Q};

/// 60 digits.
const BITS: u64 = 200;

/// Fixed point: integers in units of 2^−PLACES.
const PLACES: u64 = 512;

/// exp(−400) is less than 2^−PLACES, a unit.
const SMALLEST: i64 = -400;

fn fixed(x: &Rational) -> BigInt {
    (x.numer() << PLACES) / x.denom()
}

fn times(x: &BigInt, y: &BigInt) -> BigInt {
    (x * y) >> PLACES
}

fn over(x: &BigInt, y: &BigInt) -> BigInt {
    (x << PLACES) / y
}

/// exp(x) for x ≤ 0: the reciprocal of the series of exp(|x|), none of whose terms is negative.
fn exponential(x: &Rational) -> BigInt {
    assert!(*x <= ratio(0, 1));
    if *x < ratio(SMALLEST, 1) {
        return BigInt::from(0);
    }
    let x = fixed(&-x);
    let one = BigInt::from(1) << PLACES;
    let (mut sum, mut term) = (one.clone(), one.clone());
    let mut count = 0_u32;
    while term > BigInt::from(0) {
        count += 1;
        term = times(&term, &x) / count;
        sum += &term;
    }
    over(&one, &sum)
}

/// A component after the readings: weight, Π det S, −½ Σ νᵀS⁻¹ν, and the law of the next state.
struct Predicted {
    weight: Rational,
    determinant: Rational,
    exponent: Rational,
    mean: Q,
    covariance: Q,
}

/// Kalman predictors of each next state, one for each component.
fn predicted(
    system: &System<Rational>,
    data: &[Observation<Rational>],
    law: &InitialLaw<Rational>,
) -> Result<Vec<Vec<Predicted>>, String> {
    let mut all: Vec<Vec<Predicted>> = Vec::new();
    for component in law.components() {
        let mut system = system.clone();
        let (mean, covariance) = (component.law.mean().clone(), component.law.covariance().clone());
        system.initial = Initial::new(Before::Observation, mean, covariance);
        let path = system.realised(data).map_err(|error| error.to_string())?;
        let trace = filter(&path).map_err(|error| error.to_string())?;
        let (mut determinant, mut exponent) = (ratio(1, 1), ratio(0, 1));
        let next = trace.records.iter().skip(1).map(|record| &record.predicted).chain(&trace.ahead);
        for (step, (record, next)) in trace.records.iter().zip(next).enumerate() {
            let parts = record.likelihood.as_ref().ok_or("a regular innovation has a likelihood")?;
            determinant *= &parts.pseudo_determinant;
            exponent -= &parts.quadratic * ratio(1, 2);
            if all.len() == step {
                all.push(Vec::new());
            }
            all[step].push(Predicted {
                weight: component.weight.clone(),
                determinant: determinant.clone(),
                exponent: exponent.clone(),
                mean: next.mean.clone(),
                covariance: next.covariance.clone(),
            });
        }
    }
    Ok(all)
}

/// Probabilities, mean and covariance in fixed point, and a bound for how far they are off.
struct Direct {
    weights: Vec<Rational>,
    mean: Vec<Rational>,
    covariance: Matrix<Rational>,
    error: Rational,
}

fn direct(parts: &[Predicted]) -> Direct {
    let largest = parts.iter().map(|part| &part.exponent).max().expect("a component");
    let size = |part: &Predicted| {
        let root = (fixed(&part.determinant) << PLACES).sqrt();
        over(&times(&fixed(&part.weight), &exponential(&(&part.exponent - largest))), &root)
    };
    let sizes: Vec<BigInt> = parts.iter().map(size).collect();
    let whole: BigInt = sizes.iter().sum();
    let p: Vec<BigInt> = sizes.iter().map(|size| over(size, &whole)).collect();
    let n = parts[0].mean.rows();
    let sum = |of: &dyn Fn(&Predicted) -> BigInt| -> BigInt {
        parts.iter().zip(&p).map(|(part, p)| times(p, &of(part))).sum()
    };
    let mean: Vec<BigInt> = (0..n).map(|row| sum(&|part| fixed(&part.mean[(row, 0)]))).collect();
    let covariance = Matrix::from_fn(n, n, |row, column| {
        sum(&|part| {
            let away = |row: usize| fixed(&part.mean[(row, 0)]) - &mean[row];
            fixed(&part.covariance[(row, column)]) + times(&away(row), &away(column))
        })
    });
    // Less than 2²⁰ roundings of a unit each. Each is multiplied by no more than squares of the numbers that come in, their
    // determinants among them, and of what the smallest weight is divided by.
    let bound = |of: &dyn Fn(&Predicted) -> Rational| parts.iter().map(of).fold(ratio(1, 1), |sum, x| sum + x);
    let absolute = |x: &Rational| if *x < ratio(0, 1) { -x } else { x.clone() };
    let values = bound(&|part| part.mean.entries().iter().chain(part.covariance.entries()).map(absolute).sum());
    let scales = bound(&|part| part.weight.recip() + &part.determinant + part.determinant.recip());
    let unit = Rational::new(BigInt::from(1), BigInt::from(1) << (PLACES - 20));
    let back = |x: BigInt| Rational::new(x, BigInt::from(1) << PLACES);
    Direct {
        weights: p.into_iter().map(back).collect(),
        mean: mean.into_iter().map(back).collect(),
        covariance: covariance.map(|x| back(x.clone())),
        error: unit * &values * &values * &scales * &scales,
    }
}

/// The number is enclosed as narrowly as asked, and lies where it should.
fn agrees(averages: &mut Averages<'_>, number: &Average, truth: &Rational, error: &Rational) -> Result<(), String> {
    let found = averages.enclosed(number, BITS).map_err(|error| error.to_string())?;
    let (lower, upper) = match &found {
        Enclosed::Exact(value) => (value.clone(), value.clone()),
        Enclosed::Between(interval) => match (interval.lower().value(), interval.upper().value()) {
            (Some(lower), Some(upper)) => (lower, upper),
            // Too small to be written out.
            _ if interval.upper().magnitude() < Some(-10_000) => (ratio(0, 1), ratio(0, 1)),
            _ => return Err(format!("{} is large: {interval:?}", number.quantity)),
        },
    };
    let width = (&upper - &lower) * Rational::from(BigInt::from(1) << BITS);
    if width > lower.clone().max(-&upper) && lower != upper {
        return Err(format!("{} is wide", number.quantity));
    }
    if &lower - error <= *truth && *truth <= &upper + error {
        Ok(())
    } else {
        Err(format!("{}: {truth} is not in {found:?}", number.quantity))
    }
}

const KIND: Kind = Kind { states: 3, sensors: 3, steps: 6, adapted: false, gaps: true };

proptest! {
    #![proptest_config(ProptestConfig { cases: 80, failure_persistence: None, ..ProptestConfig::default() })]

    /// SM-MMSE, SM-4.2, SM-T1: the estimate by Bayes' rule, for random systems with atoms and degenerate Gaussian laws, agrees with the
    /// enclosures to 60 digits; so do probabilities and covariance.
    #[test]
    fn enclosures_hold_what_bayes_rule_gives(draw in draws(KIND), weights in (1_i64..9, 1_i64..9, 1_i64..9)) {
        let draw = draw.with_noisy_sensors();
        let n = draw.mean.rows();
        let law = |mean: Q, covariance: Q| Gaussian::new(mean, covariance).expect("symmetric");
        let atom = |numbers: [i64; 3]| law(Matrix::from_fn(n, 1, |i, _| ratio(numbers[i], 2)), Matrix::zeros(n, n));
        let spread = law(draw.mean.clone(), &draw.initial_factor * draw.initial_factor.transpose());
        let total = weights.0 + weights.1 + weights.2;
        let components = [(weights.0, spread), (weights.1, atom([-1, 0, 1])), (weights.2, atom([1, 2, 0]))];
        let law = InitialLaw::mixture(components.map(|(w, law)| Component { weight: ratio(w, total), law })).expect("a law");
        let (system, data) = (draw.system(), draw.data());
        let path = system.realised(&data).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let all = statistics(&path).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let predicted = predicted(&system, &data, &law).map_err(TestCaseError::fail)?;
        prop_assert_eq!(predicted.len(), all.len() - 1);
        for (now, predicted) in all.iter().skip(1).zip(&predicted) {
            let direct = direct(predicted);
            let posterior = now.posterior(&law);
            let mut averages = posterior.averages();
            let numbers = averages.weights().into_iter().chain(averages.mean());
            let numbers: Vec<Average> = numbers.chain(averages.covariance().entries().iter().cloned()).collect();
            let truths = direct.weights.iter().chain(&direct.mean).chain(direct.covariance.entries());
            prop_assert_eq!(numbers.len(), 3 + n + n * n);
            for (number, truth) in numbers.iter().zip(truths) {
                agrees(&mut averages, number, truth, &direct.error).map_err(TestCaseError::fail)?;
            }
        }
    }
}

/// A system of constant matrices in departing timing: A, H, Σʷ, Σʷᵛ, Σᵛ.
fn constant([a, h, process, cross, observation]: [Q; 5]) -> System<Rational> {
    let n = a.rows();
    System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(n, 1), Matrix::zeros(n, n)),
        transition: a.into(),
        observation: h.into(),
        noise: Noise::Covariances {
            process: process.into(),
            cross: Some(cross.into()),
            observation: observation.into(),
        },
        input: None,
        observation_input: None,
    }
}

/// `numerators / denominator`
fn matrix<const C: usize>(numerators: &[[i64; C]], denominator: i64) -> Q {
    Matrix::from_integers(numerators).map(|x: &Rational| x * ratio(1, denominator))
}

/// A decimal as `-1.25e-3`, and half a unit of its last digit.
fn decimal(text: &str) -> (Rational, Rational) {
    let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let places = digits.split_once('.').map_or(0, |(_, places)| places.len());
    let exponent = exponent.parse::<i64>().expect("an exponent") - i64::try_from(places).expect("short");
    let power = Rational::from(BigInt::from(10).pow(u32::try_from(exponent.unsigned_abs()).expect("short")));
    let unit = if exponent < 0 { power.recip() } else { power };
    let digits: BigInt = digits.replace('.', "").parse().expect("digits");
    (Rational::from(digits) * &unit, unit * ratio(1, 2))
}

/// What another program says: system, law, readings, then probabilities, mean and the lower triangle of the covariance by rows.
type Known = (System<Rational>, Vec<(Rational, Q, Q)>, Vec<Vec<Rational>>, &'static [&'static str]);

fn column<const R: usize>(numerators: [i64; R], denominator: i64) -> Q {
    matrix(&numerators.map(|x| [x]), denominator)
}

fn known() -> Vec<Known> {
    let scalar = |numbers: [i64; 5]| constant(numbers.map(|x| matrix(&[[x]], 1)));
    let atom = |weight: Rational, mean: Q| {
        let n = mean.rows();
        (weight, mean, Matrix::zeros(n, n))
    };
    let correlated = constant([
        matrix(&[[6, 3], [0, -2]], 6),
        matrix(&[[1, 0], [1, 1]], 1),
        matrix(&[[1, 0], [0, 0]], 1),
        matrix(&[[1, 0], [0, 0]], 2),
        matrix(&[[4, 1], [1, 8]], 4),
    ]);
    let nilpotent = constant([
        matrix(&[[0, 1, 0], [0, 0, 1], [0, 0, 0]], 1),
        matrix(&[[1, 1, 1]], 1),
        Matrix::zeros(3, 3),
        Matrix::zeros(3, 1),
        matrix(&[[3]], 2),
    ]);
    vec![
        (
            scalar([1, 1, 1, 0, 2]),
            vec![atom(ratio(1, 2), column([0], 1)), atom(ratio(1, 2), column([1], 1))],
            vec![vec![ratio(1, 1)], vec![ratio(3, 1)]],
            &[
                "0.25287573272933045299210717583902600271568735936619",
                "0.74712426727066954700789282416097399728431264063381",
                "1.4980828448471130313385952161073159981895417604225",
                "1.7506353762337487484976190584674937415776192113993",
            ],
        ),
        (
            correlated,
            vec![
                atom(ratio(1, 3), column([0, 1], 1)),
                atom(ratio(1, 2), column([2, -1], 1)),
                (ratio(1, 6), column([-2, 1], 2), matrix(&[[2, 1], [1, 1]], 2)),
            ],
            [[ratio(1, 1), ratio(0, 1)], [ratio(-1, 2), ratio(2, 1)], [ratio(3, 2), ratio(1, 3)]].map(Vec::from).into(),
            &[
                "0.17231592203873520682286022399413385915573444305695",
                "0.78888761340241745134601037495049960138385014656863",
                "0.03879646455884734183112940105536653946041541037442",
                "1.0696178551598251577429142302720166370799326856404",
                "0.021935915158420851540765106515009188578120310812122",
                "0.86440360797665109635022494439574120586943258220826",
                "-0.00025865748284753735908628976614691381920120236607371",
                "0.00087115467427316383361948332024207058963488084702548",
            ],
        ),
        (
            nilpotent,
            vec![
                atom(ratio(1, 4), column([1, 0, 2], 1)),
                atom(ratio(1, 4), column([0, -3, 1], 1)),
                (ratio(1, 2), column([0, 0, 0], 1), matrix(&[[2, 0, 0], [0, 0, 0], [0, 0, 1]], 1)),
            ],
            vec![vec![ratio(2, 1)], vec![ratio(-1, 1)]],
            &[
                "0.08510456425108482074333235535399894470600580961653",
                "0.0082527570696703931581920519989590050822354990032248",
                "0.90664267867924478609847559264704205021175869138024",
                "0.13423541344114516703029697769978411155708815768115",
                "0",
                "0",
                "0.79718721410901474939489542365099248583905504003335",
                "0",
                "0",
                "0",
                "0",
                "0",
            ],
        ),
        (
            scalar([1, 1, 0, 0, 1]),
            vec![atom(ratio(1, 2), column([0], 1)), atom(ratio(1, 2), column([100], 1))],
            vec![vec![ratio(0, 1)]],
            &[
                "1",
                "3.3696941483089175144500323238132201679550979027293e-2172",
                "3.3696941483089175144500323238132201679550979027293e-2170",
                "3.3696941483089175144500323238132201679550979027293e-2168",
            ],
        ),
    ]
}

/// SM-MMSE, SM-4.2: to 50 digits what a program in Python gives (mpmath 1.3, 120 digits) that shares nothing with this crate: for each component
/// it writes readings and next state as a linear image of (ξ, W(1), V(1), W(2), …), conditions their joint law in fractions,
/// and then sums `weight · det^(−½) · exp(−½ νᵀS⁻¹ν)` over the components.
#[test]
fn enclosures_have_the_digits_of_another_program() {
    for (system, law, data, digits) in known() {
        let component = |(weight, mean, covariance): &(Rational, Q, Q)| Component {
            weight: weight.clone(),
            law: Gaussian::new(mean.clone(), covariance.clone()).expect("symmetric"),
        };
        let law = InitialLaw::mixture(law.iter().map(component)).expect("a law");
        let data: Vec<_> = data.into_iter().map(Observation::complete).collect();
        let all = statistics(&system.realised(&data).expect("fits")).expect("noisy");
        let posterior = all.last().expect("some").posterior(&law);
        let mut averages = posterior.averages();
        let (mean, covariance) = (averages.mean(), averages.covariance());
        let triangle = (0..mean.len()).flat_map(|row| (0..=row).map(move |column| (row, column)));
        let entries = triangle.map(|place| covariance[place].clone());
        let numbers: Vec<Average> = averages.weights().into_iter().chain(mean.iter().cloned()).chain(entries).collect();
        assert_eq!(numbers.len(), digits.len());
        for (number, text) in numbers.iter().zip(digits) {
            let (value, half) = decimal(text);
            let (lower, upper) = match averages.enclosed(number, BITS).expect("narrow") {
                Enclosed::Exact(value) => (value.clone(), value),
                Enclosed::Between(found) => {
                    (found.lower().value().expect("short"), found.upper().value().expect("short"))
                }
            };
            assert!(&value - &half <= lower && upper <= value + half, "{}: {text}", number.quantity);
        }
    }
}

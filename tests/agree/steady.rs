//! Steady states against closed forms, exact checks of what proves them, and other routes.

use exact_kalman::certify::{CertifiedFilter, SteadyEffort, SteadyState, Unproved};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing, UnifiedStep};
use exact_kalman::riccati::RiccatiMap;
use exact_kalman::scalar::{Interval, Rational, ratio};
use exact_kalman::trace::Quantity;
use exact_kalman::verify::{DyadicMatrix, Stabilising};
use num_traits::{One, Zero};

/// Small numbers from a linear congruence.
struct Draw(u64);

impl Draw {
    fn below(&mut self, count: u64) -> i64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        i64::try_from((self.0 >> 33) % count).expect("small")
    }

    fn order(&mut self, most: u64) -> usize {
        usize::try_from(1 + self.below(most)).expect("small")
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> Matrix<Rational> {
        Matrix::from_fn(rows, columns, |_, _| ratio(self.below(13) - 6, 1 + self.below(4)))
    }

    fn units(&mut self, n: usize) -> Vec<Rational> {
        (0..n).map(|_| ratio(10, 1).pow(i32::try_from(self.below(19)).expect("small") - 9)).collect()
    }

    /// Noise from factors: R may be singular or zero, Q of low rank, both may share noise. Units are up to 1e±9.
    fn step(&mut self, most: u64) -> UnifiedStep {
        let (n, m) = (self.order(most), self.order(3));
        let (units, sensors) = (self.units(n), self.units(m));
        let (up, sensor_up) = (Matrix::diagonal(&units), Matrix::diagonal(&sensors));
        let down = Matrix::diagonal(&units.iter().map(Rational::recip).collect::<Vec<_>>());
        let sources = self.order(most + 2);
        let (d, f) = (self.matrix(n, sources), self.matrix(m, sources));
        let f = if self.below(4) == 0 { Matrix::zeros(m, sources) } else { f };
        let (d, f) = (&up * d, &sensor_up * f);
        let timing = if self.below(2) == 0 { Timing::Arriving } else { Timing::Departing };
        UnifiedStep::new(
            timing,
            &up * self.matrix(n, n).scaled(&ratio(1, 2)) * &down,
            &(&sensor_up * self.matrix(m, n) * down),
            &d * d.transpose(),
            &(&d * f.transpose()),
            &f * f.transpose(),
        )
    }
}

fn ends(interval: &Interval) -> [Rational; 2] {
    [interval.lower(), interval.upper()].map(|end| end.value().expect("short"))
}

fn overlap(one: &Matrix<Interval>, other: &Matrix<Interval>) -> bool {
    one.shape() == other.shape()
        && one.entries().iter().zip(other.entries()).all(|(a, b)| {
            let ([a, b], [c, d]) = (ends(a), ends(b));
            a <= d && c <= b
        })
}

fn digits(digits: u32) -> SteadyEffort {
    SteadyEffort { digits, ..SteadyEffort::default() }
}

fn full(matrix: &DyadicMatrix, columns: usize) -> Matrix<Rational> {
    let unit = ratio(2, 1).pow(i32::try_from(matrix.exponent).expect("small"));
    Matrix::from_fn(matrix.rows.len(), columns, |i, j| Rational::from(matrix.rows[i][j].0.clone()) * &unit)
}

fn symmetric(matrix: &DyadicMatrix) -> Matrix<Rational> {
    let unit = ratio(2, 1).pow(i32::try_from(matrix.exponent).expect("small"));
    let n = matrix.rows.len();
    Matrix::from_fn(n, n, |i, j| Rational::from(matrix.rows[i.max(j)][i.min(j)].0.clone()) * &unit)
}

/// φ(P) and A − KH, by an exact inverse.
fn image(step: &UnifiedStep, covariance: &Matrix<Rational>) -> Option<(Matrix<Rational>, Matrix<Rational>)> {
    let h = &step.observation;
    let sigma = h.congruence(covariance) + &step.observation_noise;
    if !sigma.ldl().is_ok_and(|ldl| ldl.is_positive_definite()) {
        return None;
    }
    let gamma = &step.transition * covariance * h.transpose() + &step.cross_noise;
    let gain = &gamma * sigma.inverse().ok()?;
    let image = step.transition.congruence(covariance) + &step.process_noise - &gain * gamma.transpose();
    Some((image, &step.transition - gain * h))
}

/// Whether the set is mapped into itself, and closed loops in it shrink X: with exact fractions, at its ends and in the middle.
fn holds(step: &UnifiedStep, evidence: &Stabilising) -> bool {
    let [middle, gap, shape] = [&evidence.solution, &evidence.gap, &evidence.shape].map(symmetric);
    let rate_squared = Rational::from(evidence.rate_squared.mantissa.0.clone())
        * ratio(2, 1).pow(i32::try_from(evidence.rate_squared.exponent).expect("small"));
    let (lower, upper) = (&middle - &gap, &middle + &gap);
    let ends = [&lower, &middle, &upper].map(|point| image(step, point));
    let [Some(low), Some(mid), Some(high)] = &ends else { return false };
    let shrinks =
        |closed: &Matrix<Rational>| closed.congruence(&shape).loewner_le(&shape.scaled(&rate_squared)).is_ok();
    lower.loewner_le(&low.0).is_ok()
        && high.0.loewner_le(&upper).is_ok()
        && [&low.1, &mid.1, &high.1].into_iter().all(shrinks)
        && shape.ldl().is_ok_and(|ldl| ldl.is_positive_definite())
        && rate_squared < Rational::one()
}

/// s is the larger root of `h²s² + (r − a²r − h²q + 2ahc)s − (qr − c²)`.
#[test]
fn scalar_states_lie_around_the_larger_root() {
    let mut draw = Draw(1);
    let mut seen = 0;
    for _ in 0..300 {
        let mut number = || ratio(draw.below(41) - 20, 1 + draw.below(9));
        let (a, h, d, e, f) = (number(), number(), number(), number(), number());
        let (q, c, r) = (&d * &d + &e * &e, &d * &f, &f * &f);
        let of = |value: &Rational| Matrix::from_fn(1, 1, |_, _| value.clone());
        let step = UnifiedStep {
            transition: of(&a),
            observation: of(&h),
            process_noise: of(&q),
            cross_noise: of(&c),
            observation_noise: of(&r),
        };
        let Ok(state) = SteadyState::of(&step, digits(40)) else { continue };
        let [lower, upper] = ends(&state.solution[(0, 0)]);
        let linear = &r - &a * &a * &r - &h * &h * &q + ratio(2, 1) * &a * &h * &c;
        let at = |s: &Rational| &h * &h * s * s + &linear * s - (&q * &r - &c * &c);
        assert!(at(&lower) <= Rational::zero() && at(&upper) >= Rational::zero(), "{a} {h} {q} {c} {r}");
        assert!(ratio(2, 1) * &h * &h * &upper + &linear >= Rational::zero(), "the smaller root");
        assert!(&upper - &lower <= &upper * ratio(1, 10).pow(39));
        seen += 1;
    }
    assert!(seen > 250, "{seen}");
}

/// EK-T5, EK-T6: what proves a steady state holds in exact fractions, the rate bounds closed loops by Schur and Cohn, and what
/// was changed does not hold, or says something else that is true.
#[test]
fn what_proves_a_steady_state_holds_exactly() {
    let (mut seen, mut undecided, mut rejected) = (0, 0, 0);
    for seed in 0..120 {
        let mut draw = Draw(seed);
        let step = draw.step(5);
        let Ok(state) = SteadyState::of(&step, digits(20)) else {
            undecided += 1;
            continue;
        };
        if state.kept.len() < step.sensors() {
            continue;
        }
        assert!(state.digits.is_none_or(|digits| digits >= 20), "seed {seed}: {:?}", state.digits);
        assert!(holds(&step, &state.evidence), "seed {seed}");
        let middle = symmetric(&state.evidence.solution);
        let (_, closed) = image(&step, &middle).expect("regular");
        let [_, rate] =
            ends(&Interval::square_root(&state.rate_squared.value().expect("short"), 200).expect("positive"));
        assert!(closed.spectral_radius_lt(&(rate + ratio(1, 2).pow(150))), "seed {seed}");
        let gain = full(&state.evidence.gain, step.sensors());
        let exact = (&step.transition * &middle * step.observation.transpose() + &step.cross_noise)
            * (step.observation.congruence(&middle) + &step.observation_noise).inverse().expect("regular");
        let near = gain.entries().iter().zip(exact.entries()).zip(state.gain.entries());
        assert!(near.clone().all(|((_, exact), interval)| ends(interval)[0] <= *exact && *exact <= ends(interval)[1]));
        // The set moved by three of its widths.
        let mut moved = state.evidence.clone();
        let unit = moved.gap.exponent - moved.solution.exponent;
        if unit >= 0 && !symmetric(&moved.gap).is_zero() {
            for i in 0..step.states() {
                moved.solution.rows[i][i].0 += (&moved.gap.rows[i][i].0 * 3) << unit;
            }
            rejected += usize::from(!holds(&step, &moved));
        }
        let mut faster = state.evidence.clone();
        faster.rate_squared.exponent -= 4;
        rejected += usize::from(!holds(&step, &faster));
        seen += 1;
    }
    assert!(seen > 60 && undecided < 50 && rejected > 60, "{seen} proved, {undecided} undecided, {rejected} rejected");
}

/// With more digits enclosures are narrower, and all of them meet; other units say the same.
#[test]
fn more_digits_lie_within_fewer() {
    let mut seen = 0;
    for seed in 200..230 {
        let mut draw = Draw(seed);
        let step = draw.step(4);
        let states: Vec<_> =
            [10, 40, 120].iter().filter_map(|&wanted| SteadyState::of(&step, digits(wanted)).ok()).collect();
        let [few, more, many] = &states[..] else { continue };
        for (one, other) in [(few, more), (few, many), (more, many)] {
            assert!(overlap(&one.solution, &other.solution) && overlap(&one.gain, &other.gain), "seed {seed}");
        }
        let width = |state: &SteadyState, i: usize| {
            let [lower, upper] = ends(&state.solution[(i, i)]);
            upper - lower
        };
        assert!((0..step.states()).all(|i| width(many, i) <= width(more, i) && width(more, i) <= width(few, i)));
        // Seconds become nanoseconds.
        let n = step.states();
        let unit = |i: usize| ratio(10, 1).pow(if i.is_multiple_of(2) { 9 } else { -9 });
        let up = Matrix::diagonal(&(0..n).map(unit).collect::<Vec<_>>());
        let down = Matrix::diagonal(&(0..n).map(|i| unit(i).recip()).collect::<Vec<_>>());
        let other = UnifiedStep {
            transition: &up * &step.transition * &down,
            observation: &step.observation * &down,
            process_noise: up.congruence(&step.process_noise),
            cross_noise: &up * &step.cross_noise,
            observation_noise: step.observation_noise.clone(),
        };
        let other = SteadyState::of(&other, digits(40)).expect("the same in other units");
        assert!(other.digits.is_none_or(|digits| digits >= 40));
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b] = ends(&more.solution[(i, j)]);
            let [c, d] = ends(&other.solution[(i, j)]).map(|end| end / (unit(i) * unit(j)));
            assert!(a <= d && c <= b, "seed {seed}: entry ({i}, {j})");
        }
        seen += 1;
    }
    assert!(seen > 15, "{seen}");
}

/// Where the whole state is read, bounds of the room of Riccati lie around what is enclosed here; that is the filtered
/// covariance of `x(k+1) = A x(k) + v`, before the reading.
#[test]
fn bounds_of_the_map_of_riccati_surround_it() {
    for seed in 0..12 {
        let mut draw = Draw(seed);
        let n = draw.order(3);
        let transition = draw.matrix(n, n).scaled(&ratio(1, 3));
        let mut definite = || {
            let factor = draw.matrix(n, n);
            &factor * factor.transpose() + Matrix::identity(n)
        };
        let (process, noise) = (definite(), definite());
        let map = RiccatiMap::new(transition.clone(), process.clone(), noise.clone()).expect("covariances");
        let bounds = map.fixed_point(&ratio(1, 1_000_000_000), 400).expect("a fixed point");
        let step = UnifiedStep {
            transition,
            observation: Matrix::identity(n),
            process_noise: process,
            cross_noise: Matrix::zeros(n, n),
            observation_noise: noise,
        };
        let state = SteadyState::of(&step, digits(30)).expect("a steady state");
        let middle = symmetric(&state.evidence.solution);
        let gap = symmetric(&state.evidence.gap);
        assert!(bounds.lower.loewner_le(&(&middle + &gap)).is_ok(), "seed {seed}");
        assert!((&middle - &gap).loewner_le(&bounds.upper).is_ok(), "seed {seed}");
        let spread = &bounds.upper - &bounds.lower + gap.scaled(&ratio(2, 1));
        assert!((&bounds.upper - &middle).loewner_le(&spread).is_ok(), "seed {seed}");
    }
}

/// The filter of the same system, run for long, comes to rest in it: in arriving timing its filtered covariance, in departing
/// timing its predicted one.
#[test]
fn the_filter_comes_to_rest_there() {
    for timing in [Timing::Arriving, Timing::Departing] {
        let a = Matrix::from_fn(2, 2, |i, j| ratio([[9, 4], [0, 5]][i][j], 8));
        let c = Matrix::from_fn(1, 2, |_, j| ratio([1, -1][j], 2));
        let (q, s, r) = (
            Matrix::from_fn(2, 2, |i, j| ratio([[5, 2], [2, 4]][i][j], 3)),
            Matrix::from_fn(2, 1, |i, _| ratio([1, -1][i], 3)),
            Matrix::from_fn(1, 1, |_, _| ratio(2, 1)),
        );
        let step = UnifiedStep::new(timing, a.clone(), &c, q.clone(), &s, r.clone());
        let state = SteadyState::of(&step, digits(40)).expect("a steady state");
        let system = System {
            timing,
            initial: Initial::new(Before::Observation, Matrix::zeros(2, 1), Matrix::identity(2).scaled(&ratio(50, 1))),
            transition: a.into(),
            observation: c.into(),
            noise: Noise::Covariances { process: q.into(), cross: Some(s.into()), observation: r.into() },
            input: None,
            observation_input: None,
        };
        let path = system.realised(&vec![Observation::complete([ratio(0, 1)]); 400]).expect("a path");
        let last = CertifiedFilter::new(&path, 256).last().expect("a step").expect("decided");
        let known =
            if timing == Timing::Arriving { Quantity::FilteredCovariance } else { Quantity::PredictedCovariance };
        let rate =
            ends(&Interval::square_root(&state.rate_squared.value().expect("short"), 64).expect("positive"))[1].clone();
        // 0 ≤ φᵏ(P₀) − S ≤ Gᵏ(P₀ − S)Gᵏᵀ, and X is not far from the identity here: r^600 leaves room for it.
        let room = rate.pow(600) + ratio(1, 10).pow(38);
        for (one, other) in last.values[&known].entries().iter().zip(state.solution.entries()) {
            let ([a, b], [c, d]) = (ends(one), ends(other));
            assert!(a - &d <= room && c - &b <= room, "{timing:?}");
        }
        if timing == Timing::Departing {
            for (one, other) in
                last.values[&Quantity::FilteredCovariance].entries().iter().zip(state.filtered_covariance.entries())
            {
                let ([a, b], [c, d]) = (ends(one), ends(other));
                assert!(a - &d <= room && c - &b <= room);
            }
        }
    }
}

/// The digits of each covariance are those that its own intervals have, half a width as a part of a variance.
#[test]
fn digits_are_those_of_each_covariance() {
    let mut seen = [0; 3];
    for seed in 300..400 {
        let mut draw = Draw(seed);
        let step = draw.step(4);
        let effort = SteadyEffort { digits: 1, most_bits: 64 + 16 * (seed % 4), ..SteadyEffort::default() };
        let Ok(state) = SteadyState::of(&step, effort) else { continue };
        let of = |digits: Option<u32>, vanishing: &[usize], matrix: &Matrix<Interval>| {
            for i in (0..matrix.rows()).filter(|i| digits != Some(0) && !vanishing.contains(i)) {
                let [lower, upper] = ends(&matrix[(i, i)]);
                let part = digits
                    .map_or_else(Rational::zero, |digits| ratio(1, 10).pow(i32::try_from(digits).expect("small")));
                assert!(&upper - &lower <= ratio(2, 1) * part * lower, "seed {seed}: {digits:?} of entry {i}");
            }
        };
        of(state.digits, &state.vanishing, &state.solution);
        of(state.digits, &[], &state.innovation_covariance);
        of(state.filtered_digits, &state.filtered_vanishing, &state.filtered_covariance);
        of(state.open_digits, &state.open_vanishing, &state.open_covariance);
        for (count, digits) in seen.iter_mut().zip([state.digits, state.filtered_digits, state.open_digits]) {
            *count += usize::from(digits.is_some());
        }
    }
    assert!(seen.iter().all(|count| *count > 40), "{seen:?}");
}

/// Two states that hardly differ, and a third that becomes the difference: S is known to twenty digits before A S Aᵀ + Q is.
#[test]
fn digits_of_the_open_covariance_count_where_they_are_wanted() {
    let tiny = |power| ratio(1, 10).pow(power);
    let mut step = UnifiedStep {
        transition: Matrix::zeros(3, 3),
        observation: Matrix::from_fn(2, 3, |i, j| ratio(i64::from(i == j), 1)),
        process_noise: Matrix::from_fn(3, 3, |i, j| ratio(i64::from(i < 2 && j < 2), 1)),
        cross_noise: Matrix::zeros(3, 2),
        observation_noise: Matrix::identity(2).scaled(&tiny(60)),
    };
    (step.transition[(2, 0)], step.transition[(2, 1)]) = (ratio(1, 1), ratio(-1, 1));
    step.process_noise[(1, 1)] = ratio(1, 1) + tiny(30);
    step.process_noise[(2, 2)] = tiny(32);
    let of = |open| {
        let effort = SteadyEffort { digits: 20, filtered: false, open, ..SteadyEffort::default() };
        SteadyState::of(&step, effort).expect("a steady state")
    };
    let is_enough = |digits: Option<u32>| digits.is_none_or(|digits| digits >= 20);
    let found = of(false);
    assert!(is_enough(found.digits) && !is_enough(found.open_digits), "{:?} {:?}", found.digits, found.open_digits);
    let found = of(true);
    assert!(is_enough(found.digits) && is_enough(found.open_digits), "{:?} {:?}", found.digits, found.open_digits);
}

/// A sensor that repeats another changes nothing.
#[test]
fn repeated_sensors_are_left_out() {
    let number = |rows: &[&[i64]]| Matrix::from_fn(rows.len(), rows[0].len(), |i, j| ratio(rows[i][j], 1));
    let once = UnifiedStep {
        transition: number(&[&[1, 1], &[0, 1]]),
        observation: number(&[&[1, 0]]),
        process_noise: number(&[&[1, 0], &[0, 1]]),
        cross_noise: number(&[&[0], &[0]]),
        observation_noise: number(&[&[1]]),
    };
    let twice = UnifiedStep {
        observation: number(&[&[2, 0], &[1, 0]]),
        cross_noise: number(&[&[0, 0], &[0, 0]]),
        observation_noise: number(&[&[4, 2], &[2, 1]]),
        ..once.clone()
    };
    let (once, twice) =
        (SteadyState::of(&once, digits(30)).expect("once"), SteadyState::of(&twice, digits(30)).expect("twice"));
    assert_eq!(twice.kept, [0]);
    assert!(overlap(&once.solution, &twice.solution));
    assert_eq!(twice.gain.columns(), 2);
    assert_eq!(twice.gain[(0, 1)], Interval::zero());
}

/// A sensor with the row and the noise of another, but with other cross noise, is no repetition: its noise is no covariance, and
/// leaving it out would be an answer to another question.
#[test]
fn a_sensor_that_differs_in_cross_noise_alone_is_not_left_out() {
    let number = |rows: &[&[i64]]| Matrix::from_fn(rows.len(), rows[0].len(), |i, j| ratio(rows[i][j], 2));
    let of = |cross: [i64; 2]| UnifiedStep {
        transition: number(&[&[1]]),
        observation: number(&[&[2], &[2]]),
        process_noise: number(&[&[2]]),
        cross_noise: number(&[&cross]),
        observation_noise: number(&[&[2, 2], &[2, 2]]),
    };
    let repeated = SteadyState::of(&of([1, 1]), digits(20)).expect("one sensor, twice");
    assert_eq!(repeated.kept, [0]);
    let refused = SteadyState::of(&of([1, 0]), digits(20)).expect_err("two sensors, of noise that is no covariance");
    assert!(matches!(refused, Unproved::Singular { .. }), "{refused}");
}

/// What is hard for programs with doubles: each to 30 digits.
#[test]
fn hard_scalings_are_proved() {
    let number = |value: Rational| Matrix::from_fn(1, 1, |_, _| value.clone());
    let walk = |q: Rational| UnifiedStep {
        transition: number(ratio(1, 1)),
        observation: number(ratio(1, 1)),
        process_noise: number(q),
        cross_noise: number(Rational::zero()),
        observation_noise: number(ratio(1, 1)),
    };
    for power in [30, 60, 90] {
        let state = SteadyState::of(&walk(ratio(1, 10).pow(power)), digits(30)).expect("a walk");
        assert!(state.digits.is_none_or(|digits| digits >= 30));
        assert!(state.rate_squared.value().expect("short") < ratio(1, 1));
    }
    // Seen by what it does to another coordinate, in coordinates that are not its own.
    let turn = Matrix::from_fn(2, 2, |i, j| ratio([[3, 1], [2, 1]][i][j], 1));
    let back = turn.inverse().expect("regular");
    let diagonal = Matrix::diagonal(&[ratio(2, 1), ratio(1, 2)]);
    let hidden = UnifiedStep {
        transition: &turn * diagonal * &back,
        observation: Matrix::from_fn(1, 2, |_, j| [ratio(1, 1_000_000_000), ratio(1, 1)][j].clone()) * &back,
        process_noise: Matrix::identity(2),
        cross_noise: Matrix::zeros(2, 1),
        observation_noise: number(ratio(1, 1)),
    };
    let state = SteadyState::of(&hidden, digits(30)).expect("nearly unobserved");
    assert!(state.digits.is_none_or(|digits| digits >= 30));
    assert!(holds(&hidden, &state.evidence));
    // No noise at all: a growing mode is followed exactly, S = 3; a shrinking one is forgotten, S = 0.
    let silent = |a: Rational| UnifiedStep { transition: number(a), ..walk(Rational::zero()) };
    let grows = SteadyState::of(&silent(ratio(2, 1)), digits(30)).expect("grows");
    assert_eq!((grows.digits, ends(&grows.solution[(0, 0)])), (None, [ratio(3, 1), ratio(3, 1)]));
    let shrinks = SteadyState::of(&silent(ratio(1, 2)), digits(30)).expect("shrinks");
    assert_eq!((shrinks.digits, ends(&shrinks.solution[(0, 0)])), (None, [ratio(0, 1), ratio(0, 1)]));
    assert!(SteadyState::of(&silent(ratio(1, 1)), digits(30)).is_err());
    // Nothing is read.
    let blind = UnifiedStep {
        observation: Matrix::zeros(0, 1),
        cross_noise: Matrix::zeros(1, 0),
        observation_noise: Matrix::zeros(0, 0),
        ..walk(ratio(3, 4))
    };
    let blind = UnifiedStep { transition: number(ratio(1, 2)), ..blind };
    let state = SteadyState::of(&blind, digits(30)).expect("an equation of Lyapunov");
    assert_eq!(ends(&state.solution[(0, 0)]), [ratio(1, 1), ratio(1, 1)]);
}

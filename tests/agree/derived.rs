//! What follows from an enclosed step, against the exact recursion: gains, likelihoods, predictions ahead.

use std::num::NonZero;

use exact_kalman::certify::{CertifiedFilter, CertifiedStep};
use exact_kalman::filter::{StepAhead, predict_ahead};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, PathAhead, System, Timing};
use exact_kalman::scalar::{Dyadic, Interval, Logarithms, Rational, Toward, ratio};
use exact_kalman::trace::Quantity;
use num_traits::{Signed as _, Zero as _};

/// Small numbers in a sequence that looks random; the step of Steele, Lea and Flood's splittable generator.
struct Draw(u64);

impl Draw {
    fn below(&mut self, count: u64) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((z ^ (z >> 31)) % count).expect("small")
    }

    fn integer(&mut self, most: u64) -> i64 {
        i64::try_from(self.below(2 * most + 1)).expect("small") - i64::try_from(most).expect("small")
    }

    fn entry(&mut self) -> Rational {
        ratio(self.integer(6), [1, 2, 3, 4, 10][self.below(5)])
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> Matrix<Rational> {
        Matrix::from_fn(rows, columns, |_, _| self.entry())
    }

    /// 10⁻⁹ beside 10⁹.
    fn units(&mut self, n: usize) -> Matrix<Rational> {
        let unit = |draw: &mut Self| ratio(10, 1).pow(i32::try_from(draw.integer(9)).expect("small"));
        Matrix::diagonal(&(0..n).map(|_| unit(self)).collect::<Vec<_>>())
    }

    /// All rows have sums of magnitudes of at most three, so ρ ≤ 3.
    fn transition(&mut self, n: usize) -> Matrix<Rational> {
        let a = self.matrix(n, n);
        Matrix::from_fn(n, n, |i, j| {
            let sum = a.row(i).iter().fold(Rational::zero(), |sum, entry| sum + entry.abs());
            if sum > ratio(3, 1) { &a[(i, j)] * ratio(3, 1) / sum } else { a[(i, j)].clone() }
        })
    }

    fn path(&mut self) -> PathAhead<Rational> {
        const STEPS: usize = 6;
        let (n, m) = (1 + self.below(3), 1 + self.below(2));
        let (units, sensor_units) = (self.units(n), self.units(m));
        let back = Matrix::from_fn(n, n, |i, j| if i == j { units[(i, i)].recip() } else { Rational::zero() });
        let repeated = if self.below(5) == 0 {
            let more = self.matrix(1, m);
            Matrix::from_fn(m + 1, m, |i, j| {
                if i == m { more[(0, j)].clone() } else { Rational::from_integer(i64::from(i == j).into()) }
            })
        } else {
            Matrix::identity(m)
        };
        let seen = &repeated * &sensor_units;
        let timing = if self.below(2) == 0 { Timing::Arriving } else { Timing::Departing };
        let arrives = timing == Timing::Arriving && self.below(2) == 0;
        let start = if self.below(3) == 0 { Matrix::zeros(n, n) } else { &units * self.matrix(n, n) };
        let small = [ratio(1, 1), ratio(1, 10).pow(10), ratio(0, 1), ratio(1, 1)][self.below(4)].clone();
        let faint = if self.below(3) == 0 { ratio(1, 10).pow(9) } else { ratio(1, 1) };
        let varies = self.below(2) == 0;
        // Now and then even and odd states, sensors and noises have nothing to do with each other.
        let apart = self.below(3) == 0;
        let split = |matrix: Matrix<Rational>| {
            Matrix::from_fn(matrix.rows(), matrix.columns(), |i, j| {
                if apart && (i + j) % 2 == 1 { Rational::zero() } else { matrix[(i, j)].clone() }
            })
        };
        let start = split(start);
        let mut each = |steps: usize, make: &mut dyn FnMut(&mut Self) -> Matrix<Rational>| {
            if varies {
                Coefficient::per_step((0..steps).map(|_| make(self)).collect::<Vec<_>>())
            } else {
                make(self).into()
            }
        };
        let transition = each(STEPS + 3, &mut |draw| &units * split(draw.transition(n)) * &back);
        let observation = each(STEPS, &mut |draw| {
            let c = split(draw.matrix(m, n));
            &seen * Matrix::from_fn(m, n, |i, j| if j == 0 { &c[(i, j)] * &faint } else { c[(i, j)].clone() }) * &back
        });
        // One source of noise reaches both: cross noise.
        let process = each(STEPS + 3, &mut |draw| &units * split(draw.matrix(n, 3)));
        let noise = each(STEPS, &mut |draw| (&seen * split(draw.matrix(m, 3))).scaled(&small));
        let before = if arrives { Before::Transition } else { Before::Observation };
        let system = System {
            timing,
            initial: Initial::new(before, &units * self.matrix(n, 1), &start * start.transpose()),
            transition,
            observation,
            noise: Noise::Factors { process, observation: noise },
            input: None,
            observation_input: None,
        };
        let readings: Vec<_> = (0..STEPS)
            .map(|_| {
                let y = &seen * self.matrix(m, 1);
                match self.below(6) {
                    0 => Observation::missing(y.rows()),
                    1 => {
                        Observation::new(y.entries().iter().map(|y| (self.below(2) == 0).then(|| y.clone())).collect())
                    }
                    _ => Observation::complete(y.entries().to_vec()),
                }
            })
            .collect();
        let steps = NonZero::new(1 + self.below(3)).expect("one or more");
        system.realised_ahead(&readings, steps).expect("a sound system")
    }
}

/// Logarithms to three times the bits that are tested, and ln 2π.
struct Truth {
    logarithms: Logarithms,
    of_two_pi: Interval,
}

impl Truth {
    fn new() -> Self {
        let logarithms = Logarithms::new(400);
        let of = |end: &Dyadic| logarithms.of(&(end.value().expect("short") * ratio(2, 1))).expect("positive");
        let pi = Interval::pi(500);
        let of_two_pi = of(pi.lower()).joined(&of(pi.upper()));
        Self { logarithms, of_two_pi }
    }
}

/// How wide enclosures are beside the error of their middles.
#[derive(Default)]
struct Widths(std::collections::BTreeMap<&'static str, Vec<f64>>);

impl Widths {
    fn note(&mut self, name: &'static str, interval: &Interval, value: &Rational) -> Result<(), String> {
        self.between(name, interval, [value, value])
    }

    /// A number of which is known that it lies between two others that are far closer to each other than what is tested.
    fn narrow(&mut self, name: &'static str, interval: &Interval, value: &Interval) -> Result<(), String> {
        let [lower, upper] = [value.lower(), value.upper()].map(|end| end.value().expect("short"));
        self.between(name, interval, [&lower, &upper])
    }

    fn between(&mut self, name: &'static str, interval: &Interval, value: [&Rational; 2]) -> Result<(), String> {
        let ends = [interval.lower().value(), interval.upper().value()];
        let [Some(lower), Some(upper)] = ends else { return Err(format!("{name} is long")) };
        if *value[1] < lower || upper < *value[0] {
            return Err(format!("{name}: {interval:?} without {}", value[0]));
        }
        let (radius, error) = ((&upper - &lower) / ratio(2, 1), ((&upper + &lower) / ratio(2, 1) - value[0]).abs());
        if !error.is_zero() && value[0] == value[1] || error > ratio(1, 2).pow(350) {
            let parts = [Toward::Above, Toward::Below].map(|toward| Dyadic::rounded(&(&radius / &error), 60, toward));
            let double = |x: &Dyadic| exact_kalman::scalar::nearest_double(&x.value().expect("short"));
            self.0.entry(name).or_default().push(double(&parts[0]));
        }
        Ok(())
    }

    fn all(
        &mut self,
        name: &'static str,
        intervals: &Matrix<Interval>,
        values: &Matrix<Rational>,
    ) -> Result<(), String> {
        if intervals.shape() != values.shape() {
            return Err(format!("{name} is {}", intervals.shape()));
        }
        intervals
            .entries()
            .iter()
            .zip(values.entries())
            .try_for_each(|(interval, value)| self.note(name, interval, value))
    }

    /// One step: everything that the recursion has is there, and where it should be.
    fn compared(
        &mut self,
        step: &CertifiedStep,
        exact: &StepAhead<Rational>,
        truth: &Truth,
        sum: &mut Option<Interval>,
    ) -> Result<(), String> {
        let StepAhead { record, ahead } = exact;
        let derived = &step.derived;
        for (quantity, values) in &record.values() {
            let intervals = step.values.get(quantity).ok_or_else(|| format!("no {quantity}"))?;
            self.all(quantity.name(), intervals, values)?;
        }
        if !record.observed.is_empty() {
            let parts = [
                ("predicted observation", &derived.predicted_observation, &record.predicted_observation),
                ("cross covariance", &derived.cross_covariance, &record.cross_covariance),
                ("gain", &derived.gain, &record.gain),
            ];
            for (name, intervals, values) in parts {
                self.all(name, intervals.as_ref().ok_or_else(|| format!("no {name}"))?, values)?;
            }
        }
        let (found, parts) =
            (derived.likelihood.as_ref().ok_or("no likelihood")?, record.likelihood.as_ref().ok_or("none")?);
        self.note("quadratic form", &found.quadratic, &parts.quadratic)?;
        self.note("pseudo-determinant", &found.pseudo_determinant, &parts.pseudo_determinant)?;
        let log = truth.logarithms.of(&parts.pseudo_determinant).map_err(|why| why.to_string())?;
        self.narrow("log determinant", &found.log_pseudo_determinant, &log)?;
        let rank = Interval::of(&ratio(i64::try_from(parts.rank).expect("small"), 1), 64);
        let twice = log.plus(&truth.of_two_pi.times(&rank, 500), 500).plus(&Interval::of(&parts.quadratic, 500), 500);
        let exact = twice.times(&Interval::of(&ratio(-1, 2), 1), 500);
        let is_regular = parts.rank == record.observed.len();
        if found.log_likelihood.is_some() != is_regular
            || step.values.contains_key(&Quantity::LogLikelihood) != is_regular
        {
            return Err(format!("a log likelihood of rank {} for {} readings", parts.rank, record.observed.len()));
        }
        *sum = sum.take().filter(|_| is_regular).map(|sum| sum.plus(&exact, 500));
        if let Some(log) = &found.log_likelihood {
            self.narrow("log likelihood", log, &exact)?;
        }
        match (&found.sum, &*sum) {
            (Some(found), Some(exact)) => self.narrow("sum of log likelihoods", found, exact)?,
            (None, None) => {}
            _ => return Err("a sum too many or too few".into()),
        }
        if derived.ahead.len() != ahead.len() {
            return Err(format!("{} laws ahead for {}", derived.ahead.len(), ahead.len()));
        }
        derived.ahead.iter().zip(ahead).try_for_each(|(found, exact)| {
            self.all("mean ahead", &found.mean, &exact.mean)?;
            self.all("covariance ahead", &found.covariance, &exact.covariance)
        })
    }

    fn told(&self) {
        for (name, ratios) in &self.0 {
            let mut ratios = ratios.clone();
            ratios.sort_by(f64::total_cmp);
            let at = |part: usize| ratios[(ratios.len() - 1) * part / 100];
            println!("{name:24} {:7} {:10.1} {:10.1} {:12.1}", ratios.len(), at(50), at(90), at(99));
        }
    }
}

/// EK-D1, EK-D2, EK-D3: models in units from 10⁻⁹ to 10⁹, with ρ(A) up to 3, coordinates that are hardly seen, noise of readings with variance 1, 10⁻²⁰
/// or 0 shared with the state's, known starts, coefficients that vary, readings that are missing or repeated.
#[test]
fn what_follows_from_an_enclosed_step_is_enclosed() {
    let truth = Truth::new();
    let (mut widths, mut steps, mut undecided) = (Widths::default(), 0, 0);
    for seed in 0..1200 {
        let mut draw = Draw(seed);
        let path = draw.path();
        let exact = match predict_ahead(&path) {
            Ok(trace) => trace.steps,
            Err(error) => error.computed.steps,
        };
        let bits = [128, 128, 64, 24][draw.below(4)];
        let filter = CertifiedFilter::new(path.path(), bits).everything().ahead(&path);
        let mut sum = Some(Interval::zero());
        for (k, (step, exact)) in filter.zip(&exact).enumerate() {
            let Ok(step) = step else {
                undecided += 1;
                break;
            };
            widths
                .compared(&step, exact, &truth, &mut sum)
                .unwrap_or_else(|why| panic!("seed {seed}, step {k}: {why}"));
            steps += 1;
        }
    }
    println!("{steps} steps, {undecided} runs that ended undecided; width over error: number, median, 90 %, 99 %");
    widths.told();
    assert!(steps > 4000 && undecided < 600, "{steps} {undecided}");
}

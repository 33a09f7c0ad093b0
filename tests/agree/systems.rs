//! Random systems with data that they can really produce.
//!
//! Every number comes off a tape of small integers, so a failure shrinks to a system of mostly zeros.
//! The data are simulated here, step by step from CKS-1a and CKS-1b, without any code of the crate but the matrices.

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Input, Noise, Observation, Past, System, Timing};
use exact_kalman::scalar::{Rational, ratio};

pub type Q = Matrix<Rational>;

/// A coefficient that may follow the last known observation: `base + slope · y[0]`.
#[derive(Clone, Debug)]
pub struct Feedback {
    base: Q,
    slope: Option<Q>,
}

impl Feedback {
    fn value(&self, last: Option<&Rational>) -> Q {
        match (&self.slope, last) {
            (Some(slope), Some(y)) => &self.base + slope.scaled(y),
            _ => self.base.clone(),
        }
    }

    fn coefficient(&self) -> Coefficient<Rational> {
        if self.slope.is_none() {
            return self.base.clone().into();
        }
        let rule = self.clone();
        Coefficient::adapted(move |past: Past<'_, Rational>| Ok(rule.value(past.last_entry(0))))
    }
}

/// A system in factor form, with the values its sources take.
#[derive(Clone, Debug)]
pub struct Draw {
    pub timing: Timing,
    pub before: Before,
    pub mean: Q,
    /// P₀ = L Lᵀ.
    pub initial_factor: Q,
    pub a: Feedback,
    pub b: Feedback,
    pub c: Feedback,
    pub d: Feedback,
    pub f: Feedback,
    pub g: Feedback,
    /// x_0 = mean + L · initial_source.
    pub initial_source: Q,
    /// d: the coefficients of the transition into x_s follow y_{s−d}.
    pub lag: usize,
    /// One w per step.
    pub sources: Vec<Q>,
    /// Which entries are missing, per step.
    pub missing: Vec<Vec<bool>>,
}

/// Reads small integers off a tape.
pub struct Tape(std::vec::IntoIter<i8>);

impl Tape {
    pub fn new(tape: Vec<i8>) -> Self {
        Self(tape.into_iter())
    }

    fn next(&mut self) -> i8 {
        self.0.next().unwrap_or(0)
    }

    /// One of `0..count`.
    pub fn choice(&mut self, count: usize) -> usize {
        usize::from(self.next().unsigned_abs()) % count
    }

    /// Whether one in `count` came up.
    pub fn rarely(&mut self, count: usize) -> bool {
        self.choice(count) == count - 1
    }

    /// A fraction of small integers; zero about a third of the time.
    fn entry(&mut self) -> Rational {
        let numerator = i64::from(self.next() % 4);
        if self.rarely(4) {
            ratio(numerator, 1 + i64::from(self.next().unsigned_abs() % 3))
        } else {
            ratio(numerator, 1)
        }
    }

    pub fn matrix(&mut self, rows: usize, columns: usize) -> Q {
        Matrix::from_fn(rows, columns, |_, _| self.entry())
    }

    fn feedback(&mut self, rows: usize, columns: usize, adapted: bool) -> Feedback {
        let base = self.matrix(rows, columns);
        let slope = (adapted && self.rarely(2)).then(|| self.matrix(rows, columns));
        Feedback { base, slope }
    }
}

/// What kind of system to draw.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    pub states: usize,
    pub sensors: usize,
    pub steps: usize,
    /// Coefficients may follow the data.
    pub adapted: bool,
    /// Entries may be missing.
    pub gaps: bool,
}

/// The system that a tape describes; a tape that ends is continued by zeros.
pub fn draw(kind: Kind, tape: Vec<i8>) -> Draw {
    let mut tape = Tape::new(tape);
    let n = 1 + tape.choice(kind.states);
    let m = 1 + tape.choice(kind.sensors);
    let steps = 1 + tape.choice(kind.steps);
    let q = 1 + tape.choice(3);
    let timing = if tape.rarely(2) { Timing::Arriving } else { Timing::Departing };
    let before = if timing == Timing::Arriving && tape.rarely(2) { Before::Transition } else { Before::Observation };
    let rank = tape.choice(n + 1);
    let mut draw = Draw {
        timing,
        before,
        mean: tape.matrix(n, 1),
        initial_factor: tape.matrix(n, rank),
        a: tape.feedback(n, n, kind.adapted),
        b: tape.feedback(n, 1, kind.adapted),
        c: tape.feedback(m, n, kind.adapted),
        d: tape.feedback(n, q, kind.adapted),
        f: tape.feedback(m, q, kind.adapted),
        g: tape.feedback(m, 1, kind.adapted),
        initial_source: tape.matrix(rank, 1),
        lag: 1,
        sources: (0..steps).map(|_| tape.matrix(q, 1)).collect(),
        missing: (0..steps).map(|_| (0..m).map(|_| kind.gaps && tape.rarely(6)).collect()).collect(),
    };
    if m > 1 && tape.rarely(2) {
        // A sensor that repeats another one, noise included: the innovation is singular.
        for Feedback { base, slope } in [&mut draw.c, &mut draw.f, &mut draw.g] {
            for matrix in std::iter::once(base).chain(slope) {
                for j in 0..matrix.columns() {
                    matrix[(m - 1, j)] = matrix[(0, j)].clone();
                }
            }
        }
    }
    if tape.rarely(4) {
        // No noise on the sensors.
        draw.f = Feedback { base: Matrix::zeros(m, q), slope: None };
    }
    draw
}

impl Draw {
    pub fn system(&self) -> System<Rational> {
        let input = |vector: &Feedback| Some(Input { matrix: None, vector: vector.coefficient() });
        let covariance = &self.initial_factor * self.initial_factor.transpose();
        System {
            timing: self.timing,
            initial: Initial::new(self.before, self.mean.clone(), covariance),
            transition: self.a.coefficient(),
            observation: self.c.coefficient(),
            noise: Noise::Factors { process: self.d.coefficient(), observation: self.f.coefficient() },
            input: input(&self.b),
            observation_input: input(&self.g),
        }
    }

    /// The states and the complete readings that the sources produce.
    pub fn simulated(&self, initial_source: &Q, sources: &[Q]) -> (Vec<Q>, Vec<Q>) {
        let mut state = &self.mean + &self.initial_factor * initial_source;
        let (mut states, mut readings): (Vec<Q>, Vec<Q>) = (Vec::new(), Vec::new());
        for (k, w) in sources.iter().enumerate() {
            // The last of the first `count` readings, as a rule knows it: missing entries it does not.
            let known = |count: usize, readings: &[Q]| {
                let last = count.checked_sub(1)?;
                (!self.missing[last][0]).then(|| readings[last][(0, 0)].clone())
            };
            let before = known(k, &readings);
            if self.timing == Timing::Arriving && (k > 0 || self.before == Before::Transition) {
                let (a, b, d) = (&self.a, &self.b, &self.d);
                let past = known((k + 1).saturating_sub(self.lag), &readings);
                state = a.value(past.as_ref()) * &state + b.value(past.as_ref()) + d.value(past.as_ref()) * w;
            }
            let reading = self.c.value(before.as_ref()) * &state
                + self.g.value(before.as_ref())
                + self.f.value(before.as_ref()) * w;
            states.push(state.clone());
            readings.push(reading);
            if self.timing == Timing::Departing {
                let now = known((k + 2).saturating_sub(self.lag), &readings);
                let (a, b, d) = (&self.a, &self.b, &self.d);
                state = a.value(now.as_ref()) * &state + b.value(now.as_ref()) + d.value(now.as_ref()) * w;
            }
        }
        (states, readings)
    }

    /// Readings as observations, with the entries removed that are missing.
    pub fn observations(&self, readings: &[Q]) -> Vec<Observation<Rational>> {
        let rows = readings.iter().zip(&self.missing);
        let entry = |value: &Rational, missing: bool| (!missing).then(|| value.clone());
        rows.map(|(reading, missing)| {
            Observation::new(reading.entries().iter().zip(missing).map(|(y, &gone)| entry(y, gone)).collect())
        })
        .collect()
    }

    /// Observations that the system can produce.
    pub fn data(&self) -> Vec<Observation<Rational>> {
        self.observations(&self.simulated(&self.initial_source, &self.sources).1)
    }
}

impl Draw {
    /// q, the dimension of w.
    pub fn d_columns(&self) -> usize {
        self.d.base.columns()
    }
}

impl Feedback {
    /// Whether it follows the data.
    pub fn is_adapted(&self) -> bool {
        self.slope.is_some()
    }

    /// What it is without data.
    pub fn base(&self) -> &Q {
        &self.base
    }
}

impl Draw {
    /// The same system with independent noise added to every sensor, so that no observation is free of noise.
    pub fn with_noisy_sensors(mut self) -> Self {
        let (n, m) = (self.mean.rows(), self.c.base.rows());
        let widened = |feedback: &Feedback, added: &Q| Feedback {
            base: feedback.base.beside(added),
            slope: feedback.slope.as_ref().map(|slope| slope.beside(&Matrix::zeros(slope.rows(), m))),
        };
        self.d = widened(&self.d, &Matrix::zeros(n, m));
        self.f = widened(&self.f, &Matrix::identity(m));
        self.sources =
            self.sources.iter().map(|w| w.above(&Matrix::from_fn(m, 1, |i, _| w[(i % w.rows(), 0)].clone()))).collect();
        self.timing = Timing::Departing;
        self.before = Before::Observation;
        self
    }
}

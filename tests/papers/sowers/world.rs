//! Random models as affine maps of independent standard sources, and exponents of quadratics in them.
//!
//! The variables are (1, z, η, g(0), …, g(T)): a value z of ξ, a parameter η, the sources of (W°(t+1), V°(t+1)). A vector that
//! is affine in them is a matrix with one column for each. An exponent is a symmetric matrix M with the value uᵀMu.
//! Expectations and conditional expectations of exp(uᵀMu) are again exponents, by completing squares, so that equality
//! of functions is equality of matrices. Where both sides of an identity are finite measures of φ, it is enough to try
//! φ(x) = exp(ηᵀx) for every η: they are equal as soon as these are.

use std::ops::Range;

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::nongaussian::{Statistics, statistics};
use exact_kalman::scalar::{Rational, ratio};

use super::Q;
pub use crate::dice::Dice;

/// A(t), H(t), and C with Γ(t+1) = CCᵀ by its rows for the plant and for the sensors.
pub struct At {
    pub a: Q,
    pub h: Q,
    pub plant: Q,
    pub sensors: Q,
}

impl At {
    pub fn w(&self) -> Q {
        &self.plant * self.plant.transpose()
    }

    pub fn wv(&self) -> Q {
        &self.plant * self.sensors.transpose()
    }

    pub fn v(&self) -> Q {
        &self.sensors * self.sensors.transpose()
    }

    pub fn v_inverse(&self) -> Q {
        self.v().inverse().expect("SM-A2")
    }

    /// C
    pub fn both(&self) -> Q {
        self.plant.above(&self.sensors)
    }

    /// Γ
    pub fn gamma(&self) -> Q {
        self.both() * self.both().transpose()
    }

    /// ΣʷᵛΣᵛ⁻¹
    pub fn regression(&self) -> Q {
        self.wv() * self.v_inverse()
    }
}

pub struct World {
    pub n: usize,
    pub k: usize,
    /// The sources of one step.
    pub q: usize,
    pub steps: Vec<At>,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Noises {
    Correlated,
    /// Σʷᵛ = 0, Σᵛ any
    Uncorrelated,
    /// Σʷᵛ = 0, Σᵛ = I
    Standard,
}

impl World {
    pub fn random(seed: u64, noises: Noises) -> Self {
        let mut dice = Dice(seed);
        dice.below(2);
        let [n, k, count] = [3, 2, 4].map(|most| 1 + usize::try_from(dice.below(most)).expect("small"));
        let r = 1 + usize::try_from(dice.below(2)).expect("small");
        let steps = (0..count).map(|_| {
            let standard = noises == Noises::Standard;
            // A triangle with a diagonal of 1, 2 or 3 makes Σᵛ regular.
            let triangle = Matrix::from_fn(k, k, |i, j| match (i == j, standard) {
                (true, false) => ratio(1 + i64::try_from(dice.below(3)).expect("small"), 1),
                (true, true) => ratio(1, 1),
                _ => ratio(0, 1),
            });
            let correlated = noises == Noises::Correlated;
            let shared = if correlated { dice.matrix(k, r) } else { Matrix::zeros(k, r) };
            let of_sensors = if correlated { dice.matrix(n, k) } else { Matrix::zeros(n, k) };
            At {
                a: dice.matrix(n, n),
                h: dice.matrix(k, n),
                plant: dice.matrix(n, r).beside(&of_sensors),
                sensors: shared.beside(&triangle),
            }
        });
        let steps = steps.collect();
        Self { n, k, q: r + k, steps }
    }

    /// Sixteen of each kind.
    pub fn all(noises: &'static [Noises]) -> impl Iterator<Item = (Self, Dice)> {
        (1..=16).flat_map(move |seed| noises.iter().map(move |&noises| (Self::random(seed, noises), Dice(seed + 1000))))
    }

    /// One plus n plus n + k plus the sources.
    pub fn size(&self) -> usize {
        self.sources().end
    }

    pub fn sources(&self) -> Range<usize> {
        let first = 1 + 2 * self.n + self.k;
        first..first + self.q * self.steps.len()
    }

    /// The columns of g(s).
    pub fn source(&self, s: usize) -> Range<usize> {
        let first = self.sources().start + self.q * s;
        first..first + self.q
    }

    fn selector(&self, columns: Range<usize>) -> Q {
        Matrix::from_fn(columns.len(), self.size(), |i, j| ratio(i64::from(columns.start + i == j), 1))
    }

    pub fn z(&self) -> Q {
        self.selector(1..1 + self.n)
    }

    /// η for a state.
    pub fn eta(&self) -> Q {
        self.selector(1 + self.n..1 + 2 * self.n)
    }

    /// η for both noises.
    pub fn long_eta(&self) -> Q {
        self.selector(1 + self.n..1 + 2 * self.n + self.k)
    }

    pub fn g(&self, s: usize) -> Q {
        self.selector(self.source(s))
    }

    /// W°(s+1)
    pub fn plant_noise(&self, s: usize) -> Q {
        &self.steps[s].plant * self.g(s)
    }

    /// V°(s+1)
    pub fn sensor_noise(&self, s: usize) -> Q {
        &self.steps[s].sensors * self.g(s)
    }

    /// (W°(s+1), V°(s+1))
    pub fn noise(&self, s: usize) -> Q {
        self.steps[s].both() * self.g(s)
    }

    /// X°(0), …, X°(T+1) by (1.1).
    pub fn states(&self) -> Vec<Q> {
        let mut all = vec![self.z()];
        for (s, at) in self.steps.iter().enumerate() {
            all.push(&at.a * &all[s] + self.plant_noise(s));
        }
        all
    }

    /// Y(0), …, Y(T) by (1.1).
    pub fn readings(&self) -> Vec<Q> {
        self.states().iter().zip(&self.steps).enumerate().map(|(s, (x, at))| &at.h * x + self.sensor_noise(s)).collect()
    }

    /// Something affine that is known at t: it depends on 1, z and g(0), …, g(t−1).
    pub fn adapted(&self, rows: usize, t: usize, dice: &mut Dice) -> Q {
        let (n, sources) = (self.n, self.sources().start..self.source(t.min(self.steps.len() - 1)).start);
        let sources = if t == self.steps.len() { self.sources() } else { sources };
        let all = dice.matrix(rows, self.size());
        Matrix::from_fn(rows, self.size(), |i, j| {
            if j <= n || sources.contains(&j) { all[(i, j)].clone() } else { ratio(0, 1) }
        })
    }

    /// The transition matrices from 0 of (1.6), or of (1.7).
    pub fn transitions(&self, from: usize, of_initial: bool) -> Vec<Q> {
        let mut all = vec![Matrix::identity(self.n)];
        for at in &self.steps[from..] {
            let step = if of_initial { &at.a - at.regression() * &at.h } else { at.a.clone() };
            all.push(step * &all[all.len() - 1]);
        }
        all
    }

    /// Ψ(t, 0)
    pub fn psi(&self) -> Vec<Q> {
        self.transitions(0, true)
    }

    /// The model along readings, by the crate, from a known start at 0.
    pub fn path(&self, readings: &[Q]) -> Path<Rational> {
        self.path_from(readings, &Matrix::zeros(self.n, 1), &Matrix::zeros(self.n, self.n))
    }

    /// The model along readings, by the crate, from N(mean, covariance).
    pub fn path_from(&self, readings: &[Q], mean: &Q, covariance: &Q) -> Path<Rational> {
        let list = |of: fn(&At) -> Q| Coefficient::per_step(self.steps.iter().map(of));
        let system = System {
            timing: Timing::Departing,
            initial: Initial::new(Before::Observation, mean.clone(), covariance.clone()),
            transition: list(|at| at.a.clone()),
            observation: list(|at| at.h.clone()),
            noise: Noise::Covariances { process: list(At::w), cross: Some(list(At::wv)), observation: list(At::v) },
            input: None,
            observation_input: None,
        };
        let data: Vec<_> = readings.iter().map(|y| Observation::complete(y.entries().to_vec())).collect();
        system.realised(&data).unwrap_or_else(|error| panic!("{error}"))
    }

    pub fn statistics(&self, readings: &[Q]) -> Vec<Statistics<Rational>> {
        statistics(&self.path(readings)).unwrap_or_else(|error| panic!("{error}"))
    }

    /// A point: 1, z, η and values of the sources, all drawn.
    pub fn point(&self, dice: &mut Dice) -> Q {
        Matrix::identity(1).above(&dice.matrix(self.size() - 1, 1))
    }

    /// The statistics at t = 1, 2, …, T+1, with X̄ and B̄ as matrices that multiply the column of all readings.
    pub fn linear_statistics(&self) -> Vec<OfReadings> {
        let count = self.steps.len();
        let unit = |j: usize| -> Vec<Q> {
            let entry = |s: usize, i: usize| ratio(i64::from(s * self.k + i == j), 1);
            (0..count).map(|s| Matrix::from_fn(self.k, 1, |i, _| entry(s, i))).collect()
        };
        let runs: Vec<_> = (0..count * self.k).map(|j| self.statistics(&unit(j))).collect();
        let of = |t: usize, pick: fn(&Statistics<Rational>) -> &Q| {
            Matrix::from_fn(self.n, runs.len(), |i, j| pick(&runs[j][t])[(i, 0)].clone())
        };
        let all = runs[0].iter().enumerate().skip(1);
        all.map(|(t, now)| OfReadings {
            now: now.clone(),
            mean: of(t, |now| &now.mean),
            linear: of(t, |now| &now.linear),
        })
        .collect()
    }

    /// The sources in terms of the sources g(s) − C(s)ᵀχ(s) of the new measure: a matrix S such that an affine F in the
    /// old variables is F S in the new ones.
    pub fn substitution(&self, chi: &[Q]) -> Q {
        let mut all = Matrix::identity(self.size());
        for (s, (at, chi)) in self.steps.iter().zip(chi).enumerate() {
            let shifted = self.g(s) + at.both().transpose() * chi * &all;
            for (i, row) in self.source(s).enumerate() {
                for j in 0..self.size() {
                    all[(row, j)] = shifted[(i, j)].clone();
                }
            }
        }
        all
    }

    /// The exponent of the conditional expectation of exp(uᵀMu), linear in the sources, given Y = y, where Y is linear in the
    /// sources alone; in the variables (1, z, η, y).
    pub fn conditional(&self, exponent: &Q, readings: &Q) -> Q {
        let (first, size) = (self.sources().start, self.size());
        assert!(
            exponent.block(first..size, first..size).is_zero()
                && readings.block(0..readings.rows(), 0..first).is_zero()
        );
        let slope = readings.block(0..readings.rows(), first..size);
        let gain = slope.transpose() * (&slope * slope.transpose()).inverse().expect("SM-A2");
        let rest = Matrix::identity(size - first) - &gain * &slope;
        let cross = exponent.block(0..first, first..size);
        let own = exponent.block(0..first, 0..first) + cross.congruence(&rest).scaled(&ratio(2, 1));
        let with = &cross * gain;
        let corner = Matrix::zeros(readings.rows(), readings.rows());
        own.beside(&with).above(&with.transpose().beside(&corner))
    }
}

/// Statistics, with the linear ones as functions of the readings.
pub struct OfReadings {
    pub now: Statistics<Rational>,
    pub mean: Q,
    pub linear: Q,
}

/// The exponent aᵀb.
pub fn product(a: &Q, b: &Q) -> Q {
    let half = (a.transpose() * b).scaled(&ratio(1, 2));
    &half + half.transpose()
}

/// The exponent aᵀMa.
pub fn form(a: &Q, middle: &Q) -> Q {
    a.transpose().congruence(middle)
}

/// uᵀMu
pub fn value(exponent: &Q, u: &Q) -> Rational {
    form(u, exponent)[(0, 0)].clone()
}

pub fn half(exponent: &Q) -> Q {
    exponent.scaled(&ratio(1, 2))
}

pub fn negated(exponent: &Q) -> Q {
    exponent.scaled(&ratio(-1, 1))
}

/// The expectation of exp(uᵀMu) over some standard sources: exp(uᵀM'u) / √d; nothing where it is infinite.
pub fn integrated(exponent: &Q, sources: Range<usize>) -> Option<(Q, Rational)> {
    let size = exponent.rows();
    let others: Vec<usize> = (0..size).filter(|j| !sources.contains(j)).collect();
    let inner = exponent.block(sources.clone(), sources.clone()).scaled(&ratio(2, 1));
    let curvature = Matrix::identity(sources.len()) - inner;
    if !curvature.ldl().is_ok_and(|factors| factors.is_positive_definite()) {
        return None;
    }
    let cross = exponent.select(&others, &sources.clone().collect::<Vec<_>>());
    let gained = cross.congruence(&curvature.inverse().ok()?).scaled(&ratio(2, 1));
    let reduced = exponent.select(&others, &others) + gained;
    let place = |j: usize| others.iter().position(|&other| other == j);
    let whole = Matrix::from_fn(size, size, |i, j| match (place(i), place(j)) {
        (Some(i), Some(j)) => reduced[(i, j)].clone(),
        _ => ratio(0, 1),
    });
    Some((whole, curvature.determinant().ok()?))
}

/// One below the other.
pub fn stacked(parts: &[Q]) -> Q {
    let (first, rest) = parts.split_first().expect("at least one");
    rest.iter().fold(first.clone(), |all, part| all.above(part))
}

//! State and readings along a path as linear maps of what they come from.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Mode, transition_matrix};

use super::Q;
use super::draws::{mode, sizes};
use crate::dice::Dice;

/// The columns of every map here: 1, x(0) − x̂(0), w(1), …, w(n), v(0), …, v(n−1).
pub struct Sources {
    pub path: Vec<Mode<Rational>>,
    pub initial_mean: Q,
    pub initial_covariance: Q,
}

impl Sources {
    /// Any path of the given number of modes; the number of sensors changes with time.
    pub fn random(dice: &mut Dice, modes: usize) -> Self {
        let (d, _) = sizes(dice);
        Self::of_dimension(d, dice, modes)
    }

    /// The same for a given d.
    pub fn of_dimension(d: usize, dice: &mut Dice, modes: usize) -> Self {
        let mut any = || {
            let (_, m) = sizes(dice);
            mode(dice, d, m)
        };
        let path = (0..modes).map(|_| any()).collect();
        Self { path, initial_mean: dice.matrix(d, 1), initial_covariance: dice.semidefinite(d) }
    }

    pub fn d(&self) -> usize {
        self.initial_mean.rows()
    }

    fn width(&self) -> usize {
        let sensors: usize = self.path.iter().map(|mode| mode.observation().rows()).sum();
        1 + self.d() * (1 + self.path.len()) + sensors
    }

    fn unit(&self, rows: usize, from: usize) -> Q {
        Matrix::from_fn(rows, self.width(), |i, j| ratio(i64::from(from + i == j), 1))
    }

    /// x̂(0).
    pub fn start(&self) -> Q {
        Matrix::from_fn(
            self.d(),
            self.width(),
            |i, j| {
                if j == 0 { self.initial_mean[(i, 0)].clone() } else { ratio(0, 1) }
            },
        )
    }

    /// w(j), j ≥ 1.
    pub fn w(&self, j: usize) -> Q {
        self.unit(self.d(), 1 + self.d() * j)
    }

    /// v(i).
    pub fn v(&self, i: usize) -> Q {
        let sensors = |modes: &[Mode<Rational>]| -> usize { modes.iter().map(|mode| mode.observation().rows()).sum() };
        let from = 1 + self.d() * (1 + self.path.len()) + sensors(&self.path[..i]);
        self.unit(self.path[i].observation().rows(), from)
    }

    /// x(0), …, x(n).
    pub fn states(&self) -> Vec<Q> {
        let mut states = vec![self.start() + self.unit(self.d(), 1)];
        for (k, mode) in self.path.iter().enumerate() {
            states.push(mode.transition() * &states[k] + self.w(k + 1));
        }
        states
    }

    /// y(0), …, y(n−1).
    pub fn readings(&self) -> Vec<Q> {
        let states = self.states();
        self.path.iter().enumerate().map(|(k, mode)| mode.observation() * &states[k] + self.v(k)).collect()
    }

    /// Any values of all sources.
    pub fn values(&self, dice: &mut Dice) -> Q {
        Matrix::from_fn(self.width(), 1, |i, _| if i == 0 { ratio(1, 1) } else { dice.entry() })
    }

    /// ξ(i) for the window from k.
    pub fn xi(&self, k: usize, i: usize) -> Q {
        let noise = (k + 1..=i).map(|j| transition_matrix(&self.path, j..i) * self.w(j));
        noise.fold(self.v(i), |sum, term| sum + self.path[i].observation() * term)
    }

    /// The joint covariance of all sources; w(k+1) has Q(k).
    pub fn covariance(&self) -> Q {
        let noises = self.path.iter().map(Mode::process_noise).chain(self.path.iter().map(Mode::observation_noise));
        noises
            .fold(Matrix::zeros(1, 1).block_diagonal(&self.initial_covariance), |all, noise| all.block_diagonal(noise))
    }
}

//! Section 2's proof on processes of one state: everything in it computed over all paths, none of it by the library.

use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Mode, ModeProcess};
use num_traits::{One, Zero};

use super::scalar_mode;

/// Paths with their probabilities.
pub type Weighted = Vec<(Vec<usize>, Rational)>;

/// F, H, Q, R of one time, numbers.
#[derive(Clone)]
pub struct Numbers {
    pub f: Rational,
    pub h: Rational,
    pub q: Rational,
    pub r: Rational,
}

pub fn numbers(mode: &Mode<Rational>) -> Numbers {
    let entry = |matrix: &exact_kalman::matrix::Matrix<Rational>| matrix[(0, 0)].clone();
    Numbers {
        f: entry(mode.transition()),
        h: entry(mode.observation()),
        q: entry(mode.process_noise()),
        r: entry(mode.observation_noise()),
    }
}

/// A process of one state, h, δ and P(0).
pub struct Setting {
    pub process: ModeProcess<Rational>,
    pub h: usize,
    pub delta: Rational,
    pub start: Rational,
}

/// h = 1: a strong sensor, and with probability 1/17 a weak one; G = H² > 1/8 for the strong one only.
pub fn weak_at_times() -> Setting {
    let modes = vec![
        scalar_mode([1, 1, 1, 1].map(|n| ratio(n, 1))),
        scalar_mode([ratio(1, 1), ratio(1, 4), ratio(2, 1), ratio(1, 2)]),
    ];
    let process = ModeProcess::independent(modes, vec![ratio(16, 17), ratio(1, 17)]).expect("a law");
    Setting { process, h: 1, delta: ratio(1, 8), start: ratio(2, 1) }
}

/// h = 2: no observation twice in a row is impossible but for a weak one: after a miss comes a hit, of probability 1/80 a weak one.
pub fn missed_at_times() -> Setting {
    let modes = vec![
        scalar_mode([ratio(1, 1), ratio(0, 1), ratio(1, 1), ratio(1, 1)]),
        scalar_mode([ratio(-1, 2), ratio(2, 1), ratio(1, 2), ratio(1, 3)]),
        scalar_mode([ratio(1, 1), ratio(1, 8), ratio(1, 1), ratio(1, 1)]),
    ];
    let chain = exact_kalman::matrix::Matrix::from_rows(vec![
        vec![ratio(0, 1), ratio(79, 80), ratio(1, 80)],
        vec![ratio(1, 2), ratio(79, 160), ratio(1, 160)],
        vec![ratio(0, 1), ratio(1, 1), ratio(0, 1)],
    ])
    .expect("three rows");
    let process = ModeProcess::markov(modes, vec![ratio(1, 2), ratio(1, 2), ratio(0, 1)], chain).expect("a chain");
    Setting { process, h: 2, delta: ratio(1, 4), start: ratio(1, 3) }
}

impl Setting {
    /// All paths of so many modes, with their probabilities.
    pub fn paths(&self, length: usize) -> Weighted {
        self.continuations(&[], length)
    }

    /// All continuations of a path by so many modes, with their conditional probabilities; the modes of the path are left out.
    pub fn continuations(&self, path: &[usize], length: usize) -> Weighted {
        let mut found = vec![(path.to_vec(), Rational::one())];
        for _ in 0..length {
            let extended = found.iter().flat_map(|(path, weight)| {
                (0..self.process.modes().len()).map(move |mode| {
                    let probability = match path.last() {
                        Some(&last) => &self.process.transition()[(last, mode)],
                        None => &self.process.initial()[mode],
                    };
                    (path.iter().copied().chain([mode]).collect(), weight * probability)
                })
            });
            found = extended.filter(|(_, weight): &(Vec<usize>, Rational)| !weight.is_zero()).collect();
        }
        found.into_iter().map(|(whole, weight)| (whole[path.len()..].to_vec(), weight)).collect()
    }

    pub fn at(&self, path: &[usize], time: usize) -> Numbers {
        numbers(&self.process.modes()[path[time]])
    }

    /// Φ(i, j), i ≥ j.
    pub fn phi(&self, path: &[usize], i: usize, j: usize) -> Rational {
        (j..i).map(|time| self.at(path, time).f).fold(Rational::one(), |product, f| product * f)
    }

    /// G of the window that begins at a time.
    pub fn gramian(&self, path: &[usize], begin: usize) -> Rational {
        let term = |i: usize| (self.phi(path, i, begin) * self.at(path, i).h).pow(2);
        (begin..begin + self.h).map(term).sum()
    }

    pub fn good(&self, path: &[usize], begin: usize) -> bool {
        self.gramian(path, begin) > self.delta
    }

    /// P(0), …, P(n) on a path of n modes.
    pub fn variances(&self, path: &[usize]) -> Vec<Rational> {
        let mut variances = vec![self.start.clone()];
        for time in 0..path.len() {
            let Numbers { f, h, q, r } = self.at(path, time);
            let p = &variances[time];
            variances.push(&f * &f * p * &r / (&h * &h * p + &r) + q);
        }
        variances
    }

    /// F(1 − LH) on a path.
    pub fn closed_loop(&self, path: &[usize]) -> Vec<Rational> {
        let variances = self.variances(path);
        let factor = |time: usize| {
            let Numbers { f, h, r, .. } = self.at(path, time);
            f * &r / (&h * &h * &variances[time] + &r)
        };
        (0..path.len()).map(factor).collect()
    }

    /// Q̄⁻¹(k)P(k+1) on a path.
    pub fn ratios(&self, path: &[usize]) -> Vec<Rational> {
        let variances = self.variances(path);
        let of = |time: usize| {
            let Numbers { f, h, q, r } = self.at(path, time);
            let p = &variances[time];
            let gain = p * &h / (&h * &h * p + &r);
            &variances[time + 1] / (f.pow(2) * gain.pow(2) * r + q)
        };
        (0..path.len()).map(of).collect()
    }

    /// E[z(k) | 𝒟(k)], the error variance of the observer at kh + 1, for k = 0, 1, … as far as the path goes.
    pub fn observer_variances(&self, path: &[usize]) -> Vec<Rational> {
        let mut variances = vec![self.first_observer_variance(path)];
        for begin in (1..).step_by(self.h).take_while(|begin| begin + self.h <= path.len()) {
            let before = variances.last().expect("the first one").clone();
            variances.push(self.window_variance(path, begin, &before));
        }
        variances
    }

    fn first_observer_variance(&self, path: &[usize]) -> Rational {
        if self.h == 1 {
            self.window_variance(path, 0, &self.start)
        } else {
            let Numbers { f, q, .. } = self.at(path, 0);
            f.pow(2) * &self.start + q
        }
    }

    /// WG-20 coefficient by coefficient: the error after a window, from that before it and the noises.
    pub fn window_variance(&self, path: &[usize], begin: usize, before: &Rational) -> Rational {
        let (end, good) = (begin + self.h, self.good(path, begin));
        let whole = self.phi(path, end, begin);
        let seen = if good { &whole / self.gramian(path, begin) } else { Rational::zero() };
        let of_state = (begin + 1..=end).map(|j| {
            let through = (j..end).map(|i| self.phi(path, i, begin) * self.at(path, i).h.pow(2) * self.phi(path, i, j));
            (self.phi(path, end, j) - &seen * through.sum::<Rational>()).pow(2) * self.at(path, j - 1).q
        });
        let of_observation = (begin..end).map(|i| {
            let Numbers { h, r, .. } = self.at(path, i);
            (&seen * self.phi(path, i, begin) * h).pow(2) * r
        });
        let kept = if good { Rational::zero() } else { whole.pow(2) * before };
        kept + of_state.sum::<Rational>() + of_observation.sum::<Rational>()
    }

    /// Var ξ(m) in the window that begins at a time.
    pub fn xi_variance(&self, path: &[usize], begin: usize, m: usize) -> Rational {
        let Numbers { h, r, .. } = self.at(path, m);
        h.pow(2) * self.carried_variance(path, begin, m) + r
    }

    /// Var ∑[j=begin+1..m] Φ(m, j)w(j).
    pub fn carried_variance(&self, path: &[usize], begin: usize, m: usize) -> Rational {
        (begin + 1..=m).map(|j| self.phi(path, m, j).pow(2) * self.at(path, j - 1).q).sum()
    }

    /// The least Q.
    pub fn floor(&self) -> Rational {
        self.process.modes().iter().map(|mode| numbers(mode).q).min().expect("a mode")
    }
}

/// Both settings, with √ε such that ρ₁ < 1, and as many windows as can be walked.
pub fn settings() -> [(Setting, Rational, usize); 2] {
    [(weak_at_times(), ratio(1, 4), 4), (missed_at_times(), ratio(1, 8), 3)]
}

pub fn mean<'p>(of: impl Iterator<Item = (&'p Rational, Rational)>) -> Rational {
    of.map(|(weight, value)| weight * value).sum()
}

/// The time at which window k of section 2 begins, k ≥ 1.
pub fn begin(setting: &Setting, k: usize) -> usize {
    (k - 1) * setting.h + 1
}

/// 𝒟(k−1), and for each of its paths whole continuations up to the end of window k with their conditional probabilities.
pub fn windows(setting: &Setting, k: usize) -> Vec<(Vec<usize>, Weighted)> {
    let known = setting.paths(begin(setting, k));
    let whole = |path: &Vec<usize>| {
        let rest = setting.continuations(path, setting.h).into_iter();
        rest.map(|(rest, weight)| (path.iter().copied().chain(rest).collect(), weight)).collect()
    };
    known.into_iter().map(|(path, _)| (path.clone(), whole(&path))).collect()
}

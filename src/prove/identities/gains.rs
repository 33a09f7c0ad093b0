//! Covariances of the error under any gain.

use super::path::path;
use crate::filter::filter;
use crate::matrix::Matrix;
use crate::model::{Before, Timing};
use crate::prove::body::{Body, Failure, Sides, no_value};
use crate::prove::entries::Entries;
use crate::scalar::Field;
use crate::stability::Mode;

/// A, Q, S, H, R, P and the Γ and Σ that follow.
struct Parts<F> {
    a: Matrix<F>,
    h: Matrix<F>,
    noise: Matrix<F>,
    q: Matrix<F>,
    p: Matrix<F>,
    gamma: Matrix<F>,
    sigma: Matrix<F>,
}

/// `(A − KH)P(A − KH)ᵀ + [I −K]M[I −K]ᵀ`
fn joseph<F: Field>(parts: &Parts<F>, k: &Matrix<F>) -> Matrix<F> {
    let closed = &parts.a - k * &parts.h;
    let both = Matrix::identity(parts.a.rows()).beside(&-k);
    closed.congruence(&parts.p) + both.congruence(&parts.noise)
}

/// The parts, and φ(P): what the library's filter predicts after one step.
fn parts<F: Field>([n, m, _]: [usize; 3], entries: &mut Entries<'_, F>) -> Result<(Parts<F>, Matrix<F>), Failure> {
    let path = path(Timing::Departing, Before::Observation, [n, m, 1], entries);
    let ahead = filter(&path).map_err(|error| no_value(error.source))?.ahead;
    let (Some(step), Some(next)) = (path.steps().first(), ahead) else { return Err(no_value("no step")) };
    let Some(transition) = &step.transition else { return Err(no_value("no transition")) };
    let (a, h, p) = (transition.matrix.clone(), step.observation.clone(), path.initial().covariance.clone());
    let (q, s, r) = (&transition.noise, &transition.cross_noise, &step.observation_noise);
    let noise = q.beside(s).above(&s.transpose().beside(r));
    let gamma = &a * &p * h.transpose() + s;
    let sigma = h.congruence(&p) + r;
    Ok((Parts { noise, q: q.clone(), gamma, sigma, a, h, p }, next.covariance))
}

/// Joseph's form written out, for any gain.
pub(in crate::prove) struct Joseph;

impl Body for Joseph {
    const IDENTIFIERS: &'static [&'static str] = &["EK-L1"];
    const NAME: &'static str = "Joseph's form, written out, at any gain";
    const SLIP: &'static str = "KΓᵀ is subtracted twice instead of KΓᵀ and ΓKᵀ";
    const LETTERS: &'static [&'static str] = &["n", "m"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 1, 0], [2, 1, 0], [2, 2, 0], [3, 2, 0], [4, 2, 0]];
    const RANDOM: &'static [[usize; 3]] = &[[4, 2, 0], [8, 8, 0]];

    fn sides<F: Field>(numbers: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let [n, m, _] = numbers;
        let (a, h, p) = (entries.matrix("A", n, n), entries.matrix("H", m, n), entries.symmetric("P", n));
        let noise = entries.symmetric("M", n + m);
        let k = entries.matrix("K", n, m);
        let gamma = &a * &p * h.transpose() + noise.block(0..n, n..n + m);
        let sigma = h.congruence(&p) + noise.block(n..n + m, n..n + m);
        let parts = Parts { q: noise.block(0..n, 0..n), a, h, p, noise, gamma, sigma };
        let mixed = &k * parts.gamma.transpose();
        let other = if twin { mixed.clone() } else { mixed.transpose() };
        let written = parts.a.congruence(&parts.p) + &parts.q - mixed - other + k.congruence(&parts.sigma);
        Ok(vec![(joseph(&parts, &k), written)])
    }
}

/// What any gain misses.
pub(in crate::prove) struct Squares;

impl Body for Squares {
    const IDENTIFIERS: &'static [&'static str] = &["EK-L3"];
    const NAME: &'static str = "the squares are completed, at any gain";
    const SLIP: &'static str = "Σ stands for Σ⁺";
    const LETTERS: &'static [&'static str] = &["n", "m"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 1, 0], [2, 1, 0], [1, 2, 0], [2, 2, 0], [3, 1, 0]];
    const HEAVY: &'static [[usize; 3]] = &[[3, 2, 0]];
    const RANDOM: &'static [[usize; 3]] = &[[2, 2, 0], [3, 2, 0], [4, 3, 0], [8, 4, 0]];

    fn sides<F: Field>(numbers: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (parts, next) = parts(numbers, entries)?;
        let k = entries.matrix("K", numbers[0], numbers[1]);
        let missed = &k * &parts.sigma - &parts.gamma;
        let weight = if twin { parts.sigma.clone() } else { parts.sigma.pseudo_inverse().map_err(no_value)? };
        Ok(vec![(joseph(&parts, &k) - next, missed.congruence(&weight))])
    }
}

/// Joseph's form at the gain of the filter is what the filter computes.
pub(in crate::prove) struct OptimalGain;

impl Body for OptimalGain {
    const IDENTIFIERS: &'static [&'static str] = &["EK-L3", "HV-4"];
    const NAME: &'static str = "Joseph's form = the plain form at the gain of the filter";
    const SLIP: &'static str = "the gain without the shared noise";
    const LETTERS: &'static [&'static str] = &["n", "m"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 1, 0], [2, 1, 0], [1, 2, 0], [3, 1, 0]];
    const HEAVY: &'static [[usize; 3]] = &[[2, 2, 0]];
    const RANDOM: &'static [[usize; 3]] = &[[2, 2, 0], [3, 2, 0], [4, 3, 0], [8, 4, 0]];

    fn sides<F: Field>(numbers: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (parts, next) = parts(numbers, entries)?;
        let gamma = if twin { &parts.a * &parts.p * parts.h.transpose() } else { parts.gamma.clone() };
        let k = gamma * parts.sigma.pseudo_inverse().map_err(no_value)?;
        Ok(vec![(joseph(&parts, &k), next)])
    }
}

/// One step of the random Riccati equation, in the form of Lyapunov.
pub(in crate::prove) struct Lyapunov;

impl Body for Lyapunov {
    const IDENTIFIERS: &'static [&'static str] = &["WG-52", "WG-53", "WG-1"];
    const NAME: &'static str = "the form of Lyapunov = the equation of Riccati";
    const SLIP: &'static str = "Q stands for Q̄: the noise that the gain lets in is dropped";
    const LETTERS: &'static [&'static str] = &["d", "m"];
    const SYMBOLIC: &'static [[usize; 3]] = &[[1, 1, 0], [2, 1, 0], [1, 2, 0], [2, 2, 0], [3, 1, 0]];
    const RANDOM: &'static [[usize; 3]] = &[[3, 2, 0], [4, 3, 0], [8, 4, 0]];

    fn sides<F: Field>([d, m, _]: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (f, h) = (entries.matrix("F", d, d), entries.matrix("H", m, d));
        let (q, r, p) = (entries.symmetric("Q", d), entries.symmetric("R", m), entries.symmetric("P", d));
        let mode = Mode::from_parts(f.clone(), h.clone(), q.clone(), r.clone());
        let step = mode.step(&p);
        let seen = &h * &p * f.transpose();
        let bracket = (h.congruence(&p) + r).solve(&seen).map_err(no_value)?;
        let riccati = f.congruence(&p) - seen.transpose() * bracket + &q;
        let noise = if twin { q } else { step.noise.clone() };
        Ok(vec![
            (step.next.clone(), riccati.clone()),
            (step.closed_loop.congruence(&p) + noise, riccati),
            (mode.lyapunov(&p, &step.gain), step.next),
        ])
    }
}

//! Covariances of the error under any gain.

use super::path::{changed, path, singular_path};
use crate::filter::filter;
use crate::matrix::Matrix;
use crate::model::{Observation, Path, Timing};
use crate::prove::body::{Body, Failure, Numbers, Sides, no_value};
use crate::prove::entries::Entries;
use crate::scalar::Field;
use crate::stability::Mode;
use crate::trace::{Moments, Record};

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

/// What the library's filter makes of one step.
struct Filtered<F> {
    parts: Parts<F>,
    record: Record<F>,
    /// φ(P) is its covariance.
    next: Moments<F>,
}

fn filtered<F: Field>(path: &Path<F>) -> Result<Filtered<F>, Failure> {
    let trace = filter(path).map_err(|error| no_value(error.source))?;
    let (Some(step), Some(record), Some(next)) = (path.steps().first(), trace.records.first(), trace.ahead) else {
        return Err(no_value("no step"));
    };
    let Some(transition) = &step.transition else { return Err(no_value("no transition")) };
    let (a, h, p) = (transition.matrix.clone(), step.observation.clone(), path.initial().covariance.clone());
    let (q, s, r) = (&transition.noise, &transition.cross_noise, &step.observation_noise);
    let noise = q.beside(s).above(&s.transpose().beside(r));
    let gamma = &a * &p * h.transpose() + s;
    let sigma = h.congruence(&p) + r;
    let parts = Parts { noise, q: q.clone(), gamma, sigma, a, h, p };
    Ok(Filtered { parts, record: record.clone(), next })
}

/// The gain of the filter's prediction: how far its mean moves with each entry of the reading.
fn gain_of_prediction<F: Field>(path: &Path<F>, next: &Moments<F>) -> Result<Matrix<F>, Failure> {
    let mut gain = Matrix::zeros(path.states(), 0);
    for place in 0..path.sensors() {
        let moved = changed(path, |step| {
            let mut values = step.reading.values();
            values[(place, 0)] = values[(place, 0)].plus(&F::one());
            step.reading = Observation::complete(values.entries().to_vec());
        });
        gain = gain.beside(&(filtered(&moved)?.next.mean - &next.mean));
    }
    Ok(gain)
}

/// Joseph's form written out, for any gain.
pub(in crate::prove) struct Joseph;

impl Body for Joseph {
    const IDENTIFIERS: &'static [&'static str] = &["EK-L1"];
    const NAME: &'static str = "Joseph's form, written out, at any gain";
    const WHERE: &'static str = "P and M are symmetric";
    const SLIP: &'static str = "KΓᵀ is subtracted twice instead of KΓᵀ and ΓKᵀ";
    const LETTERS: &'static [&'static str] = &["n", "m"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1], &[2, 1], &[2, 2], &[3, 2], &[4, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[4, 2], &[8, 8]];

    fn sides<F: Field>(numbers: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let [n, m, ..] = numbers;
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
    const WHERE: &'static str = "Σ is regular";
    const SLIP: &'static str = "Σ stands for Σ⁺";
    const LETTERS: &'static [&'static str] = &["n", "m"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1], &[2, 1], &[1, 2], &[2, 2], &[3, 1]];
    const HEAVY: &'static [&'static [usize]] = &[&[3, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 2], &[3, 2], &[4, 3], &[8, 4]];

    fn sides<F: Field>([n, m, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        squares(&path(Timing::Departing, [n, m, 1, 0, 0], entries), twin, entries)
    }
}

fn squares<F: Field>(path: &Path<F>, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
    let Filtered { parts, next, .. } = filtered(path)?;
    let k = entries.matrix("K", path.states(), path.sensors());
    let missed = &k * &parts.sigma - &parts.gamma;
    let weight = if twin { parts.sigma.clone() } else { parts.sigma.pseudo_inverse().map_err(no_value)? };
    Ok(vec![(joseph(&parts, &k) - next.covariance, missed.congruence(&weight))])
}

/// The same where Σ is singular.
pub(in crate::prove) struct SingularSquares;

impl Body for SingularSquares {
    const IDENTIFIERS: &'static [&'static str] = Squares::IDENTIFIERS;
    const NAME: &'static str = "the squares are completed, at any gain (singular Σ)";
    const WHERE: &'static str = "Σ has that rank, and P is zero in the known directions";
    const SLIP: &'static str = Squares::SLIP;
    const LETTERS: &'static [&'static str] = &["n", "m", "rank", "known"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 2, 1, 0], &[2, 2, 1, 0], &[2, 2, 1, 1]];
    const HEAVY: &'static [&'static [usize]] = &[&[1, 3, 2, 0]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 2, 1, 1], &[3, 3, 2, 1], &[8, 4, 2, 3]];

    fn sides<F: Field>(
        [n, m, rank, known, _]: Numbers,
        twin: bool,
        entries: &mut Entries<'_, F>,
    ) -> Result<Sides<F>, Failure> {
        squares(&singular_path(Timing::Departing, [n, m, 1, rank, known], entries), twin, entries)
    }
}

/// Joseph's form at the gain of the filter is what the filter computes.
pub(in crate::prove) struct OptimalGain;

impl Body for OptimalGain {
    const IDENTIFIERS: &'static [&'static str] = &["EK-L3", "HV-4"];
    const NAME: &'static str = "Joseph's form at the gain of the filter = what the filter computes";
    const WHERE: &'static str = "Σ is regular";
    const SLIP: &'static str = "the gain without the shared noise";
    const LETTERS: &'static [&'static str] = &["n", "m"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1], &[2, 1], &[1, 2], &[3, 1]];
    const HEAVY: &'static [&'static [usize]] = &[&[2, 2]];
    const RANDOM: &'static [&'static [usize]] = &[&[2, 2], &[3, 2], &[4, 3], &[8, 4]];

    fn sides<F: Field>([n, m, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let path = path(Timing::Departing, [n, m, 1, 0, 0], entries);
        let Filtered { parts, record, next } = filtered(&path)?;
        let k = if twin { &parts.a * &record.gain } else { gain_of_prediction(&path, &next)? };
        let kept = Matrix::identity(n) - &record.gain * &parts.h;
        let noise = parts.noise.block(n..n + m, n..n + m);
        Ok(vec![
            (joseph(&parts, &k), next.covariance),
            (kept.congruence(&parts.p) + record.gain.congruence(&noise), record.filtered.covariance),
        ])
    }
}

/// One step of the random Riccati equation, in the form of Lyapunov.
pub(in crate::prove) struct Lyapunov;

impl Body for Lyapunov {
    const IDENTIFIERS: &'static [&'static str] = &["WG-52", "WG-53", "WG-1"];
    const NAME: &'static str = "the form of Lyapunov = the equation of Riccati";
    const WHERE: &'static str = "HPHᵀ + R is regular";
    const SLIP: &'static str = "Q stands for Q̄: the noise that the gain lets in is dropped";
    const LETTERS: &'static [&'static str] = &["d", "m"];
    const SYMBOLIC: &'static [&'static [usize]] = &[&[1, 1], &[2, 1], &[1, 2], &[2, 2], &[3, 1]];
    const RANDOM: &'static [&'static [usize]] = &[&[3, 2], &[4, 3], &[8, 4]];

    fn sides<F: Field>([d, m, ..]: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure> {
        let (f, h) = (entries.matrix("F", d, d), entries.matrix("H", m, d));
        let (q, r, p) = (entries.symmetric("Q", d), entries.symmetric("R", m), entries.symmetric("P", d));
        let mode = Mode::from_parts(f.clone(), h.clone(), q.clone(), r.clone());
        let step = mode.try_step(&p).map_err(no_value)?;
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

//! Random models with sensors that repeat others, or nearly, and what is true of their steady states.

use exact_kalman::certify::{SteadyEffort, SteadyState};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Observation, Step, Timing, Transition, UnifiedStep};
use exact_kalman::scalar::{Interval, Rational, ratio};
use exact_kalman::verify::{DyadicMatrix, Stabilising};
use num_bigint::BigInt;

use super::models::Draw;
use super::truth::fractions;

pub struct Steady {
    pub step: Step<Rational>,
    pub timing: Timing,
}

/// The model with this number. Some sensors are combinations of others, with their noise; of a third of the models one of
/// these has noise of its own, or sees something else.
pub fn steady(number: u64) -> Steady {
    let mut draw = Draw(number.wrapping_mul(6007));
    let (n, base, sources) = (1 + draw.index(2), 1 + draw.index(2), 1 + draw.index(3));
    let small = |draw: &mut Draw| ratio(i64::try_from(draw.below(9)).expect("small") - 4, 2);
    let mut matrix = |rows: usize, columns: usize| Matrix::from_fn(rows, columns, |_, _| small(&mut draw));
    let (a, d) = (matrix(n, n).scaled(&ratio(3, 4)), matrix(n, sources));
    let rows = matrix(base, n).beside(&matrix(base, sources));
    let m = base + 1;
    let combination = matrix(1, base) * &rows;
    let kind = draw.below(6);
    let place = draw.index(m);
    let mut all = Matrix::from_fn(m, n + sources, |i, j| match i.cmp(&place) {
        std::cmp::Ordering::Less => rows[(i, j)].clone(),
        std::cmp::Ordering::Equal => combination[(0, j)].clone(),
        std::cmp::Ordering::Greater => rows[(i - 1, j)].clone(),
    });
    if kind == 0 {
        let column = draw.index(n + sources);
        all[(place, column)] = &all[(place, column)] + ratio(1, 2);
    }
    let c = Matrix::from_fn(m, n, |i, j| all[(i, j)].clone());
    let f = Matrix::from_fn(m, sources, |i, j| all[(i, n + j)].clone());
    let mut noise = &f * f.transpose();
    if kind == 1 {
        noise[(place, place)] = &noise[(place, place)] + ratio(1, 8);
    }
    let timing = if draw.below(2) == 0 { Timing::Arriving } else { Timing::Departing };
    let transition = Transition {
        matrix: a,
        input: Matrix::zeros(n, 1),
        noise: &d * d.transpose(),
        cross_noise: &d * f.transpose(),
    };
    let step = Step {
        transition: Some(transition),
        observation: c,
        observation_input: Matrix::zeros(m, 1),
        observation_noise: noise,
        reading: Observation::complete(vec![ratio(0, 1); m]),
    };
    Steady { step, timing }
}

impl Steady {
    pub fn sensors(&self) -> usize {
        self.step.observation.rows()
    }

    pub fn unified(&self) -> UnifiedStep {
        let Step { transition, observation, observation_noise, .. } = &self.step;
        let Transition { matrix, noise, cross_noise, .. } = transition.as_ref().expect("a transition");
        UnifiedStep::new(
            self.timing,
            matrix.clone(),
            observation,
            noise.clone(),
            cross_noise,
            observation_noise.clone(),
        )
    }

    /// The steady state to so many digits, if it is proved.
    pub fn solved(&self, digits: u32) -> Option<SteadyState> {
        let effort = SteadyEffort { digits, filtered: false, open: false, most_bits: 1024 };
        SteadyState::of(&self.unified(), effort).ok()
    }

    /// Whether each sensor that is left out is a combination of those that are kept, with all its noise.
    pub fn follows(&self, kept: &[usize]) -> bool {
        let UnifiedStep { observation, cross_noise, observation_noise, .. } = self.unified();
        let rows = observation.beside(&observation_noise).beside(&cross_noise.transpose());
        let is_known = kept.is_sorted_by(|a, b| a < b) && kept.iter().all(|sensor| *sensor < rows.rows());
        is_known && rows.select_rows(kept).rank() == rows.rank()
    }

    /// Whether a claim is true of the solution, which is known far better, and of its closed loop.
    pub fn agrees(&self, known: &SteadyState, claim: &Stabilising) -> bool {
        let [middle, tiny] = [&known.evidence.solution, &known.evidence.gap].map(fractions);
        let [point, gap] = [&claim.solution, &claim.gap].map(fractions);
        let (off, room) = (&middle - point, gap + tiny);
        let UnifiedStep { transition, observation, cross_noise, observation_noise, .. } = self.unified();
        let h = observation.select_rows(&known.kept);
        let sigma = h.congruence(&middle) + observation_noise.select(&known.kept, &known.kept);
        let gamma = &transition * &middle * h.transpose() + cross_noise.select_columns(&known.kept);
        let closed = transition - gamma * sigma.inverse().expect("regular") * h;
        let square = Rational::from(claim.rate_squared.mantissa.0.clone())
            * ratio(2, 1).pow(i32::try_from(claim.rate_squared.exponent).expect("small"));
        let rate = Interval::square_root(&square, 100).expect("positive").upper().value().expect("short");
        off.loewner_le(&room).is_ok()
            && (-&off).loewner_le(&room).is_ok()
            && closed.spectral_radius_lt(&(rate + ratio(1, 2).pow(60)))
    }
}

/// Changes one member of a claim, as the numbers say.
pub fn change(next: &mut dyn FnMut() -> usize, claim: &mut Stabilising, sensors: usize) {
    match next() % 12 {
        0 => claim.kept = None,
        1 => claim.kept = Some((0..next() % 4).map(|_| next() % (sensors + 1)).collect()),
        2 => {
            let mask = next();
            claim.kept = Some((0..sensors).filter(|sensor| mask >> sensor & 1 == 1).collect());
        }
        3 => claim.kept.get_or_insert_default().push(usize::MAX),
        4 => claim.balance = None,
        5 => claim.balance = i64::try_from(next() % 80).ok().map(|k| k - 40),
        6 => {
            let rate = &mut claim.rate_squared;
            rate.mantissa.0 = (&rate.mantissa.0 * (next() % 40)) >> 5;
        }
        7 => change_matrix(next, &mut claim.solution),
        8 => change_matrix(next, &mut claim.gap),
        9 => change_matrix(next, &mut claim.gain),
        10 => change_matrix(next, &mut claim.whitening),
        _ => change_matrix(next, &mut claim.shape),
    }
}

/// Changes the exponent, an entry or the form of a matrix.
pub fn change_matrix(next: &mut dyn FnMut() -> usize, matrix: &mut DyadicMatrix) {
    let (how, i, j, by) = (next(), next(), next(), next());
    if how % 8 == 0 {
        matrix.exponent += i64::try_from(by % 9).unwrap_or(0) - 4;
        return;
    }
    let rows = matrix.rows.len().max(1);
    let Some(row) = matrix.rows.get_mut(i % rows) else { return };
    let columns = row.len().max(1);
    let Some(entry) = row.get_mut(j % columns) else { return };
    match how % 8 {
        1 => entry.0 += by,
        2 => entry.0 -= by,
        3 => entry.0 = -&entry.0,
        4 => entry.0 = (&entry.0 * by) >> 5,
        5 => entry.0 = BigInt::from(by),
        6 => entry.0 ^= BigInt::from(1) << by,
        _ => drop(row.pop()),
    }
}

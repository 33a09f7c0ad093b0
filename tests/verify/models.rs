//! Random models whose data are possible: small fractions in units that lie far apart.

use exact_kalman::certify::CertifiedFilter;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Input, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::verify::{BeliefDocument, StepDocument};

pub type Q = Matrix<Rational>;

/// Numbers that look random (SplitMix64).
pub struct Draw(pub u64);

impl Draw {
    pub fn below(&mut self, count: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % count
    }

    pub fn index(&mut self, count: usize) -> usize {
        usize::try_from(self.below(count as u64)).expect("small")
    }

    fn signed(&mut self, most: i64) -> i64 {
        i64::try_from(self.below(2 * most.unsigned_abs() + 1)).expect("small") - most
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> Q {
        Matrix::from_fn(rows, columns, |_, _| ratio(self.signed(6), 1 + self.signed(3).abs()))
    }

    /// Units between 10⁻⁹ and 10⁹; all one in half of the draws.
    fn units(&mut self, n: usize) -> Q {
        let is_plain = self.below(2) == 0;
        let mut unit =
            || if is_plain { ratio(1, 1) } else { ratio(10, 1).pow(i32::try_from(self.signed(9)).expect("small")) };
        Matrix::diagonal(&(0..n).map(|_| unit()).collect::<Vec<_>>())
    }
}

/// A model with its data, and the same with one more reading, that is missing.
pub struct Model {
    pub path: Path<Rational>,
    pub longer: Path<Rational>,
}

/// The model with this number. Some have no noise in the sensors, a known start, sensors that repeat others, gaps.
pub fn model(number: u64) -> Model {
    let mut draw = Draw(number.wrapping_mul(7919));
    let (n, m, steps) = (1 + draw.index(4), 1 + draw.index(3), 2 + draw.index(5));
    let (units, sensor_units) = (draw.units(n), draw.units(m));
    let back = units.map(|entry| if *entry == ratio(0, 1) { ratio(0, 1) } else { entry.recip() });
    let start = if draw.below(4) == 0 { Matrix::zeros(n, n) } else { &units * draw.matrix(n, n) };
    let sources = 1 + draw.index(3);
    let d = &units * draw.matrix(n, sources);
    let mut f = if draw.below(4) == 0 { Matrix::zeros(m, sources) } else { &sensor_units * draw.matrix(m, sources) };
    let mut c = &sensor_units * draw.matrix(m, n) * &back;
    if m > 1 && draw.below(4) == 0 {
        // The last sensor repeats the first, in another unit.
        let factor = ratio(draw.signed(3), 2);
        for j in 0..n {
            c[(m - 1, j)] = &c[(0, j)] * &factor;
        }
        for j in 0..sources {
            f[(m - 1, j)] = &f[(0, j)] * &factor;
        }
    }
    let timing = if draw.below(2) == 0 { Timing::Arriving } else { Timing::Departing };
    let before =
        if timing == Timing::Arriving && draw.below(2) == 0 { Before::Transition } else { Before::Observation };
    let a = &units * draw.matrix(n, n).scaled(&ratio(1, 2)) * &back;
    let mean = &units * draw.matrix(n, 1);
    let push = &units * draw.matrix(n, 1);
    // What is read is what the model can produce.
    let mut state = &mean + &start * draw.matrix(n, 1);
    let mut readings = Vec::new();
    for k in 0..steps {
        let source = draw.matrix(sources, 1);
        if timing == Timing::Arriving && (k > 0 || before == Before::Transition) {
            state = &a * &state + &push + &d * &source;
        }
        let value = &c * &state + &f * &source;
        if timing == Timing::Departing {
            state = &a * &state + &push + &d * &source;
        }
        let all_missing = draw.below(6) == 0;
        let gap = |draw: &mut Draw| all_missing || draw.below(8) == 0;
        readings.push(Observation::new(value.entries().iter().map(|y| (!gap(&mut draw)).then(|| y.clone())).collect()));
    }
    let system = System {
        timing,
        initial: Initial::new(before, mean, &start * start.transpose()),
        transition: a.into(),
        observation: c.into(),
        noise: Noise::Factors { process: d.into(), observation: f.into() },
        input: Some(Input { matrix: None, vector: push.into() }),
        observation_input: None,
    };
    let path = system.realised(&readings).expect("a sound system");
    readings.push(Observation::missing(m));
    Model { path, longer: system.realised(&readings).expect("a sound system") }
}

/// The certificate of a path, as far as it is decided.
pub fn certified(path: &Path<Rational>, bits: u64) -> (BeliefDocument, Vec<StepDocument>) {
    let mut filter = CertifiedFilter::new(path, bits).with_witness();
    let start = filter.belief_document().expect("no diffuse start");
    let mut steps = Vec::new();
    while let Some(Ok(_)) = filter.next() {
        steps.push(filter.step_document().expect("a witness"));
    }
    (start, steps)
}

//! Long runs of enclosures: 30 proved digits, whatever the number of steps, and a time for each step that does not grow.
//!
//! Prints a Markdown table for `benches/README.md`'s kind of page. Run with `cargo run --release --example enclosures`; `--quick`
//! makes runs a hundred times shorter.

use std::time::{Duration, Instant};

use exact_kalman::certify::{CertifiedStep, Digits, RaisedFilter};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Dyadic, Interval, Rational, nearest_double, ratio};
use exact_kalman::trace::Quantity;

/// The digits that are proved of each entry of each step.
const DIGITS: u32 = 30;

/// The step with which the last one is compared.
const EARLY: usize = 100;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let part = if quick { 100 } else { 1 };
    println!(
        "| model | n | m | steps | bits | gap of P, step {EARLY} → last | gap of x̂, step {EARLY} → last | µs a step, first → last tenth |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for (name, n, steps) in [("random acceleration", 2, 100_000), ("chain of masses", 8, 10_000)] {
        let steps = (steps / part).max(2 * EARLY);
        let path = if n == 2 { acceleration(steps) } else { chain(n, steps) }?;
        told(name, &path)?;
    }
    Ok(())
}

fn told(name: &str, path: &Path<Rational>) -> Result<(), Box<dyn std::error::Error>> {
    let steps = path.steps().len();
    let mut filter = RaisedFilter::new(path, DIGITS, 1 << 12);
    let mut times = Vec::with_capacity(steps);
    let (mut early, mut last) = (None, None);
    for k in 0..steps {
        let begun = Instant::now();
        let step = filter.next().ok_or("it ended early")??;
        times.push(begun.elapsed());
        unproved(&step)?;
        if k == EARLY {
            early = Some(gaps(&step)?);
        }
        last = Some(step);
    }
    let (early, last) = (early.ok_or("too few steps")?, gaps(&last.ok_or("no step")?)?);
    let tenth = steps / 10;
    let mean = |times: &[Duration]| {
        times.iter().sum::<Duration>().as_secs_f64() * 1e6 / f64::from(u32::try_from(times.len()).unwrap_or(u32::MAX))
    };
    println!(
        "| {name} | {} | {} | {steps} | {} | {:.1e} → {:.1e} | {:.1e} → {:.1e} | {:.0} → {:.0} |",
        path.states(),
        path.sensors(),
        filter.bits(),
        early[0],
        last[0],
        early[1],
        last[1],
        mean(&times[..tenth]),
        mean(&times[steps - tenth..]),
    );
    if last[0] > 4.0 * early[0] || last[1] > 4.0 * early[1] {
        return Err(format!("{name}: a gap has grown beyond four times that of step {EARLY}").into());
    }
    Ok(())
}

/// No entry may be zero or a tie, so all digits are proved.
fn unproved(step: &CertifiedStep) -> Result<(), String> {
    for (quantity, entries) in &step.values {
        for entry in entries.entries() {
            if let within @ Digits::Within { .. } = Digits::of(entry, DIGITS) {
                return Err(format!("an entry of the {quantity} is {within}"));
            }
        }
    }
    Ok(())
}

/// The largest width of a filtered variance beside it, and of a filtered mean beside its deviation.
fn gaps(step: &CertifiedStep) -> Result<[f64; 2], &'static str> {
    let [mean, covariance] =
        [Quantity::FilteredMean, Quantity::FilteredCovariance].map(|quantity| step.values.get(&quantity));
    let (mean, covariance) = (mean.ok_or("no mean")?, covariance.ok_or("no covariance")?);
    let ends = |interval: &Interval| {
        let [lower, upper] = [interval.lower(), interval.upper()].map(Dyadic::value);
        lower.zip(upper).ok_or("a long number")
    };
    let mut most = [0.0_f64; 2];
    for i in 0..covariance.rows() {
        let (lower, upper) = ends(&covariance[(i, i)])?;
        let variance = nearest_double(&lower);
        most[0] = most[0].max(nearest_double(&(upper - &lower)) / variance);
        let (lower, upper) = ends(&mean[(i, 0)])?;
        most[1] = most[1].max(nearest_double(&(upper - lower)) / variance.sqrt());
    }
    Ok(most)
}

/// A position and a velocity, a tenth of a second a step; the acceleration is white noise, and the position is read.
fn acceleration(steps: usize) -> Result<Path<Rational>, Box<dyn std::error::Error>> {
    let rows = |rows: [[(i64, i64); 2]; 2]| {
        Matrix::from_fn(2, 2, |i, j| {
            let (over, under) = rows[i][j];
            ratio(over, under)
        })
    };
    system(
        rows([[(1, 1), (1, 10)], [(0, 1), (1, 1)]]),
        Matrix::from_integers(&[[1, 0]]),
        rows([[(1, 3000), (1, 200)], [(1, 200), (1, 10)]]),
        Matrix::from_integers(&[[2]]),
        steps,
    )
}

/// Masses, each drawn towards its neighbours and a little unstable; every second one is read, and noise moves all.
fn chain(n: usize, steps: usize) -> Result<Path<Rational>, Box<dyn std::error::Error>> {
    let transition = Matrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => ratio(9, 10),
        1 => ratio(1, 8),
        _ => ratio(0, 1),
    });
    let observation = Matrix::from_fn(n / 2, n, |i, j| ratio(i64::from(j == 2 * i), 1));
    let noise = Matrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => ratio(1, 10),
        1 => ratio(1, 30),
        _ => ratio(0, 1),
    });
    system(transition, observation, noise, Matrix::identity(n / 2), steps)
}

fn system(
    transition: Matrix<Rational>,
    observation: Matrix<Rational>,
    process: Matrix<Rational>,
    noise: Matrix<Rational>,
    steps: usize,
) -> Result<Path<Rational>, Box<dyn std::error::Error>> {
    let (n, m) = (transition.rows(), observation.rows());
    // The generator of Knuth's MMIX: readings of three decimals.
    let mut state = 1_u64;
    let mut reading = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ratio(i64::try_from((state >> 33) % 4001).unwrap_or(0) - 2000, 1000)
    };
    let start = Matrix::from_fn(n, n, |i, j| if i == j { ratio(3, 1) } else { ratio(1, 7) });
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::from_fn(n, 1, |_, _| ratio(1, 3)), start),
        transition: transition.into(),
        observation: observation.into(),
        noise: Noise::Covariances { process: process.into(), cross: None, observation: noise.into() },
        input: None,
        observation_input: None,
    };
    let readings: Vec<_> = (0..steps).map(|_| Observation::complete((0..m).map(|_| reading()))).collect();
    Ok(system.realised(&readings)?)
}

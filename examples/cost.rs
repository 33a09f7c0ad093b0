//! What exactness costs: n = 4, m = 2 with dense double-valued entries, by both exact routes.
//!
//! Run with `cargo run --release --example cost [STEPS]`.

use std::time::Instant;

use exact_kalman::filter::{Effort, filter, filter_rational};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
use exact_kalman::scalar::{Precision, Rational};
use exact_kalman::trace::Quantity;

/// Doubles in (−1, 1) with full significands, from a linear congruence.
struct Doubles(u64);

impl Doubles {
    fn next(&mut self) -> Rational {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
        let value = (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        Rational::from_float(value).unwrap_or_default()
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> Matrix<Rational> {
        Matrix::from_fn(rows, columns, |_, _| self.next())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let steps = std::env::args().nth(1).map_or(Ok(20), |text| text.parse())?;
    let (n, m) = (4, 2);
    let mut doubles = Doubles(1);
    let system = System {
        timing: Timing::Arriving,
        initial: Initial::new(Before::Transition, Matrix::zeros(n, 1), Matrix::identity(n)),
        transition: doubles.matrix(n, n).into(),
        observation: doubles.matrix(m, n).into(),
        noise: Noise::Factors {
            process: doubles.matrix(n, n + m).into(),
            observation: doubles.matrix(m, n + m).into(),
        },
        input: None,
        observation_input: None,
    };
    let readings: Vec<_> = (0..steps).map(|_| Observation::complete([doubles.next(), doubles.next()])).collect();
    let path = system.realised(&readings)?;

    let start = Instant::now();
    let fast = filter_rational(&path, Effort::default())?;
    let integers = start.elapsed();
    let start = Instant::now();
    let fractions: Vec<_> = fast.iter().map(|step| step.fractions(Precision::Exact).values).collect();
    let lowest_terms = start.elapsed();
    let bits = fractions.last().map_or(0, |step| step[&Quantity::FilteredCovariance][(0, 0)].denom().bits());
    println!("n = {n}, m = {m}, {steps} steps: the last denominator has {bits} bits");
    println!("integers                        {:>10.3} s", integers.as_secs_f64());
    println!("their fractions, lowest terms   {:>10.3} s", lowest_terms.as_secs_f64());
    let start = Instant::now();
    let slow = filter(&path)?;
    println!("recursion on fractions          {:>10.3} s", start.elapsed().as_secs_f64());
    let last = slow.records.last().map(|record| &record.filtered.covariance);
    println!("equal: {}", last == fractions.last().map(|step| &step[&Quantity::FilteredCovariance]));
    Ok(())
}

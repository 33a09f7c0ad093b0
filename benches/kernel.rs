//! Times of the exact filter and of what is done with its results; `cargo bench`, and `cargo bench -- gcd` for a part.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use exact_kalman::filter::{Effort, Route, Wanted, filter_rational};
use exact_kalman::judge::{Truth, suite};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::protocol::Decimal;
use exact_kalman::scalar::{Precision, Quotient, Rational, exact_value, ratio};
use num_bigint::BigInt;
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;

/// Dense data: fractions p/q with |p| ≤ 10 and q ≤ 10, or doubles in (−1, 1).
#[derive(Clone, Copy)]
enum Kind {
    Small,
    Double,
}

struct Numbers {
    kind: Kind,
    source: Pcg64Mcg,
}

impl Numbers {
    fn next(&mut self) -> Rational {
        let word = self.source.next_u64();
        match self.kind {
            Kind::Small => ratio((word % 21).cast_signed() - 10, ((word >> 32) % 10).cast_signed() + 1),
            #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
            Kind::Double => exact_value((word >> 11) as f64 / (1u64 << 52) as f64 - 1.0).unwrap_or_default(),
        }
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> Matrix<Rational> {
        Matrix::from_fn(rows, columns, |_, _| self.next())
    }
}

/// n states, n/2 sensors, dense noise, P₀ = I, as in `benches/compare.py`, with other numbers.
fn path(kind: Kind, n: usize, steps: usize) -> Path<Rational> {
    let m = n / 2;
    let mut numbers = Numbers { kind, source: Pcg64Mcg::new(1) };
    let system = System {
        timing: Timing::Arriving,
        initial: Initial::new(Before::Transition, Matrix::zeros(n, 1), Matrix::identity(n)),
        transition: numbers.matrix(n, n).into(),
        observation: numbers.matrix(m, n).into(),
        noise: Noise::Factors {
            process: numbers.matrix(n, n + m).into(),
            observation: numbers.matrix(m, n + m).into(),
        },
        input: None,
        observation_input: None,
    };
    let readings: Vec<_> =
        (0..steps).map(|_| Observation::complete((0..m).map(|_| numbers.next()).collect::<Vec<_>>())).collect();
    system.realised(&readings).expect("dense noise makes a model")
}

fn filters(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("filter");
    for (route, named) in [(Route::FractionFree, "fraction-free"), (Route::Multimodular, "multi-modular")] {
        let effort = Effort { route, wanted: Wanted::Filtered, ..Effort::default() };
        for (kind, kind_named) in [(Kind::Small, "small"), (Kind::Double, "double")] {
            for (n, steps) in [(2, 20), (4, 10), (8, 4)] {
                let path = path(kind, n, steps);
                group.bench_function(
                    BenchmarkId::new(named, format!("{kind_named}, n = {n}, T = {steps}")),
                    |bencher| {
                        bencher.iter(|| filter_rational(black_box(&path), effort));
                    },
                );
            }
        }
    }
    group.finish();
}

/// An odd integer of so many bits.
fn integer(bits: usize, source: &mut Pcg64Mcg) -> BigInt {
    let bytes: Vec<u8> = (0..bits / 8).map(|_| source.next_u64().to_le_bytes()[0]).collect();
    BigInt::from_bytes_le(num_bigint::Sign::Plus, &bytes) | BigInt::from(1)
}

/// Quotients as the filter hands them out: in lowest terms, which is one gcd, and as 17 digits.
fn quotients(criterion: &mut Criterion) {
    let mut source = Pcg64Mcg::new(2);
    for bits in [1_000, 10_000, 100_000] {
        let [numerator, denominator, shared] = [bits, bits, bits / 10].map(|bits| integer(bits, &mut source));
        let (numerator, denominator) = (numerator * &shared, denominator * shared);
        criterion.bench_function(&format!("gcd/{bits} bits"), |bencher| {
            bencher.iter(|| Quotient::new(black_box(&numerator), black_box(&denominator)).handed_out(Precision::Exact));
        });
        let quotient = Rational::new_raw(numerator.clone(), denominator.clone());
        criterion.bench_function(&format!("17 digits/{bits} bits"), |bencher| {
            bencher.iter(|| Decimal::rounded(black_box(&quotient), 17).to_string());
        });
    }
}

/// What the judge computes of one case before it asks anybody: the exact answer, and those of twenty problems nearby.
fn truth(criterion: &mut Criterion) {
    for case in suite().iter().step_by(10).take(3) {
        criterion.bench_function(&format!("truth/{}", case.id), |bencher| bencher.iter(|| Truth::of(black_box(case))));
    }
}

/// A minute for all of it; more samples would say little more on a machine that does other things too.
fn short() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
}

criterion_group! { name = kernel; config = short(); targets = filters, quotients, truth }
criterion_main!(kernel);

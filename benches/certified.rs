//! What a step of the enclosing filter costs beside one of the `f64` filters: `cargo bench --bench certified`.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use exact_kalman::certify::CertifiedFilter;
use exact_kalman::float::{self, Form};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, exact_value, nearest_double, ratio};
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;

const STEPS: usize = 200;

/// n states that decay, n/2 sensors, dense noise; data are doubles.
fn path(n: usize, timing: Timing) -> Path<Rational> {
    let m = n / 2;
    let mut source = Pcg64Mcg::new(1);
    let mut next = || {
        #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
        let value = (source.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        exact_value(value).unwrap_or_default()
    };
    let mut matrix = |rows, columns| Matrix::from_fn(rows, columns, |_, _| next());
    let before = if timing == Timing::Arriving { Before::Transition } else { Before::Observation };
    let system = System {
        timing,
        initial: Initial::new(before, Matrix::zeros(n, 1), Matrix::identity(n)),
        transition: matrix(n, n).scaled(&ratio(1, 2)).into(),
        observation: matrix(m, n).into(),
        noise: Noise::Factors { process: matrix(n, n + m).into(), observation: matrix(m, n + m).into() },
        input: None,
        observation_input: None,
    };
    let readings: Vec<_> =
        (0..STEPS).map(|_| Observation::complete((0..m).map(|_| next()).collect::<Vec<_>>())).collect();
    system.realised(&readings).expect("dense noise makes a model")
}

fn steps(criterion: &mut Criterion) {
    for (timing, named) in [(Timing::Arriving, "arriving"), (Timing::Departing, "departing")] {
        let mut group = criterion.benchmark_group(named);
        group.throughput(Throughput::Elements(STEPS as u64));
        for n in [2, 4, 8] {
            let path = path(n, timing);
            let doubles = path.try_map(|value| Ok::<_, ()>(nearest_double(value))).expect("numbers near one");
            for form in [Form::Textbook, Form::Joseph] {
                group.bench_function(BenchmarkId::new(form.to_string(), format!("n = {n}")), |bencher| {
                    bencher.iter(|| float::filter(form, black_box(&doubles)));
                });
            }
            for bits in [128, 256] {
                group.bench_function(
                    BenchmarkId::new(format!("certified, {bits} bits"), format!("n = {n}")),
                    |bencher| {
                        bencher.iter(|| {
                            let filter = CertifiedFilter::new(black_box(&path), bits);
                            for step in filter {
                                black_box(step.expect("regular innovations"));
                            }
                        });
                    },
                );
            }
        }
        group.finish();
    }
}

/// Half a minute for all of it.
fn short() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
}

criterion_group! { name = certified; config = short(); targets = steps }
criterion_main!(certified);

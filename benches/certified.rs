//! What a step of the enclosing filter costs beside one of the `f64` filters: `cargo bench --bench certified`.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group};
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

/// How many steps of the textbook filter in doubles one enclosing step takes, at n = 4: both take turns, and the quotient is taken within
/// a round, so that a machine that is slow for a while is slow for both.
fn print_ratios() {
    const ROUNDS: usize = 41;
    /// So many runs in doubles take about as long as an enclosing one.
    const REPEATED: u32 = 40;
    println!("\ncertified, 128 bits / textbook, n = 4, m = 2, {STEPS} steps, {ROUNDS} rounds");
    for (timing, named) in [(Timing::Arriving, "arriving"), (Timing::Departing, "departing")] {
        let path = path(4, timing);
        let doubles = path.try_map(|value| Ok::<_, ()>(nearest_double(value))).expect("numbers near one");
        let mut ratios: Vec<f64> = (0..=ROUNDS)
            .map(|_| {
                let begun = Instant::now();
                for _ in 0..REPEATED {
                    let _ = black_box(float::filter(Form::Textbook, black_box(&doubles)));
                }
                let middle = Instant::now();
                CertifiedFilter::new(black_box(&path), 128).for_each(|step| {
                    black_box(step.expect("regular innovations"));
                });
                middle.elapsed().as_secs_f64() / ((middle - begun).as_secs_f64() / f64::from(REPEATED))
            })
            .skip(1)
            .collect();
        ratios.sort_by(f64::total_cmp);
        let [least, low, median, high, largest] = [0, 1, 2, 3, 4].map(|quarter| ratios[quarter * (ROUNDS - 1) / 4]);
        println!(
            "{named:10} median {median:.1}, quartiles {low:.1} and {high:.1}, least {least:.1}, largest {largest:.1}"
        );
    }
}

criterion_group! { name = certified; config = short(); targets = steps }

fn main() {
    // A filter on the names of benchmarks, or a run as a test, leaves the comparison out.
    if std::env::args().skip(1).all(|argument| argument == "--bench") {
        print_ratios();
    }
    certified();
    Criterion::default().configure_from_args().final_summary();
}

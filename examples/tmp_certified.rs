//! Temporary.
use exact_kalman::certify::CertifiedFilter;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::*;
use exact_kalman::scalar::*;
use exact_kalman::trace::Quantity;
fn main() {
    let arg: Vec<usize> = std::env::args().skip(1).map(|a| a.parse().unwrap()).collect();
    let (n, m, steps, bits) = (arg[0], arg[1], arg[2], arg[3] as u64);
    let mut state = 12345u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((state >> 11) as f64) / ((1u64 << 53) as f64) - 0.5
    };
    let mut mat = |r: usize, c: usize, s: f64| Matrix::from_fn(r, c, |_, _| exact_value(next() * s).unwrap());
    let a = mat(n, n, 2.0 / (n as f64).sqrt());
    let c = mat(m, n, 2.0);
    let d = mat(n, n, 1.0);
    let f = mat(m, m, 1.0);
    let i = |k| Matrix::<Rational>::identity(k);
    let q = &d * d.transpose() + i(n).scaled(&ratio(1, 16));
    let r = &f * f.transpose() + i(m).scaled(&ratio(1, 16));
    let q = Precise(q);
    let r = Precise(r);
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(n, 1), i(n)),
        transition: a.into(),
        observation: c.into(),
        noise: Noise::Covariances { process: q.0.into(), cross: None, observation: r.0.into() },
        input: None,
        observation_input: None,
    };
    let ys: Vec<_> = (0..steps)
        .map(|_| {
            let y = mat(m, 1, 4.0);
            Observation::complete(y.entries().to_vec())
        })
        .collect();
    let path = system.realised(&ys).unwrap();
    let t = std::time::Instant::now();
    for (k, step) in CertifiedFilter::new(&path, bits).enumerate() {
        let step = step.unwrap();
        if (k + 1).is_power_of_two() || k + 1 == steps {
            let w = |q: Quantity| {
                let i = &step.values[&q][(0, 0)];
                let w = i.upper().plus(&i.lower().negated(), 30, Toward::Above);
                w.magnitude().unwrap_or(0)
            };
            println!(
                "{k} {:?} cov 2^{} mean 2^{}",
                t.elapsed(),
                w(Quantity::FilteredCovariance),
                w(Quantity::FilteredMean)
            );
        }
    }
    println!("per step {:?}", t.elapsed() / steps as u32);
    let fpath = path.try_map(|v| Ok::<_, ()>(nearest_double(v))).unwrap();
    let t = std::time::Instant::now();
    exact_kalman::float::filter(exact_kalman::float::Form::Textbook, &fpath).unwrap();
    println!("f64 per step {:?}", t.elapsed() / steps as u32);
}
struct Precise(Matrix<Rational>);

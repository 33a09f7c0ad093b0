//! What holds with probability one, simulated: seeded, with a statistic that tells a dropped hypothesis apart.
//!
//! Two kinds of tests. *Averages* over one path of 100 000 steps are compared with their limit within six standard
//! deviations, which follow from the covariances of the system (normal noise): a correct program fails one in 10⁹ times,
//! and the limits that a mistake or a dropped hypothesis has are further away. *Medians* of an error over 400 runs are
//! compared at n and 16n. Where the error falls like n^(−1/2) their ratio comes to 1/4, where it does not fall to 1; the
//! bound is 1/2. The sample median of 400 runs has a relative standard deviation of 6 % for a half-normal error and of 8 %
//! for a Cauchy one, the ratio of two of them 9 % and 11 %: from 1/4 or 1 to the bound it is six deviations. At these n early
//! steps still count: the ratios measured are 0.24 to 0.29, and 0.34 and 0.31 for the averages of AK-T2.5 and AK-C2.4, which
//! leaves about four deviations to the bound. Where nothing should fall they are 0.88 to 1.5, but 0.67 for A = 11/10 in
//! AK-T2.5, three deviations. Seeds are fixed, so a test that passes always passes.

use exact_kalman::float::{AdaptiveFilter, Estimator};
use exact_kalman::model::{Reading, Repair};
use exact_kalman::reproduce::Stream;
use nalgebra::{SMatrix, SVector};

/// A scalar system with normal noise.
#[derive(Clone, Copy)]
struct System {
    a: f64,
    v: f64,
    w: f64,
    start: f64,
}

/// A = 1/2, V = 3, W = 1: X = 4, Φ = 5, ψ = A X = 2, B(1) = 17/4, B(2) = 77/16.
const REGULAR: System = System { a: 0.5, v: 3.0, w: 1.0, start: 20.0 };

const STEPS: usize = 100_000;

/// One path: y(k), w(k) and v(k−1), at index k − 1.
struct Path {
    y: Vec<f64>,
    w: Vec<f64>,
    v: Vec<f64>,
}

impl System {
    fn path(&self, stream: &mut Stream, n: usize) -> Path {
        let mut x = self.start;
        let mut path = Path { y: Vec::with_capacity(n), w: Vec::with_capacity(n), v: Vec::with_capacity(n) };
        for _ in 0..n {
            let (v, w) = (self.v.sqrt() * stream.normal(), self.w.sqrt() * stream.normal());
            x = self.a * x + v;
            path.y.push(x + w);
            path.v.push(v);
            path.w.push(w);
        }
        path
    }
}

fn real(n: usize) -> f64 {
    f64::from(u32::try_from(n).expect("a small number"))
}

fn mean(values: impl Iterator<Item = f64>, n: usize) -> f64 {
    values.sum::<f64>() / real(n)
}

/// Within six standard deviations, the variance of the average being `variance`/n.
fn near(average: f64, limit: f64, variance: f64, n: usize) -> bool {
    (average - limit).abs() <= 6.0 * (variance / real(n)).sqrt()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The medians over 400 runs of some errors, each at n and at 16n: their ratios.
fn ratios_of_medians<const N: usize>(name: &str, errors: impl Fn(&mut Stream) -> [[f64; 2]; N]) -> [f64; N] {
    let runs: Vec<[[f64; 2]; N]> =
        (0..400).map(|run| errors(&mut Stream::named(&format!("{name}/{run}"), 1969))).collect();
    std::array::from_fn(|which| {
        let [early, late] = [0, 1].map(|place| median(runs.iter().map(|errors| errors[which][place]).collect()));
        late / early
    })
}

fn ratio_of_medians(name: &str, error: impl Fn(&mut Stream) -> [f64; 2]) -> f64 {
    let [ratio] = ratios_of_medians(name, |stream| [error(stream)]);
    ratio
}

/// |Â(n) − A| at n = 500 and 8000, by (2.1) with two sums.
fn errors_of_transition(system: System) -> impl Fn(&mut Stream) -> [f64; 2] {
    move |stream| {
        let y = system.path(stream, 8000).y;
        let error = |n: usize| {
            let sum = |lag: usize| (2..n).map(|k| y[k - lag] * y[k - 2]).sum::<f64>();
            (sum(0) / sum(1) - system.a).abs()
        };
        [error(500), error(8000)]
    }
}

/// AK-T2.1: the error of Â(n) falls; not so for A = 0 (nothing to find in the lag sum), nor for V = 0 (only the transient
/// of x(0) = 100 tells of A). ρ(A) < 1 is not needed in order one: at A = 11/10 the error falls much faster.
#[test]
fn estimates_of_the_transition_are_consistent() {
    assert!(ratio_of_medians("T2.1", errors_of_transition(REGULAR)) < 0.5);
    let blind = System { a: 0.0, start: 0.0, ..REGULAR };
    assert!(ratio_of_medians("T2.1, A = 0", errors_of_transition(blind)) > 0.5);
    let quiet = System { a: 0.9, v: 0.0, w: 1.0, start: 100.0 };
    assert!(ratio_of_medians("T2.1, V = 0", errors_of_transition(quiet)) > 0.5);
    let explosive = System { a: 1.1, ..REGULAR };
    let errors = |stream: &mut Stream| {
        let y = explosive.path(stream, 160).y;
        [10, 160].map(|n: usize| {
            let sum = |lag: usize| (2..n).map(|k| y[k - lag] * y[k - 2]).sum::<f64>();
            (sum(0) / sum(1) - explosive.a).abs()
        })
    };
    assert!(ratio_of_medians("T2.1, A = 11/10", errors) < 0.01);
}

/// AK-T2.1 in order two, with the program's own estimator.
#[test]
fn matrices_are_estimated_consistently() {
    let a = SMatrix::<f64, 2, 2>::new(0.5, 0.25, -0.25, 0.5);
    let errors = |stream: &mut Stream| {
        let mut estimator = Estimator::<2>::new(Reading::Printed);
        let (mut x, mut early) = (SVector::<f64, 2>::new(20.0, -20.0), f64::NAN);
        let error = |estimator: &Estimator<2>| (estimator.estimates().expect("three readings").transition - a).norm();
        for k in 1..=4000 {
            x = a * x + SVector::from_fn(|_, _| stream.normal());
            let y = x + SVector::from_fn(|_, _| stream.normal());
            estimator.observe(y).expect("a regular lag sum");
            if k == 250 {
                early = error(&estimator);
            }
        }
        [early, error(&estimator)]
    };
    assert!(ratio_of_medians("T2.1, p = 2", errors) < 0.5);
}

/// |B(n,i) − B(i)| at n = 500 and 8000.
fn errors_of_residuals(system: System, reading: Reading, i: usize) -> impl Fn(&mut Stream) -> [f64; 2] {
    move |stream| {
        let System { a, v, w, .. } = system;
        let b = if i == 1 { v + w + a * a * w } else { v + w + a * a * v + a.powi(4) * w };
        let mut estimator = Estimator::<1>::new(reading);
        let mut error = [f64::NAN; 2];
        for (k, &y) in system.path(stream, 8000).y.iter().enumerate() {
            estimator.observe(SVector::<f64, 1>::new(y)).expect("no zero");
            if let Some(place) = [499, 7999].iter().position(|&last| last == k) {
                let estimates = estimator.estimates().expect("three readings");
                let found = if i == 1 { estimates.one_step } else { estimates.two_step };
                error[place] = (found[(0, 0)] - b).abs();
            }
        }
        error
    }
}

/// |B(n,1) − B(1)| at n and 16n with Â(k) = A + 1/k in (2.2): a consistent estimate that is not (2.1).
fn errors_with_another_estimate(system: System, n: usize) -> impl Fn(&mut Stream) -> [f64; 2] {
    move |stream| {
        let System { a, v, w, .. } = system;
        let y = system.path(stream, 16 * n).y;
        [n, 16 * n].map(|n| {
            let residual = |k: usize| y[k - 1] - (a + 1.0 / real(k)) * y[k - 2];
            let found = (3..=n).map(|k| residual(k).powi(2)).sum::<f64>() / real(n);
            (found - (v + w + a * a * w)).abs()
        })
    }
}

/// AK-T2.2 for a consistent estimate that is none of the paper's, Â(k) = A + 1/k: B(n,1) is consistent for A = 1/2. ρ(A) < 1 is
/// needed: at A = 11/10 the residual y(k) − Â(k)y(k−1) = z(k) − y(k−1)/k grows, and the error with it.
#[test]
fn any_consistent_estimate_of_the_transition_serves_stable_systems() {
    assert!(ratio_of_medians("T2.2, A + 1/k", errors_with_another_estimate(REGULAR, 500)) < 0.5);
    let explosive = System { a: 1.1, ..REGULAR };
    assert!(ratio_of_medians("T2.2, A + 1/k, A = 11/10", errors_with_another_estimate(explosive, 10)) > 100.0);
}

/// AK-T2.2, AK-Rem2.2: B(n,1) and B(n,2) with Â(k), with Â(n), and in the reading that meets Table 1; not with (2.1) on a
/// system with A = 0, where Â is not consistent.
#[test]
fn estimates_of_the_residual_covariances_are_consistent() {
    for reading in Reading::ALL {
        for i in [1, 2] {
            let name = format!("T2.2/{}/{i}", reading.name());
            assert!(ratio_of_medians(&name, errors_of_residuals(REGULAR, reading, i)) < 0.5, "{name}");
        }
    }
    let blind = System { a: 0.0, start: 0.0, ..REGULAR };
    assert!(ratio_of_medians("T2.2, A = 0", errors_of_residuals(blind, Reading::Last, 1)) > 0.5);
}

/// AK-Kron-limit, AK-3.1, AK-3.2: the averages of w(k)y(k−2), (v(k−1) − Aw(k−1))y(k−2) and z(k)y(k−2) go to 0, that of
/// y(k−1)y(k−2) to ψ = 2. Variances by AK-Var.1 and AK-Var.2 with weights 1: WΦ = 5, (V + A²W)Φ = 65/4; their sum has
/// V Φ + W E(y(k−2) − Ay(k−1))² = 77/4 (the w's regrouped); the last Σ_h γ(h)² + γ(h+1)γ(h−1) = 157/3. With lag 1 in place
/// of 2 the limit is −AW = −1/2, and for A = 0 it is ψ = 0, which is singular.
#[test]
fn noise_averages_vanish_and_the_lag_sum_does_not() {
    let path = REGULAR.path(&mut Stream::named("3.1", 1969), STEPS);
    let Path { y, w, v } = &path;
    let a = REGULAR.a;
    let average = |term: &dyn Fn(usize) -> f64| mean((2..STEPS).map(term), STEPS);
    assert!(near(average(&|k| w[k] * y[k - 2]), 0.0, 5.0, STEPS));
    assert!(near(average(&|k| (v[k] - a * w[k - 1]) * y[k - 2]), 0.0, 65.0 / 4.0, STEPS));
    let z = |k: usize| y[k] - a * y[k - 1];
    assert!(near(average(&|k| z(k) * y[k - 2]), 0.0, 77.0 / 4.0, STEPS));
    let lagged = average(&|k| z(k) * y[k - 1]);
    assert!(!near(lagged, 0.0, 77.0 / 4.0, STEPS) && (lagged + 0.5).abs() < 0.25, "{lagged}");
    assert!(near(average(&|k| y[k - 1] * y[k - 2]), 2.0, 157.0 / 3.0, STEPS));
    let blind = System { a: 0.0, ..REGULAR }.path(&mut Stream::named("3.2, A = 0", 1969), STEPS).y;
    assert!(near(mean((2..STEPS).map(|k| blind[k - 1] * blind[k - 2]), STEPS), 0.0, 16.0, STEPS));
}

/// AK-L3.2, AK-3.8a, AK-3.8b, AK-3.9, AK-3.9-bound: averages of lagged products and of their moduli, for y (from x(0) = 20)
/// and for u (stationary) with the same noise, go to the same limits γ(i) and (2/π)γ(0)(√(1−ρ²) + ρ asin ρ), ρ = γ(i)/γ(0).
/// The variance of the product is as in (3.2). AK-3.8b is claimed for the lags 0, where the modulus is the product, and 1, where
/// n times the variance of the average modulus is 47 (from a path of 400 000 steps) and 60 is taken: that keeps the limit,
/// 3.44, apart from 3.18, that of independent factors. At lags 2 and 3 it is too near to that. The single differences vanish like 2⁻ᵏ, and |u(k)|/k is bounded by the largest
/// average, itself below six deviations.
#[test]
fn averages_of_lagged_products_converge() {
    let mut stream = Stream::named("3.8", 1969);
    let stationary = 2.0 * stream.normal();
    let path = REGULAR.path(&mut stream, STEPS);
    // The same noise from the stationary start: u(k) = y(k) + Aᵏ(stationary − 20).
    let q = |k: usize| REGULAR.a.powi(i32::try_from(k + 1).expect("small")) * (stationary - REGULAR.start);
    let u: Vec<f64> = path.y.iter().enumerate().map(|(k, y)| y + q(k)).collect();
    for i in 0..=3_usize {
        let gamma = if i == 0 { 5.0 } else { 4.0 * 0.5_f64.powi(i32::try_from(i).expect("small")) };
        let correlation: f64 = gamma / 5.0;
        let modulus = 5.0
            * std::f64::consts::FRAC_2_PI
            * ((1.0 - correlation * correlation).sqrt() + correlation * correlation.asin());
        for series in [&path.y, &u] {
            let average = |f: fn(f64) -> f64| mean((i..STEPS).map(|k| f(series[k] * series[k - i])), STEPS);
            // At i = 0 the variance is 2 Σ γ(h)² = 214/3, at others less.
            assert!(near(average(|product| product), gamma, 214.0 / 3.0, STEPS), "lag {i}");
            if i <= 1 {
                let variance = if i == 0 { 214.0 / 3.0 } else { 60.0 };
                assert!(near(average(f64::abs), modulus, variance, STEPS), "lag {i}");
                assert!(!near(average(f64::abs), 10.0 * std::f64::consts::FRAC_1_PI, variance, STEPS), "lag {i}");
            }
        }
        let difference = |k: usize| (u[k] * u[k - i] - path.y[k] * path.y[k - i]).abs();
        assert!((0..10).any(|k| difference(k + i) > 0.1));
        assert!((150..STEPS).all(|k| difference(k) < 1e-10));
    }
    let mut sum = 0.0;
    let averages = u.iter().enumerate().map(|(k, u)| {
        sum += u.abs();
        sum / real(k + 1)
    });
    let largest = averages.fold(0.0, f64::max);
    assert!(largest < 6.0 * 5.0_f64.sqrt());
    assert!(u.iter().enumerate().all(|(k, u)| u.abs() / real(k + 1) <= largest));
}

/// AK-u: metric transitivity, on an event that no moment knows: the share of k with u(k) > 0 and u(k+1) > 0 on one path
/// goes to its probability 1/4 + asin(ρ)/2π, ρ = 2/5 (variance at most 1/4 times three for the correlations). A
/// stationary process that is not transitive fails the same test: u plus a constant that was drawn once, ±10.
#[test]
fn time_averages_are_means() {
    let mut stream = Stream::named("u", 1969);
    let mut x = 2.0 * stream.normal();
    let u: Vec<f64> = (0..=STEPS)
        .map(|_| {
            x = 0.5 * x + 3.0_f64.sqrt() * stream.normal();
            x + stream.normal()
        })
        .collect();
    let share = |shift: f64| {
        let both = (0..STEPS).filter(|&k| u[k] + shift > 0.0 && u[k + 1] + shift > 0.0).count();
        real(both) / real(STEPS)
    };
    let probability = 0.25 + 0.4_f64.asin() / (2.0 * std::f64::consts::PI);
    assert!(near(share(0.0), probability, 0.75, STEPS));
    let mixture = 0.5 * (share(10.0) + share(-10.0));
    for constant in [10.0, -10.0] {
        assert!(!near(share(constant), mixture, 0.75, STEPS));
    }
}

/// AK-Bbar-limit: B̄(n,1) → 17/4 and B̄(n,2) → 77/16, with variances 2 Σ_h γ(h)² of the residuals: γ = 17/4, −1/2 and
/// γ = 77/16, 3/2, −1/4. The residuals are computed from the noise, as in AK-z; so ρ(A) does not enter, and at A = 2 they are
/// as near. Readings at A = 2 are not simulated.
#[test]
fn residual_covariances_with_the_true_transition() {
    for a in [0.5, 2.0] {
        let System { v, w, .. } = REGULAR;
        let Path { v: noise, w: error, .. } = REGULAR.path(&mut Stream::named("Bbar", 1969), STEPS);
        let one = |k: usize| error[k] + noise[k] - a * error[k - 1];
        let two = |k: usize| error[k] + noise[k] + a * noise[k - 1] - a * a * error[k - 2];
        let of = |residual: &dyn Fn(usize) -> f64| mean((2..STEPS).map(|k| residual(k) * residual(k)), STEPS);
        let (b1, b2) = (v + w + a * a * w, v + w + a * a * v + a.powi(4) * w);
        let variance =
            |gamma: &[f64]| 2.0 * (gamma[0] * gamma[0] + 2.0 * gamma[1..].iter().map(|g| g * g).sum::<f64>());
        assert!(near(of(&one), b1, variance(&[b1, -a * w]), STEPS));
        assert!(near(of(&two), b2, variance(&[b2, a * v, -a * a * w]), STEPS));
    }
}

/// |Ŝ(n) − S∞| and the averages over k ≤ n of |x(k|k) − x̂(k|k)| and |x(k+3|k) − Â(k)³x̂(k|k)|, at n and 16n.
fn errors_of_filter(system: System, n: usize, scale: f64) -> impl Fn(&mut Stream) -> [[f64; 2]; 3] {
    move |stream| {
        let System { a, v, w, start } = system;
        let number = SMatrix::<f64, 1, 1>::new;
        let mut estimator = Estimator::<1>::new(Reading::Printed);
        // x(0) is known: P(0) = 0. The adaptive filter begins at y(2).
        let mut truth = AdaptiveFilter::new(SVector::<f64, 1>::new(start), number(0.0), Repair::Keep);
        let mut adaptive = AdaptiveFilter::new(SVector::<f64, 1>::new(0.0), number(0.0), Repair::LastSemidefinite);
        let (mut sums, mut errors) = ([0.0; 2], [[f64::NAN; 2]; 3]);
        for (index, &reading) in system.path(stream, 16 * n).y.iter().enumerate() {
            let (k, y) = (index + 1, SVector::<f64, 1>::new(reading));
            let exact = truth.advance(number(a), number(v), number(w), y).expect("S + W > 0");
            estimator.observe(y).expect("no zero");
            let Some(mut estimates) = estimator.estimates() else { continue };
            estimates.transition *= scale;
            let found = adaptive.observe(&estimates, y).expect("no zero");
            let difference = |power: i32| {
                a.powi(power) * truth.mean[0] - estimates.transition[(0, 0)].powi(power) * adaptive.mean[0]
            };
            sums[0] += difference(0).abs();
            sums[1] += difference(3).abs();
            if let Some(place) = [n, 16 * n].iter().position(|&last| last == k) {
                let gap = found.predicted_covariance - exact.predicted_covariance;
                errors[0][place] = gap[(0, 0)].abs();
                errors[1][place] = sums[0] / real(k);
                errors[2][place] = sums[1] / real(k);
            }
        }
        errors
    }
}

/// AK-T2.5, AK-C2.4, and AK-T2.4 with random estimates: V̂ and Ŵ that are negative are replaced by the last that were not.
/// With a wrong Â (half of it) nothing falls; nor, with ρ(A) = 11/10, does the average difference: x grows like Aᵏ, as fast
/// as the error of Â falls.
#[test]
fn the_adaptive_filter_comes_to_the_filter() {
    let ratios =
        |name: &str, system: System, n: usize, scale: f64| ratios_of_medians(name, errors_of_filter(system, n, scale));
    for ratio in ratios("T2.5", REGULAR, 500, 1.0) {
        assert!(ratio < 0.5, "{ratio}");
    }
    for ratio in ratios("T2.5, wrong", REGULAR, 500, 0.5) {
        assert!(ratio > 0.5, "{ratio}");
    }
    let [_, filtered, predicted] = ratios("T2.5, explosive", System { a: 1.1, ..REGULAR }, 15, 1.0);
    assert!(filtered > 0.5 && predicted > 0.5, "{filtered} {predicted}");
}

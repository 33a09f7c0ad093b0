//! The scalar equation of Riccati in `f64`, on ranges where neighbouring inputs are far apart compared with rounding.

use std::convert::Infallible;

use exact_kalman::float::{FloatMode, Form, filter};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
use exact_kalman::scalar::{Rational, nearest_double, ratio};
use exact_kalman::trace::Quantity;

use crate::harness::{Replays, below, cover, harness};

/// Any multiple of 1/16 below `count / 16`.
fn sixteenth(count: u64) -> f64 {
    f64::from(u32::try_from(below(count)).unwrap_or(0)) / 16.0
}

fn scalar(value: f64) -> Matrix<f64> {
    Matrix::column(vec![value])
}

harness! {
    /// `P ↦ f²P − (fPh)²/(h²P + r) + q` by the form of Joseph: finite, never below q, never above `f²P + q`, and it does not fall
    /// where P rises.
    ///
    /// Domain: f in {0, 1/2, 1, 2}, h in {0, 1, 3}, P and the next P in sixteenths up to 4, r from 1/16 to 1, q = 0 or 1/3.
    scalar_steps_are_monotone_and_bounded, unwind 12, Replays::All(4 * 3 * 64 * 16 * 2),
    covers ["unseen", "nothing moves", "a variance of zero", "rises"], {
        let f = [0.0, 0.5, 1.0, 2.0][usize::try_from(below(4)).unwrap_or(0)];
        let h = [0.0, 1.0, 3.0][usize::try_from(below(3)).unwrap_or(0)];
        let (p, r) = (sixteenth(64), sixteenth(16) + 0.0625);
        let q = if below(2) == 0 { 0.0 } else { 1.0 / 3.0 };
        let mode = FloatMode {
            transition: scalar(f),
            observation: scalar(h),
            process_noise: scalar(q),
            observation_noise: scalar(r),
        };
        let step = |p: f64| match mode.step(&scalar(p)) {
            Ok(next) => next[(0, 0)],
            Err(error) => panic!("r > 0, but {error}"),
        };
        let (low, high) = (step(p), step(p + 0.0625));
        assert!(low.is_finite() && low >= q);
        assert!(low <= f * f * p + q);
        assert!(low <= high);
        cover!(h == 0.0, "unseen");
        cover!(f == 0.0, "nothing moves");
        cover!(p == 0.0, "a variance of zero");
        cover!(low < high, "rises");
    }
}

harness! {
    /// One reading of a scalar state, in every form: the filtered variance is finite, not negative and not above the prior, and does
    /// not fall where the prior rises.
    ///
    /// Domain: all nine forms, c in {1, 3}, the prior and the next prior in sixteenths from 1/16 to 1, r in sixteenths from 1/16 to 1.
    scalar_updates_are_monotone_and_bounded, unwind 12, Replays::All(9 * 2 * 16 * 16), covers ["nearly exact", "nearly blind"], {
        let forms = u64::try_from(Form::ALL.len()).unwrap_or(0);
        let form = Form::ALL[usize::try_from(below(forms)).unwrap_or(0)];
        let c = [1, 3][usize::try_from(below(2)).unwrap_or(0)];
        let [p, r] = [(); 2].map(|()| 1 + i64::try_from(below(16)).unwrap_or(0));
        let updated = |p: i64| {
            let one = |n: i64, d: i64| Matrix::column(vec![ratio(n, d)]);
            let system = System::<Rational> {
                timing: Timing::Departing,
                initial: Initial::new(Before::Observation, one(0, 1), one(p, 16)),
                transition: one(1, 1).into(),
                observation: one(c, 1).into(),
                noise: Noise::Covariances { process: one(0, 1).into(), cross: None, observation: one(r, 16).into() },
                input: None,
                observation_input: None,
            };
            let Ok(path) = system.realised(&[Observation::complete([ratio(1, 1)])]) else { panic!("shapes fit") };
            let Ok(path) = path.try_map(|entry| Ok::<_, Infallible>(nearest_double(entry)));
            match filter(form, &path) {
                Ok(values) => values[0][&Quantity::FilteredCovariance][(0, 0)],
                Err(error) => panic!("r > 0, but {error}"),
            }
        };
        let (low, high) = (updated(p), updated(p + 1));
        let prior = nearest_double(&ratio(p, 16));
        assert!(low.is_finite() && low >= 0.0 && low <= prior);
        assert!(low <= high);
        cover!(c == 3 && r == 1 && p == 16, "nearly exact");
        cover!(p == 1 && r == 16, "nearly blind");
    }
}

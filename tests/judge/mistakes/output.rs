//! What is done to right numbers before they are handed out.

use exact_kalman::matrix::Matrix;
use exact_kalman::trace::{Quantity, Values};
use nalgebra::Cholesky;

use super::filter::{Filter, Said};
use super::model::{M, Model};
use super::subject::Steps;

const COVARIANCES: [Quantity; 3] =
    [Quantity::PredictedCovariance, Quantity::FilteredCovariance, Quantity::InnovationCovariance];

fn copy(values: &mut Values<f64>, to: [Quantity; 2], from: Option<&Values<f64>>, of: [Quantity; 2]) {
    for (to, of) in to.into_iter().zip(of) {
        if let Some(value) = from.and_then(|from| from.get(&of)) {
            values.insert(to, value.clone());
        }
    }
}

fn on(values: &mut Values<f64>, names: &[Quantity], change: impl Fn(&Matrix<f64>) -> Matrix<f64>) {
    for (name, value) in values.iter_mut() {
        if names.contains(name) {
            *value = change(value);
        }
    }
}

fn on_all(values: &mut Values<f64>, change: impl Fn(&f64) -> f64) {
    for value in values.values_mut() {
        *value = value.map(&change);
    }
}

fn dense(matrix: &Matrix<f64>) -> M {
    M::from_fn(matrix.rows(), matrix.columns(), |i, j| matrix[(i, j)])
}

fn back(m: &M) -> Matrix<f64> {
    Matrix::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)])
}

fn factor(m: &M) -> M {
    Cholesky::new(m.clone()).map_or_else(|| m.map(|entry| entry.max(0.0).sqrt()), |cholesky| cholesky.l())
}

/// Makes the mistakes of handing out.
pub(crate) fn spoiled(filter: &Filter<'_>, model: &Model, said: &[Said], steps: &mut Steps) {
    let predicted = [Quantity::PredictedMean, Quantity::PredictedCovariance];
    let filtered = [Quantity::FilteredMean, Quantity::FilteredCovariance];
    let right = steps.clone();
    for (k, values) in steps.iter_mut().enumerate() {
        let (own, next) = (&right[k], right.get(k + 1));
        match filter.habit {
            "predicted-for-filtered" => copy(values, filtered, Some(own), predicted),
            "filtered-for-predicted" => copy(values, predicted, Some(own), filtered),
            "filtered-and-predicted-exchanged" => {
                copy(values, filtered, Some(own), predicted);
                copy(values, predicted, Some(own), filtered);
            }
            "next-prediction-for-filtered" => copy(values, filtered, next, predicted),
            "next-prediction-for-predicted" => copy(values, predicted, next, predicted),
            "steps-late" => *values = if k > 0 { right[k - 1].clone() } else { own.clone() },
            "steps-early" => *values = next.unwrap_or(own).clone(),
            "standard-deviations-for-variances" => {
                on(values, &COVARIANCES, |p| p.map(|entry| entry.abs().sqrt().copysign(*entry)));
            }
            "factor-for-covariance" => on(values, &COVARIANCES, |p| {
                let lower = factor(&dense(p));
                back(&if filter.way == 0.0 { lower } else { lower.transpose() })
            }),
            "inverse-for-covariance" => {
                on(values, &COVARIANCES, |p| {
                    dense(p).try_inverse().map_or_else(|| p.clone(), |inverse| back(&inverse))
                });
            }
            "covariances-without-off-diagonals" => {
                on(values, &COVARIANCES, |p| back(&M::from_diagonal(&dense(p).diagonal())));
            }
            "innovation-of-the-other-sign" => on(values, &[Quantity::Innovation], |v| v.map(|entry| -entry)),
            "residual-for-innovation" => {
                let sight = &model.sights[k];
                let rows: Vec<usize> = (0..sight.y.len()).filter(|&i| sight.y[i].is_some()).collect();
                let left = &sight.c * &said[k].filtered.0 + &sight.g;
                on(values, &[Quantity::Innovation], |_| {
                    Matrix::column(rows.iter().filter_map(|&i| sight.y[i].map(|y| y - left[(i, 0)])).collect())
                });
            }
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
            "few-digits" => {
                let digits = filter.way.abs() as usize;
                let printed = |value: &f64| {
                    let text =
                        if filter.way > 0.0 { format!("{value:.*e}", digits - 1) } else { format!("{value:.digits$}") };
                    text.parse().expect("a printed number")
                };
                on_all(values, printed);
            }
            #[expect(clippy::cast_possible_truncation, reason = "this is the mistake")]
            "single-precision" => {
                on_all(values, |entry| f64::from(*entry as f32));
            }
            _ => {}
        }
    }
}

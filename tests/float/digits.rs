//! How many decimal digits of a result are right.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::Rational;
use exact_kalman::trace::{Quantity, Values};
use num_traits::ToPrimitive;

/// What stands for exact.
const ALL: f64 = 17.0;

/// The least digits over all quantities and entries: −log₁₀ of the error, relative to the standard deviations
/// that belong to the entry (or to the value, where that is greater).
pub(crate) fn least(found: &Values<f64>, truth: &Values<Rational>) -> f64 {
    assert!(found.keys().eq(truth.keys()), "found {:?}, expected {:?}", found.keys(), truth.keys());
    let state = deviations(&truth[&Quantity::PredictedCovariance]);
    let filtered = deviations(&truth[&Quantity::FilteredCovariance]);
    let innovation = truth.get(&Quantity::InnovationCovariance).map(deviations).unwrap_or_default();
    let digits = truth.iter().flat_map(|(quantity, exact)| {
        let (rows, columns) = match quantity {
            Quantity::FilteredMean => (filtered.clone(), vec![1.0]),
            Quantity::PredictedMean => (state.clone(), vec![1.0]),
            Quantity::Innovation => (innovation.clone(), vec![1.0]),
            Quantity::PredictedCovariance => (state.clone(), state.clone()),
            Quantity::InnovationCovariance => (innovation.clone(), innovation.clone()),
            Quantity::Gain => (state.clone(), innovation.iter().map(|deviation| deviation.recip()).collect()),
            _ => (filtered.clone(), filtered.clone()),
        };
        let found = &found[quantity];
        assert_eq!(found.shape(), exact.shape(), "{quantity}");
        let places = (0..exact.rows()).flat_map(|i| (0..exact.columns()).map(move |j| (i, j))).collect::<Vec<_>>();
        places
            .into_iter()
            .map(move |(i, j)| entry(found[(i, j)], &exact[(i, j)], rows[i] * columns[j]))
            .collect::<Vec<_>>()
    });
    digits.fold(ALL, f64::min)
}

fn entry(found: f64, exact: &Rational, scale: f64) -> f64 {
    let error = Rational::from_float(found).expect("filters return finite numbers only") - exact;
    let error = error.to_f64().expect("a double").abs();
    if error == 0.0 {
        return ALL;
    }
    let scale = scale.max(exact.to_f64().expect("a double").abs());
    (-(error / scale).log10()).min(ALL)
}

fn deviations(covariance: &Matrix<Rational>) -> Vec<f64> {
    (0..covariance.rows()).map(|i| covariance[(i, i)].to_f64().expect("a double").sqrt()).collect()
}

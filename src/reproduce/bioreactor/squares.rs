//! Mean squared errors and their comparison.

use super::Concentration;

/// The sum of the squared errors over n − 1, as printed: no mean is subtracted.
///
/// HV-MS.SKP: `MS_SKP = (1/(n−1)) Σ_{k=1..n} (x_B(k) − x̂_SKP,B(k))²`
///
/// HV-MS.EKP: `MS_EKP = (1/(n−1)) Σ_{k=1..n} (x_B(k) − x̂_EKP,B(k))²`
///
/// d steps ahead there are only n − d + 1 errors; the divisor stays. Nothing for fewer than two steps.
pub fn mean_squared_error<T: Concentration>(errors: &[T], steps: usize) -> Option<T> {
    let divisor = T::from_usize(steps.checked_sub(1)?)?;
    let sum = errors.iter().fold(T::zero(), |sum, error| sum + error.clone() * error.clone());
    if divisor.is_zero() { None } else { Some(sum / divisor) }
}

/// By how many per cent the extended predictor is worse.
///
/// HV-Delta: `Δ = 100 (MS_EKP − MS_SKP)/MS_SKP`
///
/// Nothing where MS_SKP is 0.
pub fn relative_efficiency<T: Concentration>(standard: &T, extended: &T) -> Option<T> {
    if standard.is_zero() {
        return None;
    }
    Some(T::from_u8(100)? * (extended.clone() - standard.clone()) / standard.clone())
}

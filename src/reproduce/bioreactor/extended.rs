//! The extended predictor: the old substrates are further states, and the growth law is made linear.

use std::num::NonZeroUsize;

use super::{Belief, BioreactorError, Concentration, Reactor, Setting, Unphysical};
use crate::float::{AdditiveNoise, ExtendedSystem, ExtendedTrace, Linearisation, Linearised, predict_extended};
use crate::matrix::Matrix;
use crate::model::Observation;

/// The transition of the extended state [x_B, x_S, z₁, …, z_d] without noise, z_i being x_S of i steps before; and its
/// Jacobian matrix.
///
/// HV-EKP: `z(k+1) = x_S(k), so that μ(k) = α z(k)/(γ + z(k)^β)`
///
/// The growth rate depends on the last entry. Shapes: `state` (2+d)×1; the results are of that order.
///
/// # Errors
///
/// [`Unphysical`] where the growth law has no value.
///
/// # Panics
///
/// If the state has fewer than two entries.
pub fn linear_at<T: Concentration>(
    reactor: &Reactor<T>,
    dilution: &T,
    state: &Matrix<T>,
) -> Result<(Matrix<T>, Matrix<T>), Unphysical> {
    let n = state.rows();
    let eaten_from = &state[(n - 1, 0)];
    let (growth, slope) = (reactor.growth_rate(eaten_from)?, reactor.growth_slope(eaten_from)?);
    let biomass = state[(0, 0)].clone();
    let plant = [biomass.clone(), state[(1, 0)].clone()];
    let next = reactor.next(&plant, &growth, dilution, &[T::zero(), T::zero()]);
    let value = Matrix::from_fn(n, 1, |i, _| if i < 2 { next[i].clone() } else { state[(i - 1, 0)].clone() });
    let known = reactor.transition(&growth, dilution);
    let mut jacobian = Matrix::from_fn(n, n, |i, j| match (i, j) {
        (0 | 1, 0 | 1) => known[(i, j)].clone(),
        _ if i >= 2 && j + 1 == i => T::one(),
        _ => T::zero(),
    });
    let through_growth = reactor.period.clone() * slope * biomass;
    let last = n - 1;
    jacobian[(0, last)] = jacobian[(0, last)].clone() + through_growth.clone();
    jacobian[(1, last)] = jacobian[(1, last)].clone() - through_growth / reactor.yield_coefficient.clone();
    Ok((value, jacobian))
}

/// The extended predictor along readings. The dilution rate is known, as for the standard predictor; the growth rate is
/// taken at the estimate of the old substrate.
///
/// `ahead` may be at most one more than the delay; a dilution rate that depends on a reading to come counts as NaN.
///
/// # Errors
///
/// [`BioreactorError::States`] unless the start has 2 + d states; [`BioreactorError::Extended`] where the predictor stops.
pub fn extended_predictions(
    setting: &Setting<f64>,
    start: &Belief<f64>,
    linearisation: Linearisation,
    readings: &[f64],
    ahead: NonZeroUsize,
) -> Result<ExtendedTrace, BioreactorError> {
    let n = 2 + setting.delay();
    start.check_states("extended", n)?;
    let reactor = &setting.reactor;
    let transition = |k: usize, state: &Matrix<f64>| {
        let seen = match k.checked_sub(setting.delay()) {
            None => setting.earlier[k].reading,
            Some(j) => readings.get(j).copied().unwrap_or(f64::NAN),
        };
        let (value, jacobian) = linear_at(reactor, &reactor.dilution(&seen)?, state)?;
        Ok(Linearised { value, jacobian })
    };
    let sensor = Matrix::from_fn(1, n, |_, j| if j == 1 { 1.0 } else { 0.0 });
    let observation = |_, state: &Matrix<f64>| {
        Ok(Linearised { value: Matrix::column(vec![state[(1, 0)]]), jacobian: sensor.clone() })
    };
    let covariance = setting.noise_covariance();
    let noise = AdditiveNoise {
        process: Matrix::from_fn(n, n, |i, j| if i < 2 && j < 2 { covariance[(i, j)] } else { 0.0 }),
        cross: Matrix::column(vec![0.0; n]),
        observation: Matrix::column(vec![0.0]),
    };
    let system = ExtendedSystem {
        mean: &start.mean,
        covariance: &start.covariance,
        transition: &transition,
        observation: &observation,
        noise: &|_| noise.clone(),
        linearisation,
    };
    let readings: Vec<_> = readings.iter().map(|&y| Observation::complete([y])).collect();
    Ok(predict_extended(&system, &readings, ahead)?)
}

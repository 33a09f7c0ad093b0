//! The reactor as a linear system with coefficients adapted to its readings.

use std::sync::Arc;

use super::{Belief, BioreactorError, Coefficients, Concentration, Setting};
use crate::matrix::Matrix;
use crate::model::{
    Before, Coefficient, Initial, Input, Noise, Observation, Past, Path, Step, System, Timing, Transition,
};
use crate::scalar::{Rational, Undefined};

/// The exact system: departing, the start before the first reading, no noise in the readings.
///
/// HV-9a: `x(k+1) = [[1 + T(μ(k) − u(k)), 0], [−Tμ(k)/τ, 1 − Tu(k)]] x(k) + [0; TS₀] u(k) + D(k)w(k)`
///
/// HV-9b: `y(k) = [0, 1] x(k)`
///
/// The paper's C(k−1) = \[0, 1\], F(k−1) = 0, and there is no G v. Where an exponent is no natural number the growth rate
/// is a rounded double, taken as an exact datum ([`Exponent::Real`](super::Exponent::Real)).
///
/// # Examples
///
/// The start as printed, run under the override: one reading makes the variance of the biomass negative.
///
/// ```
/// use exact_kalman::filter::filter;
/// use exact_kalman::model::Observation;
/// use exact_kalman::reproduce::bioreactor::{system, Exponent, Preset, Setting};
/// use exact_kalman::scalar::ratio;
///
/// let setting = Setting::printed(Exponent::Natural(1), 1);
/// let start = Preset::Printed.start(1);
/// let mut system = system(&setting, &start.standard);
/// let reading = [Observation::complete([ratio(30, 1)])];
/// assert!(system.realised(&reading).is_err());
/// system.initial.allow_indefinite = true;
/// let filtered = filter(&system.realised(&reading)?)?.records[0].filtered.clone();
/// assert_eq!(filtered.mean[(0, 0)], ratio(-335, 4));
/// assert_eq!(filtered.covariance[(0, 0)], ratio(-3045, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn system(setting: &Setting<Rational>, start: &Belief<Rational>) -> System<Rational> {
    let setting = Arc::new(setting.clone());
    let rule = |matrix: fn(&Setting<Rational>, &Coefficients<Rational>) -> Matrix<Rational>| {
        let setting = Arc::clone(&setting);
        Coefficient::adapted(move |past: Past<'_, Rational>| {
            match setting.coefficients(past.step(), |j| past.entry(j, 0).cloned()) {
                Ok(Some(rates)) => Ok(matrix(&setting, &rates)),
                Ok(None) => Err(Undefined::Missing),
                Err(_) => Err(Undefined::OutsideTheRing),
            }
        })
    };
    System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, start.mean.clone(), start.covariance.clone()),
        transition: rule(|setting, rates| setting.reactor.transition(&rates.growth, &rates.dilution)),
        observation: observation_matrix().into(),
        noise: Noise::Factors {
            process: Matrix::from_fn(2, 2, |i, j| setting.noise_factor[i][j].clone()).into(),
            observation: Matrix::zeros(1, 2).into(),
        },
        input: Some(Input { matrix: None, vector: rule(|setting, rates| setting.reactor.input(&rates.dilution)) }),
        observation_input: None,
    }
}

/// The exact system along readings.
///
/// # Errors
///
/// [`BioreactorError::Unphysical`] with the step whose rates have no value, else what
/// [`System::realised`] finds; a start that is not positive semidefinite unless `allow_indefinite`.
pub fn realised(
    setting: &Setting<Rational>,
    start: &Belief<Rational>,
    allow_indefinite: bool,
    readings: &[Rational],
) -> Result<Path<Rational>, BioreactorError> {
    for step in 0..readings.len() {
        let rates = setting.coefficients(step, |j| readings.get(j).cloned());
        rates.map_err(|source| BioreactorError::Unphysical { step, source })?;
    }
    let mut system = system(setting, start);
    system.initial.allow_indefinite = allow_indefinite;
    let readings: Vec<_> = readings.iter().map(|y| Observation::complete([y.clone()])).collect();
    Ok(system.realised(&readings)?)
}

/// The same path computed in doubles, for simulations; nothing is checked but the rates.
///
/// # Errors
///
/// [`BioreactorError::Unphysical`] with the step whose rates have no value; [`BioreactorError::States`] unless the start has
/// two states.
pub fn path_in_doubles(
    setting: &Setting<f64>,
    start: &Belief<f64>,
    readings: &[f64],
) -> Result<Path<f64>, BioreactorError> {
    start.check_states("standard", 2)?;
    let noise = setting.noise_covariance();
    let scalar = |value: f64| Matrix::column(vec![value]);
    let step = |(k, &reading): (usize, &f64)| {
        let rates = setting.coefficients(k, |j| readings.get(j).copied());
        let rates = rates.map_err(|source| BioreactorError::Unphysical { step: k, source })?;
        let transition = rates.map(|Coefficients { growth, dilution }| Transition {
            matrix: setting.reactor.transition(&growth, &dilution),
            input: setting.reactor.input(&dilution),
            noise: noise.clone(),
            cross_noise: Matrix::column(vec![0.0; 2]),
        });
        Ok(Step {
            transition,
            observation: observation_matrix(),
            observation_input: scalar(0.0),
            observation_noise: scalar(0.0),
            reading: Observation::complete([reading]),
        })
    };
    let steps = readings.iter().enumerate().map(step).collect::<Result<_, BioreactorError>>()?;
    let initial = Initial::new(Before::Observation, start.mean.clone(), start.covariance.clone());
    Ok(Path::from_parts(Timing::Departing, initial, steps))
}

/// C = [0, 1].
fn observation_matrix<T: Concentration>() -> Matrix<T> {
    Matrix::from_fn(1, 2, |_, j| if j == 0 { T::zero() } else { T::one() })
}

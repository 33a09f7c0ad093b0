//! One run of the reactor, predicted twice.

use super::{
    Belief, BioreactorError, Earlier, Exponent, Options, Setting, Truth, extended_predictions, mean_squared_error,
    path_in_doubles, standard_predictions,
};
use crate::filter::FilterError;
use crate::gaussian::Gaussian;
use crate::matrix::Matrix;
use crate::reproduce::Stream;
use crate::scalar::{Rational, exact_value};

/// The mean squared errors of one run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// MS_SKP
    pub standard: f64,
    /// MS_EKP
    pub extended: f64,
}

/// The biomass of one run, and what was predicted; entry k of each list is the paper's k + 1.
pub(super) struct Course {
    pub(super) biomass: Vec<f64>,
    pub(super) standard: Vec<f64>,
    pub(super) extended: Vec<f64>,
}

/// The mean squared errors of a run for one exponent. Runs of one number see the same noise for all exponents.
///
/// # Errors
///
/// [`BioreactorError`]: the options have no meaning, or reactor or predictor stopped.
pub fn trial(options: &Options, exponent: Exponent, run: u64) -> Result<Errors, BioreactorError> {
    let Course { biomass, standard, extended } = course(options, exponent, run)?;
    // Before that there is no prediction of so many steps.
    let first = options.ahead.get() - 1;
    let error = |predicted: &[f64]| {
        let errors: Vec<f64> =
            biomass.iter().zip(predicted).skip(first).map(|(true_one, found)| true_one - found).collect();
        mean_squared_error(&errors, options.steps).ok_or(BioreactorError::Empty)
    };
    Ok(Errors { standard: error(&standard)?, extended: error(&extended)? })
}

/// Simulates a run and predicts it.
pub(super) fn course(options: &Options, exponent: Exponent, run: u64) -> Result<Course, BioreactorError> {
    options.checked()?;
    let seed = options.seed.wrapping_add(run);
    let mut setting = Setting::printed(exponent, options.delay).doubles();
    let mut standard_start = options.start.standard.doubles();
    if options.truth == Truth::Drawn {
        standard_start = drawn(&mut setting, &options.start.extended, &mut Stream::named("HV-C4b", seed))?;
    }
    let noise = Stream::named("HV-Sim", seed).pairs(options.steps - 1);
    let states = setting.simulated(&noise)?;
    let readings: Vec<f64> = states.iter().map(|[_, substrate]| *substrate).collect();
    let path = path_in_doubles(&setting, &standard_start, &readings)?;
    let standard = standard_predictions(&path, options.ahead.get())?;
    let extended_start = options.start.extended.doubles();
    let linearisation = options.start.linearisation;
    let extended = extended_predictions(&setting, &extended_start, linearisation, &readings, options.ahead)?;
    Ok(Course {
        biomass: states.iter().map(|[biomass, _]| *biomass).collect(),
        standard: standard.iter().map(|mean| mean[(0, 0)]).collect(),
        extended: extended.predictions().take(options.steps).map(|law| law.mean[(0, 0)]).collect(),
    })
}

/// Draws x(1) and the old substrates from a belief, and returns the law of x(1) given these.
fn drawn(
    setting: &mut Setting<f64>,
    belief: &Belief<Rational>,
    stream: &mut Stream,
) -> Result<Belief<f64>, BioreactorError> {
    let n = belief.mean.rows();
    let factors = belief.factors("extended")?;
    let pivots = Belief { mean: Matrix::column(factors.pivots), covariance: factors.lower }.doubles();
    let sources: Vec<f64> = (0..n).map(|i| pivots.mean[(i, 0)].sqrt() * stream.normal()).collect();
    let centre = belief.doubles().mean;
    let value = |i: usize| centre[(i, 0)] + (0..=i).map(|j| pivots.covariance[(i, j)] * sources[j]).sum::<f64>();
    setting.first = [value(0), value(1)];
    let delay = setting.delay();
    for (i, earlier) in setting.earlier.iter_mut().enumerate() {
        let substrate = value(1 + delay - i);
        *earlier = Earlier { substrate, reading: substrate };
    }
    let old: Vec<usize> = (2..n).collect();
    let values: Vec<Rational> = old.iter().filter_map(|&i| exact_value(value(i))).collect();
    let stopped = |source| BioreactorError::Exact(FilterError { step: 0, source, computed: Vec::new() });
    let law = Gaussian::new(belief.mean.clone(), belief.covariance.clone());
    let law = law.map_err(|_| BioreactorError::Asymmetric { predictor: "extended" })?;
    let given = law.conditioned(&old, &Matrix::column(values)).map_err(stopped)?.law;
    Ok(Belief { mean: given.mean().clone(), covariance: given.covariance().clone() }.doubles())
}

//! Figures 1 and 2: one run, drawn.

use std::fmt;

use super::trial::{Course, course};
use super::{BioreactorError, Exponent, Options};

/// The biomass at one time, and its predictions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The paper's k, from 1.
    pub time: usize,
    /// x_B(k), mg/l.
    pub biomass: f64,
    /// The standard prediction.
    pub standard: f64,
    /// The extended prediction.
    pub extended: f64,
}

/// The course of one run.
///
/// HV-Fig1: `x_B(k), x̂_SKP,B(k) and x̂_EKP,B(k) for k = 1, …, 150`
///
/// HV-Fig2: `x_B(k), x̂_SKP2,B(k) and x̂_EKP2,B(k) under HV-mu2 and HV-u2`
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// From the first time that is predicted d steps ahead.
    pub points: Vec<Point>,
}

/// The course of a run for one exponent; the paper draws β = 1/2.
///
/// # Errors
///
/// [`BioreactorError`]: the options have no meaning, or reactor or predictor stopped.
pub fn figure(options: &Options, exponent: Exponent, run: u64) -> Result<Figure, BioreactorError> {
    let Course { biomass, standard, extended } = course(options, exponent, run)?;
    let lists = biomass.iter().zip(&standard).zip(&extended).enumerate().skip(options.ahead.get() - 1);
    let points =
        lists.map(|(k, ((&biomass, &standard), &extended))| Point { time: k + 1, biomass, standard, extended });
    Ok(Figure { points: points.collect() })
}

impl fmt::Display for Figure {
    /// Comma-separated values with a head line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "k,biomass,standard,extended")?;
        for Point { time, biomass, standard, extended } in &self.points {
            writeln!(f, "{time},{biomass},{standard},{extended}")?;
        }
        Ok(())
    }
}

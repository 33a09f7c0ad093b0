//! Table 1, over many runs instead of one.

use std::fmt;

use super::{Band, BioreactorError, Errors, Exponent, Options, PRINTED, Printed, relative_efficiency, trial};

/// One exponent.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// β.
    pub exponent: Exponent,
    /// MS_SKP over the runs; nothing if all failed.
    pub standard: Option<Band>,
    /// MS_EKP.
    pub extended: Option<Band>,
    /// Δ in per cent.
    pub efficiency: Option<Band>,
    /// In how many runs the extended predictor had the smaller error.
    pub extended_better: usize,
    /// In how many the reactor or a predictor stopped; they count nowhere else.
    pub failed: usize,
    /// The printed row of that exponent.
    pub printed: Option<Printed>,
}

/// The rows of Table 1, computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// One per exponent.
    pub rows: Vec<Row>,
}

/// Simulates the options' runs for each of the ten printed exponents.
///
/// HV-Tab1: `MS_SKP rises from 65.38 to 75.45, MS_EKP from 66.22 to 88.72, Δ from 1.28 % to 17.59 % as β falls from 2 to 0`
///
/// No choice of what the paper leaves out gives the whole table. The printed numbers stand beside the computed ones, as
/// far as they belong to the options: the paper has no numbers for two steps ahead.
///
/// # Errors
///
/// [`BioreactorError`] if the options have no meaning. Runs that stop are counted, not reported.
///
/// # Examples
///
/// ```
/// use exact_kalman::reproduce::bioreactor::{table, Options, Preset};
///
/// let mut options = Options { runs: 3, ..Options::one_step(Preset::Printed.start(1)) };
/// assert!(table(&options).is_err(), "the printed covariances are indefinite");
/// options.start.allow_indefinite = true;
/// println!("{}", table(&options)?);
/// # Ok::<(), exact_kalman::reproduce::bioreactor::BioreactorError>(())
/// ```
pub fn table(options: &Options) -> Result<Table, BioreactorError> {
    options.checked()?;
    let rows = PRINTED.iter().map(|printed| {
        let errors: Vec<_> = (0..options.runs).filter_map(|run| trial(options, printed.exponent, run).ok()).collect();
        let all = usize::try_from(options.runs).unwrap_or(usize::MAX);
        row(printed, &errors, all - errors.len(), options.ahead.get() == 1)
    });
    Ok(Table { rows: rows.collect() })
}

fn row(printed: &Printed, errors: &[Errors], failed: usize, comparable: bool) -> Row {
    let band = |value: &dyn Fn(&Errors) -> Option<f64>| Band::of(errors.iter().filter_map(value).collect());
    Row {
        exponent: printed.exponent,
        standard: band(&|errors| Some(errors.standard)),
        extended: band(&|errors| Some(errors.extended)),
        efficiency: band(&|errors| relative_efficiency(&errors.standard, &errors.extended)),
        extended_better: errors.iter().filter(|errors| errors.extended < errors.standard).count(),
        failed,
        printed: comparable.then_some(*printed),
    }
}

impl fmt::Display for Table {
    /// One line per number: printed value, median, band, and whether the printed value lies in it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:<6} {:<7} {:>8} {:>10} {:>10} {:>10}  in band",
            "beta", "number", "printed", "5 %", "median", "95 %"
        )?;
        for row in &self.rows {
            let printed = |value: fn(&Printed) -> i32| row.printed.as_ref().map(|row| f64::from(value(row)) / 100.0);
            let numbers = [
                ("MS_SKP", printed(|row| row.standard), row.standard),
                ("MS_EKP", printed(|row| row.extended), row.extended),
                ("Delta %", printed(|row| row.efficiency), row.efficiency),
            ];
            for (name, printed, band) in numbers {
                line(f, row.exponent, name, printed, band)?;
            }
            writeln!(f, "{:<6} extended better in {} runs, {} failed", row.exponent, row.extended_better, row.failed)?;
        }
        Ok(())
    }
}

fn line(
    f: &mut fmt::Formatter<'_>,
    exponent: Exponent,
    name: &str,
    printed: Option<f64>,
    band: Option<Band>,
) -> fmt::Result {
    let shown = printed.map_or("-".to_owned(), |value| format!("{value:.2}"));
    write!(f, "{exponent:<6} {name:<7} {shown:>8} ")?;
    let Some(band) = band else { return writeln!(f, "{:>10} {:>10} {:>10}  -", "-", "-", "-") };
    let Band { low, median, high } = band;
    let inside = printed.map_or("-", |value| if band.contains(value) { "yes" } else { "no" });
    writeln!(f, "{low:>10.2} {median:>10.2} {high:>10.2}  {inside}")
}

//! `reproduce HV-Tab1`, `HV-Fig1`, `HV-Fig2`: the reactor of Hilgert and Vila, predicted twice.

use std::io::Write as _;

use clap::ValueEnum;
use serde_json::json;

use crate::cli::Format;
use crate::cli::exit::{Exit, Trouble};
use crate::float::Linearisation;
use crate::reproduce::bioreactor::{Band, BioreactorError, Exponent, Options, Preset, Row, Truth, figure, table};

const EXAMPLES: &str = "\
Examples:
  exact-kalman reproduce HV-Tab1 --start repaired --runs 20
  exact-kalman reproduce HV-Tab1 --start printed --allow-indefinite --runs 20
  exact-kalman reproduce HV-Tab1 --start drawn --two-steps --runs 20 --format json

Each printed number is compared with the middle 90 % of the runs. No choice of what the paper leaves
out gives the whole table; `exact-kalman spec HV-Tab1` says why. The printed covariances are not
positive semidefinite: they are refused unless --allow-indefinite is given.";

const FIGURE_EXAMPLES: &str = "\
Examples:
  exact-kalman reproduce HV-Fig1 --start repaired
  exact-kalman reproduce HV-Fig2 --start repaired
  exact-kalman reproduce HV-Fig1 --start drawn --beta 2 --seed 7

Columns, separated by commas: the time k, the biomass, its standard and its extended prediction.";

/// How the predictors start.
#[derive(clap::Args, Debug)]
struct Start {
    /// What the predictors believe at the start: as printed (indefinite), the choice that comes closest to the printed
    /// table (indefinite), the printed one with P_BB = 5000, or a law that the true start is drawn from.
    #[arg(
        long = "start",
        value_name = "START",
        value_parser = clap::builder::PossibleValuesParser::new(Preset::ALL.map(Preset::name)),
        default_value = "repaired"
    )]
    preset: String,
    /// Where the extended predictor is made linear; the paper does not say.
    #[arg(long, value_enum, default_value_t)]
    linearisation: Point,
    /// Run covariances that are not positive semidefinite: what comes out are numbers of the recursion, no moments.
    #[arg(long)]
    allow_indefinite: bool,
    /// The seed of the random streams.
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

/// Where the extended predictor is made linear.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum Point {
    /// At the prediction.
    #[default]
    Prediction,
    /// At the filtered mean.
    Filtered,
}

/// Table 1 of Hilgert and Vila 1999: errors of the standard and the extended predictor
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Errors {
    #[command(flatten)]
    start: Start,
    /// How many runs; the paper shows one.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    runs: u64,
    /// Predict two steps ahead, for which the paper prints no numbers.
    #[arg(long)]
    two_steps: bool,
    /// How to print the table.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// Figure 1 of Hilgert and Vila 1999: one run, predicted one step ahead
#[derive(clap::Args, Debug)]
#[command(after_help = FIGURE_EXAMPLES)]
pub(super) struct OneStep {
    #[command(flatten)]
    run: Run,
}

/// Figure 2 of Hilgert and Vila 1999: one run, predicted two steps ahead
#[derive(clap::Args, Debug)]
#[command(after_help = FIGURE_EXAMPLES)]
pub(super) struct TwoSteps {
    #[command(flatten)]
    run: Run,
}

#[derive(clap::Args, Debug)]
struct Run {
    #[command(flatten)]
    start: Start,
    /// The exponent β of the growth law, at least 0.
    #[arg(long, default_value_t = 0.5, value_parser = exponent, allow_negative_numbers = true)]
    beta: f64,
}

fn exponent(text: &str) -> Result<f64, String> {
    let beta = text.parse().ok().filter(|beta: &f64| beta.is_finite() && *beta >= 0.0);
    beta.ok_or_else(|| "a number, at least 0".to_owned())
}

impl Start {
    fn options(&self, two_steps: bool, runs: u64) -> Options {
        // The parser lets nothing else pass.
        let preset = Preset::ALL.into_iter().find(|preset| preset.name() == self.preset).unwrap_or(Preset::Repaired);
        let mut options =
            if two_steps { Options::two_steps(preset.start(2)) } else { Options::one_step(preset.start(1)) };
        options.truth = if preset == Preset::Drawn { Truth::Drawn } else { Truth::Fixed };
        options.start.linearisation = match self.linearisation {
            Point::Prediction => Linearisation::Prediction,
            Point::Filtered => Linearisation::Filtered,
        };
        options.start.allow_indefinite = self.allow_indefinite;
        options.seed = self.seed;
        options.runs = runs;
        options
    }

    /// A refusal, with the way out where there is one.
    fn refused(&self, error: &BioreactorError) -> Trouble {
        let message = match error {
            BioreactorError::Indefinite { predictor, proof, .. } => format!(
                "the initial covariance of the {predictor} predictor is not positive semidefinite: v = {} has v\'Pv = {}; \
                 --start repaired is a start, and --allow-indefinite runs this one all the same",
                proof.witness, proof.value
            ),
            // No choice of the start is to blame.
            other => return Trouble::Other { place: "the reactor".to_owned(), message: other.to_string() },
        };
        Trouble::Other { place: format!("--start {}", self.preset), message }
    }
}

impl Errors {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let options = self.start.options(self.two_steps, self.runs);
        let table = table(&options).map_err(|error| self.start.refused(&error))?;
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Json => {
                for row in &table.rows {
                    writeln!(out, "{}", self.document(row))?;
                }
            }
            Format::Text => {
                let steps = if self.two_steps { "two steps" } else { "one step" };
                writeln!(
                    out,
                    "HV-Tab1 · {steps} ahead, start {}, linear at the {}; {} runs of 150 steps, seed {}",
                    self.start.preset,
                    self.start.point(),
                    self.runs,
                    self.start.seed
                )?;
                write!(out, "{table}")?;
            }
        }
        Ok(Exit::Clean)
    }

    fn document(&self, row: &Row) -> serde_json::Value {
        let number = |band: Option<Band>, printed: Option<i32>| {
            let printed = printed.map(|hundredths| f64::from(hundredths) / 100.0);
            band.map(|band| {
                json!({
                    "printed": printed,
                    "low": band.low,
                    "median": band.median,
                    "high": band.high,
                    "inside": printed.map(|value| band.contains(value)),
                })
            })
        };
        json!({
            "table": "HV-Tab1",
            "start": self.start.preset,
            "linearisation": self.start.point(),
            "steps_ahead": if self.two_steps { 2 } else { 1 },
            "runs": self.runs,
            "seed": self.start.seed,
            "beta": row.exponent.to_string(),
            "standard": number(row.standard, row.printed.map(|printed| printed.standard)),
            "extended": number(row.extended, row.printed.map(|printed| printed.extended)),
            "efficiency": number(row.efficiency, row.printed.map(|printed| printed.efficiency)),
            "extended_better": row.extended_better,
            "failed": row.failed,
        })
    }
}

impl Start {
    fn point(&self) -> &'static str {
        match self.linearisation {
            Point::Prediction => "prediction",
            Point::Filtered => "filtered mean",
        }
    }
}

impl OneStep {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        self.run.print(false)
    }
}

impl TwoSteps {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        self.run.print(true)
    }
}

impl Run {
    fn print(&self, two_steps: bool) -> Result<Exit, Trouble> {
        let options = self.start.options(two_steps, 1);
        let course = figure(&options, Exponent::Real(self.beta), 0).map_err(|error| self.start.refused(&error))?;
        write!(std::io::stdout().lock(), "{course}")?;
        Ok(Exit::Clean)
    }
}

//! `identify`: systems from data, exactly.

use std::io::Write as _;
use std::path::PathBuf;

use serde_json::{Map, Value};

use super::Format;
use super::exit::{Exit, Trouble};
use super::input;
use crate::filter::filter;
use crate::identify::{
    AdaptiveRecord, Belief, Estimates, History, Regression, Series, SeriesError, adaptive_filter, estimates,
};
use crate::matrix::Matrix;
use crate::model::{Observation, Reading, Repair};
use crate::protocol::{Decimal, Identification, IdentificationError, LeastSquares, Moments, RepairName, ResidualsName};
use crate::scalar::Rational;

const EXAMPLES: &str = "\
Examples:
  exact-kalman identify examples/identify/moments.json --last           A, V and W from readings
  exact-kalman identify examples/identify/moments.json --exact --last   as fractions
  exact-kalman identify examples/identify/least-squares.json            coefficients, step by step
  exact-kalman identify examples/identify/adaptive.json --format json   with the adaptive filter

The input is described in docs/IDENTIFY.md. Exit codes: 0 all answered, 2 trouble with the input";

/// Estimate a system from data, exactly
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Identify {
    /// A file with one document, or `-` for standard input.
    file: PathBuf,
    /// Significant decimal digits, correctly rounded (halves away from zero).
    #[arg(long, default_value_t = 17, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    digits: u32,
    /// Print fractions instead of decimals.
    #[arg(long, conflicts_with = "digits")]
    exact: bool,
    /// Only the last step.
    #[arg(long)]
    last: bool,
    /// How to print the results; JSON is one object on one line.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// The largest work that is begun, some seconds (in release mode): fractions lengthen with every reading.
const MAXIMAL_ORDER: usize = 4;
const MAXIMAL_LAGS: usize = 32;

/// A step: its title, and its values by name.
struct Step {
    title: String,
    values: Vec<(&'static str, Matrix<Rational>)>,
}

impl Identify {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let place = self.file.display().to_string();
        let text = input::text(&self.file)?;
        let refused = |source| Trouble::Identification { place: place.clone(), source };
        let document = Identification::parse(text.strip_prefix('\u{feff}').unwrap_or(&text)).map_err(refused)?;
        let steps = match (&document.moments, &document.least_squares) {
            (Some(moments), _) => moments_steps(&document, moments),
            (None, Some(least_squares)) => least_squares_steps(&document, least_squares),
            (None, None) => Ok(Vec::new()),
        };
        let mut steps = steps.map_err(refused)?;
        if self.last {
            steps.drain(..steps.len().saturating_sub(1));
        }
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Text => {
                for step in &steps {
                    writeln!(out, "{}", step.title)?;
                    for (name, matrix) in &step.values {
                        writeln!(out, "  {name:24} {}", self.text(matrix))?;
                    }
                }
            }
            Format::Json => writeln!(out, "{}", self.json(&steps))?,
        }
        Ok(Exit::Clean)
    }

    fn number(&self, value: &Rational) -> String {
        if self.exact { value.to_string() } else { Decimal::rounded(value, self.digits).to_string() }
    }

    /// A number, a column as `[a, b]`, or a matrix as `[[a, b], [c, d]]`.
    fn text(&self, matrix: &Matrix<Rational>) -> String {
        let texts = matrix.map(|entry| self.number(entry));
        match (texts.rows(), texts.columns()) {
            (1, 1) => texts[(0, 0)].clone(),
            (_, 1) => format!("[{}]", texts.entries().join(", ")),
            _ => texts.to_string(),
        }
    }

    fn json(&self, steps: &[Step]) -> Value {
        let row = |matrix: &Matrix<Rational>, i: usize| -> Value {
            matrix.row(i).iter().map(|entry| Value::from(self.number(entry))).collect()
        };
        let step = |step: &Step| {
            let mut object = Map::from_iter([("step".to_owned(), Value::from(step.title.clone()))]);
            for (name, matrix) in &step.values {
                let rows: Value = (0..matrix.rows()).map(|i| row(matrix, i)).collect();
                object.insert(name.replace([' ', '-'], "_"), rows);
            }
            Value::from(object)
        };
        Map::from_iter([("steps".to_owned(), steps.iter().map(step).collect::<Value>())]).into()
    }
}

fn too_large(path: &str, what: &str) -> IdentificationError {
    IdentificationError::at(path, format!("{what}: exact numbers would be too long; take fewer"))
}

fn moments_steps(document: &Identification, moments: &Moments) -> Result<Vec<Step>, IdentificationError> {
    const PATH: &str = "moments.readings";
    let reading = match moments.residuals {
        ResidualsName::Printed => Reading::Printed,
        ResidualsName::Last => Reading::Last,
        ResidualsName::Predictive => Reading::Predictive,
    };
    let (n, p) = (moments.readings.len(), moments.readings.first().map_or(0, Vec::len));
    let most = match (reading, &moments.adaptive_filter) {
        (Reading::Last, None) => 4000,
        (Reading::Last, Some(_)) => 80,
        (_, None) => 120,
        (_, Some(_)) => 24,
    };
    if p > MAXIMAL_ORDER || n.saturating_mul(p.saturating_pow(3)) > most {
        let hint = "with `\"residuals\": \"last\"` and without the adaptive filter there may be more";
        return Err(too_large(PATH, &format!("{n} readings of {p} components ({hint})")));
    }
    let rows = document.rows(PATH, &moments.readings)?;
    let series = Series::new(rows).map_err(|error| match error {
        SeriesError::Ragged { index, .. } => IdentificationError::at(format!("{PATH}[{index}]"), error.to_string()),
        other => IdentificationError::at(PATH, other.to_string()),
    })?;
    let all = estimates(&series, reading).map_err(|error| IdentificationError::at(PATH, error.to_string()))?;
    let mut steps: Vec<Step> = all.iter().map(estimated).collect();
    if let Some(start) = &moments.adaptive_filter {
        let repair = match start.repair {
            RepairName::Keep => Repair::Keep,
            RepairName::Zero => Repair::Zero,
            RepairName::LastSemidefinite => Repair::LastSemidefinite,
        };
        let mean = document.column("moments.adaptive_filter.mean", &start.mean, p)?;
        let covariance = document.covariance("moments.adaptive_filter.covariance", &start.covariance, p)?;
        let records = adaptive_filter(&series, reading, &Belief { mean, covariance }, repair)
            .map_err(|error| IdentificationError::at("moments.adaptive_filter", error.to_string()))?;
        for (step, record) in steps.iter_mut().zip(records) {
            step.values.extend(adapted(record));
        }
    }
    Ok(steps)
}

fn estimated(estimates: &Estimates<Rational>) -> Step {
    let residuals = &estimates.residuals;
    let mut values = vec![
        ("transition", estimates.transition.clone()),
        ("one-step residuals", residuals.one_step.clone()),
        ("two-step residuals", residuals.two_step.clone()),
    ];
    match estimates.noise() {
        Ok(noise) => values.extend([("process noise", noise.process), ("observation noise", noise.observation)]),
        Err(singular) => values.push(("kernel of the transition", singular.kernel)),
    }
    Step { title: format!("{} readings", estimates.count), values }
}

fn adapted(record: AdaptiveRecord<Rational>) -> [(&'static str, Matrix<Rational>); 6] {
    [
        ("process noise used", record.model.noise.process),
        ("observation noise used", record.model.noise.observation),
        ("predicted covariance", record.predicted_covariance),
        ("gain", record.gain),
        ("filtered mean", record.belief.mean),
        ("filtered covariance", record.belief.covariance),
    ]
}

fn least_squares_steps(document: &Identification, asked: &LeastSquares) -> Result<Vec<Step>, IdentificationError> {
    let path = |name: &str| format!("least_squares.{name}");
    let count = asked.output_lags.saturating_add(asked.input_lags);
    if count == 0 {
        return Err(IdentificationError::at(path("output_lags"), "there is no coefficient to learn"));
    }
    let n = asked.outputs.len();
    if count > MAXIMAL_LAGS || n.saturating_mul(count * count) > 20_000 {
        return Err(too_large(&path("outputs"), &format!("{n} outputs and {count} coefficients")));
    }
    if n == 0 {
        return Err(IdentificationError::at(path("outputs"), "there is no output"));
    }
    // The last regressor holds u up to n − 2.
    let needed = if asked.input_lags == 0 { 0 } else { n - 1 };
    if asked.inputs.len() < needed || asked.inputs.len() > n {
        let message = format!("{} inputs; from {needed} to {n} are needed for {n} outputs", asked.inputs.len());
        return Err(IdentificationError::at(path("inputs"), message));
    }
    let outputs = document.list(&path("outputs"), &asked.outputs)?;
    let inputs = document.list(&path("inputs"), &asked.inputs)?;
    let noise = document.number(&path("noise"), &asked.noise)?;
    if noise < Rational::from_integer(0.into()) {
        return Err(IdentificationError::at(path("noise"), "a variance is not negative"));
    }
    let regression = Regression {
        output_lags: asked.output_lags,
        input_lags: asked.input_lags,
        mean: document.column(&path("mean"), &asked.mean, count)?,
        covariance: document.covariance(&path("covariance"), &asked.covariance, count)?,
        noise,
        history: History {
            outputs: document.list(&path("earlier_outputs"), &asked.earlier_outputs)?,
            inputs: document.list(&path("earlier_inputs"), &asked.earlier_inputs)?,
        },
    };
    let wrong = |error: String| IdentificationError::at(path("outputs"), error);
    let data: Vec<_> = outputs.into_iter().map(|y| Observation::complete([y])).collect();
    let realised = regression.recorded(inputs).realised(&data).map_err(|error| wrong(error.to_string()))?;
    let trace = filter(&realised).map_err(|error| wrong(error.to_string()))?;
    let step = |(k, record): (usize, crate::trace::Record<Rational>)| {
        let values = vec![("mean", record.filtered.mean), ("covariance", record.filtered.covariance)];
        Step { title: format!("output {k}"), values }
    };
    Ok(trace.records.into_iter().enumerate().map(step).collect())
}

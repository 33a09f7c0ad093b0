//! `identify`: systems from data, exactly.

use std::io::Write as _;
use std::path::PathBuf;

use serde_json::{Map, Value};

use super::Format;
use super::effort::Effort;
use super::exit::{Exit, Trouble};
use super::input;
use super::numbers::{Numbers, laid_out};
use crate::filter::filter;
use crate::identify::{
    AdaptiveRecord, Belief, Estimates, History, Regression, Series, SeriesError, adaptive_filter, estimates,
};
use crate::matrix::Matrix;
use crate::model::{Observation, Reading, Repair};
use crate::protocol::{Identification, InputError, LeastSquares, Moments, RepairName, ResidualsName};
use crate::scalar::Rational;

const EXAMPLES: &str = "\
Examples:
  exact-kalman identify examples/identify/moments.json --last           A, V and W from readings
  exact-kalman identify examples/identify/moments.json --exact --last   as fractions
  exact-kalman identify examples/identify/least-squares.json            coefficients, step by step
  exact-kalman identify examples/identify/adaptive.json --format json   with the adaptive filter

The input is described in docs/IDENTIFY.md. Where the data contradict the model, or the adaptive filter
stops, the steps before are printed all the same. Exit codes: 0 all answered, 1 stopped before the last
reading, 2 trouble with the input";

/// The place of the start of the adaptive filter in the document.
const ADAPTIVE_START: &str = "moments.adaptive_filter";

/// Estimate a system from data, exactly
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Identify {
    /// A file with one document, or `-` for standard input.
    file: PathBuf,
    #[command(flatten)]
    numbers: Numbers,
    /// Only the last step.
    #[arg(long)]
    last: bool,
    /// How to print the results; JSON is one object on one line.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// What a step is after.
enum Place {
    /// So many readings.
    Count(usize),
    /// This output, counted from 0.
    Output(usize),
}

/// A step: its values by name, and which of them another matrix stands for.
struct Step {
    place: Place,
    values: Vec<(&'static str, Matrix<Rational>)>,
    repaired: Vec<(&'static str, bool)>,
}

/// The steps, and why there is no further one.
struct Steps {
    steps: Vec<Step>,
    stopped: Option<String>,
}

/// The values that are lists in JSON.
const COLUMNS: [&str; 3] = ["mean", "filtered mean", "kernel of the transition"];

impl Identify {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let place = self.file.display().to_string();
        let text = input::text(&self.file)?;
        let refused = |source| Trouble::Question { place: place.clone(), source };
        let document = Identification::parse(text.strip_prefix('\u{feff}').unwrap_or(&text)).map_err(refused)?;
        let steps = match (&document.moments, &document.least_squares) {
            (Some(moments), _) => moments_steps(&document, moments),
            (None, Some(least_squares)) => least_squares_steps(&document, least_squares),
            (None, None) => Ok(Steps { steps: Vec::new(), stopped: None }),
        };
        let Steps { mut steps, stopped } = steps.map_err(refused)?;
        if self.last {
            steps.drain(..steps.len().saturating_sub(1));
        }
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Text => {
                for step in &steps {
                    match step.place {
                        Place::Count(n) => writeln!(out, "{n} readings")?,
                        Place::Output(k) => writeln!(out, "output {k}")?,
                    }
                    for (name, matrix) in &step.values {
                        writeln!(out, "  {name:24} {}", laid_out(&matrix.map(|entry| self.numbers.text(entry))))?;
                    }
                }
            }
            Format::Json => writeln!(out, "{}", self.json(&steps, stopped.as_deref()))?,
        }
        match stopped {
            None => Ok(Exit::Clean),
            Some(reason) => {
                eprintln!("{place}: {reason}");
                Ok(Exit::Findings)
            }
        }
    }

    fn json(&self, steps: &[Step], stopped: Option<&str>) -> Value {
        let list = |entries: &[Rational]| -> Value {
            entries.iter().map(|entry| Value::from(self.numbers.text(entry))).collect()
        };
        let key = |name: &str| name.replace([' ', '-'], "_");
        let step = |step: &Step| {
            let mut object = Map::new();
            match step.place {
                Place::Count(n) => object.insert("count".to_owned(), n.into()),
                Place::Output(k) => object.insert("output".to_owned(), k.into()),
            };
            for (name, matrix) in &step.values {
                let value = if COLUMNS.contains(name) {
                    list(matrix.entries())
                } else {
                    (0..matrix.rows()).map(|i| list(matrix.row(i))).collect()
                };
                object.insert(key(name), value);
            }
            object.extend(step.repaired.iter().map(|(name, repaired)| (key(name), Value::from(*repaired))));
            Value::from(object)
        };
        let mut object = Map::from_iter([("steps".to_owned(), steps.iter().map(step).collect::<Value>())]);
        if let Some(reason) = stopped {
            object.insert("stopped".to_owned(), reason.into());
        }
        object.into()
    }
}

fn moments_steps(document: &Identification, moments: &Moments) -> Result<Steps, InputError> {
    const PATH: &str = "moments.readings";
    let reading = match moments.residuals {
        ResidualsName::Printed => Reading::Printed,
        ResidualsName::Last => Reading::Last,
        ResidualsName::Predictive => Reading::Predictive,
    };
    let (n, p) = (moments.readings.len(), moments.readings.first().map_or(0, Vec::len));
    let effort = Effort::of_moments(reading, moments.adaptive_filter.is_some());
    effort.admits_count(PATH, n, p)?;
    let rows = document.numbers.rows(PATH, &moments.readings)?;
    effort.admits_lengths(PATH, n, p, rows.iter().flatten())?;
    let series = Series::new(rows).map_err(|error| match error {
        SeriesError::Ragged { index, .. } => InputError::at(format!("{PATH}[{index}]"), error.to_string()),
        other => InputError::at(PATH, other.to_string()),
    })?;
    let all = estimates(&series, reading).map_err(|error| InputError::at(PATH, error.to_string()))?;
    let mut steps: Vec<Step> = all.iter().map(estimated).collect();
    let mut stopped = None;
    if let Some(start) = &moments.adaptive_filter {
        let repair = match start.repair {
            RepairName::Keep => Repair::Keep,
            RepairName::Zero => Repair::Zero,
            RepairName::LastSemidefinite => Repair::LastSemidefinite,
        };
        let mean = document.numbers.column("moments.adaptive_filter.mean", &start.mean, p)?;
        let covariance = document.numbers.covariance("moments.adaptive_filter.covariance", &start.covariance, p)?;
        let numbers = rows_and_start(&series, &mean, &covariance);
        effort.admits_lengths(ADAPTIVE_START, n, p, numbers)?;
        let records = match adaptive_filter(&series, reading, &Belief { mean, covariance }, repair) {
            Ok(records) => records,
            Err(error) => {
                stopped = Some(format!("{ADAPTIVE_START}: {error}"));
                steps.retain(|step| matches!(step.place, Place::Count(n) if n < error.step));
                error.computed
            }
        };
        for record in records {
            let of_record = |step: &&mut Step| matches!(step.place, Place::Count(n) if n == record.step);
            if let Some(step) = steps.iter_mut().find(of_record) {
                step.repaired = vec![
                    ("process noise repaired", record.process_repaired),
                    ("observation noise repaired", record.observation_repaired),
                ];
                step.values.extend(adapted(record));
            }
        }
    }
    Ok(Steps { steps, stopped })
}

fn rows_and_start<'a>(
    series: &'a Series<Rational>,
    mean: &'a Matrix<Rational>,
    covariance: &'a Matrix<Rational>,
) -> impl Iterator<Item = &'a Rational> {
    series.readings().iter().chain([mean, covariance]).flat_map(Matrix::entries)
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
    Step { place: Place::Count(estimates.count), values, repaired: Vec::new() }
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

fn least_squares_steps(document: &Identification, asked: &LeastSquares) -> Result<Steps, InputError> {
    let path = |name: &str| format!("least_squares.{name}");
    let count = asked.output_lags.saturating_add(asked.input_lags);
    if count == 0 {
        return Err(InputError::at(path("output_lags"), "there is no coefficient to learn"));
    }
    let n = asked.outputs.len();
    let effort = Effort::of_least_squares();
    effort.admits_count(&path("outputs"), n, count)?;
    if n == 0 {
        return Err(InputError::at(path("outputs"), "there is no output"));
    }
    for (name, given, lags, of) in [
        ("earlier_outputs", asked.earlier_outputs.len(), asked.output_lags, "output_lags"),
        ("earlier_inputs", asked.earlier_inputs.len(), asked.input_lags, "input_lags"),
        ("inputs", asked.inputs.len(), if asked.input_lags == 0 { 0 } else { usize::MAX }, "input_lags"),
    ] {
        if given > lags {
            let message = format!("{given} numbers, of which `{of}` of {lags} would use {lags}; leave out the others");
            return Err(InputError::at(path(name), message));
        }
    }
    // The last regressor holds u up to n − 2.
    let needed = if asked.input_lags == 0 { 0 } else { n - 1 };
    if asked.inputs.len() < needed || asked.inputs.len() > n {
        let message = format!("{} inputs; from {needed} to {n} are needed for {n} outputs", asked.inputs.len());
        return Err(InputError::at(path("inputs"), message));
    }
    let outputs = document.numbers.list(&path("outputs"), &asked.outputs)?;
    let inputs = document.numbers.list(&path("inputs"), &asked.inputs)?;
    let noise = document.numbers.value(&path("noise"), &asked.noise)?;
    if noise < Rational::from_integer(0.into()) {
        return Err(InputError::at(path("noise"), "a variance is not negative"));
    }
    let regression = Regression {
        output_lags: asked.output_lags,
        input_lags: asked.input_lags,
        mean: document.numbers.column(&path("mean"), &asked.mean, count)?,
        covariance: document.numbers.covariance(&path("covariance"), &asked.covariance, count)?,
        noise,
        history: History {
            outputs: document.numbers.list(&path("earlier_outputs"), &asked.earlier_outputs)?,
            inputs: document.numbers.list(&path("earlier_inputs"), &asked.earlier_inputs)?,
        },
    };
    let start = regression.mean.entries().iter().chain(regression.covariance.entries()).chain([&regression.noise]);
    let history = regression.history.outputs.iter().chain(&regression.history.inputs);
    let numbers = start.chain(history).chain(&outputs).chain(&inputs);
    effort.admits_lengths(&path("outputs"), n, count, numbers)?;
    let wrong = |error: String| InputError::at(path("outputs"), error);
    let data: Vec<_> = outputs.into_iter().map(|y| Observation::complete([y])).collect();
    let realised = regression.recorded(inputs).realised(&data).map_err(|error| wrong(error.to_string()))?;
    let (records, stopped) = match filter(&realised) {
        Ok(trace) => (trace.records, None),
        Err(error) => (error.computed, Some(format!("{}[{}]: {}", path("outputs"), error.step, error.source))),
    };
    let step = |(k, record): (usize, crate::trace::Record<Rational>)| {
        let values = vec![("mean", record.filtered.mean), ("covariance", record.filtered.covariance)];
        Step { place: Place::Output(k), values, repaired: Vec::new() }
    };
    Ok(Steps { steps: records.into_iter().enumerate().map(step).collect(), stopped })
}

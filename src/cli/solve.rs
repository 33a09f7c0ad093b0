//! `solve`: the exact answer to a case.

use std::io::Write;
use std::num::NonZero;
use std::path::PathBuf;

use super::Format;
use super::exit::{Exit, Trouble};
use super::input;
use crate::filter::{
    FilterError, FractionFreeError, FractionFreeStep, Precision, StepAhead, filter, filter_fraction_free, predict_ahead,
};
use crate::matrix::Matrix;
use crate::model::{Path, PathAhead};
use crate::protocol::{Answer, AnswerNumber, Case, CaseError, Decimal, LawAhead, Outcome};
use crate::scalar::Rational;
use crate::trace::{Moments, Quantity, Record, Values};

const EXAMPLES: &str = "\
Examples:
  exact-kalman solve examples/cases/nile.json --last              the last step, 17 digits
  exact-kalman solve examples/cases/nile.json --last --digits 24
  exact-kalman solve examples/cases/walk.json --exact             as fractions
  exact-kalman solve examples/cases/walk.json --trace             every named quantity
  exact-kalman solve examples/cases/nile.json --last --ahead 3    and the next three states
  exact-kalman cases --only basic --format json | exact-kalman solve - --format json

A case that is no valid problem is refused, with the reason; the others are answered all the same. Exit
codes: 0 all answered, 1 some data contradict their model, 2 some case refused, or other trouble";

/// Print the exact answer to cases, correctly rounded
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Solve {
    /// A case file (one case, or one on each line), a directory of such files, or `-` for standard input.
    case: PathBuf,
    /// Significant decimal digits, correctly rounded (halves away from zero).
    #[arg(long, default_value_t = 17, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    digits: u32,
    /// Print fractions instead of decimals.
    #[arg(long, conflicts_with = "digits")]
    exact: bool,
    /// Only the last step (of text).
    #[arg(long)]
    last: bool,
    /// Every named quantity, computed by the readable recursion (slower): also the gain, the cross covariance and
    /// the parts of the likelihood.
    #[arg(long)]
    trace: bool,
    /// Also the mean and the covariance of so many next states, given the readings up to each step (slower). Lists of
    /// transitions may go on beyond the last reading, and prediction ends where they do.
    #[arg(long, value_name = "STEPS", value_parser = ahead)]
    ahead: Option<NonZero<usize>>,
    /// How to print the answers; JSON is that of docs/PROTOCOL.md, one answer on each line.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// The most steps ahead that are printed.
const MAXIMAL_STEPS_AHEAD: usize = 1000;

fn ahead(text: &str) -> Result<NonZero<usize>, String> {
    let steps = text.parse().ok().and_then(NonZero::new).filter(|steps| steps.get() <= MAXIMAL_STEPS_AHEAD);
    steps.ok_or_else(|| format!("from 1 to {MAXIMAL_STEPS_AHEAD} steps"))
}

/// What is shown of a step.
struct Shown {
    values: Values<Rational>,
    more: Vec<(String, Matrix<Rational>)>,
    ahead: Vec<Moments<Rational>>,
}

/// Why there is no answer from some step on.
struct Stopped {
    step: usize,
    reason: String,
}

impl Solve {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let mut out = std::io::stdout().lock();
        let mut exit = Exit::Clean;
        for case in input::cases(&self.case)? {
            let (steps, stopped) = match self.results(&case) {
                Ok(results) => results,
                // One bad case does not hide the others.
                Err(why) => {
                    eprintln!("error: case {:?}: {why}", case.id);
                    exit = Exit::Trouble;
                    if self.format == Format::Json {
                        writeln!(out, "{}", refusal(&case, why.to_string()))?;
                    }
                    continue;
                }
            };
            if case.initial.allow_indefinite {
                eprintln!(
                    "{}: the override for an indefinite initial covariance is set: if it is one, these are numbers of the \
                     recursion and no conditional moments, and a contradiction says nothing about the data",
                    case.id
                );
            }
            if let Some(Stopped { step, reason }) = &stopped {
                eprintln!("{}: at step {step} {reason}", case.id);
                if exit == Exit::Clean {
                    exit = Exit::Findings;
                }
            }
            match self.format {
                Format::Text => self.write_text(&mut out, &case, &steps)?,
                Format::Json => writeln!(out, "{}", self.answer(&case, &steps, stopped))?,
            }
        }
        Ok(exit)
    }

    fn results(&self, case: &Case) -> Result<(Vec<Shown>, Option<Stopped>), CaseError> {
        let problem = case.problem()?;
        Ok(match self.ahead {
            Some(steps_ahead) => predicted(&problem.realised_ahead(steps_ahead)?, self.trace),
            None if self.trace => traced(&problem.realised()?),
            None => solved(&problem.realised()?),
        })
    }

    fn number(&self, value: &Rational) -> String {
        if self.exact { value.to_string() } else { Decimal::rounded(value, self.digits).to_string() }
    }

    fn write_text(&self, out: &mut impl Write, case: &Case, steps: &[Shown]) -> Result<(), Trouble> {
        let first = if self.last { steps.len().saturating_sub(1) } else { 0 };
        for (step, shown) in steps.iter().enumerate().skip(first) {
            writeln!(out, "{} · step {step}", case.id)?;
            let named = shown.values.iter().map(|(quantity, matrix)| (quantity.to_string(), matrix));
            let more = shown.more.iter().map(|(name, matrix)| (name.clone(), matrix));
            let ahead = (1..).zip(&shown.ahead).flat_map(|(i, law)| named_ahead(i, law, self.trace));
            let all: Vec<_> = named.chain(more).chain(ahead).collect();
            if all.is_empty() {
                writeln!(out, "  (the start is diffuse, and not yet resolved)")?;
            }
            for (name, matrix) in all {
                writeln!(out, "  {name:36} {}", self.text(matrix))?;
            }
        }
        Ok(())
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

    fn answer(&self, case: &Case, steps: &[Shown], stopped: Option<Stopped>) -> String {
        if self.exact {
            return answer_line(case, steps, stopped, Rational::clone);
        }
        answer_line(case, steps, stopped, |value| Decimal::rounded(value, self.digits))
    }
}

fn answer_line<T: AnswerNumber>(
    case: &Case,
    steps: &[Shown],
    stopped: Option<Stopped>,
    number: impl Fn(&Rational) -> T,
) -> String {
    let values = |shown: &Shown| -> Values<T> {
        shown.values.iter().map(|(quantity, matrix)| (*quantity, matrix.map(&number))).collect()
    };
    let law = |Moments { mean, covariance, diffuse }: &Moments<Rational>| {
        diffuse.is_none().then(|| LawAhead { mean: mean.map(&number), covariance: covariance.map(&number) })
    };
    let mut answer = Answer::answered(&case.id, steps.iter().map(values).collect());
    answer.ahead = steps.iter().map(|shown| shown.ahead.iter().map(law).collect()).collect();
    if let Some(Stopped { step, reason }) = stopped {
        answer.outcome = Outcome::Flagged;
        answer.step = Some(step);
        answer.message = Some(reason);
    }
    answer.to_line()
}

fn refusal(case: &Case, why: String) -> String {
    let answer = Answer::<Rational>::answered(&case.id, Vec::new());
    Answer { outcome: Outcome::Refused, message: Some(why), ..answer }.to_line()
}

fn solved(path: &Path<Rational>) -> (Vec<Shown>, Option<Stopped>) {
    let show = |step: FractionFreeStep| Shown { values: step.values, more: Vec::new(), ahead: Vec::new() };
    match filter_fraction_free(path, Precision::Exact) {
        Ok(steps) => (steps.into_iter().map(show).collect(), None),
        Err(FractionFreeError { step, reason, computed }) => {
            (computed.into_iter().map(show).collect(), Some(Stopped { step, reason: reason.to_string() }))
        }
    }
}

fn traced(path: &Path<Rational>) -> (Vec<Shown>, Option<Stopped>) {
    let (records, stopped) = match filter(path) {
        Ok(trace) => (trace.records, None),
        Err(error) => (error.computed, Some(Stopped { step: error.step, reason: error.source.to_string() })),
    };
    (records.iter().map(everything).collect(), stopped)
}

/// The predictor, with every named quantity of its records or with those that are shown without being asked for.
fn predicted(path: &PathAhead<Rational>, trace: bool) -> (Vec<Shown>, Option<Stopped>) {
    let (computed, stopped) = match predict_ahead(path) {
        Ok(computed) => (computed, None),
        Err(FilterError { step, source, computed }) => (computed, Some(Stopped { step, reason: source.to_string() })),
    };
    let show = |StepAhead { record, ahead }: StepAhead<Rational>| {
        let mut shown = everything(&record);
        if !trace {
            shown.values.remove(&Quantity::Gain);
            shown.more.clear();
        }
        Shown { ahead, ..shown }
    };
    (computed.steps.into_iter().map(show).collect(), stopped)
}

/// The moments of a state i steps ahead, by name; of one that is still diffuse only if everything is asked for.
fn named_ahead(i: usize, law: &Moments<Rational>, everything: bool) -> Vec<(String, &Matrix<Rational>)> {
    let Moments { mean, covariance, diffuse } = law;
    match diffuse {
        None => vec![(format!("mean {i} ahead"), mean), (format!("covariance {i} ahead"), covariance)],
        Some(diffuse) if everything => vec![
            (format!("mean {i} ahead, its limit"), mean),
            (format!("covariance {i} ahead of order 1"), covariance),
            (format!("covariance {i} ahead of order kappa"), diffuse),
        ],
        Some(_) => Vec::new(),
    }
}

/// Every named quantity of a record that is not among its values.
fn everything(record: &Record<Rational>) -> Shown {
    let number = |value: Rational| Matrix::column(vec![value]);
    let mut more = Vec::new();
    let mut add = |name: &str, matrix: Matrix<Rational>| more.push((name.to_owned(), matrix));
    for (name, moments) in [("predicted", &record.predicted), ("filtered", &record.filtered)] {
        if let Some(diffuse) = &moments.diffuse {
            add(&format!("{name} mean, its limit"), moments.mean.clone());
            add(&format!("{name} covariance of order 1"), moments.covariance.clone());
            add(&format!("{name} covariance of order kappa"), diffuse.clone());
        }
    }
    if !record.observed.is_empty() {
        add("predicted observation", record.predicted_observation.clone());
        add("cross covariance", record.cross_covariance.clone());
        if record.predicted.diffuse.is_some() {
            add("gain, its limit", record.gain.clone());
        }
        if let Some(diffuse) = &record.innovation_diffuse {
            add("innovation covariance of order kappa", diffuse.clone());
        }
        add("rank of the innovation covariance", number(Rational::from_integer(record.innovation_rank.into())));
        if let Some(likelihood) = &record.likelihood {
            add("likelihood: quadratic form", number(likelihood.quadratic.clone()));
            add("likelihood: pseudo-determinant", number(likelihood.pseudo_determinant.clone()));
        }
    }
    Shown { values: record.values(), more, ahead: Vec::new() }
}

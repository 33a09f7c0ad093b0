//! `solve`: the exact answer to a case.

use std::io::Write;
use std::num::NonZero;
use std::path::PathBuf;

use super::Format;
use super::exit::{Exit, Trouble};
use super::input;
use super::numbers::{Numbers, laid_out};
use super::shown::{Shown, Stopped, named_ahead, predicted, solved, traced};
use crate::protocol::{Answer, AnswerNumber, Case, CaseError, Decimal, LawAhead, Outcome};
use crate::scalar::Rational;
use crate::trace::{Moments, Values};

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
    #[command(flatten)]
    numbers: Numbers,
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

/// The most steps ahead: fractions lengthen with each, and with decimal matrices a hundred take seconds.
const MAXIMAL_STEPS_AHEAD: usize = 100;

fn ahead(text: &str) -> Result<NonZero<usize>, String> {
    let steps = text.parse().ok().and_then(NonZero::new).filter(|steps| steps.get() <= MAXIMAL_STEPS_AHEAD);
    steps.ok_or_else(|| format!("from 1 to {MAXIMAL_STEPS_AHEAD} steps"))
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
                writeln!(out, "  {name:36} {}", laid_out(&matrix.map(|entry| self.numbers.text(entry))))?;
            }
        }
        Ok(())
    }

    fn answer(&self, case: &Case, steps: &[Shown], stopped: Option<Stopped>) -> String {
        if self.numbers.exact {
            return answer_line(case, steps, stopped, Rational::clone);
        }
        answer_line(case, steps, stopped, |value| Decimal::rounded(value, self.numbers.digits))
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

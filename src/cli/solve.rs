//! `solve`: the exact answer to a case.

use std::fmt::{Display, Write as _};
use std::io::{BufWriter, Write};
use std::num::NonZero;
use std::path::PathBuf;

use super::Format;
use super::certificate::{self, Certificate};
use super::exit::{Exit, Trouble};
use super::length::MaximalBits;
use super::notation::{Decimals, LowestTerms, Notation};
use super::numbers::{Numbers, laid_out};
use super::shown::{Shown, named_ahead};
use super::steps::{Along, Source, Step, Stop, Wanted};
use super::tier::{Tier, Tiering};
use super::{input, interrupt, progress};
use crate::certify::Growth;
use crate::filter::StopReason;
use crate::protocol::{Answer, AnswerNumber, AnswerStream, Case, CaseError, LawAhead, Outcome};
use crate::scalar::Rational;
use crate::trace::Moments;

const EXAMPLES: &str = "\
Examples:
  exact-kalman solve examples/cases/nile.json --last              the last step, 17 digits
  exact-kalman solve examples/cases/nile.json --last --digits 24
  exact-kalman solve examples/cases/walk.json --exact             as fractions
  exact-kalman solve examples/cases/walk.json --trace             every named quantity
  exact-kalman solve examples/cases/nile.json --last --ahead 3    and the next three states
  exact-kalman solve examples/cases/walk.json --tier certified    by enclosures alone
  exact-kalman cases --only basic --format json | exact-kalman solve - --format json

Each step is printed as soon as it is known. Ctrl-C stops: what is known by then is printed, with a note
on where it ends, and the exit code is 130; a second Ctrl-C ends at once. There is no way to go on from there:
the next run begins anew.

A case that is no valid problem is refused, with the reason; the others are answered all the same. Exit
codes: 0 all answered, 1 some data contradict their model, 2 some case refused, or other trouble,
3 nothing of that, but some numbers grew too long\nor were not decided, 130 interrupted";

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
    #[command(flatten)]
    tiering: Tiering,
    /// Every named quantity, computed by the readable recursion (slower) or enclosed: also the gain, the cross covariance and
    /// the parts of the likelihood.
    #[arg(long)]
    trace: bool,
    /// Also the mean and the covariance of so many next states, given the readings up to each step (slower). Lists of
    /// transitions may go on beyond the last reading, and prediction ends where they do.
    #[arg(long, value_name = "STEPS", value_parser = ahead)]
    ahead: Option<NonZero<usize>>,
    /// How long denominators may be when another step is begun, in bits, or `none`. What is known by then is printed. It bounds time and memory,
    /// since all numbers of a step have about that length; with --trace and --ahead, whose fractions cost far more, a
    /// sixteenth of it counts [default: 2^31 / (m + 2n)^2 for n states and m sensors, which keeps memory below some two
    /// gibibytes].
    #[arg(long, value_name = "BITS")]
    max_bits: Option<MaximalBits>,
    /// How to print the answers; JSON is that of docs/PROTOCOL.md, one answer on each line.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    certificate: Certificate,
}

/// The most steps ahead: fractions lengthen with each, and with decimal matrices a hundred take seconds.
const MAXIMAL_STEPS_AHEAD: usize = 100;

fn ahead(text: &str) -> Result<NonZero<usize>, String> {
    let steps = text.parse().ok().and_then(NonZero::new).filter(|steps| steps.get() <= MAXIMAL_STEPS_AHEAD);
    steps.ok_or_else(|| format!("from 1 to {MAXIMAL_STEPS_AHEAD} steps"))
}

impl Solve {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        interrupt::listen(None);
        if let Some(file) = &self.certificate.file {
            input::keep(&self.case, file)?;
            return certificate::write(file, &input::cases(&self.case)?, self.numbers, self.tiering);
        }
        // Every step is flushed, so that it is seen when it is known.
        let mut out = BufWriter::new(std::io::stdout().lock());
        let mut exit = Exit::Clean;
        let mut cases = input::cases(&self.case)?.into_iter();
        for case in cases.by_ref() {
            match self.source(&case) {
                Ok(source) => {
                    if case.initial.allow_indefinite {
                        eprintln!(
                            "{}: the override for an indefinite initial covariance is set: if it is one, these are numbers \
                             of the recursion and no conditional moments, and a contradiction says nothing about the data",
                            case.id
                        );
                    }
                    let Numbers { digits, exact } = self.numbers;
                    exit = exit.or(if exact {
                        self.answer(&mut out, &case.id, source, &LowestTerms)?
                    } else {
                        self.answer(&mut out, &case.id, source, &Decimals { digits })?
                    });
                }
                // One bad case does not hide the others.
                Err(why) => {
                    eprintln!("error: case {:?}: {why}", case.id);
                    exit = exit.or(Exit::Trouble);
                    if self.format == Format::Json {
                        writeln!(out, "{}", refusal(&case, why.to_string()))?;
                        out.flush()?;
                    }
                }
            }
            if interrupt::requested() {
                break;
            }
        }
        if cases.len() > 0 {
            let were = if cases.len() == 1 { "case was" } else { "cases were" };
            eprintln!("interrupted: {} more {were} not begun", cases.len());
            exit = Exit::Interrupted;
        }
        Ok(exit)
    }

    fn source(&self, case: &Case) -> Result<Source, CaseError> {
        let problem = case.problem()?;
        let Numbers { digits, exact } = self.numbers;
        let readable = self.trace || self.ahead.is_some();
        let tier = match self.tiering.tier(exact, readable) {
            // Where exact numbers are those of the recursion alone they are not mixed with others.
            Tier::Auto if case.initial.allow_indefinite => Tier::Exact,
            tier => tier,
        };
        let wanted = Wanted { digits, most_bits: self.tiering.most_bits(digits), everything: self.trace };
        Ok(match (self.ahead, tier) {
            (Some(ahead), Tier::Certified) => Source::Certified(Along::Ahead(problem.realised_ahead(ahead)?), wanted),
            (None, Tier::Certified) => Source::Certified(Along::Path(problem.realised()?), wanted),
            (Some(ahead), _) => Source::Ahead(problem.realised_ahead(ahead)?),
            (None, Tier::Auto) => Source::Tiered(problem.realised()?, wanted),
            (None, Tier::Exact) if self.trace => Source::Readable(problem.realised()?),
            (None, Tier::Exact) => Source::Fast(problem.realised()?),
        })
    }

    /// Prints the steps of a case as they become known.
    fn answer<N: Notation>(
        &self,
        out: &mut impl Write,
        id: &str,
        source: Source,
        notation: &N,
    ) -> Result<Exit, Trouble> {
        let path = source.path();
        let all = path.steps().len();
        let limit = self.max_bits.unwrap_or_default().of(path.states(), path.sensors());
        let mut steps = source.steps(limit);
        let mut progress = progress::Steps::of(id, all);
        let mut page = match self.format {
            Format::Json => Page::Json(AnswerStream::begin::<N::Number>(out, id)?),
            Format::Text => Page::Text(out),
        };
        let (mut last, mut known, mut growth, mut left_out) = (None, 0, Growth::default(), 0);
        let stop = loop {
            let (step, bits) = match steps.next(|| progress.tick()) {
                Ok(step) => step,
                Err(stop) => break stop,
            };
            progress.step(bits);
            if let Step::Enclosed(step) = &step {
                growth.note(known, bits, step.accuracy());
            }
            match &mut page {
                Page::Json(stream) => match &step {
                    Step::Exact(step) => {
                        let shown = Shown::of(step, self.trace, notation);
                        progress.aside(|| written(stream, shown))?;
                    }
                    Step::Enclosed(step) => {
                        let shown = Shown::enclosed(step, self.numbers.digits).proved();
                        left_out += usize::from(shown.values.len() < step.values.len());
                        progress.aside(|| written(stream, shown))?;
                    }
                },
                Page::Text(_) if self.last => last = Some(step),
                Page::Text(out) => {
                    let text = self.text_of(id, known, &step, notation);
                    progress.aside(|| out.write_all(text.as_bytes()).and_then(|()| out.flush()))?;
                }
            }
            known += 1;
        };
        drop(progress);
        if growth.is_told() {
            eprintln!("{id}: {growth}");
        }
        if left_out > 0 {
            eprintln!(
                "{id}: at {left_out} steps a quantity with an entry that may be zero or a tie is left out; --tier auto, or text, has it"
            );
        }
        let ended = Ended::of(stop, known, all);
        if let Some(ended) = &ended {
            eprintln!("{id}: {}", ended.told(self.last && self.format == Format::Text));
        }
        match page {
            Page::Json(stream) => match &ended {
                Some(Ended { step, reason, outcome, .. }) => stream.end(*outcome, Some(*step), Some(reason.clone()))?,
                None => stream.end(Outcome::Answered, None, None)?,
            },
            Page::Text(out) => {
                if let Some(step) = last {
                    out.write_all(self.text_of(id, known - 1, &step, notation).as_bytes())?;
                }
                out.flush()?;
            }
        }
        Ok(ended.map_or(Exit::Clean, |ended| ended.exit))
    }

    fn text_of(&self, id: &str, number: usize, step: &Step, notation: &impl Notation) -> String {
        match step {
            Step::Exact(step) => self.text(id, number, &Shown::of(step, self.trace, notation)),
            Step::Enclosed(step) => self.text(id, number, &Shown::enclosed(step, self.numbers.digits)),
        }
    }

    fn text<T: Clone + Display>(&self, id: &str, step: usize, shown: &Shown<T>) -> String {
        let mut text = format!("{id} · step {step}\n");
        let named = shown.values.iter().map(|(quantity, matrix)| (quantity.to_string(), matrix));
        let more = shown.more.iter().map(|(name, matrix)| (name.clone(), matrix));
        let ahead = (1..).zip(&shown.ahead).flat_map(|(i, law)| named_ahead(i, law, self.trace));
        let all: Vec<_> = named.chain(more).chain(ahead).collect();
        if all.is_empty() {
            text += "  (the start is diffuse, and not yet resolved)\n";
        }
        for (name, matrix) in all {
            let _ = writeln!(text, "  {name:36} {}", laid_out(&matrix.map(ToString::to_string)));
        }
        text
    }
}

/// Where an answer is written to.
enum Page<'a, W> {
    Text(&'a mut W),
    Json(AnswerStream<&'a mut W>),
}

fn written<W: Write, T: AnswerNumber>(stream: &mut AnswerStream<W>, shown: Shown<T>) -> std::io::Result<()> {
    let laws: Vec<_> = shown.ahead.into_iter().map(law).collect();
    stream.step(&shown.values, &laws)
}

fn law<T>(Moments { mean, covariance, diffuse }: Moments<T>) -> Option<LawAhead<T>> {
    diffuse.is_none().then_some(LawAhead { mean, covariance })
}

fn refusal(case: &Case, why: String) -> String {
    let answer = Answer::<Rational>::answered(&case.id, Vec::new());
    Answer { outcome: Outcome::Refused, message: Some(why), ..answer }.to_line()
}

/// Why an answer ends before its last step.
struct Ended {
    /// The first step that is not known.
    step: usize,
    reason: String,
    /// What to do instead.
    instead: &'static str,
    outcome: Outcome,
    exit: Exit,
}

impl Ended {
    fn of(stop: Stop, step: usize, all: usize) -> Option<Self> {
        let ended = |reason, instead, outcome, exit| Some(Self { step, reason, instead, outcome, exit });
        match stop {
            Stop::Ended => None,
            Stop::Interrupted => ended(
                format!("it was interrupted, {step} of {all} steps are known"),
                "; for the rest run it again: it begins anew",
                Outcome::Error,
                Exit::Interrupted,
            ),
            Stop::Reason(reason @ StopReason::TooLong { .. }) => ended(
                reason.to_string(),
                "; give a higher --max-bits (--trace and --ahead use a sixteenth of it; time and memory grow with it), fewer observations, or data of fewer digits: \
                 with each step numbers lengthen by about what its data have",
                Outcome::Error,
                Exit::Undecided,
            ),
            Stop::Undecided(halt) => ended(
                halt.to_string(),
                "; give --tier auto, which goes on with exact numbers, or a higher --most-bits",
                Outcome::Error,
                Exit::Undecided,
            ),
            Stop::Reason(reason) => ended(reason.to_string(), "", Outcome::Flagged, Exit::Findings),
        }
    }

    /// What is said on standard error.
    fn told(&self, only_last: bool) -> String {
        let Self { step, reason, instead, .. } = self;
        let printed = match (instead.is_empty(), step) {
            (true, _) => "",
            (_, 0) => "; no step is known",
            (_, 1) => "; the step before it is printed",
            _ if only_last => "; the last step before it is printed",
            _ => "; the steps before it are printed",
        };
        format!("at step {step} {reason}{printed}{instead}")
    }
}

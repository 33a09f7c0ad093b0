//! `verify`: whether a certificate proves what it says.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::{Value, json};

use super::Format;
use super::exit::{Exit, Trouble};
use super::proved_interval::{shown, shown_matrix};
use super::{input, verify_steady};
use crate::protocol::{Case, CaseError, Problem, SteadyModel};
use crate::verify::{
    Belief, Condition, FilterCertificate, FilterFormat, MAXIMAL_LINE_BYTES, ProvedStep, Rejection, VerifyError,
};

const EXAMPLES: &str = "\
Examples:
  exact-kalman solve examples/certificates/nile.json --certificate nile.certificate --digits 30
  exact-kalman verify nile.certificate --last
  exact-kalman verify nile.certificate --case examples/certificates/nile.json

The checker shares no code with what makes certificates, and computes with integers alone. It holds what
the case inside says, and one step of it and of the certificate at a time. The format and the
inequalities are described in docs/CERTIFICATES.md. Exit codes: 0 verified, 1 rejected, 2 trouble with a file";

/// Check a certificate: every number in it is proved, or it is rejected
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Verify {
    /// A certificate, or `-` for standard input.
    certificate: PathBuf,
    /// The case, or the model, of which it must speak; without it, it speaks of the one inside.
    #[arg(long, value_name = "FILE")]
    case: Option<PathBuf>,
    /// The most significant digits that are printed.
    #[arg(long, default_value_t = 17, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    digits: u32,
    /// Also the moments of the last step, to the digits that are proved.
    #[arg(long)]
    last: bool,
    /// How to print the verdict; JSON is one object on one line.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// The most places in the readings of a case: two gibibytes of them. A line has room for fewer that are filled, but `null` may stand for
/// many that are not. All else that is held was written out, and matrices of a step have few rows.
const MOST_READINGS: usize = 1 << 25;

/// The member that tells the certificate of a filter; the others are left alone.
#[derive(Deserialize)]
struct Kind {
    certificate: FilterFormat,
}

/// What is verified: lines of text, and members of JSON.
pub(super) struct Verified {
    pub(super) name: String,
    pub(super) lines: Vec<(String, String)>,
    pub(super) members: Vec<(&'static str, Value)>,
}

/// Why nothing is verified.
pub(super) enum Failed {
    Rejected(Rejection),
    Trouble(Trouble),
}

impl From<Trouble> for Failed {
    fn from(trouble: Trouble) -> Self {
        Self::Trouble(trouble)
    }
}

pub(super) fn rejected(condition: Condition, message: impl Into<String>) -> Failed {
    Failed::Rejected(Rejection { line: None, step: None, condition, message: message.into() })
}

impl Verify {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let result = self.verified();
        let mut out = io::stdout().lock();
        match (result, self.format) {
            (Err(Failed::Trouble(trouble)), _) => return Err(trouble),
            (Ok(Verified { name, lines, .. }), Format::Text) => {
                writeln!(out, "{}: verified", crate::report::printable(&name))?;
                for (name, value) in lines {
                    writeln!(out, "  {name:36} {value}")?;
                }
            }
            (Ok(Verified { name, members, .. }), Format::Json) => {
                let mut object = json!({"verified": true, "id": name});
                for (name, value) in members {
                    object[name] = value;
                }
                writeln!(out, "{object}")?;
            }
            (Err(Failed::Rejected(rejection)), Format::Text) => {
                writeln!(out, "rejected: {}", crate::report::printable(&rejection.to_string()))?;
                return Ok(Exit::Findings);
            }
            (Err(Failed::Rejected(Rejection { line, step, condition, message })), Format::Json) => {
                let condition = condition.to_string();
                let object =
                    json!({"verified": false, "line": line, "step": step, "condition": condition, "message": message});
                writeln!(out, "{object}")?;
                return Ok(Exit::Findings);
            }
        }
        Ok(Exit::Clean)
    }

    fn verified(&self) -> Result<Verified, Failed> {
        let place = self.certificate.display().to_string();
        let input = |source| Trouble::Input { place: place.clone(), source };
        let mut reader: Box<dyn BufRead> = if self.certificate == Path::new("-") {
            Box::new(io::stdin().lock())
        } else {
            Box::new(BufReader::new(File::open(&self.certificate).map_err(input)?))
        };
        let mut first = Vec::new();
        let most = u64::try_from(MAXIMAL_LINE_BYTES).unwrap_or(u64::MAX);
        reader.by_ref().take(most + 1).read_until(b'\n', &mut first).map_err(input)?;
        if matches!(serde_json::from_slice(&first), Ok(Kind { certificate: FilterFormat::One })) {
            return self.of_filter(io::Cursor::new(first).chain(reader), &place);
        }
        let mut document = first;
        reader.take(most).read_to_end(&mut document).map_err(input)?;
        if document.len() > MAXIMAL_LINE_BYTES {
            return Err(rejected(Condition::Document, format!("it has more than {MAXIMAL_LINE_BYTES} bytes")));
        }
        let document = String::from_utf8(document).map_err(|error| rejected(Condition::Document, error.to_string()))?;
        let given = self.case.as_ref().map(|file| {
            let refused = |source| Trouble::Question { place: file.display().to_string(), source };
            SteadyModel::parse(&input::text(file)?).map_err(refused)
        });
        verify_steady::verified(&document, given.transpose()?.as_ref(), self.digits)
    }

    fn of_filter(&self, reader: impl BufRead, place: &str) -> Result<Verified, Failed> {
        let failed = |error| match error {
            VerifyError::Rejected(rejection) => Failed::Rejected(rejection),
            VerifyError::Case(error) => inside(&CaseError::Model(error)),
            VerifyError::Input(source) => Failed::Trouble(Trouble::Input { place: place.to_owned(), source }),
        };
        let certificate = FilterCertificate::open(reader).map_err(failed)?;
        let case = Case::parse(certificate.case()).map_err(|error| inside(&error))?;
        let (all, m) = (case.observations.len(), case.sensors());
        if all.saturating_mul(m) > MOST_READINGS {
            let message = format!(
                "the case inside has {all} readings of {m} sensors: more than the {MOST_READINGS} places that are held"
            );
            return Err(rejected(Condition::Size, message));
        }
        let problem = case.problem().map_err(|error| inside(&error))?;
        let (id, may_be_indefinite) = (case.id.clone(), case.initial.allow_indefinite);
        drop(case);
        if let Some(file) = &self.case
            && !is_given(&problem, &id, file)?
        {
            return Err(rejected(Condition::Case, "the case inside is not the one that is given"));
        }
        let (mut step, mut least, mut last) = (0, None::<(u64, usize)>, None);
        let is_wanted = self.last;
        let verdict = certificate.verify(&problem.system, &problem.observations, |proved| {
            if let Some(bits) = proved.bits.filter(|bits| least.is_none_or(|(least, _)| *bits < least)) {
                least = Some((bits, step));
            }
            step += 1;
            if is_wanted && step == all {
                last = Some(proved.clone());
            }
        });
        verdict.map_err(failed)?;
        let mut lines = vec![("steps".to_owned(), step.to_string())];
        let mut members = vec![("kind", json!("filter")), ("steps", json!(step))];
        match least {
            Some((bits, at)) => {
                let digits = digits(bits);
                lines.push(("digits proved, at least".into(), format!("{digits} (step {at})")));
                members.extend([("digits", json!(digits)), ("least_digits_at", json!(at))]);
            }
            None => lines.push(("digits proved, at least".into(), "all: every number is exact".into())),
        }
        if may_be_indefinite {
            let words = "may be indefinite: these are then numbers of the recursion, and no conditional moments";
            lines.push(("the initial covariance".into(), words.into()));
        }
        if let Some(ProvedStep { predicted, filtered, ahead, .. }) = &last {
            let beliefs = [("predicted", Some(predicted)), ("filtered", Some(filtered)), ("ahead", ahead.as_ref())];
            let mut moments = json!({});
            for (name, belief) in beliefs {
                let Some(belief) = belief else { continue };
                let (mean, covariance) = self.moments(belief);
                lines.push((format!("{name} mean"), shown(&mean)));
                lines.push((format!("{name} covariance"), shown_matrix(&covariance)));
                moments[format!("{name}_mean")] = json!(mean);
                moments[format!("{name}_covariance")] = json!(covariance);
            }
            members.push(("last", moments));
        }
        Ok(Verified { name: id, lines, members })
    }

    fn moments(&self, belief: &Belief) -> (Vec<String>, Vec<Vec<String>>) {
        let n = belief.states();
        let text = |ends: [_; 2]| super::proved_interval::text(&ends, self.digits);
        let mean = (0..n).map(|i| text(belief.mean(i))).collect();
        (mean, (0..n).map(|i| (0..n).map(|j| text(belief.covariance(i, j))).collect()).collect())
    }
}

fn inside(error: &CaseError) -> Failed {
    rejected(Condition::Case, format!("the case inside: {error}"))
}

/// Whether the problem inside is that of the case with this name in a file, or of the only one there: the same law, step by step.
fn is_given(own: &Problem, id: &str, file: &Path) -> Result<bool, Failed> {
    let mut cases = input::cases(file)?;
    let Some(place) = cases.iter().position(|given| given.id == id).or((cases.len() == 1).then_some(0)) else {
        return Ok(false);
    };
    let trouble = |source| Failed::Trouble(Trouble::Case { place: file.display().to_string(), source });
    let given = cases.swap_remove(place).problem().map_err(trouble)?;
    // Before anything inside is evaluated, which may be large.
    if own.system.timing != given.system.timing
        || own.system.initial != given.system.initial
        || own.observations.len() != given.observations.len()
    {
        return Ok(false);
    }
    let steps = own.system.steps(&own.observations).map_err(|error| inside(&error.into()))?;
    let others = given.system.steps(&given.observations).map_err(|error| trouble(error.into()))?;
    for (step, other) in steps.zip(others) {
        let (step, other) =
            (step.map_err(|error| inside(&error.into()))?, other.map_err(|error| trouble(error.into()))?);
        if step != other {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The decimal digits that so many bits are, rounded down.
pub(super) fn digits(bits: u64) -> u64 {
    // log10(2) > 0.30102
    bits.saturating_mul(30_102) / 100_000
}

//! `steady`: the stabilising solution of a filter or of control, enclosed, or a proof that there is none.

mod certificate;
mod enclosed;
mod json;
mod text;

use std::path::PathBuf;

use super::Format;
use super::exit::{Exit, Trouble};
use super::input;
use crate::certify::{Absence, Existence, SteadyEffort, SteadyState, Unproved};
use crate::model::{Timing, UnifiedStep};
use crate::protocol::{SteadyEquation, SteadyModel};

const EXAMPLES: &str = "\
Examples:
  exact-kalman steady examples/steady/radar.json                  the covariance at rest, and its gains
  exact-kalman steady examples/steady/walk.json --digits 50
  exact-kalman steady examples/steady/regulator.json              the feedback of a linear quadratic regulator
  exact-kalman steady examples/cases/nile.json --format json
  exact-kalman steady examples/steady/radar.json --certificate radar.certificate.json

The file is described in docs/STEADY.md; cases with constant matrices are read as well. Exit codes: 0 proved,
1 proved that there is no stabilising solution, 2 trouble with the input, 3 undecided, or fewer digits than asked for";

/// Prove the steady state of a filter, to any number of digits, or that there is none
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Steady {
    /// A file with one model or one case, or `-` for standard input.
    file: PathBuf,
    /// Significant decimal digits, of the unit √(sᵢᵢ sⱼⱼ) of an entry; each entry is correctly rounded where that is proved.
    #[arg(long, default_value_t = 17, value_parser = clap::value_parser!(u32).range(1..=1000))]
    digits: u32,
    /// The most bits of the numbers in a proof; they are doubled until the digits are proved.
    #[arg(long, default_value_t = 4096, value_parser = clap::value_parser!(u64).range(64..=65_536))]
    most_bits: u64,
    /// Write what proves the answer to this file, for others to check (docs/STEADY.md).
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// How to print; JSON is one object on one line.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// More digits than are printed, so that most entries are rounded correctly.
const SPARE: u32 = 4;

/// What is printed.
struct Page<'a> {
    model: &'a SteadyModel,
    step: UnifiedStep,
    digits: u32,
}

/// What is known.
enum Finding {
    Proved(Box<SteadyState>),
    Absent(Box<Absence>),
    Undecided(Unproved, Option<String>),
}

impl Steady {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let place = self.file.display().to_string();
        let text = input::text(&self.file)?;
        let model = SteadyModel::parse(text.strip_prefix('\u{feff}').unwrap_or(&text))
            .map_err(|source| Trouble::Question { place, source })?;
        let step = model.unified();
        let effort = SteadyEffort { digits: self.digits + SPARE, most_bits: self.most_bits };
        let finding = found(&step, effort);
        let page = Page { model: &model, step, digits: self.digits };
        if let Some(file) = &self.certificate {
            certificate::write(file, &page, &finding)?;
        }
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Text => text::write(&mut out, &page, &finding)?,
            Format::Json => json::write(&mut out, &page, &finding)?,
        }
        Ok(match &finding {
            Finding::Proved(state) if state.digits.is_none_or(|digits| digits >= self.digits) => Exit::Clean,
            Finding::Absent(_) => Exit::Findings,
            Finding::Proved(_) | Finding::Undecided(..) => Exit::Undecided,
        })
    }
}

fn found(step: &UnifiedStep, effort: SteadyEffort) -> Finding {
    let unproved = match SteadyState::of(step, effort) {
        Ok(state) => return Finding::Proved(Box::new(state)),
        Err(unproved) => unproved,
    };
    match Existence::of(step) {
        Existence::Absent(absence) => Finding::Absent(absence),
        Existence::Present => Finding::Undecided(
            unproved,
            Some("there is one, as the theory of such models says; it is not enclosed".to_owned()),
        ),
        Existence::Undecided(unknown) => Finding::Undecided(unproved, Some(unknown.to_string())),
    }
}

/// More states and sensors are not asked whether their noise is a covariance.
const MOST: usize = 40;

impl Page<'_> {
    /// Whether the noise is a covariance, without which S ≥ 0 does not follow; nothing if that was not asked.
    fn is_covariance(&self) -> Option<bool> {
        let UnifiedStep { process_noise, cross_noise, observation_noise, .. } = &self.step;
        if process_noise.rows() + observation_noise.rows() > MOST {
            return None;
        }
        let joint = process_noise.beside(cross_noise).above(&cross_noise.transpose().beside(observation_noise));
        Some(joint.ldl().is_ok())
    }

    fn kind(&self) -> &'static str {
        match &self.model.equation {
            SteadyEquation::Filter { timing: Timing::Departing, .. } => "departing",
            SteadyEquation::Filter { timing: Timing::Arriving, .. } => "arriving",
            SteadyEquation::Control { .. } => "control",
        }
    }
}

//! `steady`: the stabilising solution of a filter or of control, enclosed, or a proof that there is none.

mod certificate;
mod enclosed;
mod json;
mod text;

use std::path::{Path, PathBuf};

use super::Format;
use super::exit::{Exit, Trouble};
use super::input;
use crate::certify::{Absence, Existence, SteadyEffort, SteadyState, Unproved};
use crate::model::{Timing, UnifiedStep};
use crate::protocol::SteadyModel;

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
        if let Some(file) = &self.certificate {
            if file == Path::new("-") {
                let message = "what is found is printed there; give the certificate a file of its own".into();
                return Err(Trouble::Other { place: "--certificate -".into(), message });
            }
            input::keep(&self.file, file)?;
        }
        let text = input::text(&self.file)?;
        let model = SteadyModel::parse(text.strip_prefix('\u{feff}').unwrap_or(&text))
            .map_err(|source| Trouble::Question { place, source })?;
        let step = model.unified();
        let page = Page { model: &model, step, digits: self.digits };
        let (filtered, open) = (page.has(Timing::Departing), page.has(Timing::Arriving));
        let effort = SteadyEffort { digits: self.digits + SPARE, filtered, open, most_bits: self.most_bits };
        let finding = found(&page.step, effort);
        if let Some(file) = &self.certificate {
            certificate::write(file, &page, &finding)?;
        }
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Text => text::write(&mut out, &page, &finding)?,
            Format::Json => json::write(&mut out, &page, &finding)?,
        }
        Ok(match &finding {
            Finding::Proved(state) if page.is_known(state, self.digits) => Exit::Clean,
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

impl Page<'_> {
    /// Whether the noise is a covariance, without which S ≥ 0 does not follow.
    fn is_covariance(&self) -> bool {
        let UnifiedStep { process_noise, cross_noise, observation_noise, .. } = &self.step;
        let joint = process_noise.beside(cross_noise).above(&cross_noise.transpose().beside(observation_noise));
        joint.ldl().is_ok()
    }

    fn kind(&self) -> &'static str {
        match self.model.equation.timing() {
            Some(Timing::Departing) => "departing",
            Some(Timing::Arriving) => "arriving",
            None => "control",
        }
    }

    fn has(&self, timing: Timing) -> bool {
        self.model.equation.timing() == Some(timing)
    }

    /// What is printed beside the solution and the innovation covariance: its name, its digits, and the states whose variances
    /// are not told from zero.
    fn other<'a>(&self, state: &'a SteadyState) -> Option<(&'static str, Option<u32>, &'a [usize])> {
        match self.model.equation.timing()? {
            Timing::Departing => Some(("filtered", state.filtered_digits, &state.filtered_vanishing)),
            Timing::Arriving => Some(("predicted", state.open_digits, &state.open_vanishing)),
        }
    }

    /// The digits of the covariances that are printed; nothing if all is exact.
    fn known(&self, state: &SteadyState) -> Option<u32> {
        state.digits.into_iter().chain(self.other(state).and_then(|(_, digits, _)| digits)).min()
    }

    /// Whether so many digits are proved, each of its own variances.
    fn is_known(&self, state: &SteadyState, digits: u32) -> bool {
        let all_told = state.vanishing.is_empty() && self.other(state).is_none_or(|(_, _, states)| states.is_empty());
        all_told && self.known(state).is_none_or(|known| known >= digits)
    }
}

//! `stability`: whether the covariance of a filter with random coefficients stays bounded, with proofs.

mod findings;
mod json;
mod text;

use std::path::PathBuf;

use super::Format;
use super::exit::{Exit, Trouble};
use super::input;
use super::numbers::Numbers;
use crate::matrix::Matrix;
use crate::protocol::{InputError, StabilityModel};
use crate::scalar::Rational;
use crate::stability::{Mode, ModeProcess};
use findings::{Findings, Limits};

const EXAMPLES: &str = "\
Examples:
  exact-kalman stability examples/stability/link.json                    readings that get lost
  exact-kalman stability examples/stability/link.json --steps 12 --exact
  exact-kalman stability examples/stability/bursts.json                  losses in bursts
  exact-kalman stability examples/stability/sensors.json --moments 1     sensors drawn at random
  exact-kalman stability examples/stability/plane.json --format json     with all certificates

The file is described in docs/STABILITY.md. Exit codes: 0 the mean of P(k) stays bounded,
1 it grows without bound, 2 trouble with the input, 3 undecided";

/// Decide whether the covariance of a filter with random coefficients stays bounded
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Stability {
    /// A file with one model, or `-` for standard input.
    file: PathBuf,
    #[command(flatten)]
    numbers: Numbers,
    /// For how many steps the mean of P(k) is computed, over all paths.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(0..=1000))]
    steps: u32,
    /// Up to which order moments are decided.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=8))]
    moments: u32,
    /// The most paths, subspaces, Gramians, and values of P(k) times d³ that are looked at.
    #[arg(long, default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    most: u32,
    /// How to print; JSON is one object on one line, with the certificates.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// A model as the theory wants it.
struct Model {
    id: String,
    names: Vec<String>,
    process: ModeProcess<Rational>,
    start: Matrix<Rational>,
}

/// No number of a model is longer.
const MOST_BITS: u64 = 2048;

impl Stability {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let place = self.file.display().to_string();
        let text = input::text(&self.file)?;
        let model = read(text.strip_prefix('\u{feff}').unwrap_or(&text))
            .map_err(|source| Trouble::Question { place, source })?;
        let limits = Limits { steps: self.steps, moments: self.moments, most: self.most as usize };
        let findings = Findings::of(&model, limits);
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Text => text::write(&mut out, &model, &findings, self.numbers)?,
            Format::Json => json::write(&mut out, &model, &findings, self.numbers)?,
        }
        Ok(findings.exit())
    }
}

fn read(text: &str) -> Result<Model, InputError> {
    let document = StabilityModel::parse(text)?;
    printable("id", &document.id)?;
    let mut modes = Vec::with_capacity(document.modes.len());
    for (index, own) in document.modes.iter().enumerate() {
        let place = format!("modes[{index}]");
        if document.modes[..index].iter().any(|other| other.name == own.name) {
            return Err(InputError::at(format!("{place}.name"), format!("{:?} is the name of another mode", own.name)));
        }
        printable(&format!("{place}.name"), &own.name)?;
        let matrices = document.mode(index)?;
        let all = [
            ("transition", &matrices.transition),
            ("observation", &matrices.observation),
            ("process_noise", &matrices.process_noise),
            ("observation_noise", &matrices.observation_noise),
        ];
        all.iter().try_for_each(|(name, matrix)| short(&format!("{place}.{name}"), matrix.entries()))?;
        let mode =
            Mode::new(matrices.transition, matrices.observation, matrices.process_noise, matrices.observation_noise);
        modes.push(mode.map_err(|error| InputError::at(place, error.to_string()))?);
    }
    let chain = document.probabilities()?;
    let law = if document.chain.is_some() { "chain" } else { "probabilities" };
    short(law, chain.initial.iter().chain(chain.transition.entries()))?;
    let start = document.initial_covariance()?;
    short("initial_covariance", start.entries())?;
    let process = ModeProcess::markov(modes, chain.initial, chain.transition)
        .map_err(|error| InputError::at(law, error.to_string()))?;
    let names = document.modes.into_iter().map(|mode| mode.name).collect();
    Ok(Model { id: document.id, names, process, start })
}

/// A name that can stand in a line of text.
fn printable(path: &str, name: &str) -> Result<(), InputError> {
    if name.is_empty() {
        return Err(InputError::at(path, "is empty"));
    }
    match name.chars().find(|character| character.is_control()) {
        Some(character) => Err(InputError::at(path, format!("holds the control character {character:?}"))),
        None => Ok(()),
    }
}

fn short<'a>(path: &str, numbers: impl IntoIterator<Item = &'a Rational>) -> Result<(), InputError> {
    let bits = |number: &Rational| number.numer().bits().max(number.denom().bits());
    match numbers.into_iter().map(bits).max() {
        Some(bits) if bits > MOST_BITS => {
            Err(InputError::at(path, format!("a number of {bits} bits; at most {MOST_BITS} are worked with")))
        }
        _ => Ok(()),
    }
}

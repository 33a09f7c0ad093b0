//! `solve --certificate`: the enclosed filter, with what proves it.

use std::fs::File;
use std::io::{BufWriter, Write, stdout};
use std::path::{Path, PathBuf};

use super::exit::{Exit, Trouble};
use super::interrupt;
use super::numbers::Numbers;
use super::tier::Tiering;
use crate::certify::{CertifiedFilter, NotEnclosed};
use crate::model;
use crate::protocol::Case;
use crate::scalar::Rational;
use crate::verify::CertificateWriter;

/// What is written instead of answers.
#[derive(clap::Args, Debug)]
pub(super) struct Certificate {
    /// Write a certificate to this file, or to standard output for `-`, instead of printing answers: enclosures of all steps, to so
    /// many digits as asked, which `verify` checks. It costs about as much for each step, however many there are. Of one case, whose
    /// start is not diffuse.
    #[arg(long = "certificate", value_name = "FILE", conflicts_with_all = ["exact", "trace", "ahead", "last", "max_bits", "format"])]
    pub(super) file: Option<PathBuf>,
}

/// Why there is no certificate.
enum Refusal {
    Interrupted,
    Undecided(String),
    Contradiction(String),
}

/// Writes the certificate of the only case.
pub(super) fn write(file: &Path, cases: &[Case], numbers: Numbers, tiering: Tiering) -> Result<Exit, Trouble> {
    if tiering.is_exact() {
        let message = "a certificate tells of enclosures: leave --tier exact out".into();
        return Err(Trouble::Other { place: "--certificate".into(), message });
    }
    let [case] = cases else {
        let message = format!("a certificate speaks of one case, and {} are given", cases.len());
        return Err(Trouble::Other { place: "--certificate".into(), message });
    };
    let trouble = |source| Trouble::Case { place: case.id.clone(), source };
    let path = case.problem().map_err(trouble)?.realised().map_err(trouble)?;
    let bits = match enough(&path, numbers.digits, tiering.most_bits(numbers.digits)) {
        Ok(bits) => bits,
        Err(Refusal::Interrupted) => {
            eprintln!("interrupted: no certificate is written");
            return Ok(Exit::Interrupted);
        }
        Err(Refusal::Undecided(why)) => {
            eprintln!("{}: no certificate is written: {why}", case.id);
            return Ok(Exit::Undecided);
        }
        Err(Refusal::Contradiction(why)) => {
            eprintln!("{}: no certificate is written: {why}", case.id);
            return Ok(Exit::Findings);
        }
    };
    if file == Path::new("-") {
        certify(stdout().lock(), case, &path, bits)?;
    } else {
        let place = file.display().to_string();
        let named = |source| Trouble::Input { place: place.clone(), source };
        let created = File::create(file).map_err(named)?;
        certify(BufWriter::new(created), case, &path, bits).map_err(|trouble| match trouble {
            Trouble::Output(source) => named(source),
            other => other,
        })?;
    }
    eprintln!("{}: {} steps certified with {bits} bits", case.id, path.steps().len());
    Ok(Exit::Clean)
}

/// The bits with which all steps are decided, to so many digits: at most so many.
fn enough(path: &model::Path<Rational>, digits: u32, most: u64) -> Result<u64, Refusal> {
    // log2(10) < 3.322, and one bit more for what rounding does to the last digit.
    let wanted = u64::from(digits) * 3322 / 1000 + 2;
    if path.initial().diffuse.iter().any(|part| !part.is_zero()) {
        let why = "the start is diffuse; a certificate speaks of a start with a covariance. Leave --certificate out";
        return Err(Refusal::Undecided(why.into()));
    }
    let mut bits = most.min(wanted + 32);
    loop {
        match first_in_doubt(path, bits, wanted) {
            None => return Ok(bits),
            Some(Refusal::Undecided(_)) if bits < most => bits = (2 * bits).min(most),
            Some(refusal) => return Err(refusal),
        }
    }
}

/// Why not all steps are decided, to so many bits.
fn first_in_doubt(path: &model::Path<Rational>, bits: u64, wanted: u64) -> Option<Refusal> {
    for (k, step) in CertifiedFilter::new(path, bits).enumerate() {
        if interrupt::requested() {
            return Some(Refusal::Interrupted);
        }
        match step {
            Ok(step) => {
                if let Some(known) = step.accuracy().filter(|&known| known < wanted) {
                    return Some(Refusal::Undecided(format!(
                        "step {k} is known to {known} bits of {wanted} with {bits} bits; give a higher --most-bits, or fewer --digits"
                    )));
                }
            }
            Err(NotEnclosed::Undecided(undecided)) => {
                return Some(Refusal::Undecided(format!(
                    "at step {k} {undecided} ({bits}). Exact numbers decide: leave --certificate out"
                )));
            }
            Err(contradiction @ NotEnclosed::Contradiction(_)) => {
                return Some(Refusal::Contradiction(format!("at step {k} {contradiction}")));
            }
        }
    }
    None
}

fn certify<W: Write>(out: W, case: &Case, path: &model::Path<Rational>, bits: u64) -> Result<(), Trouble> {
    let mut filter = CertifiedFilter::new(path, bits).with_witness();
    let Some(start) = filter.belief_document() else { return Ok(()) };
    let mut writer = CertificateWriter::begin(out, &case.to_line(), &start)?;
    while let Some(Ok(_)) = filter.next() {
        if let Some(step) = filter.step_document() {
            writer.step(&step)?;
        }
    }
    writer.end()?;
    Ok(())
}

//! The certificate of a filter as a file: read line by line, and written so.

use std::io::{self, BufRead, Write};

use serde::Serialize;
use serde_json::value::RawValue;
use sha2::{Digest, Sha256};

use super::digest::digits;
use super::document::{BeliefDocument, FilterEnd, FilterFormat, FilterHeader, StepDocument};
use super::filter::{FilterCheck, ProvedStep};
use super::lines::{Lines, VerifyError};
use super::rejection::{Condition, wrong};
use super::step::check_order;
use crate::model::{Observation, System};
use crate::scalar::Rational;

/// A certificate whose first line was read.
///
/// # Examples
///
/// ```
/// use exact_kalman::certify::CertifiedFilter;
/// use exact_kalman::protocol::Case;
/// use exact_kalman::verify::{CertificateWriter, FilterCertificate};
///
/// let case = r#"{"format":"exact-kalman/case/1","id":"walk","timing":"departing",
///     "initial":{"before":"observation","mean":["0"],"covariance":[["1"]]},
///     "transition":[["1"]],"observation":[["1"]],
///     "noise":{"process":[["1"]],"observation":[["1"]]},"observations":[["1"],["0.3"]]}"#;
/// let path = Case::parse(case)?.problem()?.realised()?;
/// let mut filter = CertifiedFilter::new(&path, 128).with_witness();
/// let start = filter.belief_document().ok_or("diffuse")?;
/// let mut writer = CertificateWriter::begin(Vec::new(), &Case::parse(case)?.to_line(), &start)?;
/// while let Some(step) = filter.next() {
///     step?;
///     writer.step(&filter.step_document().ok_or("no witness")?)?;
/// }
/// let certificate = writer.end()?;
///
/// let read = FilterCertificate::open(certificate.as_slice())?;
/// let problem = Case::parse(read.case())?.problem()?;
/// let mut least = u64::MAX;
/// read.verify(&problem.system, &problem.observations, |step| least = least.min(step.bits.unwrap_or(u64::MAX)))?;
/// assert!(least > 110);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FilterCertificate<R> {
    lines: Lines<R>,
    header: FilterHeader,
}

impl<R: BufRead> FilterCertificate<R> {
    /// Reads the first line.
    ///
    /// # Errors
    ///
    /// [`VerifyError`].
    pub fn open(reader: R) -> Result<Self, VerifyError> {
        let mut lines = Lines::new(reader);
        let header = lines.document("first line of a certificate of a filter")?;
        Ok(Self { lines, header })
    }

    /// The document of the case for which it speaks.
    pub fn case(&self) -> &str {
        self.header.case.get()
    }

    /// Checks all steps against those of the case, with one step of both in memory at a time; hands out what is proved of each as soon as it is.
    ///
    /// The system and its observations alone say for which case it is: whether they are those of the case inside, and that is the
    /// one that was meant, is for the caller.
    ///
    /// # Errors
    ///
    /// [`VerifyError`] at the first line that is wrong, or the first step of the case that is no sound model. What was handed out before
    /// is true of the steps up to there, unless the fault is in the digest; only the end says that the whole is a certificate.
    pub fn verify(
        mut self,
        system: &System<Rational>,
        observations: &[Observation<Rational>],
        mut proved: impl FnMut(&ProvedStep),
    ) -> Result<(), VerifyError> {
        let lines = &mut self.lines;
        // Before the case is looked at: to check larger matrices would take long.
        check_order(system.initial.mean.rows(), observations.first().map_or(0, Observation::dimension))
            .map_err(|rejection| lines.at(rejection))?;
        let steps = system.steps(observations)?;
        let mut check = FilterCheck::begin(system.timing, &system.initial, &self.header.start)
            .map_err(|rejection| lines.at(rejection))?;
        for step in steps {
            let step = step?;
            let document: StepDocument = lines.document("step")?;
            proved(&check.step(&step, &document).map_err(|rejection| lines.at(rejection))?);
        }
        check.end(observations.len()).map_err(|rejection| lines.at(rejection))?;
        let end: FilterEnd = lines.document("last line")?;
        if end.steps != check.done() {
            let message = format!("the last line says {} steps, there are {}", end.steps, check.done());
            return Err(lines.at(wrong(Condition::Order, message)).into());
        }
        let digest = lines.digest();
        if end.sha256 != digest {
            let message = format!(
                "all steps are proved, but sha256 {} is stated and {digest} is right: some byte was changed",
                end.sha256
            );
            return Err(lines.at(wrong(Condition::Digest, message)).into());
        }
        if lines.next()?.is_some() {
            return Err(lines.at(wrong(Condition::Document, "something follows the last line")).into());
        }
        Ok(())
    }
}

/// Writes the certificate of a filter, step by step.
#[derive(Debug)]
pub struct CertificateWriter<W> {
    writer: W,
    digest: Sha256,
    steps: usize,
}

impl<W: Write> CertificateWriter<W> {
    /// Writes the first line: the case, a document on one line, and the belief with which it begins.
    ///
    /// # Errors
    ///
    /// [`io::Error`] of the writer, or if the case is not JSON on one line.
    pub fn begin(writer: W, case: &str, start: &BeliefDocument) -> io::Result<Self> {
        let case = RawValue::from_string(case.to_owned())?;
        if case.get().contains('\n') {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "the case stands on several lines"));
        }
        let mut writer = Self { writer, digest: Sha256::new(), steps: 0 };
        writer.line(&FilterHeader { certificate: FilterFormat::One, case, start: start.clone() })?;
        Ok(writer)
    }

    /// Writes a step.
    ///
    /// # Errors
    ///
    /// [`io::Error`] of the writer.
    pub fn step(&mut self, step: &StepDocument) -> io::Result<()> {
        self.steps += 1;
        self.line(step)
    }

    /// Writes the last line, and hands the writer back.
    ///
    /// # Errors
    ///
    /// [`io::Error`] of the writer.
    pub fn end(mut self) -> io::Result<W> {
        let end = FilterEnd { steps: self.steps, sha256: digits(self.digest.clone()) };
        self.line(&end)?;
        self.writer.flush()?;
        Ok(self.writer)
    }

    fn line(&mut self, document: &impl Serialize) -> io::Result<()> {
        let mut line = serde_json::to_vec(document)?;
        line.push(b'\n');
        self.digest.update(&line);
        self.writer.write_all(&line)
    }
}

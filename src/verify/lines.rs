//! Lines of bounded length, with the digest of those that came before.

use std::io::{self, BufRead, Read};

use sha2::{Digest, Sha256};

use super::digest::digits;
use super::document::MAXIMAL_LINE_BYTES;
use super::rejection::{Condition, Rejection, wrong};
use crate::model::ModelError;
use crate::scalar::Rational;

/// Why reading a certificate ended.
#[derive(Debug, thiserror::Error)]
pub enum VerifyError {
    /// The certificate is not accepted.
    #[error(transparent)]
    Rejected(#[from] Rejection),
    /// The case for which it speaks is none: wherever that is found, nothing is proved.
    #[error("the case: {0}")]
    Case(Box<ModelError<Rational>>),
    /// It could not be read.
    #[error("cannot read: {0}")]
    Input(#[from] io::Error),
}

impl From<ModelError<Rational>> for VerifyError {
    fn from(error: ModelError<Rational>) -> Self {
        Self::Case(Box::new(error))
    }
}

#[derive(Debug)]
pub(super) struct Lines<R> {
    reader: R,
    digest: Sha256,
    /// The number of the last line, from 1.
    pub(super) number: usize,
    /// The last line; it is not yet in the digest.
    line: Vec<u8>,
}

impl<R: BufRead> Lines<R> {
    pub(super) fn new(reader: R) -> Self {
        Self { reader, digest: Sha256::new(), number: 0, line: Vec::new() }
    }

    /// The next line; nothing at the end.
    pub(super) fn next(&mut self) -> Result<Option<&str>, VerifyError> {
        self.digest.update(&self.line);
        self.line.clear();
        let most = u64::try_from(MAXIMAL_LINE_BYTES).unwrap_or(u64::MAX);
        self.reader.by_ref().take(most + 1).read_until(b'\n', &mut self.line)?;
        if self.line.is_empty() {
            return Ok(None);
        }
        self.number += 1;
        if self.line.len() > MAXIMAL_LINE_BYTES {
            let message = format!("a line has more than {MAXIMAL_LINE_BYTES} bytes");
            return Err(self.at(wrong(Condition::Document, message)).into());
        }
        match std::str::from_utf8(&self.line) {
            Ok(line) => Ok(Some(line)),
            Err(error) => Err(VerifyError::Rejected(Rejection {
                line: Some(self.number),
                ..wrong(Condition::Document, error.to_string())
            })),
        }
    }

    /// The digest of all lines before the last.
    pub(super) fn digest(&self) -> String {
        digits(self.digest.clone())
    }

    /// The rejection, at the last line.
    pub(super) fn at(&self, rejection: Rejection) -> Rejection {
        Rejection { line: Some(self.number), ..rejection }
    }

    /// The next line as a document.
    pub(super) fn document<T: serde::de::DeserializeOwned>(&mut self, what: &str) -> Result<T, VerifyError> {
        let Some(line) = self.next()? else {
            let missing = wrong(Condition::Document, format!("it ends where {what} is expected"));
            return Err(VerifyError::Rejected(Rejection { line: Some(self.number + 1), ..missing }));
        };
        // A derived reader would take a list of the members as well.
        let read = if line.starts_with('{') {
            serde_json::from_str(line).map_err(|error| error.to_string())
        } else {
            Err("an object is expected".to_owned())
        };
        read.map_err(|error| self.at(wrong(Condition::Document, format!("no {what}: {error}"))).into())
    }
}

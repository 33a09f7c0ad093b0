//! An answer that is written while it is found.

use std::io::{self, Write};

use super::ahead_document::LawDocument;
use super::answer::{LawAhead, Outcome};
use super::answer_document::{Ending, Nested, StepDocument};
use super::answer_number::AnswerNumber;
use super::document;
use crate::trace::Values;

/// An answer on one line, each step written as soon as it is known; what came of it stands at the end.
///
/// It reads back as the same [`Answer`](super::Answer): the order of the keys says nothing.
#[derive(Debug)]
pub struct AnswerStream<W> {
    out: W,
    steps: usize,
}

impl<W: Write> AnswerStream<W> {
    /// Begins the answer to a case, with numbers of type T in all its steps.
    ///
    /// # Errors
    ///
    /// Those of the writer, as for the other methods.
    pub fn begin<T: AnswerNumber>(mut out: W, id: &str) -> io::Result<Self> {
        write!(out, r#"{{"id":{},"numbers":{},"steps":["#, document::line(&id), document::line(&T::NUMBERS))?;
        Ok(Self { out, steps: 0 })
    }

    /// Writes the next step, and hands on all that is written.
    ///
    /// # Errors
    ///
    /// Those of the writer.
    pub fn step<T: AnswerNumber>(&mut self, values: &Values<T>, ahead: &[Option<LawAhead<T>>]) -> io::Result<()> {
        let step = StepDocument {
            quantities: values.iter().map(|(name, matrix)| (*name, Nested::of(*name, matrix))).collect(),
            ahead: ahead.iter().map(|law| law.as_ref().map(LawDocument::of)).collect(),
        };
        let comma = if self.steps == 0 { "" } else { "," };
        write!(self.out, "{comma}{}", document::line(&step))?;
        self.steps += 1;
        self.out.flush()
    }

    /// Ends the answer: what came of it, where, and why.
    ///
    /// # Errors
    ///
    /// Those of the writer.
    pub fn end(mut self, outcome: Outcome, step: Option<usize>, message: Option<String>) -> io::Result<()> {
        // The closing half of an object whose opening half is written already.
        let ending = document::line(&Ending { outcome, step, message });
        writeln!(self.out, "],{}", ending.strip_prefix('{').unwrap_or(&ending))?;
        self.out.flush()
    }
}

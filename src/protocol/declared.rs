//! What is declared in the course of a run.

use super::Declaration;

/// The declaration of a subject, and what is to be said of others that came.
///
/// The first line that is one counts, if no answer came before it. A program that is started again may repeat it.
#[derive(Clone, Debug, Default)]
pub struct Declared {
    declaration: Option<Declaration>,
    remarks: Vec<String>,
    answered: bool,
    said: Said,
}

/// What the present process has said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Said {
    #[default]
    Nothing,
    Declaration,
    Answer,
}

impl Declared {
    /// How many remarks are kept.
    const KEPT: usize = 5;

    /// A line came that is meant as a declaration.
    pub fn line(&mut self, line: &str) {
        let declaration = match Declaration::parse(line) {
            Ok(declaration) => declaration,
            Err(error) => return self.passed_over(&error.to_string()),
        };
        match (&self.declaration, self.said) {
            (_, Said::Answer) => self.passed_over("it came after an answer; it belongs before the first one"),
            (_, Said::Declaration) => self.passed_over("it was the second one; one is enough"),
            (None, Said::Nothing) if self.answered => {
                self.passed_over("it came after an answer, from a program that was started again");
            }
            (Some(first), Said::Nothing) if *first != declaration => {
                self.passed_over("the program was started again, and declared something else than before");
            }
            (_, Said::Nothing) => {
                self.declaration.get_or_insert(declaration);
                self.said = Said::Declaration;
            }
        }
    }

    /// A line came that is an answer.
    pub fn answer(&mut self) {
        self.answered = true;
        self.said = Said::Answer;
    }

    /// The program is started, perhaps again.
    pub fn start(&mut self) {
        self.said = Said::Nothing;
    }

    /// What is declared, so far.
    pub fn declaration(&self) -> Option<&Declaration> {
        self.declaration.as_ref()
    }

    /// Why declarations were passed over, each reason once.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    fn passed_over(&mut self, why: &str) {
        let remark = format!("a declaration was passed over: {}", super::document::excerpt(why));
        if self.remarks.len() < Self::KEPT && !self.remarks.contains(&remark) {
            self.remarks.push(remark);
        }
    }
}

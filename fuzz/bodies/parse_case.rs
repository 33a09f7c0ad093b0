//! A text from outside is read or refused, never a panic; what was read is written so that it is read again.

use exact_kalman::protocol::Case;

/// How far a text came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// Too long for this target, or no UTF-8.
    NoText,
    /// No document of a case.
    NoCase,
    /// A case whose literals have no meaning.
    NoProblem,
    /// A problem that describes no model.
    NoPath,
    /// All the way.
    Path,
}

/// Longer texts take longer and show nothing new.
const MAXIMAL_BYTES: usize = 1 << 14;

/// Reads the bytes as a case.
///
/// # Panics
///
/// If a case that was read is not the case that its own line says.
pub fn run(bytes: &[u8]) -> Reached {
    let Some(text) = std::str::from_utf8(bytes).ok().filter(|text| text.len() <= MAXIMAL_BYTES) else {
        return Reached::NoText;
    };
    let case = match Case::parse(text) {
        Ok(case) => case,
        Err(error) => return refused(&error, Reached::NoCase),
    };
    let line = case.to_line();
    assert!(!line.contains('\n'), "a line is one line");
    assert_eq!(Case::parse(&line).as_ref(), Ok(&case), "{line}");
    assert_eq!(Case::parse(&case.to_pretty()).as_ref(), Ok(&case), "{line}");
    let problem = match case.problem() {
        Ok(problem) => problem,
        Err(error) => return refused(&error, Reached::NoProblem),
    };
    match problem.realised() {
        Ok(path) => {
            assert_eq!(path.steps().len(), case.observations.len());
            Reached::Path
        }
        Err(error) => refused(&error, Reached::NoPath),
    }
}

/// A refusal says something.
fn refused(error: &impl std::error::Error, reached: Reached) -> Reached {
    assert!(!error.to_string().is_empty());
    reached
}

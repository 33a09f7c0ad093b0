//! `explain`: the known mistakes, one by one.

use std::io::Write as _;

use super::exit::{Exit, Trouble};
use crate::judge::{Kind, Mistake, mistake, mistakes};

const EXAMPLES: &str = "\
Examples:
  exact-kalman explain                           all known mistakes, a line each
  exact-kalman explain predicted-for-filtered    what it is, how it comes about, what to do";

/// Explain a known mistake, or list them all
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Explain {
    /// The name of a mistake, as `check` prints it.
    #[arg(value_name = "MISTAKE")]
    name: Option<String>,
}

impl Explain {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let mut out = std::io::stdout().lock();
        let Some(name) = self.name else {
            for (kind, title) in [(Kind::Mistake, "Mistakes"), (Kind::Reading, "Readings, which are no faults")] {
                let gap = if kind == Kind::Mistake { "" } else { "\n" };
                writeln!(out, "{gap}{title}\n")?;
                for Mistake { name, sentence, .. } in mistakes().iter().filter(|mistake| mistake.kind == kind) {
                    writeln!(out, "{name}: {sentence}")?;
                }
            }
            return Ok(Exit::Clean);
        };
        let Some(Mistake { name, kind, sentence, cause, effect, remedy }) = mistake(&name) else {
            let message = "no mistake has this name; exact-kalman explain lists them all".to_owned();
            return Err(Trouble::Other { place: name, message });
        };
        writeln!(out, "{name} ({})\n\n{sentence}\n", kind.name())?;
        writeln!(out, "Cause:  {cause}\nEffect: {effect}\nRemedy: {remedy}")?;
        Ok(Exit::Clean)
    }
}

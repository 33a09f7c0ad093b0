//! `cases`: lists the suite, or writes it to files.

use std::fs;
use std::io::Write as _;
use std::path::PathBuf;

use super::Format;
use super::exit::{Exit, Trouble};
use super::input::Selection;

const EXAMPLES: &str = "\
Examples:
  exact-kalman cases                            list the suite
  exact-kalman cases --only singular            the cases of a category, or with a flag
  exact-kalman cases --out suite                one file per case below suite/
  exact-kalman cases --format json              the cases themselves, for other programs";

/// List the cases of the suite, or write them to files
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct ListCases {
    #[command(flatten)]
    selection: Selection,
    /// Write one file per case below this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// How to print the list: ids with a sentence on each, or the cases themselves, one on each line.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl ListCases {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let cases = self.selection.cases()?;
        if let Some(directory) = self.out {
            // All ids first: nothing is written if one of them cannot be.
            for case in &cases {
                // The ids of the suite are relative paths; those of other people need not be.
                if case.id.split('/').any(|part| part.is_empty() || part.starts_with('.')) || case.id.contains('\\') {
                    let message = "this id cannot be the name of a file".to_owned();
                    return Err(Trouble::Other { place: case.id.clone(), message });
                }
            }
            for case in &cases {
                let path = directory.join(format!("{}.json", case.id));
                let write = |path: &PathBuf| {
                    fs::create_dir_all(path.parent().unwrap_or(&directory))?;
                    fs::write(path, case.to_pretty())
                };
                write(&path).map_err(|source| Trouble::Input { place: path.display().to_string(), source })?;
            }
            eprintln!("{} cases written below {}", cases.len(), directory.display());
            return Ok(Exit::Clean);
        }
        let mut out = std::io::stdout().lock();
        for case in &cases {
            match self.format {
                Format::Json => writeln!(out, "{}", case.to_line())?,
                Format::Text => writeln!(out, "{:34} {}", case.id, case.about)?,
            }
        }
        Ok(Exit::Clean)
    }
}

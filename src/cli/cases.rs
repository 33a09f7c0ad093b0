//! `cases`: lists the suite, or writes it to files.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Format;
use super::exit::{Exit, Trouble};
use super::input::Selection;
use super::manifest::Manifest;
use super::parallel::Jobs;
use super::{interrupt, progress};
use crate::judge::{Truth, categories};
use crate::protocol::Case;
use crate::report::reference;

const EXAMPLES: &str = "\
Examples:
  exact-kalman cases                            list the suite
  exact-kalman cases --only singular            the cases with this text in their id or in a flag
  exact-kalman cases --category units           the cases of a category
  exact-kalman cases --seed 7 --format json     other made-up readings, for other programs
  exact-kalman cases --out suite                one file per case below suite/
  exact-kalman cases --category basic --references --out release

With --references the cases go below cases/, their exact answers below references/, and MANIFEST.json lists all
files with their checksums.";

/// List the cases of the suite, or write them to files
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct ListCases {
    #[command(flatten)]
    selection: Selection,
    /// Write one file per case below this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the exact answers, too: 25 correct digits of everything, and the digits that are attainable.
    #[arg(long, requires = "out")]
    references: bool,
    #[command(flatten)]
    jobs: Jobs,
    /// How to print the list: ids with a sentence on each, or the cases themselves, one on each line.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// The ids of the suite are relative paths; those of other people need not be.
fn is_path(id: &str) -> bool {
    !id.contains('\\') && id.split('/').all(|part| !part.is_empty() && !part.starts_with('.'))
}

fn write(directory: &Path, name: &str, text: &str) -> Result<(), Trouble> {
    let path = directory.join(name);
    let written = fs::create_dir_all(path.parent().unwrap_or(directory)).and_then(|()| fs::write(&path, text));
    written.map_err(|source| Trouble::Input { place: path.display().to_string(), source })
}

impl ListCases {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let cases = self.selection.cases()?;
        if let Some(directory) = &self.out {
            // All ids first: nothing is written if one of them cannot be.
            if let Some(case) = cases.iter().find(|case| !is_path(&case.id)) {
                let message = "this id cannot be the name of a file".to_owned();
                return Err(Trouble::Other { place: case.id.clone(), message });
            }
            if self.references {
                return self.release(directory, cases);
            }
            for case in &cases {
                write(directory, &format!("{}.json", case.id), &case.to_pretty())?;
            }
            eprintln!("{} cases written below {}", cases.len(), directory.display());
            return Ok(Exit::Clean);
        }
        let mut out = std::io::stdout().lock();
        let whole = self.selection.is_whole_suite();
        let mut category = "";
        for case in &cases {
            let name = case.id.split('/').next().unwrap_or_default();
            match self.format {
                Format::Json => writeln!(out, "{}", case.to_line())?,
                Format::Text => {
                    if let Some(found) = categories().iter().find(|known| known.name == name).filter(|_| whole)
                        && name != category
                    {
                        let gap = if category.is_empty() { "" } else { "\n" };
                        writeln!(out, "{gap}{name}: {}", found.about)?;
                    }
                    writeln!(out, "{}{:38} {}", if whole { "  " } else { "" }, case.id, case.about)?;
                }
            }
            category = name;
        }
        Ok(Exit::Clean)
    }

    /// Writes cases, references and the list of files.
    fn release(&self, directory: &Path, cases: Vec<Case>) -> Result<Exit, Trouble> {
        interrupt::listen(None);
        let mut manifest = Manifest::new(cases.len(), self.selection.seed());
        let (all, progress) = (cases.len(), progress::of_cases(cases.len()));
        let cases: Vec<_> = cases.into_iter().map(Arc::new).collect();
        let references = self.jobs.ahead(cases.clone(), |case: Arc<Case>| reference(&case, &Truth::of(&case)))?;
        let mut unknown = 0;
        for (case, reference) in cases.iter().zip(references) {
            progress.set_message(case.id.clone());
            let Some(reference) = reference.wait() else { return Ok(Exit::Interrupted) };
            let files = [("cases", Some(case.to_pretty())), ("references", reference)];
            for (kind, text) in files {
                let Some(text) = text else {
                    unknown += 1;
                    continue;
                };
                let name = format!("{kind}/{}.json", case.id);
                write(directory, &name, &text)?;
                manifest.add(name, &text);
            }
            progress.inc(1);
        }
        progress.finish_and_clear();
        write(directory, "MANIFEST.json", &manifest.text())?;
        eprintln!("{all} cases and {} references written below {}", all - unknown, directory.display());
        Ok(if unknown > 0 { Exit::Undecided } else { Exit::Clean })
    }
}

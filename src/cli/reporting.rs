//! Where a report goes, and in which form.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::exit::Trouble;
use crate::report::{Report, json, junit, markdown};

/// The forms of a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Form {
    /// For people.
    #[default]
    Text,
    /// For programs, one line for each filter that is judged.
    Json,
    /// For continuous integration: JUnit's XML.
    Junit,
    /// For a comment on a change, or an issue.
    Markdown,
}

/// How the verbs that judge report.
#[derive(clap::Args, Debug)]
pub(super) struct Reporting {
    /// Show all findings, not only the worst twenty; of the built-in filters, each case.
    #[arg(long)]
    pub(super) all: bool,
    /// How to print the report.
    #[arg(long, value_enum, default_value_t)]
    format: Form,
    /// Write the report to this file as well; may be given several times. Its ending says how: .txt, .json,
    /// .xml (JUnit), .md.
    #[arg(long = "report", value_name = "FILE", value_parser = file)]
    files: Vec<PathBuf>,
}

fn form_of(path: &Path) -> Option<Form> {
    match path.extension()?.to_str()? {
        "txt" => Some(Form::Text),
        "json" => Some(Form::Json),
        "xml" => Some(Form::Junit),
        "md" => Some(Form::Markdown),
        _ => None,
    }
}

/// A file that can be meant: found out before a program is asked for minutes.
fn file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if form_of(&path).is_none() {
        return Err("its ending says which form is wanted: .txt, .json, .xml or .md".to_owned());
    }
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !directory.is_dir() {
        return Err(format!("{} is no directory", directory.display()));
    }
    Ok(path)
}

impl Reporting {
    /// Prints the reports, and writes the files; `text` is what people read.
    pub(super) fn publish(&self, reports: &[Report], text: impl Fn() -> String) -> Result<(), Trouble> {
        let rendered = |form: Form| -> Result<String, Trouble> {
            Ok(match form {
                Form::Text => text(),
                Form::Json => reports.iter().map(|report| json(report).to_string() + "\n").collect(),
                Form::Junit => junit(reports)?,
                Form::Markdown => markdown(reports, self.all),
            })
        };
        std::io::stdout().lock().write_all(rendered(self.format)?.as_bytes())?;
        for path in &self.files {
            let form = form_of(path).unwrap_or_default();
            let place = path.display().to_string();
            fs::write(path, rendered(form)?).map_err(|source| Trouble::Input { place, source })?;
        }
        Ok(())
    }
}

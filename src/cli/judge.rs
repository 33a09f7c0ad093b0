//! `judge`: judges answers that were saved before.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::PathBuf;

use super::Format;
use super::exit::{Exit, Trouble};
use super::input::{Selection, text as read};
use crate::judge::{Judgement, Truth};
use crate::protocol::{Answer, Reply};
use crate::report::{Report, json, text};

const EXAMPLES: &str = "\
Examples:
  exact-kalman cases --format json > cases.jsonl
  python3 my_filter.py < cases.jsonl > answers.jsonl
  exact-kalman judge answers.jsonl --cases cases.jsonl";

/// Judge answers that a program has written to a file
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct JudgeAnswers {
    /// The answers, one on each line, or `-`.
    answers: PathBuf,
    #[command(flatten)]
    selection: Selection,
    /// Show all findings, not only the worst twenty.
    #[arg(long)]
    all: bool,
    /// How to print the report.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl JudgeAnswers {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let cases = self.selection.cases()?;
        let lines = read(&self.answers)?;
        let mut report = Report::new(self.answers.display().to_string());
        let mut replies: BTreeMap<String, Reply> = BTreeMap::new();
        let mut strays = 0;
        for (number, line) in lines.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
            if !line.trim_start().starts_with('{') {
                strays += 1;
                continue;
            }
            match Answer::parse(line) {
                Ok(answer) => {
                    let id = answer.id.clone();
                    if replies.insert(id.clone(), Reply::Answer(answer)).is_some() {
                        report.remarks.push(format!("{id:?} is answered more than once; the last answer counts"));
                    }
                }
                Err(why) => report.remarks.push(format!("line {} is no answer: {why}", number + 1)),
            }
        }
        if strays > 0 {
            report.remarks.push(format!("{strays} lines that are no answers were passed over"));
        }
        for case in cases {
            let reply = replies.remove(&case.id).unwrap_or_else(|| Reply::Malformed {
                detail: "there is no answer to this case".into(),
                line: String::new(),
            });
            let judgement = Judgement::of(case.expect, &Truth::of(&case), &reply);
            report.results.push((case, judgement));
        }
        for id in replies.keys() {
            report.remarks.push(format!("{id:?} is answered, but it is no case that was asked"));
        }
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Text => write!(out, "{}", text(&report, self.all))?,
            Format::Json => writeln!(out, "{}", json(&report))?,
        }
        Ok(Exit::of(&report))
    }
}

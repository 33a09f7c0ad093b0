//! `judge`: judges answers that were saved before.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use super::Format;
use super::exit::{Exit, Trouble};
use super::input::{Selection, text as read};
use super::parallel::Jobs;
use super::{interrupt, progress};
use crate::judge::{Judgement, Truth};
use crate::protocol::{Answer, Case, Reply};
use crate::report::{Report, json, text};

const EXAMPLES: &str = "\
Examples:
  exact-kalman cases --format json > cases.jsonl                        one case on each line
  python3 examples/subjects/textbook.py < cases.jsonl > answers.jsonl   a program answers
  exact-kalman judge answers.jsonl                                      judge what it said

Answers may stand in any order; a case without one is a finding. Ctrl-C stops: the report is on what was
judged by then, says so, and the exit code is 130; a second Ctrl-C ends at once, without a report.";

/// Judge answers that were saved to a file
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct JudgeAnswers {
    /// The answers, one on each line; `-` for standard input.
    answers: PathBuf,
    #[command(flatten)]
    selection: Selection,
    #[command(flatten)]
    jobs: Jobs,
    /// Show all findings, not only the worst twenty.
    #[arg(long)]
    all: bool,
    /// How to print the report.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

impl JudgeAnswers {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        if self.selection.is_standard_input() && self.answers == Path::new("-") {
            let message = "cases and answers cannot both be read from standard input".to_owned();
            return Err(Trouble::Other { place: "-".into(), message });
        }
        interrupt::listen(None);
        let cases = self.selection.cases()?;
        let mut report = Report::new(self.answers.display().to_string());
        let mut answers = Answers::of(&read(&self.answers)?, &mut report.remarks);
        let questions: Vec<_> = cases.into_iter().map(|case| (answers.0.remove(&case.id), case)).collect();
        let all = questions.len();
        let progress = progress::of_cases(all);
        for judged in self.jobs.ahead(questions, |(answer, case)| (judgement(&case, answer), case))? {
            let Some((judgement, case)) = judged.wait() else { break };
            progress.set_message(case.id.clone());
            report.results.push((case, judgement));
            progress.inc(1);
            if interrupt::requested() {
                break;
            }
        }
        progress.finish_and_clear();
        report.unjudged = all - report.results.len();
        for id in answers.0.keys() {
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

/// The judgement on the answer to a case.
fn judgement(case: &Case, answer: Option<Result<Answer, String>>) -> Judgement {
    match answer {
        Some(Ok(answer)) => Judgement::of(case.expect, &Truth::of(case), &Reply::Answer(answer)),
        Some(Err(why)) => Judgement::unanswered(why),
        None => Judgement::unanswered("there is no answer to this case"),
    }
}

/// Answers by id, or why they are none.
struct Answers(BTreeMap<String, Result<Answer, String>>);

impl Answers {
    /// The answers of a text, one on each line; what else there is becomes a remark.
    fn of(text: &str, remarks: &mut Vec<String>) -> Self {
        let mut answers = BTreeMap::new();
        let mut strays = 0;
        let lines = text.strip_prefix('\u{feff}').unwrap_or(text).lines().enumerate();
        for (number, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
            if !line.trim_start().starts_with('{') {
                strays += 1;
                continue;
            }
            let (id, answer) = match Answer::parse(line) {
                Ok(answer) => (answer.id.clone(), Ok(answer)),
                Err(why) => {
                    let why = format!("line {} is no answer: {why}", number + 1);
                    let Some(id) = id_of(line) else {
                        remarks.push(why);
                        continue;
                    };
                    (id, Err(why))
                }
            };
            if answers.insert(id.clone(), answer).is_some() {
                remarks.push(format!("{id:?} is answered more than once; the last answer counts"));
            }
        }
        if strays > 0 {
            remarks.push(format!("{strays} stray lines passed over"));
        }
        Self(answers)
    }
}

/// The id of a line that is JSON, but no answer.
fn id_of(line: &str) -> Option<String> {
    let value: serde_json::Value = serde_json::from_str(line).ok()?;
    value.get("id")?.as_str().map(str::to_owned)
}

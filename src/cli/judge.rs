//! `judge`: judges answers that were saved before.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::exit::{Exit, Trouble};
use super::input::{Selection, text as read};
use super::parallel::Jobs;
use super::progress::Cases;
use super::reporting::Reporting;
use super::{declared, interrupt};
use crate::judge::{Judgement, Truth};
use crate::protocol::{Answer, Case, Declaration, Declared, Reply};
use crate::report::{Report, text};

const EXAMPLES: &str = "\
Examples:
  exact-kalman cases --format json > cases.jsonl                        one case on each line
  python3 examples/subjects/textbook.py < cases.jsonl > answers.jsonl   a program answers
  exact-kalman judge answers.jsonl                                      judge what it said
  exact-kalman judge cases.jsonl answers.jsonl                          on cases from a file

One name alone is that of the answers. They may stand in any order; a case without one is a finding.
A line before them may declare what is unsupported, as on standard output (docs/PROTOCOL.md).

Ctrl-C stops: the report is on what was judged by then, says so, and the exit code is 130; a second
Ctrl-C ends at once, without a report.";

/// Judge answers that were saved to a file
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES, override_usage = "exact-kalman judge [OPTIONS] [CASES] <ANSWERS>")]
pub(super) struct JudgeAnswers {
    /// The cases, as for --cases [default: the built-in suite].
    #[arg(value_name = "CASES")]
    first: Option<PathBuf>,
    /// The answers, one on each line; `-` for standard input.
    #[arg(value_name = "ANSWERS")]
    second: Option<PathBuf>,
    #[command(flatten)]
    selection: Selection,
    #[command(flatten)]
    jobs: Jobs,
    /// Stop at the first finding; the report says how many cases are left.
    #[arg(long)]
    fail_fast: bool,
    #[command(flatten)]
    reporting: Reporting,
}

impl JudgeAnswers {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        // One name alone is that of the answers.
        let (selection, answers) = match (&self.first, &self.second) {
            (Some(cases), Some(answers)) => (self.selection.with_cases(cases)?, answers),
            (Some(answers), None) | (None, Some(answers)) => (self.selection, answers),
            (None, None) => {
                let message = "no answers. Usage: exact-kalman judge [OPTIONS] [CASES] <ANSWERS>".to_owned();
                return Err(Trouble::Other { place: "judge".into(), message });
            }
        };
        if selection.is_standard_input() && answers == Path::new("-") {
            let message = "cases and answers cannot both be read from standard input".to_owned();
            return Err(Trouble::Other { place: "-".into(), message });
        }
        interrupt::listen(None);
        let cases = selection.cases()?;
        let mut report = Report::new(answers.display().to_string());
        let mut answers = Answers::of(&read(answers)?, &mut report);
        report.remarks.extend(report.declaration.as_ref().and_then(|it| declared::remark(it, cases.iter())));
        let questions: Vec<_> = cases.into_iter().map(|case| (answers.0.remove(&case.id), case)).collect();
        let all = questions.len();
        let progress = Cases::of(all);
        let declaration = report.declaration.clone();
        let judge = move |(answer, case)| (judgement(declaration.as_ref(), &case, answer), case);
        for judged in self.jobs.ahead(questions, judge)? {
            let Some((judgement, case)) = judged.wait() else { break };
            progress.case(&case.id);
            report.at_first_finding = self.fail_fast && judgement.verdict.is_finding();
            report.results.push((case, judgement));
            progress.done();
            if report.at_first_finding || interrupt::requested() {
                break;
            }
        }
        drop(progress);
        report.unjudged = all - report.results.len();
        for id in answers.0.keys() {
            report.remarks.push(format!("{id:?} is answered, but it is no case that was asked"));
        }
        self.reporting.publish(std::slice::from_ref(&report), || text(&report, self.reporting.all))?;
        Ok(Exit::of(&report))
    }
}

/// The judgement on the answer to a case.
fn judgement(declaration: Option<&Declaration>, case: &Case, answer: Option<Result<Answer, String>>) -> Judgement {
    if let Some(unsupported) = declared::judgement(declaration, case) {
        return unsupported;
    }
    match answer {
        Some(Ok(answer)) => Judgement::of(case.expect, &Truth::of(case), &Reply::Answer(answer)),
        Some(Err(why)) => Judgement::unanswered(why),
        None => Judgement::unanswered("there is no answer to this case"),
    }
}

/// Answers by id, or why they are none.
struct Answers(BTreeMap<String, Result<Answer, String>>);

impl Answers {
    /// The answers of a text, one on each line, and what is declared before them; what else there is becomes a remark.
    fn of(text: &str, report: &mut Report) -> Self {
        let remarks = &mut report.remarks;
        let (mut answers, mut declared) = (BTreeMap::new(), Declared::default());
        let mut strays = 0;
        let lines = text.strip_prefix('\u{feff}').unwrap_or(text).lines().enumerate();
        for (number, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
            if !line.trim_start().starts_with('{') {
                strays += 1;
                continue;
            }
            let (id, answer) = match Answer::parse(line) {
                Ok(answer) => {
                    declared.answer();
                    (answer.id.clone(), Ok(answer))
                }
                Err(_) if Declaration::is_meant_by(line) => {
                    declared.line(line);
                    continue;
                }
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
        remarks.extend_from_slice(declared.remarks());
        report.declaration = declared.declaration().cloned();
        Self(answers)
    }
}

/// The id of a line that is JSON, but no answer.
fn id_of(line: &str) -> Option<String> {
    let value: serde_json::Value = serde_json::from_str(line).ok()?;
    value.get("id")?.as_str().map(str::to_owned)
}

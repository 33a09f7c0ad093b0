//! `check`: asks a program every case and judges its answers.

use std::io::{IsTerminal as _, Write as _};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::Format;
use super::exit::{Exit, Trouble};
use super::input::Selection;
use crate::float::Form;
use crate::judge::{Examinee, Judgement, Truth};
use crate::protocol::{Case, Limits, Subject};
use crate::report::{Report, json, side_by_side, text};

const EXAMPLES: &str = "\
Examples:
  exact-kalman check                                              the built-in f64 filters
  exact-kalman check -- python3 examples/subjects/textbook.py     a program of yours
  exact-kalman check --only nile -- ./my_filter --fast            some cases

A program reads one case on each line of its standard input and prints one answer on a line of its
standard output, flushed; docs/PROTOCOL.md says the rest. Without a program this demonstrates, and
exits with 0.";

/// Judge a program, or the built-in f64 filters, against exact truth
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Check {
    #[command(flatten)]
    selection: Selection,
    /// Seconds that the program may take for one case.
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0, value_parser = seconds)]
    time: f64,
    /// Show all findings, not only the worst twenty.
    #[arg(long)]
    all: bool,
    /// How to print the report.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// The program to judge, with its arguments, after `--`.
    #[arg(last = true, value_name = "COMMAND")]
    command: Vec<String>,
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| "not a number of seconds".to_owned())?;
    if (0.001..=86_400.0).contains(&seconds) { Ok(seconds) } else { Err("from 0.001 to 86400 seconds".into()) }
}

impl Check {
    pub(super) fn run(self) -> Result<Exit, Trouble> {
        let cases = self.selection.cases()?;
        if self.command.is_empty() {
            let mut forms = Form::ALL;
            let mut examinees: Vec<&mut dyn Examinee> =
                forms.iter_mut().map(|form| form as &mut dyn Examinee).collect();
            let reports = examine(&cases, &mut examinees);
            self.demonstrate(&reports)?;
            return Ok(Exit::Clean);
        }
        let limits = Limits { case_time: Duration::from_secs_f64(self.time), ..Limits::default() };
        let mut subject = Subject::new(&self.command, limits);
        let mut reports = examine(&cases, &mut [&mut subject]);
        let Some(mut report) = reports.pop() else { return Ok(Exit::Clean) };
        let strays = subject.strays();
        if strays.count > 0 {
            let first: Vec<String> = strays.first.iter().map(|line| format!("{line:?}")).collect();
            report.remarks.push(format!(
                "{} lines on standard output are no answers: {}",
                strays.count,
                first.join(", ")
            ));
        }
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Text => write!(out, "{}", text(&report, self.all))?,
            Format::Json => writeln!(out, "{}", json(&report))?,
        }
        Ok(Exit::of(&report))
    }

    fn demonstrate(&self, reports: &[Report]) -> Result<(), Trouble> {
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Json => {
                for report in reports {
                    writeln!(out, "{}", json(report))?;
                }
            }
            Format::Text => {
                writeln!(out, "Correct digits of three f64 Kalman filters against exact rational arithmetic:")?;
                writeln!(out, "filtered mean / filtered covariance, the fewest over all steps.\n")?;
                writeln!(out, "{}", side_by_side(reports))?;
                for form in Form::ALL {
                    writeln!(out, "{:16}{}", form.name(), form.description())?;
                }
                writeln!(
                    out,
                    "\n17 is exact; attainable is what a backward-stable method keeps (other data of the same case,\n\
                     moved by 2^-53, move the answer that much); ! marks a loss of more than 2 digits against it.\n\
                     Judge a filter of your own:  exact-kalman check -- python3 my_filter.py"
                )?;
            }
        }
        Ok(())
    }
}

/// Asks every examinee every case and judges the replies.
fn examine(cases: &[Case], examinees: &mut [&mut dyn Examinee]) -> Vec<Report> {
    let mut reports: Vec<Report> = examinees.iter().map(|examinee| Report::new(examinee.name())).collect();
    let progress = progress(cases.len());
    for case in cases {
        progress.set_message(case.id.clone());
        let truth = Truth::of(case);
        for (examinee, report) in examinees.iter_mut().zip(&mut reports) {
            let reply = examinee.reply(case);
            report.results.push((case.clone(), Judgement::of(case.expect, &truth, &reply)));
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    reports
}

/// A bar on standard error, if somebody is looking.
fn progress(cases: usize) -> ProgressBar {
    let target =
        if std::io::stderr().is_terminal() { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(Some(cases as u64), target);
    match ProgressStyle::with_template("{pos:>4} of {len}  {msg}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

//! `check`: asks a program every case and judges its answers.

use std::io::{IsTerminal as _, Write as _};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::Format;
use super::exit::{Exit, Trouble};
use super::input::Selection;
use crate::float::Form;
use crate::judge::{Examinee, Judgement, Truth};
use crate::protocol::{Case, Limits, Reply, Subject};
use crate::report::{Report, json, side_by_side, text};

const EXAMPLES: &str = "\
Examples:
  exact-kalman check                                              the built-in f64 filters
  exact-kalman check -- python3 examples/subjects/textbook.py     a program of yours
  exact-kalman check --only nile -- ./my_filter --fast            only some cases
  exact-kalman check --cases examples/cases -- ./my_filter        cases of your own

The program reads one case on each line of its standard input, and prints one answer on a line of its
standard output, flushed; docs/PROTOCOL.md says the rest, and has a complete example.

Exit codes: 0 all agree; 1 some finding; 2 trouble with the command line or the input; 3 nothing wrong,
but something undecided. Without a program this demonstrates, and exits with 0.";

/// Judge a program, or the built-in f64 filters, against exact truth
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Check {
    #[command(flatten)]
    selection: Selection,
    /// Seconds that the program may take for one case, its start included.
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0, value_parser = seconds)]
    time: f64,
    /// Show all findings, not only the worst twenty.
    #[arg(long)]
    all: bool,
    /// How to print the report.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// The program to judge, with its arguments, after `--` [default: the built-in f64 filters].
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
            let reports = examine(&cases, &mut examinees)?;
            self.demonstrate(&reports)?;
            return Ok(Exit::Clean);
        }
        let limits = Limits { case_time: Duration::from_secs_f64(self.time), ..Limits::default() };
        let mut subject = Subject::new(&self.command, limits);
        let mut reports = examine(&cases, &mut [&mut subject])?;
        let Some(mut report) = reports.pop() else { return Ok(Exit::Clean) };
        let strays = subject.strays();
        if strays.count > 0 {
            let first: Vec<String> = strays.first.iter().map(|line| format!("{line:?}")).collect();
            let more = if strays.count > first.len() { ", …" } else { "" };
            let lines = if strays.count == 1 { "line" } else { "lines" };
            report.remarks.push(format!(
                "{} stray {lines} on standard output passed over: {}{more}",
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
                    "\n17 is exact. Attainable is what is left of the answer when all data are moved by one part in 2^53;\n\
                     where an innovation covariance is singular, at most 15. Negative: wrong by so many powers of ten.\n\
                     ! marks a step with more than 2 digits fewer than attainable there; where a verdict stands beside\n\
                     the digits it is about other quantities (--format json tells all).\n\
                     Judge a filter of your own:  exact-kalman check -- python3 my_filter.py"
                )?;
            }
        }
        Ok(())
    }
}

/// Asks every examinee every case and judges the replies. A program that cannot even be started the first time is no
/// finding but a mistake on the command line.
fn examine(cases: &[Case], examinees: &mut [&mut dyn Examinee]) -> Result<Vec<Report>, Trouble> {
    let mut reports: Vec<Report> = examinees.iter().map(|examinee| Report::new(examinee.name())).collect();
    let progress = progress(cases.len());
    for case in cases {
        progress.set_message(case.id.clone());
        let truth = Truth::of(case);
        for (examinee, report) in examinees.iter_mut().zip(&mut reports) {
            let reply = examinee.reply(case);
            if let Reply::NotStarted { detail } = &reply
                && report.results.is_empty()
            {
                progress.finish_and_clear();
                return Err(Trouble::Other { place: examinee.name(), message: detail.clone() });
            }
            report.results.push((case.clone(), Judgement::of(case.expect, &truth, &reply)));
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    Ok(reports)
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

//! `check`: asks a program every case and judges its answers.

use std::io::Write as _;
use std::sync::Arc;
use std::time::Duration;

use super::Format;
use super::exit::{Exit, Trouble};
use super::input::Selection;
use super::parallel::Jobs;
use super::{interrupt, progress};
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
standard output, flushed; docs/PROTOCOL.md says the rest, and has a complete example. One process is asked
one case at a time, whatever --jobs says, which is about the exact answers only.

Ctrl-C stops after the present case: the report is on what was judged by then, says so, and the exit code is
130. A second Ctrl-C ends at once, without a report.

Exit codes: 0 all agree; 1 some finding; 2 trouble with the command line or the input; 3 nothing wrong,
but something undecided; 130 interrupted. Without a program this demonstrates, and exits with 0.";

/// Judge a program, or the built-in f64 filters, against exact truth
#[derive(clap::Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Check {
    #[command(flatten)]
    selection: Selection,
    /// Seconds that the program may take for one case, its start included.
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0, value_parser = seconds)]
    time: f64,
    #[command(flatten)]
    jobs: Jobs,
    /// Show all findings, not only the worst twenty; without a program, each case.
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
            interrupt::listen(None);
            let reports = built_in(cases, self.jobs)?;
            self.demonstrate(&reports)?;
            let interrupted = reports.iter().any(|report| report.unjudged > 0);
            return Ok(if interrupted { Exit::Interrupted } else { Exit::Clean });
        }
        interrupt::listen(Some("stopping after this case; Ctrl-C once more ends at once"));
        let limits = Limits { case_time: Duration::from_secs_f64(self.time), ..Limits::default() };
        let mut subject = Subject::new(&self.command, limits);
        let mut report = examine(cases, &mut subject, self.jobs)?;
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

    /// Shows the built-in filters side by side.
    fn demonstrate(&self, reports: &[Report]) -> Result<(), Trouble> {
        let mut out = std::io::stdout().lock();
        match self.format {
            Format::Json => {
                for report in reports {
                    writeln!(out, "{}", json(report))?;
                }
            }
            Format::Text => {
                writeln!(
                    out,
                    "{} f64 Kalman filters against exact rational arithmetic, by category:",
                    Form::ALL.len()
                )?;
                writeln!(out, "cases that agree / cases that the form supports, and the fewest correct digits.\n")?;
                writeln!(out, "{}", side_by_side(reports, self.all))?;
                for form in Form::ALL {
                    writeln!(out, "{:16}{}", form.name(), form.description())?;
                }
                writeln!(
                    out,
                    "\nAttainable is what is left of the answer when all data are moved by one part in 2^53; where an innovation\n\
                     covariance is singular, at most 15. docs/FORMS.md says what each form is good and bad at.\n\
                     Judge a filter of your own:  exact-kalman check -- python3 my_filter.py"
                )?;
            }
        }
        Ok(())
    }
}

/// Asks a program every case, one after the other, and judges the replies; the truths are computed meanwhile and ahead. A
/// program that cannot even be started the first time is no finding but a mistake on the command line.
fn examine(cases: Vec<Case>, subject: &mut Subject, jobs: Jobs) -> Result<Report, Trouble> {
    let mut report = Report::new(subject.name());
    let all = cases.len();
    let progress = progress::of_cases(all);
    let cases: Vec<_> = cases.into_iter().map(Arc::new).collect();
    let truths = jobs.ahead(cases.clone(), |case: Arc<Case>| Truth::of(&case))?;
    for (case, truth) in cases.into_iter().zip(truths) {
        progress.set_message(case.id.clone());
        let reply = subject.reply(&case);
        if let Reply::NotStarted { detail } = &reply
            && report.results.is_empty()
        {
            progress.finish_and_clear();
            return Err(Trouble::Other { place: subject.name(), message: detail.clone() });
        }
        let Some(truth) = truth.wait() else { break };
        let judgement = Judgement::of(case.expect, &truth, &reply);
        report.results.push((Arc::unwrap_or_clone(case), judgement));
        progress.inc(1);
        if interrupt::requested() {
            break;
        }
    }
    progress.finish_and_clear();
    report.unjudged = all - report.results.len();
    Ok(report)
}

/// Judges the built-in filters.
fn built_in(cases: Vec<Case>, jobs: Jobs) -> Result<Vec<Report>, Trouble> {
    let mut reports: Vec<_> = Form::ALL.iter().map(|form| Report::new(form.name())).collect();
    let all = cases.len();
    let progress = progress::of_cases(all);
    let judge = |case: Case| {
        let truth = Truth::of(&case);
        let judgement = |mut form: Form| Judgement::of(case.expect, &truth, &form.reply(&case));
        (Form::ALL.map(judgement), case)
    };
    for judged in jobs.ahead(cases, judge)? {
        let Some((judgements, case)) = judged.wait() else { break };
        progress.set_message(case.id.clone());
        for (report, judgement) in reports.iter_mut().zip(judgements) {
            report.results.push((case.clone(), judgement));
        }
        progress.inc(1);
        if interrupt::requested() {
            break;
        }
    }
    progress.finish_and_clear();
    for report in &mut reports {
        report.unjudged = all - report.results.len();
    }
    Ok(reports)
}

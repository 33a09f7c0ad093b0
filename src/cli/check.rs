//! `check`: asks a program every case and judges its answers.

use std::sync::{Arc, OnceLock};
use std::time::Duration;

use super::exit::{Exit, Trouble};
use super::input::Selection;
use super::parallel::Jobs;
use super::progress::Cases;
use super::reporting::Reporting;
use super::{declared, interrupt};
use crate::float::Form;
use crate::judge::{Examinee, Judgement, Truth};
use crate::protocol::{Case, Limits, Reply, Strays, Subject};
use crate::report::{Report, side_by_side, text};

const EXAMPLES: &str = "\
Examples:
  exact-kalman check                                              the built-in f64 filters
  exact-kalman check -- python3 examples/subjects/textbook.py     a program of yours
  exact-kalman check --only nile -- ./my_filter --fast            only some cases
  exact-kalman check --cases examples/cases -- ./my_filter        cases of your own
  exact-kalman check --fail-fast -- ./my_filter                   up to the first finding
  exact-kalman check --report judged.xml -- ./my_filter           JUnit for CI, text for people

The program reads one case on each line of its standard input, and prints one answer on a line of
its standard output, flushed; docs/PROTOCOL.md says the rest, and has a complete example. One
process is asked one case at a time, whatever --jobs says, which is about the exact answers only.

Ctrl-C stops after the present case: the report is on what was judged by then, says so, and the
exit code is 130. A second Ctrl-C ends at once, without a report.

Exit codes: 0 all agree; 1 some finding; 2 trouble with the command line or the input; 3 nothing
wrong, but something undecided; 130 interrupted. Without a program this demonstrates, and exits
with 0.";

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
    /// Stop at the first finding; the report says how many cases were not asked.
    #[arg(long, requires = "command")]
    fail_fast: bool,
    #[command(flatten)]
    reporting: Reporting,
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
            self.reporting.publish(&reports, || demonstration(&reports, self.reporting.all))?;
            let interrupted = reports.iter().any(|report| report.unjudged > 0);
            return Ok(if interrupted { Exit::Interrupted } else { Exit::Clean });
        }
        interrupt::listen(Some("stopping after this case; Ctrl-C once more ends at once"));
        let limits = Limits { case_time: Duration::from_secs_f64(self.time), ..Limits::default() };
        let mut subject = Subject::new(&self.command, limits);
        let mut report = examine(cases, &mut subject, self.jobs, self.fail_fast)?;
        report.remarks.extend(subject.remarks().iter().cloned().chain(strays(&subject.strays())));
        self.reporting.publish(std::slice::from_ref(&report), || text(&report, self.reporting.all))?;
        Ok(Exit::of(&report))
    }
}

/// A remark on stray lines.
fn strays(strays: &Strays) -> Option<String> {
    let first: Vec<String> = strays.first.iter().map(|line| format!("{line:?}")).collect();
    let more = if strays.count > first.len() { ", …" } else { "" };
    let lines = if strays.count == 1 { "line" } else { "lines" };
    let remark =
        || format!("{} stray {lines} on standard output passed over: {}{more}", strays.count, first.join(", "));
    (strays.count > 0).then(remark)
}

/// The built-in filters side by side, for people: by category and where they differ, or case by case.
fn demonstration(reports: &[Report], all: bool) -> String {
    let forms: Vec<String> = Form::ALL.iter().map(|form| format!("{:16}{}", form.name(), form.description())).collect();
    format!(
        "{} f64 Kalman filters against exact rational arithmetic, by category:\n\
         cases that agree / cases that the form supports, and the fewest correct digits.\n\n\
         {}\n{}\n\n\
         Attainable is what is left of the answer when all data are moved by one part in 2^53; where an innovation\n\
         covariance is singular, at most 15. docs/FORMS.md says what each form is good and bad at.\n\
         Judge a filter of your own:  exact-kalman check -- python3 my_filter.py\n",
        Form::ALL.len(),
        side_by_side(reports, all),
        forms.join("\n")
    )
}

/// Asks a program every case that is for it, one after the other, and judges the replies; the truths are computed meanwhile and
/// ahead. A program that cannot even be started the first time is no finding but a mistake on the command line.
fn examine(cases: Vec<Case>, subject: &mut Subject, jobs: Jobs, fail_fast: bool) -> Result<Report, Trouble> {
    let mut report = Report::new(subject.name());
    let all = cases.len();
    let progress = Cases::of(all);
    let cases: Vec<_> = cases.into_iter().map(Arc::new).collect();
    // What is declared not to be asked needs no truth either; until it is declared, that is not known.
    let declaration = Arc::new(OnceLock::new());
    let known = Arc::clone(&declaration);
    let truth = move |case: Arc<Case>| declared::judgement(known.get(), &case).is_none().then(|| Truth::of(&case));
    for (case, truth) in cases.clone().into_iter().zip(jobs.ahead(cases.clone(), truth)?) {
        progress.case(&case.id);
        let reply = declared::judgement(subject.declaration(), &case).is_none().then(|| subject.reply(&case));
        if let Some(Reply::NotStarted { detail }) = &reply
            && report.results.is_empty()
        {
            return Err(Trouble::Other { place: subject.name(), message: detail.clone() });
        }
        if let Some(found) = subject.declaration() {
            declaration.get_or_init(|| found.clone());
        }
        // The first case is asked before anything is declared: what comes back is not judged if it is none for the subject.
        let judgement = match (declared::judgement(subject.declaration(), &case), &reply) {
            (Some(unsupported), _) => unsupported,
            (None, Some(reply)) => {
                let Some(Some(truth)) = truth.wait() else { break };
                Judgement::of(case.expect, &truth, reply)
            }
            (None, None) => break,
        };
        let finding = judgement.verdict.is_finding();
        report.results.push((Arc::unwrap_or_clone(case), judgement));
        progress.done();
        report.at_first_finding = fail_fast && finding;
        if report.at_first_finding || interrupt::requested() {
            break;
        }
    }
    report.unjudged = all - report.results.len();
    report.declaration = subject.declaration().cloned();
    report
        .remarks
        .extend(report.declaration.as_ref().and_then(|it| declared::remark(it, cases.iter().map(Arc::as_ref))));
    Ok(report)
}

/// Judges the built-in filters.
fn built_in(cases: Vec<Case>, jobs: Jobs) -> Result<Vec<Report>, Trouble> {
    let mut reports: Vec<_> = Form::ALL.iter().map(|form| Report::new(form.name())).collect();
    let all = cases.len();
    let progress = Cases::of(all);
    let judge = |case: Case| {
        let truth = Truth::of(&case);
        let judgement = |mut form: Form| Judgement::of(case.expect, &truth, &form.reply(&case));
        (Form::ALL.map(judgement), case)
    };
    for judged in jobs.ahead(cases, judge)? {
        let Some((judgements, case)) = judged.wait() else { break };
        progress.case(&case.id);
        for (report, judgement) in reports.iter_mut().zip(judgements) {
            report.results.push((case.clone(), judgement));
        }
        progress.done();
        if interrupt::requested() {
            break;
        }
    }
    for report in &mut reports {
        report.unjudged = all - report.results.len();
    }
    Ok(reports)
}

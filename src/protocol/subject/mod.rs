//! Programs under test: long-lived processes that answer cases, and every way in which they do not.
//!
//! One process answers all cases. It is started when it is first asked, and again after it hung, flooded, died
//! or lost step with the questions. Nothing here waits without a limit or keeps more than a limit.

mod command;
mod inlet;
mod outlet;
mod process;
mod reply;
mod stray;
mod tail;

use std::time::Duration;

use super::{Declaration, Declared};
use process::{Next, Process};

pub use reply::Reply;
pub use stray::Strays;

/// What a subject may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The time for one case, the start of the program included.
    pub case_time: Duration,
    /// The bytes it may print for one case.
    pub output_bytes: usize,
}

impl Default for Limits {
    /// 10 s and 64 MiB.
    fn default() -> Self {
        Self { case_time: Duration::from_secs(10), output_bytes: super::MAXIMAL_DOCUMENT_BYTES }
    }
}

/// A program that reads cases on its standard input and prints answers on its standard output.
///
/// On Unix it runs in a process group of its own, and the whole group is killed when the subject fails or is
/// dropped; elsewhere only the process itself is.
///
/// # Examples
///
/// ```no_run
/// use exact_kalman::protocol::{Limits, Reply, Subject};
///
/// let command = ["python3", "my_filter.py"].map(String::from);
/// let mut subject = Subject::new(&command, Limits::default());
/// # let line = "";
/// match subject.ask("nile/known-start", line) {
///     Reply::Answer(answer) => println!("{} steps", answer.steps.len()),
///     other => println!("{other}"),
/// }
/// ```
#[derive(Debug)]
pub struct Subject {
    command: Vec<String>,
    limits: Limits,
    process: Option<Process>,
    strays: Strays,
    declared: Declared,
    starts: usize,
}

impl Subject {
    /// A subject that is started when it is first asked.
    pub fn new(command: &[String], limits: Limits) -> Self {
        let (strays, declared) = (Strays::default(), Declared::default());
        Self { command: command.to_vec(), limits, process: None, strays, declared, starts: 0 }
    }

    /// Sends one case and waits for its answer.
    ///
    /// `line` is the case on one line; a line break in it is sent as a space. A process that ended with success
    /// after it had answered an earlier case is started once more and asked again: a subject may answer one
    /// case per run.
    pub fn ask(&mut self, id: &str, line: &str) -> Reply {
        match self.ask_once(id, line) {
            // A fresh process has answered nothing before, so this happens once.
            (_, Next::AskAgain) => self.ask_once(id, line).0,
            (reply, _) => reply,
        }
    }

    /// The lines on standard output that were no answers, of all processes so far.
    pub fn strays(&self) -> Strays {
        let mut strays = self.strays.clone();
        if let Some(process) = &self.process {
            strays.add(&process.strays());
        }
        strays
    }

    /// What the program has declared; nothing before the first case was asked.
    pub fn declaration(&self) -> Option<&Declaration> {
        self.declared.declaration()
    }

    /// Why declarations were passed over.
    pub fn remarks(&self) -> &[String] {
        self.declared.remarks()
    }

    /// How often the program was started.
    pub fn starts(&self) -> usize {
        self.starts
    }

    fn ask_once(&mut self, id: &str, line: &str) -> (Reply, Next) {
        let process = match &mut self.process {
            Some(process) => process,
            none => match Process::start(&self.command, self.limits) {
                Ok(process) => {
                    self.starts += 1;
                    self.declared.start();
                    none.insert(process)
                }
                Err(detail) => return (Reply::NotStarted { detail }, Next::Restart),
            },
        };
        let (reply, next) = process.ask(id, line, &mut self.declared);
        if next != Next::Continue
            && let Some(process) = self.process.take()
        {
            self.strays.add(&process.strays());
        }
        (reply, next)
    }
}

impl std::fmt::Display for Subject {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.command.join(" "))
    }
}

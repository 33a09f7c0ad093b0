//! One running process of a subject.

use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use super::super::answer_document::OnlyId;
use super::super::document::excerpt;
use super::super::{Answer, Declaration, Declared};
use super::inlet::Inlet;
use super::outlet::{Event, Outlet};
use super::tail::Tail;
use super::{Limits, Reply, Strays, command};

/// How often it is asked whether the process still runs: a grandchild may hold the pipe after its death.
const HEARTBEAT: Duration = Duration::from_millis(50);

/// How long a process may take to be gone after it was killed, or to end after it closed its output.
const PARTING: Duration = Duration::from_secs(1);

/// What the next case needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Next {
    /// This process.
    Continue,
    /// A fresh process.
    Restart,
    /// A fresh process, and this case again: the old one ended with success after earlier answers, and may be a
    /// program that answers one case per run.
    AskAgain,
}

/// A process with its three streams.
#[derive(Debug)]
pub(super) struct Process {
    child: Child,
    /// Absent once closed.
    inlet: Option<Inlet>,
    outlet: Outlet,
    errors: Tail,
    limits: Limits,
    answered: usize,
}

impl Process {
    /// Starts the program, or says in words why not.
    pub(super) fn start(words: &[String], limits: Limits) -> Result<Self, String> {
        let Some((program, arguments)) = words.split_first() else {
            return Err("no program to start: give its name and arguments".to_owned());
        };
        let mut command = Command::new(program);
        command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command::in_own_group(&mut command);
        let mut child = command
            .spawn()
            .map_err(|error| format!("cannot start {program:?}: {error}; is it installed, and on the PATH?"))?;
        let (Some(input), Some(output), Some(errors)) = (child.stdin.take(), child.stdout.take(), child.stderr.take())
        else {
            command::kill(&mut child);
            return Err(format!("cannot connect to {program:?}"));
        };
        Ok(Self {
            child,
            inlet: Some(Inlet::into(input)),
            outlet: Outlet::of(output, limits.output_bytes),
            errors: Tail::of(errors),
            limits,
            answered: 0,
        })
    }

    /// The lines that were no answers.
    pub(super) fn strays(&self) -> Strays {
        self.outlet.strays()
    }

    /// Sends a case and waits for its answer; what is declared meanwhile is kept, and waits for nothing.
    pub(super) fn ask(&mut self, id: &str, line: &str, declared: &mut Declared) -> (Reply, Next) {
        let limit = self.limits.case_time;
        let deadline = Instant::now() + limit;
        let timed_out = || (Reply::TimedOut { limit }, Next::Restart);
        self.outlet.begin();
        if !self.inlet.as_ref().is_some_and(|inlet| inlet.send(line, deadline)) {
            return timed_out();
        }
        let mut gone = false;
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() && !gone {
                return timed_out();
            }
            // What a process wrote before its death may still be on its way: one more heartbeat of patience.
            match self.outlet.next(if gone { HEARTBEAT } else { left.min(HEARTBEAT) }) {
                Some(Event::Line(line)) => {
                    if let Some(heard) = self.heard(id, line, declared) {
                        return heard;
                    }
                }
                Some(Event::Flooded) => return (Reply::Flooded { limit: self.limits.output_bytes }, Next::Restart),
                Some(Event::Ended) => return self.died(deadline),
                None if gone => return self.died(deadline),
                None => gone = !matches!(self.child.try_wait(), Ok(None)),
            }
        }
    }

    /// What a line comes to; nothing if it is a declaration.
    fn heard(&mut self, id: &str, line: Vec<u8>, declared: &mut Declared) -> Option<(Reply, Next)> {
        let text = match String::from_utf8(line) {
            Ok(text) => text,
            Err(error) => {
                let line = excerpt(&String::from_utf8_lossy(error.as_bytes()));
                let detail = format!("not UTF-8, from byte {} on", error.utf8_error().valid_up_to());
                return Some((Reply::Malformed { detail, line }, Next::Restart));
            }
        };
        let (found, detail) = match Answer::parse(&text) {
            Ok(answer) if answer.id == id => {
                self.answered += 1;
                declared.answer();
                return Some((Reply::Answer(answer), Next::Continue));
            }
            Ok(answer) => (Some(answer.id), None),
            Err(_) if Declaration::is_meant_by(&text) => {
                declared.line(&text);
                return None;
            }
            Err(error) => (serde_json::from_str(&text).ok().map(|OnlyId { id, .. }| id), Some(error.to_string())),
        };
        // A bad answer to the right question leaves the process in step; anything else may have shifted it.
        let next = if found.as_deref() == Some(id) { Next::Continue } else { Next::Restart };
        let detail = match (detail, found) {
            (Some(detail), _) => detail,
            (None, found) => format!(
                "answers out of order: asked {id:?}, answered {:?}; print one line per case, in the order of the \
                 cases, with the id of the case",
                excerpt(&found.unwrap_or_default())
            ),
        };
        Some((Reply::Malformed { detail, line: excerpt(&text) }, next))
    }

    /// The reply for a process that ended, or closed its output.
    fn died(&mut self, deadline: Instant) -> (Reply, Next) {
        let parting = deadline.min(Instant::now() + PARTING);
        let status = self.ended_by(parting.max(Instant::now() + HEARTBEAT));
        let politely = self.answered > 0 && status.is_some_and(|status| status.success());
        let status = status
            .map_or_else(|| "closed its standard output and kept running".to_owned(), |status| status.to_string());
        // The group goes first, so that nobody holds standard error.
        command::kill(&mut self.child);
        let next = if politely { Next::AskAgain } else { Next::Restart };
        (Reply::Died { status, stderr: self.errors.text() }, next)
    }

    /// The status, if the process ends in time.
    fn ended_by(&mut self, deadline: Instant) -> Option<ExitStatus> {
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return Some(status),
                Err(_) => return None,
                Ok(None) if Instant::now() >= deadline => return None,
                Ok(None) => thread::sleep(Duration::from_millis(2)),
            }
        }
    }
}

impl Drop for Process {
    /// Closes the input, which asks a well-behaved program to end, and soon kills whatever is left.
    fn drop(&mut self) {
        self.inlet = None;
        self.ended_by(Instant::now() + 2 * HEARTBEAT);
        command::kill(&mut self.child);
        // Reaps it; one that even now does not go is left to the system.
        self.ended_by(Instant::now() + PARTING);
    }
}

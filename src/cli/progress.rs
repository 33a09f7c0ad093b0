//! Bars on standard error, if somebody is looking and something lasts.

use std::io::IsTerminal as _;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::rest::rest;
use crate::report::printable;

/// What is over by then needs no bar.
const MOMENT: Duration = Duration::from_secs(1);

/// A bar that counts up to a number.
fn bar(all: usize, target: ProgressDrawTarget) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(all as u64), target);
    match ProgressStyle::with_template("{prefix}{pos:>4} of {len}  {msg}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// The cases that are judged.
#[derive(Debug)]
pub(super) struct Cases(ProgressBar);

impl Cases {
    pub(super) fn of(cases: usize) -> Self {
        let looking = std::io::stderr().is_terminal();
        Self(bar(cases, if looking { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() }))
    }

    /// The case that is asked now.
    pub(super) fn case(&self, id: &str) {
        self.0.set_message(printable(id));
    }

    /// One more case is judged.
    pub(super) fn done(&self) {
        self.0.inc(1);
    }
}

impl Drop for Cases {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// The steps of a case that is solved.
#[derive(Debug)]
pub(super) struct Steps {
    bar: ProgressBar,
    begun: Instant,
    all: usize,
    bits: u64,
    /// When each step was known; not kept if nobody looks.
    done_at: Vec<Duration>,
    looking: bool,
    shown: bool,
}

impl Steps {
    pub(super) fn of(case: &str, all: usize) -> Self {
        let looking = std::io::stderr().is_terminal();
        let bar = bar(all, ProgressDrawTarget::hidden()).with_prefix(format!("{} · step ", printable(case)));
        Self { bar, begun: Instant::now(), all, bits: 0, done_at: Vec::new(), looking, shown: false }
    }

    /// One more step is known.
    pub(super) fn step(&mut self, bits: u64) {
        self.bits = bits;
        if self.looking {
            self.done_at.push(self.begun.elapsed());
        }
        self.bar.inc(1);
        self.tick();
    }

    /// Time has passed.
    pub(super) fn tick(&mut self) {
        if !self.looking || self.begun.elapsed() < MOMENT {
            return;
        }
        if !self.shown {
            self.shown = true;
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        let rest = rest(&self.done_at, self.all).map(|rest| format!(", about {} left", lasting(rest)));
        self.bar.set_message(format!("numbers of {} bits{}", self.bits, rest.unwrap_or_default()));
        self.bar.tick();
    }

    /// Does something, such as to print, while the bar is away.
    pub(super) fn aside<R>(&self, what: impl FnOnce() -> R) -> R {
        self.bar.suspend(what)
    }
}

impl Drop for Steps {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A time in the one unit that says enough.
fn lasting(time: Duration) -> String {
    match time.as_secs() {
        seconds @ ..120 => format!("{seconds} s"),
        seconds @ 120..7200 => format!("{} min", seconds / 60),
        seconds @ 7200..172_800 => format!("{} h", seconds / 3600),
        seconds => format!("{} days", seconds / 86_400),
    }
}

//! The steps of a case, one at a time, by the route that is asked for.

use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use super::interrupt;
use crate::certify::{CertifiedStep, Halt, RaisedFilter, TieredFilter, TieredStep};
use crate::filter::{
    Effort, FRACTIONS_PART, Predictions, RationalFilter, RationalStep, Records, StepAhead, StopReason,
};
use crate::gaussian::ConditionError;
use crate::model::{Path, PathAhead};
use crate::scalar::Rational;
use crate::trace::Record;

/// How often it is asked whether to stop.
const HEARTBEAT: Duration = Duration::from_millis(50);

/// How the steps are computed.
#[derive(Debug)]
pub(super) enum Source {
    /// On integers over one denominator.
    Fast(Path<Rational>),
    /// By the readable recursion.
    Readable(Path<Rational>),
    /// By the predictor.
    Ahead(PathAhead<Rational>),
    /// On integers while denominators are short, and where enclosures decide nothing; else enclosed.
    Tiered(Path<Rational>, Wanted),
    /// Enclosed.
    Certified(Along, Wanted),
}

/// What an enclosure is made along.
#[derive(Debug)]
pub(super) enum Along {
    Path(Path<Rational>),
    Ahead(PathAhead<Rational>),
}

/// What is wanted of enclosures.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    /// The decimal digits of each entry.
    pub(super) digits: u32,
    /// The bits that they may have.
    pub(super) most_bits: u64,
    /// Whether everything is wanted that has a name.
    pub(super) everything: bool,
}

/// What is known of a step.
#[derive(Debug)]
pub(super) enum Step {
    Exact(ExactStep),
    Enclosed(Box<CertifiedStep>),
}

/// A step of which every number is known.
#[derive(Debug)]
pub(super) enum ExactStep {
    Fast(RationalStep),
    Readable(Box<Record<Rational>>),
    Ahead(Box<StepAhead<Rational>>),
}

/// Why there is no next step.
#[derive(Debug)]
pub(super) enum Stop {
    /// There are no more.
    Ended,
    /// The filter cannot go on.
    Reason(StopReason),
    /// Enclosures do not decide.
    Undecided(Halt),
    /// Ctrl-C.
    Interrupted,
}

/// What one thread, which computes, says to another, which prints.
enum News {
    Step(Step, u64),
    Stop(Stop),
}

/// Steps that are computed while those before them are printed; one waits between the two.
pub(super) struct Steps {
    news: Receiver<News>,
    worker: Option<JoinHandle<()>>,
    /// After Ctrl-C, whether the step that waited has been taken.
    interrupted: bool,
}

impl Source {
    pub(super) fn path(&self) -> &Path<Rational> {
        match self {
            Self::Fast(path) | Self::Readable(path) | Self::Tiered(path, _) | Self::Certified(Along::Path(path), _) => {
                path
            }
            Self::Ahead(path) | Self::Certified(Along::Ahead(path), _) => path.path(),
        }
    }

    /// Begins to compute, with denominators of at most so many bits.
    pub(super) fn steps(self, maximal_bits: Option<u64>) -> Steps {
        let (sender, news) = sync_channel(1);
        let worker = std::thread::spawn(move || {
            let stop = self.run(maximal_bits, &sender).unwrap_or(Stop::Ended);
            // Nobody may be listening any more.
            let _ = sender.send(News::Stop(stop));
        });
        Steps { news, worker: Some(worker), interrupted: false }
    }

    /// Sends all steps; says why they end, if it is not the path that ends.
    fn run(self, maximal_bits: Option<u64>, to: &SyncSender<News>) -> Option<Stop> {
        let tell = |step, bits| to.send(News::Step(step, bits)).is_ok();
        let all = self.path().steps().len();
        match self {
            Self::Fast(path) => {
                let mut filter = RationalFilter::new(&path, Effort { maximal_bits, ..Effort::default() });
                while let Some(step) = filter.next() {
                    let step = match step {
                        Ok(step) => step,
                        Err(reason) => return Some(Stop::Reason(reason)),
                    };
                    if !tell(Step::Exact(ExactStep::Fast(step)), filter.bits()) {
                        return None;
                    }
                }
                None
            }
            Self::Readable(path) => {
                let step = |record| Step::Exact(ExactStep::Readable(Box::new(record)));
                fractions(Records::new(&path), all, maximal_bits, |record| record, step, tell)
            }
            Self::Ahead(path) => {
                let step = |ahead| Step::Exact(ExactStep::Ahead(Box::new(ahead)));
                fractions(Predictions::new(&path), all, maximal_bits, |ahead| &ahead.record, step, tell)
            }
            Self::Tiered(path, wanted) => tiered(&path, wanted, maximal_bits, tell),
            Self::Certified(along, wanted) => certified(&along, wanted, tell),
        }
    }
}

fn tiered(
    path: &Path<Rational>,
    Wanted { digits, most_bits, .. }: Wanted,
    maximal_bits: Option<u64>,
    tell: impl Fn(Step, u64) -> bool,
) -> Option<Stop> {
    let mut filter = TieredFilter::to_digits(path, digits, most_bits, maximal_bits);
    while let Some(step) = filter.next() {
        let step = match step {
            Ok(TieredStep::Exact(step)) => Step::Exact(ExactStep::Fast(step)),
            Ok(TieredStep::Certified(step)) => Step::Enclosed(step),
            Err(reason) => return Some(Stop::Reason(reason)),
        };
        if !tell(step, filter.bits()) {
            return None;
        }
    }
    None
}

fn certified(along: &Along, wanted: Wanted, tell: impl Fn(Step, u64) -> bool) -> Option<Stop> {
    let Wanted { digits, most_bits, everything } = wanted;
    let mut filter = match along {
        Along::Path(path) => RaisedFilter::new(path, digits, most_bits),
        Along::Ahead(path) => RaisedFilter::new(path.path(), digits, most_bits).ahead(path),
    };
    if everything {
        filter = filter.everything();
    }
    while let Some(step) = filter.next() {
        let step = match step {
            Ok(step) => Step::Enclosed(Box::new(step)),
            Err(Halt::Contradiction(proof)) => {
                return Some(Stop::Reason(StopReason::Condition(ConditionError::Inconsistent(proof))));
            }
            Err(halt) => return Some(Stop::Undecided(halt)),
        };
        if !tell(step, filter.bits()) {
            return None;
        }
    }
    None
}

/// Runs a filter on fractions, which knows no limit itself, along a path of so many steps.
fn fractions<T>(
    results: impl Iterator<Item = Result<T, ConditionError<Rational>>>,
    all: usize,
    maximal_bits: Option<u64>,
    record: impl Fn(&T) -> &Record<Rational>,
    step: impl Fn(T) -> Step,
    tell: impl Fn(Step, u64) -> bool,
) -> Option<Stop> {
    let limit = maximal_bits.map(|limit| limit / FRACTIONS_PART);
    for (done, result) in (1..).zip(results) {
        let result = match result {
            Ok(result) => result,
            Err(reason) => return Some(Stop::Reason(reason.into())),
        };
        let bits = record(&result).denominator_bits();
        if !tell(step(result), bits) {
            return None;
        }
        if let Some(limit) = limit.filter(|limit| bits > *limit && done < all) {
            return Some(Stop::Reason(StopReason::TooLong { bits, limit }));
        }
    }
    None
}

impl Steps {
    /// The next step with the length of its numbers, or why there is none; `tick` is called from time to time.
    ///
    /// After Ctrl-C a step that waits is still handed out; one that is not known yet is not waited for.
    pub(super) fn next(&mut self, mut tick: impl FnMut()) -> Result<(Step, u64), Stop> {
        loop {
            if self.interrupted {
                return Err(Stop::Interrupted);
            }
            self.interrupted = interrupt::requested();
            match self.news.recv_timeout(if self.interrupted { Duration::ZERO } else { HEARTBEAT }) {
                Ok(News::Step(step, bits)) => return Ok((step, bits)),
                Ok(News::Stop(stop)) => return Err(stop),
                Err(RecvTimeoutError::Timeout) => tick(),
                // It says why it stops, unless it panics.
                Err(RecvTimeoutError::Disconnected) => match self.worker.take().map(JoinHandle::join) {
                    Some(Err(panic)) => std::panic::resume_unwind(panic),
                    _ => return Err(Stop::Ended),
                },
            }
        }
    }
}

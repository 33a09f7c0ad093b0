//! Work on many things side by side, with the results in order.

use std::collections::VecDeque;
use std::num::NonZero;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use rayon::ThreadPool;

use super::exit::Trouble;
use super::interrupt;

/// How often it is asked whether to stop.
const HEARTBEAT: Duration = Duration::from_millis(50);

/// How many results there may be for each thread, those that wait to be taken included: this bounds memory.
const RESULTS_PER_THREAD: usize = 4;

/// How many threads compute.
#[derive(clap::Args, Clone, Copy, Debug)]
pub(super) struct Jobs {
    /// How many threads compute exact answers; the report does not depend on it [default: one for each processor].
    #[arg(long, value_name = "THREADS", value_parser = threads)]
    jobs: Option<NonZero<usize>>,
}

const MAXIMAL_THREADS: usize = 256;

fn threads(text: &str) -> Result<NonZero<usize>, String> {
    let threads = text.parse().ok().and_then(NonZero::new).filter(|threads| threads.get() <= MAXIMAL_THREADS);
    threads.ok_or_else(|| format!("from 1 to {MAXIMAL_THREADS} threads"))
}

impl Jobs {
    /// Works on items in their order, some of them ahead of those whose results are taken.
    ///
    /// What runs in parallel inside the work shares these threads.
    pub(super) fn ahead<T, R, W>(self, items: Vec<T>, work: W) -> Result<Ahead<T, R, W>, Trouble>
    where
        T: Send + 'static,
        R: Send + 'static,
        W: Fn(T) -> R + Send + Sync + 'static,
    {
        let threads =
            self.jobs.map_or_else(|| std::thread::available_parallelism().map_or(1, NonZero::get), NonZero::get);
        let threads = threads.min(MAXIMAL_THREADS);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|why| Trouble::Other { place: "--jobs".into(), message: why.to_string() })?;
        Ok(Ahead {
            pool,
            most: threads * RESULTS_PER_THREAD,
            items: items.into_iter(),
            work: Arc::new(work),
            pending: VecDeque::new(),
            abandoned: Arc::default(),
        })
    }
}

/// The results to come, in order.
pub(super) struct Ahead<T, R, W> {
    pool: ThreadPool,
    most: usize,
    items: std::vec::IntoIter<T>,
    work: Arc<W>,
    pending: VecDeque<Pending<R>>,
    abandoned: Arc<AtomicBool>,
}

/// A result to come.
pub(super) struct Pending<R>(Receiver<R>);

impl<R> Pending<R> {
    /// The result; nothing after Ctrl-C, if it is not known by then.
    pub(super) fn wait(self) -> Option<R> {
        loop {
            match self.0.recv_timeout(HEARTBEAT) {
                Ok(result) => return Some(result),
                Err(RecvTimeoutError::Timeout) if !interrupt::requested() => {}
                Err(_) => return None,
            }
        }
    }
}

impl<T, R, W> Iterator for Ahead<T, R, W>
where
    T: Send + 'static,
    R: Send + 'static,
    W: Fn(T) -> R + Send + Sync + 'static,
{
    type Item = Pending<R>;

    fn next(&mut self) -> Option<Pending<R>> {
        while self.pending.len() < self.most
            && let Some(item) = self.items.next()
        {
            let (sender, receiver) = channel();
            let (work, abandoned) = (Arc::clone(&self.work), Arc::clone(&self.abandoned));
            self.pool.spawn_fifo(move || {
                if !abandoned.load(Ordering::Relaxed) {
                    // Whoever asked may have gone.
                    let _ = sender.send(work(item));
                }
            });
            self.pending.push_back(Pending(receiver));
        }
        self.pending.pop_front()
    }
}

impl<T, R, W> Drop for Ahead<T, R, W> {
    /// What is not begun is not done; what is begun ends by itself, or with the program.
    fn drop(&mut self) {
        self.abandoned.store(true, Ordering::Relaxed);
    }
}

//! The subject's standard output, read by a thread with bounded memory.

use std::io::Read;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use super::Strays;

/// What is read next.
pub(super) enum Event {
    /// A line that starts with a brace.
    Line(Vec<u8>),
    /// More bytes than allowed since the last question; nothing more is read.
    Flooded,
    /// The end of the output.
    Ended,
}

/// The reading end. At most one line waits here and one is being gathered; a subject that prints more is
/// stopped by its own full pipe.
#[derive(Debug)]
pub(super) struct Outlet {
    events: Receiver<Event>,
    shared: Arc<Shared>,
}

#[derive(Debug, Default)]
struct Shared {
    /// Bytes read since the last question.
    bytes: AtomicUsize,
    strays: Mutex<Strays>,
}

impl Shared {
    fn strays(&self) -> MutexGuard<'_, Strays> {
        self.strays.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Outlet {
    /// Starts to read, at most `limit` bytes between two questions.
    pub(super) fn of(stream: impl Read + Send + 'static, limit: usize) -> Self {
        let (sender, events) = sync_channel(1);
        let shared = Arc::<Shared>::default();
        let gatherer = Gatherer { sender, shared: Arc::clone(&shared), limit, line: Vec::new() };
        thread::spawn(move || gatherer.run(stream));
        Self { events, shared }
    }

    /// A new question begins: its output counts from zero.
    pub(super) fn begin(&self) {
        self.shared.bytes.store(0, Ordering::Relaxed);
    }

    /// The next event; nothing if there is none in this time. After the end, the end again.
    pub(super) fn next(&self, patience: Duration) -> Option<Event> {
        match self.events.recv_timeout(patience) {
            Ok(event) => Some(event),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(Event::Ended),
        }
    }

    pub(super) fn strays(&self) -> Strays {
        self.shared.strays().clone()
    }
}

struct Gatherer {
    sender: SyncSender<Event>,
    shared: Arc<Shared>,
    limit: usize,
    line: Vec<u8>,
}

impl Gatherer {
    /// Reads until the stream ends, the limit is passed or nobody listens any more.
    fn run(mut self, mut stream: impl Read) {
        let mut chunk = vec![0; 1 << 16];
        while let Ok(length @ 1..) = stream.read(&mut chunk) {
            let before = self.shared.bytes.fetch_add(length, Ordering::Relaxed);
            if before.saturating_add(length) > self.limit || self.line.len().saturating_add(length) > self.limit {
                let _nobody_listens = self.sender.send(Event::Flooded);
                return;
            }
            for piece in chunk.get(..length).unwrap_or_default().split_inclusive(|byte| *byte == b'\n') {
                self.line.extend_from_slice(piece);
                if piece.ends_with(b"\n") && !self.pass() {
                    return;
                }
            }
        }
        let _nobody_listens = self.pass() && self.sender.send(Event::Ended).is_ok();
    }

    /// Passes the gathered line on; false if nobody listens.
    fn pass(&mut self) -> bool {
        let line = std::mem::take(&mut self.line);
        // Some systems write a byte order mark before the first line.
        let text = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&line).trim_ascii();
        if text.is_empty() {
            return true;
        }
        if !text.starts_with(b"{") {
            self.shared.strays().line(text);
            return true;
        }
        self.sender.send(Event::Line(text.to_vec())).is_ok()
    }
}

//! The end of what a subject prints on standard error.

use std::io::Read;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How much is kept.
const KEPT: usize = 4096;

/// The last bytes of a stream, gathered by a thread of its own.
#[derive(Debug)]
pub(super) struct Tail(Arc<Mutex<Gathered>>);

#[derive(Debug, Default)]
struct Gathered {
    bytes: Vec<u8>,
    ended: bool,
}

fn locked(gathered: &Mutex<Gathered>) -> MutexGuard<'_, Gathered> {
    gathered.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Tail {
    /// Starts to read.
    pub(super) fn of(mut stream: impl Read + Send + 'static) -> Self {
        let gathered = Arc::new(Mutex::new(Gathered::default()));
        let shared = Arc::clone(&gathered);
        thread::spawn(move || {
            let mut chunk = [0; KEPT];
            while let Ok(length @ 1..) = stream.read(&mut chunk) {
                let mut gathered = locked(&shared);
                gathered.bytes.extend(chunk.iter().take(length));
                let surplus = gathered.bytes.len().saturating_sub(KEPT);
                gathered.bytes.drain(..surplus);
            }
            locked(&shared).ended = true;
        });
        Self(gathered)
    }

    /// What has been kept, after a short wait for the end of the stream.
    pub(super) fn text(&self) -> String {
        let deadline = Instant::now() + Duration::from_millis(200);
        while !locked(&self.0).ended && Instant::now() < deadline {
            thread::sleep(Duration::from_millis(2));
        }
        String::from_utf8_lossy(&locked(&self.0).bytes).into_owned()
    }
}

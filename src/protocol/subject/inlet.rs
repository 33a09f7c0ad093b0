//! The subject's standard input, written by a thread: a subject that never reads must not block us.

use std::io::Write;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

/// The writing end; dropping it closes the subject's input once what was sent is written.
#[derive(Debug)]
pub(super) struct Inlet(SyncSender<Vec<u8>>);

impl Inlet {
    /// Starts to write. The thread ends when the inlet is dropped or the subject's end of the pipe is closed.
    pub(super) fn into(mut stream: impl Write + Send + 'static) -> Self {
        let (sender, receiver) = sync_channel::<Vec<u8>>(1);
        thread::spawn(move || {
            for line in receiver {
                if stream.write_all(&line).and_then(|()| stream.flush()).is_err() {
                    break;
                }
            }
        });
        Self(sender)
    }

    /// Hands over a line; false if earlier lines were still not read at the deadline.
    pub(super) fn send(&self, line: &str, deadline: Instant) -> bool {
        let mut bytes: Vec<u8> =
            line.bytes().map(|byte| if matches!(byte, b'\n' | b'\r') { b' ' } else { byte }).collect();
        bytes.push(b'\n');
        loop {
            match self.0.try_send(bytes) {
                // A closed input is no failure yet: what the subject says or how it ends will tell.
                Ok(()) | Err(TrySendError::Disconnected(_)) => return true,
                Err(TrySendError::Full(_)) if Instant::now() >= deadline => return false,
                Err(TrySendError::Full(back)) => {
                    bytes = back;
                    thread::sleep(Duration::from_millis(2));
                }
            }
        }
    }
}

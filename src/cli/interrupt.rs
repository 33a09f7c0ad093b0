//! Ctrl-C: the first one asks to stop, the second one ends the program at once.

use std::io::Write as _;
use std::sync::atomic::{AtomicBool, Ordering};

use super::exit::Exit;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Begins to listen. `notice` is said when the first Ctrl-C comes, if stopping may take a while.
///
/// A program that was started to ignore Ctrl-C, as shells start those in the background, goes on ignoring it.
pub(super) fn listen(notice: Option<&'static str>) {
    let heard = move || {
        if REQUESTED.swap(true, Ordering::SeqCst) {
            std::process::exit(Exit::Interrupted as i32);
        }
        if let Some(notice) = notice {
            // Nobody may be listening on standard error.
            let _ = writeln!(std::io::stderr(), "{notice}");
        }
    };
    // Where there can be no handler, Ctrl-C does what it always does.
    let _ = ctrlc::try_set_handler(heard);
}

/// Whether it has come.
pub(super) fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

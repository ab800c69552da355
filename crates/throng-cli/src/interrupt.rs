//! Ctrl-C and the signals that ask a program to end.

use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Installs a handler: the first Ctrl-C makes [`asked`] return true, the second ends the program at once.
pub fn watch() {
    // If the handler cannot be installed, the first Ctrl-C ends the program at once.
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::SeqCst) {
            std::process::exit(130);
        }
    });
}

/// Whether an end of the run was requested.
pub fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

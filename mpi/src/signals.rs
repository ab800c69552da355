//! Signals that ask a run to end.

use crate::failure::Failure;
use signal_hook::consts::{SIGINT, SIGTERM, SIGUSR1};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether a signal has asked the run to end.
#[derive(Default)]
pub struct Signals(Arc<AtomicBool>);

impl Signals {
    /// Watches for Ctrl-C, SIGTERM and SIGUSR1. The second of them ends the program at once.
    ///
    /// # Errors
    /// The system refuses.
    pub fn watch() -> Result<Self, Failure> {
        let asked = Self::default();
        for signal in [SIGINT, SIGTERM, SIGUSR1] {
            let end = signal_hook::flag::register_conditional_shutdown(signal, 130, asked.0.clone());
            let begin = end.and_then(|_| signal_hook::flag::register(signal, asked.0.clone()));
            begin.map_err(|error| Failure::Here(format!("cannot watch for signals: {error}")))?;
        }
        Ok(asked)
    }

    /// Whether the run is to end.
    pub fn asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

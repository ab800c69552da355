//! Standard output and standard error.

use crate::failure::Failure;
use std::fmt::Arguments;
use std::io::{self, BufWriter, ErrorKind, Stdout, Write};

/// Standard output. A reader that has gone (`throng list | head -1`) ends the command quietly.
pub struct Out {
    stdout: BufWriter<Stdout>,
}

impl Out {
    /// Standard output.
    pub fn new() -> Self {
        Self { stdout: BufWriter::new(io::stdout()) }
    }

    /// Writes a line. Used as `out.line(format_args!(...))`.
    ///
    /// # Errors
    /// The reader has gone, or what standard output was sent to cannot be written.
    pub fn line(&mut self, text: Arguments) -> Result<(), Failure> {
        writeln!(self.stdout, "{text}").map_err(|error| failure(&error))
    }

    /// Writes text as it is.
    ///
    /// # Errors
    /// Those of [`line`](Self::line).
    pub fn text(&mut self, text: &[u8]) -> Result<(), Failure> {
        self.stdout.write_all(text).map_err(|error| failure(&error))
    }

    /// Hands on everything written so far.
    ///
    /// # Errors
    /// Those of [`line`](Self::line).
    pub fn flush(&mut self) -> Result<(), Failure> {
        self.stdout.flush().map_err(|error| failure(&error))
    }
}

fn failure(error: &io::Error) -> Failure {
    match error.kind() {
        ErrorKind::BrokenPipe => Failure::ClosedPipe,
        ErrorKind::StorageFull => Failure::Error("cannot write to standard output: the disk is full".into()),
        _ => Failure::Error(format!("cannot write to standard output: {error}")),
    }
}

/// Writes a line to standard error. If that cannot be done there is nobody to tell.
pub fn complain(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// Says to standard error what was left out of a file, or changed.
pub fn note<'n>(notes: impl IntoIterator<Item = &'n String>) {
    notes.into_iter().for_each(|note| complain(&format!("note: {note}")));
}

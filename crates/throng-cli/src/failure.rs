//! Failures of commands and their exit codes.

use throng_record::{ChoiceError, OutputError, TrajectoriesError};

/// A reason why a command failed.
#[derive(Debug)]
pub enum Failure {
    /// An error in the input, or a file that cannot be written. The text says what is wrong and how to fix it.
    Error(String),
    /// The scene did not meet its `[expect]`. The report has already said so.
    Expectation,
    /// The run was interrupted; its files are finished.
    Interrupted,
    /// The reader of standard output closed the pipe.
    ClosedPipe,
}

impl Failure {
    /// Creates an error with a hint on a separate line.
    pub fn hint(text: impl std::fmt::Display, hint: impl std::fmt::Display) -> Self {
        Self::Error(format!("{text}\n  hint: {hint}"))
    }

    /// Returns the exit code: 0 for a closed pipe, 1 for a failed expectation, 2 for errors, 130 for an interrupt.
    pub fn code(&self) -> u8 {
        match self {
            Self::Error(_) => 2,
            Self::Expectation => 1,
            Self::Interrupted => 130,
            Self::ClosedPipe => 0,
        }
    }

    /// Returns the message for the user, if there is one.
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Error(text) => Some(text),
            _ => None,
        }
    }
}

macro_rules! errors {
    ($($type:ty),*) => {
        $(impl From<$type> for Failure {
            fn from(error: $type) -> Self {
                Self::Error(error.to_string())
            }
        })*
    };
}

errors!(throng_scene::Error, throng_draw::Error, OutputError, TrajectoriesError, ChoiceError);

//! Why a command did not succeed, and the exit code that says so.

use throng_record::{ChoiceError, OutputError, TracksError};

/// Why a command did not succeed.
#[derive(Debug)]
pub enum Failure {
    /// Something is wrong with what the user gave, or a file cannot be written: the text says what, and how to mend
    /// it.
    Error(String),
    /// The scene ran, and did not show what its `[expect]` says. The report has said so already.
    Expectation,
    /// The run was interrupted; its files are finished.
    Interrupted,
    /// Whoever read our output has gone: nobody is left to tell.
    ClosedPipe,
}

impl Failure {
    /// An error with a hint on a line of its own.
    pub fn hint(text: impl std::fmt::Display, hint: impl std::fmt::Display) -> Self {
        Self::Error(format!("{text}\n  hint: {hint}"))
    }

    /// The exit code: 0 for a closed pipe, 1 for a failed expectation, 2 for errors, 130 for an interrupt.
    pub fn code(&self) -> u8 {
        match self {
            Self::Error(_) => 2,
            Self::Expectation => 1,
            Self::Interrupted => 130,
            Self::ClosedPipe => 0,
        }
    }

    /// What to tell the user, if there is something left to tell.
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

errors!(throng_scene::Error, throng_draw::Error, OutputError, TracksError, ChoiceError);

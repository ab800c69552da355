//! Failures, and how all ranks learn of them.

use crate::ranks::Ranks;
use std::fmt::Display;

/// A reason why a run ends early.
#[derive(Debug)]
pub enum Failure {
    /// An error on this rank. The text says what is wrong and how to fix it.
    Here(String),
    /// An error on another rank, which reports it.
    Elsewhere,
    /// The run was asked to end; its files are complete, and it can be resumed.
    Interrupted,
}

impl Failure {
    /// Creates an error with a hint on a separate line.
    pub fn hint(text: impl Display, hint: impl Display) -> Self {
        Self::Here(format!("{text}\n  hint: {hint}"))
    }

    /// Returns the exit code of the program.
    pub fn code(&self) -> u8 {
        match self {
            Self::Here(_) | Self::Elsewhere => 2,
            Self::Interrupted => 130,
        }
    }
}

/// Errors of other crates, which say what is wrong and where.
macro_rules! errors {
    ($($type:ty),*) => {
        $(impl From<$type> for Failure {
            fn from(error: $type) -> Self {
                Self::Here(error.to_string())
            }
        })*
    };
}

errors!(throng::Error, throng_scene::Error, throng_record::OutputError);

/// Returns an error on all ranks if there is one on any rank. All ranks must call it.
///
/// # Errors
/// The own error, or [`Failure::Elsewhere`].
pub fn together<T>(ranks: &Ranks, own: Result<T, Failure>) -> Result<T, Failure> {
    let [failed] = ranks.any([own.is_err()]);
    let own = own?;
    if failed { Err(Failure::Elsewhere) } else { Ok(own) }
}

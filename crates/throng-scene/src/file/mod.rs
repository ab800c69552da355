//! Scene files: TOML in and out, and where in a file a value came from.

mod about;
mod document;
mod path;
mod read;
mod serde_message;
mod set;
mod value;

pub use document::Origin;
pub(crate) use path::{Path, Problem};
pub(crate) use read::{missing, read_text};
pub(crate) use serde_message::{explain, keys_of, nearest, unknown_key, value_of};
pub(crate) use set::quoted;

//! Scene files: reads and writes TOML, and finds the position of a value in a file.

mod about;
mod check_about;
mod document;
mod path;
mod presets;
mod read;
mod serde_message;
mod set;
mod toml_file;
mod value;

pub use document::Origin;
pub use path::TomlStep;
pub(crate) use path::{Path, Problem};
pub(crate) use read::{LARGEST, missing, read_bytes, read_text, too_large};
pub(crate) use serde_message::{explain, nearest, unknown_key, unknown_variant};
pub(crate) use set::quoted;
pub use toml_file::TomlFile;
pub(crate) use value::Value as FileValue;

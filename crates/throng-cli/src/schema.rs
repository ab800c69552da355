//! `throng schema`: the JSON schema of scene files.

use crate::failure::Failure;
use crate::out::Out;

/// Writes the schema to standard output.
///
/// # Errors
/// Standard output cannot be written.
pub fn schema(out: &mut Out) -> Result<(), Failure> {
    out.line(format_args!("{:#}", throng_scene::schema()))
}

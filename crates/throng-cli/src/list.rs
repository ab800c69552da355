//! `throng list`: the scenes of the gallery.

use crate::args::ListArgs;
use crate::failure::Failure;
use crate::out::Out;
use throng_scene::gallery;

/// Writes the names and titles of all scenes, group by group, to standard output.
///
/// # Errors
/// Standard output cannot be written.
pub fn list(args: &ListArgs, out: &mut Out) -> Result<(), Failure> {
    let widest = gallery::names().map(str::len).max().unwrap_or(0);
    for (group, names) in gallery::groups() {
        if !args.names {
            out.line(format_args!("{group}"))?;
        }
        for name in names {
            let title = gallery::title(name).unwrap_or_default();
            match args.names {
                true => out.line(format_args!("{name}"))?,
                false => out.line(format_args!("  {name:widest$}  {title}"))?,
            }
        }
    }
    Ok(())
}

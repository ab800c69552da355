//! Menge's projects: a scene (`*S.xml`: who is there, and what is solid), a behaviour (`*B.xml`: a state machine of where they go), and
//! the files these name.
//!
//! Mapped: profiles and who inherits them, generators, obstacles, navigation meshes that are the ground, goals, and the way through
//! the states as a journey. Road maps and navigation meshes for finding ways are not needed; a vector field governs its group. What
//! states do beyond that is said in the notes. `docs/import.md` lists it.

mod convert;
mod files;
mod lattice;
mod machine;
mod nav;
mod people;
mod profile;
mod route;
mod solids;
mod xml;

use super::Imported;
use crate::error::Error;
use std::path::Path;

pub(super) use files::is_project;

/// Reads a project: its file (`<Project>`), its scene, its behaviour, or the folder of both.
///
/// # Errors
/// With file, line and column: a part is missing or is not what Menge takes.
pub fn load(path: impl AsRef<Path>) -> Result<Imported, Error> {
    convert::convert(&files::find(path.as_ref())?)
}

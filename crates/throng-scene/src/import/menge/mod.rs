//! Menge projects: a scene (`*S.xml`: agents and obstacles), a behaviour (`*B.xml`: a state machine of goals), and the
//! files that these name.
//!
//! Imported: profiles and their inheritance, generators, obstacles, navigation meshes that are the ground, goals, and
//! the sequence of states as a journey. Road maps and navigation meshes for path planning are not needed; a vector
//! field guides its group. Notes name everything else that states do. `docs/import.md` lists it.

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
/// A part is missing or is not valid in Menge. The error has file, line and column.
pub fn load(path: impl AsRef<Path>) -> Result<Imported, Error> {
    convert::convert(&files::find(path.as_ref())?)
}

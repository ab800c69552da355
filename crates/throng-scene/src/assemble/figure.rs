//! The files with the bodies of groups.

use crate::error::{Error, Kind};
use crate::file::{Path, Problem, read_bytes};
use crate::scene::Scene;

impl Scene {
    /// Returns the bytes of the file with the body of a group ([`Group::figure`](crate::Group::figure)); `None` if the group, by
    /// its position in the scene, has none.
    ///
    /// # Errors
    /// The file does not exist, cannot be read, or is larger than 64 MB.
    pub fn figure(&self, group: usize) -> Result<Option<Vec<u8>>, Error> {
        let Some(name) = self.groups.get(group).and_then(|group| group.figure.as_ref()) else { return Ok(None) };
        let bytes = read_bytes(&self.origin.folder.join(name));
        bytes.map(Some).map_err(|error| self.wrong_figure(group, &error.message, error.hint.as_deref()))
    }

    /// Returns the error of a group with a body that cannot be used, with the position of its key `figure`.
    pub fn wrong_figure(&self, group: usize, why: &str, hint: Option<&str>) -> Error {
        let path = Path::of("group").index(group).key("figure");
        let problem = Problem::new(&path, Kind::File, why);
        self.explain(match hint {
            Some(hint) => problem.hint(hint),
            None => problem,
        })
    }
}

//! The files with the bodies of groups, and with the set of pictures.

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
        self.wrong_file(&Path::of("group").index(group).key("figure"), why, hint)
    }

    /// Returns the bytes of the file with the set of pictures ([`View::set`](crate::View::set)); `None` if there is no set.
    ///
    /// # Errors
    /// The file does not exist, cannot be read, or is larger than 64 MB.
    pub fn stage_set(&self) -> Result<Option<Vec<u8>>, Error> {
        let Some(set) = &self.view.set else { return Ok(None) };
        let bytes = read_bytes(&self.origin.folder.join(&set.file));
        bytes.map(Some).map_err(|error| self.wrong_set(&error.message, error.hint.as_deref()))
    }

    /// Returns the error of a set that cannot be used, with the position of its key `file`.
    pub fn wrong_set(&self, why: &str, hint: Option<&str>) -> Error {
        self.wrong_file(&Path::of("view").key("set").key("file"), why, hint)
    }

    fn wrong_file(&self, path: &Path, why: &str, hint: Option<&str>) -> Error {
        let problem = Problem::new(path, Kind::File, why);
        self.explain(match hint {
            Some(hint) => problem.hint(hint),
            None => problem,
        })
    }
}

//! TOML files other than scenes.

use super::document::Document;
use super::path::{Path, Problem, TomlStep};
use super::read::read_text;
use crate::error::{Error, Kind};
use serde::Deserialize;
use std::path::Path as FilePath;

/// A TOML file that is not a scene, such as a plan of runs. Its errors are those of scene files: file, line and column,
/// the mistake, and how to fix it.
///
/// ```
/// use throng_scene::{Kind, TomlFile};
///
/// #[derive(serde::Deserialize)]
/// #[serde(deny_unknown_fields)]
/// struct Plan {
///     limit: f64,
/// }
/// let file = TomlFile::new("plan.toml", "limit = 5");
/// assert_eq!(file.read::<Plan>()?.limit, 5.0);
/// let error = file.error(Kind::OutOfRange, ["limit"], "5 s are too short", "write at least 10");
/// assert!(error.to_string().starts_with("plan.toml:1:9: 5 s are too short"));
/// let wrong = TomlFile::new("plan.toml", "limti = 5").read::<Plan>().err().expect("there is no such key");
/// assert!(wrong.to_string().contains("did you mean `limit`?"));
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct TomlFile {
    document: Document,
}

impl TomlFile {
    /// Returns a text as a file; errors use `name` as the file name.
    pub fn new(name: &str, text: impl Into<String>) -> Self {
        Self { document: Document::new(Some(name.to_owned()), text.into()) }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// The file does not exist, cannot be read, or is not text.
    pub fn open(path: impl AsRef<FilePath>) -> Result<Self, Error> {
        let path = path.as_ref();
        Ok(Self::new(&path.display().to_string(), read_text(path)?))
    }

    /// Returns the contents.
    ///
    /// # Errors
    /// The text is not TOML, or has keys or values that the type does not have.
    pub fn read<T: for<'de> Deserialize<'de>>(&self) -> Result<T, Error> {
        self.document.read()
    }

    /// Returns an error about the value at a path, with the position of the value, or of the nearest enclosing value; for
    /// a key that does not exist, with that of the key.
    pub fn error<S: Into<TomlStep>>(
        &self,
        kind: Kind,
        path: impl IntoIterator<Item = S>,
        message: impl Into<String>,
        hint: impl Into<Box<str>>,
    ) -> Error {
        let path = Path { steps: path.into_iter().map(Into::into).collect() };
        let is_key = kind == Kind::UnknownKey && matches!(path.steps.last(), Some(TomlStep::Key(_)));
        self.document.explain(Problem { is_key, ..Problem::new(&path, kind, message).hint(hint) })
    }
}

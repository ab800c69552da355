//! Reading and writing scene files.

use super::document::Document;
use super::path;
use crate::error::{Error, Kind};
use crate::scene::Scene;
use std::io::{ErrorKind, Read};
use std::path::Path;
use std::str::FromStr;
use std::sync::Arc;

impl Scene {
    /// Reads a scene file.
    ///
    /// # Errors
    /// The file cannot be read, is not TOML, or has keys or values that scenes do not have. The error has file, line,
    /// column and a hint. So are sliders and presets that do not fit the scene. [`Scene::plan`] and [`Scene::build`] check whether the values fit together, and what the scene
    /// says of behaviours, fields and models of plug-ins.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = text(path, read_at_most(path, LARGEST_SCENE)?)?;
        let mut scene = Self::parse(&path.display().to_string(), text)?;
        scene.check_about()?;
        scene.origin.folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Ok(scene)
    }

    /// Reads the text of a scene file. Errors use `name` as the file name.
    ///
    /// # Errors
    /// As for [`Scene::load`].
    pub fn parse(name: &str, text: impl Into<String>) -> Result<Self, Error> {
        let document = Document::new(Some(name.to_owned()), text.into());
        let mut scene: Self = document.read()?;
        scene.origin.document = Some(Arc::new(document));
        scene.check_keys()?;
        Ok(scene)
    }

    /// Checks that what the scene chooses from the registry has the given parameters, as far as it is known.
    pub(super) fn check_keys(&self) -> Result<(), Error> {
        let known = &self.plugins;
        for (i, group) in self.groups.iter().enumerate() {
            let at = |key: &str| path::Path::of("group").index(i).key(key);
            let place = known.placements.check_keys(&group.place, &at("place"));
            let goal = group.goal.as_ref().map_or(Ok(()), |goal| known.goals.check_keys(goal, &at("goal")));
            let avoid = group.avoid.as_ref().map_or(Ok(()), |avoid| known.models.check_keys(avoid, &at("avoid")));
            let vehicle = group.vehicle.as_ref().map_or(Ok(()), |vehicle| vehicle.check_keys(&at("vehicle")));
            place.and(goal).and(avoid).and(vehicle).map_err(|problem| self.explain(problem))?;
        }
        Ok(())
    }

    /// Returns the text of a scene file. Reading it gives the same scene.
    ///
    /// # Errors
    /// The seed is too large for TOML.
    pub fn to_toml(&self) -> Result<String, Error> {
        toml::to_string(self).map_err(|error| {
            Error::new(Kind::OutOfRange, format!("this scene cannot be written as TOML: {error}"))
                .hint("a TOML file holds whole numbers up to 9223372036854775807")
        })
    }
}

impl FromStr for Scene {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Self::parse("scene", text)
    }
}

/// Maximum size of a floor plan, a picture or a scenario, bytes.
pub(crate) const LARGEST: u64 = 64 << 20;
/// Maximum size of a scene file, bytes: the parsed values take up to a hundred times as much memory.
const LARGEST_SCENE: u64 = 16 << 20;

/// Returns the error for a file with more bytes than `most`.
pub(crate) fn too_large(name: &str, most: u64) -> Error {
    Error::new(Kind::File, format!("{name} is larger than {} MB", most >> 20))
        .hint("leave out what the scene does not need, and say many agents of one kind by `count`")
}

/// Reads the bytes of a file.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, Error> {
    read_at_most(path, LARGEST)
}

fn read_at_most(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    let mut bytes = vec![];
    let file = std::fs::File::open(path).map_err(|error| missing(path, &error))?;
    file.take(most + 1).read_to_end(&mut bytes).map_err(|error| missing(path, &error))?;
    if bytes.len() as u64 > most { Err(too_large(&path.display().to_string(), most)) } else { Ok(bytes) }
}

/// Reads the text of a file.
pub(crate) fn read_text(path: &Path) -> Result<String, Error> {
    text(path, read_bytes(path)?)
}

/// Converts the bytes of a file to text.
fn text(path: &Path, bytes: Vec<u8>) -> Result<String, Error> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").map(<[u8]>::to_vec).unwrap_or(bytes);
    String::from_utf8(bytes).map_err(|_| {
        Error::new(Kind::Syntax, format!("{} is not a text file", path.display()))
            .hint("scene files and floor plans are UTF-8 text")
    })
}

/// Returns the error for a file that cannot be read, with the names of similar files in its folder.
pub(crate) fn missing(path: &Path, error: &std::io::Error) -> Error {
    let shown = path.display();
    if error.kind() != ErrorKind::NotFound {
        return Error::new(Kind::File, format!("{shown} cannot be read: {error}"));
    }
    let out = Error::new(Kind::File, format!("there is no file {shown}"));
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return out.hint(format!("there is no folder {} either", folder.display()));
    }
    let extension = path.extension();
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .filter(|entry| Path::new(&entry.file_name()).extension() == extension)
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let wrong = path.file_name().unwrap_or_default().to_string_lossy();
    match super::serde_message::nearest(&wrong, &names) {
        Some(near) => out.hint(format!("did you mean {}?", folder.join(near).display())),
        None => out.hint("check the name, and the folder it is looked for in"),
    }
}

//! Seed inputs: the files of `corpus/TARGET`, and files elsewhere in the repository.

use crate::Target;
use std::path::{Path, PathBuf};

/// The folder of this crate.
const CRATE: &str = env!("CARGO_MANIFEST_DIR");

/// A seed input.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The name of its file.
    pub name: String,
    /// The content.
    pub bytes: Vec<u8>,
}

/// Returns the seed inputs of a target, by file name: first those of `corpus/TARGET`, then those elsewhere in the
/// repository.
///
/// # Errors
/// A folder or file cannot be read, or there are no files.
pub fn of(target: &Target) -> Result<Vec<Sample>, String> {
    let mut paths = files(&folder(target), None)?;
    for (place, ending) in target.elsewhere {
        paths.extend(files(&Path::new(CRATE).join(place), Some(ending))?);
    }
    let mut samples = Vec::new();
    for path in paths {
        let bytes = std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        samples.push(Sample { name: path.file_name().unwrap_or_default().to_string_lossy().into_owned(), bytes });
    }
    if samples.is_empty() {
        return Err(format!("{} has no files to start from", folder(target).display()));
    }
    Ok(samples)
}

/// Returns the folder of a target's files.
pub fn folder(target: &Target) -> PathBuf {
    Path::new(CRATE).join("corpus").join(target.name)
}

/// Returns the files of a folder, by name; none if the folder does not exist.
fn files(folder: &Path, ending: Option<&str>) -> Result<Vec<PathBuf>, String> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let entries = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.is_file() && ending.is_none_or(|ending| path.extension().is_some_and(|e| e == ending)));
    paths.sort();
    Ok(paths)
}

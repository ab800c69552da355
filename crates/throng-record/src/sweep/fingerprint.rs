//! Fingerprints of all that the result of a run depends on.

use super::SweepRun;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use throng_scene::{About, Scene};

/// The fingerprint of all that the result of a run depends on: the version of throng, the scene with its parameters, its
/// seed and its limit, the contents of the files that the scene names, and what is recorded. The numbering of the plan
/// is no part of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fingerprint(u128);

/// The fingerprints of files that were read.
#[derive(Debug, Default)]
pub struct FileFingerprints(Mutex<BTreeMap<PathBuf, Option<u128>>>);

impl Fingerprint {
    /// Returns the fingerprint of a run; `files` remembers files that were read before.
    pub fn of(run: &SweepRun, files: &FileFingerprints) -> Self {
        let mut hash = Hash::default();
        hash.part(env!("CARGO_PKG_VERSION").as_bytes());
        hash.part(format!("{:?}", run.plan.recorded.file).as_bytes());
        let scene = run.scene().map(|scene| Scene { about: About::default(), ..scene });
        match scene.and_then(|scene| Ok((scene.to_toml()?, scene))) {
            Ok((text, scene)) => {
                hash.part(text.as_bytes());
                for (name, file) in files.of(&scene) {
                    hash.part(name.as_bytes());
                    hash.part(&file.to_le_bytes());
                }
            }
            // such a run cannot be made: its result is the error
            Err(error) => hash.part(error.to_string().as_bytes()),
        }
        Self(hash.0)
    }
}

impl fmt::Display for Fingerprint {
    /// Writes 32 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl FileFingerprints {
    /// Returns the files that a scene names, with their fingerprints. Any text of the scene that is the name of a file in
    /// the scene's folder counts, whatever its key is: so parameters of plug-ins count too.
    fn of(&self, scene: &Scene) -> Vec<(String, u128)> {
        let mut names = Vec::new();
        if let Ok(value) = serde_json::to_value(scene) {
            texts(&value, &mut names);
        }
        names.sort();
        names.dedup();
        let folder = &scene.origin.folder;
        names
            .into_iter()
            .filter_map(|name| Some((self.file(&folder.join(&name))?, name)))
            .map(|(file, name)| (name, file))
            .collect()
    }

    /// Returns the fingerprint of a file; `None` if there is no such file.
    fn file(&self, path: &Path) -> Option<u128> {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner).get(path).copied();
        known.unwrap_or_else(|| {
            let file = path.is_file().then(|| std::fs::read(path).ok()).flatten();
            let file = file.map(|bytes| {
                let mut hash = Hash::default();
                hash.part(&bytes);
                hash.0
            });
            self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(path.to_path_buf(), file);
            file
        })
    }
}

/// Collects all texts in a value.
fn texts(value: &Value, to: &mut Vec<String>) {
    match value {
        Value::String(text) if !text.is_empty() => to.push(text.clone()),
        Value::Array(items) => items.iter().for_each(|item| texts(item, to)),
        Value::Object(entries) => entries.values().for_each(|entry| texts(entry, to)),
        _ => {}
    }
}

/// FNV-1a with 128 bits, of parts that are each preceded by their length.
struct Hash(u128);

impl Default for Hash {
    fn default() -> Self {
        Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Hash {
    fn part(&mut self, bytes: &[u8]) {
        let length = (bytes.len() as u64).to_le_bytes();
        for &byte in length.iter().chain(bytes) {
            self.0 = (self.0 ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b);
        }
    }
}

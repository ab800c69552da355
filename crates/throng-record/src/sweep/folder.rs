//! The folder of finished runs.

use super::{Fingerprint, Row, SweepRun};
use crate::{Cell, Output, OutputError};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A folder that keeps the results of finished runs, a file each, so that a sweep can be continued. A file has the name
/// of its [`Fingerprint`], and appears complete or not at all: any number of processes can share a folder.
///
/// ```
/// use throng_record::sweep::{FileFingerprints, Fingerprint, Plan, RunFolder, run_one};
/// let place = tempfile::tempdir()?;
/// let plan = Plan::parse("plan.toml", "scenes = 'headon'", "", &throng_scene::Plugins::new())?;
/// let run = plan.run(0).expect("a plan has at least one run");
/// let fingerprint = Fingerprint::of(&run, &FileFingerprints::default());
/// let folder = RunFolder::create(place.path().join("runs"))?;
/// assert_eq!(folder.row(&run, fingerprint), None);
/// let row = run_one(&run, || true).expect("it is not interrupted");
/// folder.keep(&row, fingerprint)?;
/// assert_eq!(folder.row(&run, fingerprint), Some(row));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct RunFolder {
    path: PathBuf,
}

/// The contents of a file.
#[derive(Serialize, Deserialize)]
struct KeptRun {
    fingerprint: String,
    results: Vec<(String, Cell)>,
}

impl RunFolder {
    /// Returns the folder with this path, and creates it if it does not exist.
    ///
    /// # Errors
    /// The folder cannot be created.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, OutputError> {
        let path = path.as_ref();
        std::fs::create_dir_all(path).map_err(|source| OutputError::new(path, source))?;
        let folder = Self { path: path.to_path_buf() };
        Output::remove_leftovers(folder.path.join("any"));
        Ok(folder)
    }

    /// Returns the folder with this path, which need not exist.
    pub fn at(path: impl AsRef<Path>) -> Self {
        Self { path: path.as_ref().to_path_buf() }
    }

    /// Returns the path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the row of a run, if its result is kept. A damaged file counts as none.
    pub fn row(&self, run: &SweepRun, fingerprint: Fingerprint) -> Option<Row> {
        let text = std::fs::read(self.file(fingerprint)).ok()?;
        let kept: KeptRun = serde_json::from_slice(&text).ok()?;
        (kept.fingerprint == fingerprint.to_string()).then(|| Row::of(run, kept.results))
    }

    /// Keeps the result of a run.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn keep(&self, row: &Row, fingerprint: Fingerprint) -> Result<(), OutputError> {
        let path = self.file(fingerprint);
        let kept = KeptRun { fingerprint: fingerprint.to_string(), results: row.results.clone() };
        let text = serde_json::to_string(&kept).map_err(|error| OutputError::new(&path, error.into()))?;
        let mut output = Output::create(&path)?;
        output.put(text.as_bytes())?;
        output.finish()
    }

    fn file(&self, fingerprint: Fingerprint) -> PathBuf {
        self.path.join(format!("{fingerprint}.json"))
    }
}

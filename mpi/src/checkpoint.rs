//! Checkpoints: the state of each rank, and a manifest that is written last.

use crate::failure::{Failure, together};
use crate::ranks::Ranks;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use throng_record::Output;

/// The manifest of the last complete checkpoint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// The version of the program.
    pub version: String,
    /// The hash of the scene and of the options that change it.
    pub scene: String,
    /// Steps made.
    pub steps: u64,
    /// The number of states, one of each rank.
    pub ranks: usize,
    /// The folder of the states, beside the manifest.
    pub folder: String,
}

const NAME: &str = "checkpoint.json";

impl Manifest {
    /// Reads the manifest of a run.
    ///
    /// # Errors
    /// There is none, it is damaged, or it belongs to another scene or another version.
    pub fn read(run: &Path, version: &str, scene: &str) -> Result<Self, Failure> {
        let path = run.join(NAME);
        let shown = path.display();
        let text = fs::read(&path).map_err(|error| {
            Failure::hint(
                format!("cannot read {shown}: {error}"),
                "start the run without --resume: there is no checkpoint",
            )
        })?;
        let manifest: Self = serde_json::from_slice(&text).map_err(|error| {
            Failure::hint(format!("{shown} is no manifest of a checkpoint: {error}"), "start the run without --resume")
        })?;
        if manifest.version != version {
            let text = format!("{shown} is of version {}, this program is {version}", manifest.version);
            return Err(Failure::hint(text, "resume with the program that wrote it"));
        }
        if manifest.scene != scene {
            let text = format!("{shown} is a checkpoint of another scene, or of other people or options");
            return Err(Failure::hint(text, "give the scene, --people and --set of the run"));
        }
        Ok(manifest)
    }

    /// Returns the file of the state of a rank.
    fn state(&self, run: &Path, rank: usize) -> PathBuf {
        run.join(&self.folder).join(format!("state-{rank:05}"))
    }

    /// Reads the state of a rank.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read_state(&self, run: &Path, rank: usize) -> Result<Vec<u8>, Failure> {
        let path = self.state(run, rank);
        fs::read(&path).map_err(|error| {
            let text = format!("cannot read the state of rank {rank}, {}: {error}", path.display());
            Failure::hint(
                text,
                format!("the checkpoint needs the files of all {} ranks: copy them to one folder", self.ranks),
            )
        })
    }

    /// Writes a checkpoint: the states of all ranks, then the manifest, then removes the checkpoint before. All ranks
    /// must call it.
    ///
    /// # Errors
    /// A file cannot be written on any rank. The checkpoint before stays.
    pub fn write(self, run: &Path, ranks: &Ranks, state: &[u8], before: Option<&Self>) -> Result<Self, Failure> {
        let folder = run.join(&self.folder);
        let write = || {
            fs::create_dir_all(&folder)
                .map_err(|error| Failure::Here(format!("cannot make the folder {}: {error}", folder.display())))?;
            written(&self.state(run, ranks.rank()), state)
        };
        together(ranks, write())?;
        let manifest = || {
            let text = serde_json::to_string_pretty(&self).unwrap_or_default();
            written(&run.join(NAME), text.as_bytes())
        };
        together(ranks, if ranks.is_first() { manifest() } else { Ok(()) })?;
        if let Some(before) = before.filter(|before| ranks.is_first() && before.folder != self.folder) {
            // a checkpoint that stays takes room, and nothing else
            let _ = fs::remove_dir_all(run.join(&before.folder));
        }
        Ok(self)
    }
}

/// Writes a file that appears under its name only when it is complete.
fn written(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let mut output = Output::create(path)?;
    let failed = |error| throng_record::OutputError::new(path, error);
    output.write_all(bytes).map_err(failed)?;
    Ok(output.finish()?)
}

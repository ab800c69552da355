//! What a sweep reports.

use crate::failure::Failure;
use crate::out::Out;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The number of failed runs that are written out.
const SHOWN: usize = 5;

/// The report of a sweep.
pub struct SweepReport<'a> {
    /// The plan.
    pub plan: &'a Path,
    /// The number of runs of the plan.
    pub runs: usize,
    /// The number of runs that were to be finished.
    pub chosen: usize,
    /// The number of runs made now.
    pub made: usize,
    /// The number of runs that were kept before.
    pub kept: usize,
    /// The numbers of the runs that could not be made, and why.
    pub failed: Vec<(usize, String)>,
    /// The folder of finished runs.
    pub folder: &'a Path,
    /// The tables written.
    pub files: Vec<PathBuf>,
    /// Whether the sweep was interrupted.
    pub interrupted: bool,
}

impl SweepReport<'_> {
    /// Returns the report as one JSON object. `throng sweep --help` describes its keys.
    pub fn json(&self, wall: Duration) -> Value {
        let failed = self.failed.iter().map(|(index, error)| json!({ "index": index, "error": error }));
        json!({
            "plan": self.plan.to_string_lossy(),
            "runs": self.runs,
            "chosen": self.chosen,
            "made": self.made,
            "kept": self.kept,
            "failed": failed.collect::<Vec<_>>(),
            "folder": self.folder.to_string_lossy(),
            "files": self.files.iter().map(|path| path.to_string_lossy()).collect::<Vec<_>>(),
            "wall_seconds": wall.as_secs_f64(),
            "interrupted": self.interrupted,
        })
    }

    /// Writes the report as text.
    ///
    /// # Errors
    /// Standard output cannot be written.
    pub fn print(&self, out: &mut Out) -> Result<(), Failure> {
        let Self { runs, chosen, made, kept, .. } = self;
        let of = if chosen == runs { String::new() } else { format!("{chosen} of ") };
        out.line(format_args!("{}: {of}{runs} runs; {made} made now, {kept} kept before", self.plan.display()))?;
        for (index, error) in self.failed.iter().take(SHOWN) {
            // the whole error is in the table
            let error = error.lines().next().unwrap_or_default();
            out.line(format_args!("  run {index} could not be made: {error}"))?;
        }
        if self.failed.len() > SHOWN {
            out.line(format_args!(
                "  and {} more could not be made; the column `error` says why",
                self.failed.len() - SHOWN
            ))?;
        }
        self.files.iter().try_for_each(|path| out.line(format_args!("wrote {}", path.display())))
    }

    /// Returns the message of an interrupted sweep.
    pub fn how_to_go_on(&self) -> String {
        let (done, folder) = (self.made + self.kept, self.folder.display());
        format!(
            "interrupted; {done} of {} runs are finished and kept in {folder}: the same command makes the rest",
            self.chosen
        )
    }
}

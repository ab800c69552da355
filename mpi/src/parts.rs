//! The trajectory files of a rank: a file for each time between two checkpoints.

use crate::args::Kind;
use crate::failure::Failure;
use std::fs;
use std::path::{Path, PathBuf};
use throng::World;
use throng_record::{Choice, Format, Frame, Setting, Writer, moment};

/// Writes the moments of a rank. A checkpoint completes the file and begins another, so that the files before a checkpoint
/// stay as they are if the run ends after it.
pub struct Parts {
    folder: PathBuf,
    rank: usize,
    kind: Kind,
    setting: Setting,
    /// Steps between two moments.
    every: u64,
    writer: Option<Box<dyn Writer>>,
    frame: Frame,
}

impl Parts {
    /// Returns the files of a rank; none are written if `every` is 0.
    pub fn new(folder: &Path, rank: usize, kind: Kind, setting: Setting, every: u64) -> Self {
        Self { folder: folder.into(), rank, kind, setting, every, writer: None, frame: Frame::default() }
    }

    /// Removes the files that begin after the checkpoint at a step, and what a killed process has left of them: a run that
    /// goes on from there writes them again. Without a checkpoint, removes the files of a run before.
    ///
    /// # Errors
    /// A file cannot be removed.
    pub fn remove_after(folder: &Path, checkpoint: Option<u64>) -> Result<(), Failure> {
        let names = fs::read_dir(folder).map_err(|error| unread(folder, &error))?;
        for path in names.filter_map(|entry| Some(entry.ok()?.path())) {
            let begins = path.file_name().and_then(|name| name.to_str()).and_then(first_step);
            if begins.is_some_and(|begins| checkpoint.is_none_or(|step| begins > step)) {
                fs::remove_file(&path)
                    .map_err(|error| Failure::Here(format!("cannot remove {}: {error}", path.display())))?;
            }
        }
        Ok(())
    }

    /// Writes the moment after a step, if it is due.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn push(&mut self, world: &World) -> Result<(), Failure> {
        if self.every == 0 || !world.steps().is_multiple_of(self.every) {
            return Ok(());
        }
        if self.writer.is_none() {
            self.writer = Some(self.begin(world.steps())?);
        }
        moment::capture(world, &mut self.frame);
        self.writer.as_mut().map_or(Ok(()), |writer| writer.push(&self.frame)).map_err(Failure::from)
    }

    /// Completes the current file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn complete(&mut self) -> Result<(), Failure> {
        self.writer.take().map_or(Ok(()), Writer::finish).map_err(Failure::from)
    }

    fn begin(&self, step: u64) -> Result<Box<dyn Writer>, Failure> {
        let path = self.folder.join(format!("part-{step:010}-{:05}.{}", self.rank, self.kind.ending()));
        let format = Format::of(&path).expect("both formats are known");
        let output = format.output(&path)?;
        let created = Choice::default().create(format, output, &self.setting, || false);
        Ok(created.expect("both formats are written")?)
    }
}

/// Returns the step at which a part begins, from its name.
fn first_step(name: &str) -> Option<u64> {
    name.strip_prefix("part-")?.split('-').next()?.parse().ok()
}

/// Returns the error of a folder that cannot be read.
pub fn unread(folder: &Path, error: &std::io::Error) -> Failure {
    Failure::Here(format!("cannot read {}: {error}", folder.display()))
}

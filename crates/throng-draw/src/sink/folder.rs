//! A folder of numbered PNG files.

use super::{FrameSink, SameSize, png::encode};
use crate::{Error, Image};
use std::path::{Path, PathBuf};
use throng_record::{Output, OutputError};

/// Writes every picture as a separate file: `frame_000000.png`, `frame_000001.png` and so on.
///
/// Each file is complete when it appears. If the film is dropped before it is finished, its pictures are deleted. Files
/// with these names from an earlier, longer film are removed at the end, so that the folder holds one film.
#[derive(Debug)]
pub struct FolderSink {
    folder: PathBuf,
    /// Whether the sink created the folder.
    new: bool,
    /// Whether the film is complete.
    complete: bool,
    count: usize,
    size: SameSize,
}

impl FolderSink {
    /// Starts a film in `folder`, which is created if its parent folder exists.
    ///
    /// # Errors
    /// The folder cannot be created.
    pub fn create(folder: impl AsRef<Path>) -> Result<Self, Error> {
        let folder = folder.as_ref().to_path_buf();
        let new = !folder.is_dir();
        if new {
            std::fs::create_dir(&folder).map_err(|source| OutputError::new(&folder, source))?;
        }
        Ok(Self { new, complete: false, count: 0, size: SameSize::new(&folder), folder })
    }

    fn file(&self, index: usize) -> PathBuf {
        self.folder.join(format!("frame_{index:06}.png"))
    }
}

impl FrameSink for FolderSink {
    fn push(&mut self, image: &Image) -> Result<(), Error> {
        self.size.check(image)?;
        let output = Output::create(self.file(self.count))?;
        self.count += 1;
        encode(output, image, ::png::Compression::Fast)
    }

    fn finish(mut self: Box<Self>) -> Result<(), Error> {
        self.size.known()?;
        self.complete = true;
        for index in self.count.. {
            let stale = self.file(index);
            if !stale.is_file() {
                break;
            }
            std::fs::remove_file(&stale).map_err(|source| OutputError::new(&stale, source))?;
        }
        Ok(())
    }
}

impl Drop for FolderSink {
    /// Deletes the pictures of an unfinished film.
    fn drop(&mut self) {
        if !self.complete {
            // Errors cannot be handled here.
            (0..self.count).for_each(|index| drop(std::fs::remove_file(self.file(index))));
            if self.new {
                let _ = std::fs::remove_dir(&self.folder);
            }
        }
    }
}

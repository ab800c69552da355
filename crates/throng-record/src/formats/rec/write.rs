//! Writes `.rec`.

use super::Contents;
use super::file::{END, HEAD, Head, INDEX, Index, MAGIC, encode, prefix};
use super::frame::{Memory, RecMoment};
use super::state::RecState;
use crate::formats::Writer;
use crate::output::part_of;
use crate::{Frame, Output, OutputError, Setting, TrajectoriesError};
use std::path::Path;

/// Frames from one key frame to the next.
pub(super) const APART: u64 = 64;

/// Writes trajectories during a run. The [module](super) describes the data.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.rec");
/// use throng_record::formats::rec::RecWriter;
/// use throng_record::{Frame, Output, Setting, Trajectories, Writer};
/// let mut writer = RecWriter::new(Output::create_kept(&path)?, &Setting::default())?;
/// writer.push(&Frame::default())?;
/// drop(writer);
/// assert!(Trajectories::read(folder.path().join("run.rec.part")).is_ok());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct RecWriter {
    output: Output,
    /// Bytes written.
    written: u64,
    index: Index,
    /// Whether the next frame must be a key frame.
    alone: bool,
    /// The previous frame and the frame being written.
    moments: [RecMoment; 2],
    memory: Memory,
    record: Vec<u8>,
}

/// An error of appending to a file.
#[derive(Debug, thiserror::Error)]
pub enum AppendError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] TrajectoriesError),
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] OutputError),
}

impl RecWriter {
    /// Starts a file with the constant data.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn new(output: Output, setting: &Setting) -> Result<Self, OutputError> {
        let record = encode(HEAD, &Head::of(setting));
        let mut writer = Self {
            output,
            written: 0,
            index: Index::default(),
            alone: true,
            moments: Default::default(),
            memory: Memory::default(),
            record,
        };
        writer.put(&MAGIC)?;
        writer.put_record()?;
        Ok(writer)
    }

    /// Continues a file, complete or not, after all its complete frames. `path` is the name of the complete file, with
    /// or without `.part`. New frames must be later than those in the file, and groups are numbered as in its
    /// [setting](Contents::setting).
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("run.rec");
    /// use throng_record::formats::rec::RecWriter;
    /// use throng_record::{Body, Frame, Output, Setting, Trajectories, Writer};
    /// let mut writer = RecWriter::new(Output::create_kept(&path)?, &Setting::default())?;
    /// writer.push(&Frame { time: 0.0, ..Frame::default() })?;
    /// Box::new(writer).finish()?;
    /// let mut writer = RecWriter::append(&path)?;
    /// writer.push(&Frame { time: 0.5, ..Frame::default() })?;
    /// Box::new(writer).finish()?;
    /// let bytes = std::fs::read(&path)?;
    /// assert_eq!(throng_record::formats::rec::Contents::of(&bytes)?.moments, Some(2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The file cannot be read or written, has another format, or is damaged before its end.
    pub fn append(path: impl AsRef<Path>) -> Result<Self, AppendError> {
        let path = path.as_ref();
        let path =
            if path.extension().is_some_and(|end| end == "part") { path.with_extension("") } else { path.into() };
        let found = if path.exists() { path.clone() } else { part_of(&path) };
        let bytes = std::fs::read(&found).map_err(|source| TrajectoriesError::File { path: found.clone(), source })?;
        let whole = Contents::of(&bytes).and_then(|contents| contents.whole());
        let (written, index) = whole.map_err(|flaw| TrajectoriesError::Content { path: found, flaw })?;
        Ok(Self {
            output: Output::append_kept(&path, bytes.len() as u64, written)?,
            written,
            index,
            alone: true,
            moments: Default::default(),
            memory: Memory::default(),
            record: Vec::new(),
        })
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), OutputError> {
        self.written += bytes.len() as u64;
        self.output.put(bytes)
    }

    fn put_record(&mut self) -> Result<(), OutputError> {
        let record = std::mem::take(&mut self.record);
        self.put(&prefix(&record))?;
        self.put(&record)?;
        self.record = record;
        Ok(())
    }
}

impl Writer for RecWriter {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        self.moments.swap(0, 1);
        let [last, now] = &mut self.moments;
        now.time = frame.time;
        now.states.clear();
        now.states.extend(frame.bodies.iter().map(RecState::of));
        now.states.sort_unstable_by_key(|state| state.number);
        now.states.dedup_by_key(|state| state.number);
        let key = std::mem::take(&mut self.alone) || self.index.moments.is_multiple_of(APART);
        if key {
            self.index.keys.push((self.written, self.index.moments, frame.time));
        }
        self.record.clear();
        self.memory.write(now, (!key).then_some(last), &mut self.record);
        self.index.moments += 1;
        self.index.last = frame.time;
        self.put_record()?;
        self.output.settle(false)
    }

    fn finish(mut self: Box<Self>) -> Result<(), OutputError> {
        let at = self.written;
        self.record = encode(INDEX, &self.index);
        self.put_record()?;
        self.put(&at.to_le_bytes())?;
        self.put(&END)?;
        self.output.finish()
    }
}

//! Reads `.rec`: the whole file, or the frames between two times.

use super::file::{END, HEAD, Head, INDEX, Index, MAGIC, Next, decode, next};
use super::frame::{KEY, Memory, NEXT, RecMoment};
use super::pack::Rest;
use crate::Setting;
use crate::formats::{FormatFlaw, Reading};
use crate::trajectories::{Sample, Trajectories};

const HINT: &str = "`throng run -o NAME.rec` writes such files; the frames before the damaged record are lost too";

/// Reads a file up to its end, or to its last complete record if it is incomplete.
pub(super) fn read(bytes: &[u8], _: &Reading) -> Result<Trajectories, FormatFlaw> {
    let contents = Contents::of(bytes)?;
    contents.between(f64::NEG_INFINITY, f64::INFINITY)
}

/// The head and the index of a file, for access to any part of it.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.rec");
/// # use throng_record::formats::rec::RecWriter;
/// # use throng_record::{Frame, Output, Setting, Writer};
/// # let mut writer = RecWriter::new(Output::create_kept(&path)?, &Setting::default())?;
/// # for k in 0..100 { writer.push(&Frame { time: f64::from(k) * 0.1, ..Frame::default() })?; }
/// # Box::new(writer).finish()?;
/// use throng_record::formats::rec::Contents;
/// let bytes = std::fs::read(&path)?;
/// let contents = Contents::of(&bytes)?;
/// assert_eq!((contents.moments, contents.keys.len()), (Some(100), 2));
/// let tracks = contents.between(7.0, 8.0)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Contents<'a> {
    /// The place and the names.
    pub setting: Setting,
    /// The program that wrote the file, and its version.
    pub program: String,
    /// Number of frames; `None` for an incomplete file.
    pub moments: Option<u64>,
    /// The frames at which reading can start; empty for an incomplete file.
    pub keys: Vec<Key>,
    bytes: &'a [u8],
    /// Offset of the first frame.
    start: usize,
}

/// A key frame, which does not depend on other frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// The index of the frame, from 0.
    pub moment: u64,
    /// The time of the frame, seconds.
    pub time: f64,
    /// The offset of its record.
    at: usize,
}

impl<'a> Contents<'a> {
    /// Reads the head and the index of a file.
    ///
    /// # Errors
    /// The file has another format, or its head is incomplete or damaged.
    pub fn of(bytes: &'a [u8]) -> Result<Self, FormatFlaw> {
        let mut rest = Rest(bytes);
        match rest.array::<8>() {
            Some(MAGIC) => {}
            Some([b'\x89', b't', b'h', b'r', b'o', b'n', b'g', version]) => {
                return Err(flaw(format!("the file has version {version}, which this program does not read")));
            }
            _ => return Err(flaw("the file does not begin like a .rec file")),
        }
        let head = match next(&mut rest) {
            Next::Record(record) => decode::<Head>(HEAD, record),
            Next::End | Next::Changed => None,
        };
        let head = head.ok_or_else(|| flaw("the beginning of the file is damaged"))?;
        let program = head.program.clone();
        let setting = head.into_setting();
        let start = bytes.len() - rest.0.len();
        let index = index(bytes);
        let key = |&(at, moment, time): &(u64, u64, f64)| Some(Key { moment, time, at: usize::try_from(at).ok()? });
        let keys = index.as_ref().map_or_else(Vec::new, |index| index.keys.iter().filter_map(key).collect());
        Ok(Self { setting, program, moments: index.map(|index| index.moments), keys, bytes, start })
    }

    /// Reads the frames between two times, seconds, both included.
    ///
    /// # Errors
    /// A record is damaged. An incomplete record at the end of the file is ignored.
    pub fn between(&self, from: f64, to: f64) -> Result<Trajectories, FormatFlaw> {
        let first = self.keys.iter().rfind(|key| key.time <= from).map_or(self.start, |key| key.at);
        let mut records = RecRecords::from(self, first);
        let mut tracks = Trajectories { setting: self.setting.clone(), ..Trajectories::default() };
        while let Some((record, moment)) = records.next()? {
            if moment.time > to {
                break;
            }
            if moment.time >= from {
                let spots: Option<Vec<Sample>> = moment.states.iter().map(|state| state.spot(moment.time)).collect();
                tracks.spots.extend(spots.ok_or_else(|| broken(record.at))?);
            }
        }
        // times in a file of another program may decrease
        tracks.sort();
        if let Some(most) = tracks.spots.iter().map(|spot| spot.group).max() {
            self.name(most, &mut tracks.setting.groups)?;
        }
        Ok(tracks)
    }

    /// Returns the offset of the end of the last complete frame, and an index of all frames.
    ///
    /// # Errors
    /// A record is damaged.
    pub(super) fn whole(&self) -> Result<(u64, Index), FormatFlaw> {
        let mut records = RecRecords::from(self, self.start);
        let mut index = Index::default();
        while let Some((record, moment)) = records.next()? {
            if record.key {
                index.keys.push((record.at as u64, index.moments, moment.time));
            }
            index.moments += 1;
            index.last = moment.time;
        }
        Ok((records.at() as u64, index))
    }

    /// Names groups without a name by their index.
    fn name(&self, most: u32, groups: &mut Vec<String>) -> Result<(), FormatFlaw> {
        if most as usize > groups.len() + self.bytes.len() {
            return Err(flaw(format!("an agent is in group {most}, but there are {} groups", groups.len())));
        }
        groups.extend((groups.len() as u32..=most).map(|group| group.to_string()));
        Ok(())
    }
}

/// The frames of a file, in order.
struct RecRecords<'a> {
    contents: &'a Contents<'a>,
    /// The bytes after the last frame.
    rest: Rest<'a>,
    last: Option<RecMoment>,
    memory: Memory,
}

/// The position of a frame.
struct Record {
    /// The offset of its first byte.
    at: usize,
    /// Whether it is a key frame.
    key: bool,
}

impl<'a> RecRecords<'a> {
    /// Returns the frames from an offset on.
    fn from(contents: &'a Contents<'a>, at: usize) -> Self {
        let rest = Rest(contents.bytes.get(at..).unwrap_or_default());
        Self { contents, rest, last: None, memory: Memory::default() }
    }

    /// Returns the offset of the end of the last frame.
    fn at(&self) -> usize {
        self.contents.bytes.len() - self.rest.0.len()
    }

    /// Reads the next frame; `None` after the last one.
    fn next(&mut self) -> Result<Option<(Record, &RecMoment)>, FormatFlaw> {
        let (at, mut rest) = (self.at(), self.rest);
        let record = match next(&mut rest) {
            Next::Record(record) => record,
            // only an incomplete file may end within a record
            Next::End if self.contents.moments.is_none() => return Ok(None),
            Next::End | Next::Changed => return Err(broken(at)),
        };
        if !matches!(record.first(), Some(&(KEY | NEXT))) {
            return Ok(None);
        }
        let moment = self.memory.read(record, self.last.as_ref()).ok_or_else(|| broken(at))?;
        self.rest = rest;
        let key = record[0] == KEY;
        Ok(Some((Record { at, key }, self.last.insert(moment))))
    }
}

/// Reads the index at the end of a complete file.
fn index(bytes: &[u8]) -> Option<Index> {
    let (before, end) = bytes.split_at_checked(bytes.len().checked_sub(16)?)?;
    let at = u64::from_le_bytes(end[..8].try_into().ok()?);
    if end[8..] != END {
        return None;
    }
    let mut rest = Rest(before.get(usize::try_from(at).ok()?..)?);
    match next(&mut rest) {
        Next::Record(record) => decode(INDEX, record),
        Next::End | Next::Changed => None,
    }
}

fn broken(at: usize) -> FormatFlaw {
    flaw(format!("the record at byte {at} is damaged"))
}

fn flaw(why: impl Into<String>) -> FormatFlaw {
    FormatFlaw { line: None, why: why.into(), hint: Some(HINT) }
}

//! `.rec` read: all of it, or what lies between two times.

use super::file::{END, HEAD, Head, INDEX, Index, MAGIC, Next, decode, next};
use super::frame::{KEY, Memory, Moment, NEXT};
use super::pack::Rest;
use crate::Setting;
use crate::formats::{Flaw, Reading};
use crate::tracks::{Spot, Tracks};

const HINT: &str =
    "`throng run -o NAME.rec` writes such files; what stands before the place that is broken is lost with it";

/// Reads a file up to its end, or to its last whole record if it was not completed.
pub(super) fn read(bytes: &[u8], _: &Reading) -> Result<Tracks, Flaw> {
    let contents = Contents::of(bytes)?;
    contents.between(f64::NEG_INFINITY, f64::INFINITY)
}

/// A file of which the beginning and the index were read, to look at any part of it.
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
    /// The program that wrote it, and its version.
    pub program: String,
    /// How many moments there are; `None` of a file that was not completed.
    pub moments: Option<u64>,
    /// The moments from which one can begin to read; of a file that was not completed none are known.
    pub keys: Vec<Key>,
    bytes: &'a [u8],
    /// Where the moments begin.
    start: usize,
}

/// A moment that stands by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// Its number, from 0.
    pub moment: u64,
    /// Its time, seconds.
    pub time: f64,
    /// The byte at which its record begins.
    at: usize,
}

impl<'a> Contents<'a> {
    /// What is in a file.
    ///
    /// # Errors
    /// It is no such file, or what it begins with is not whole.
    pub fn of(bytes: &'a [u8]) -> Result<Self, Flaw> {
        let mut rest = Rest(bytes);
        match rest.array::<8>() {
            Some(MAGIC) => {}
            Some([b'\x89', b't', b'h', b'r', b'o', b'n', b'g', version]) => {
                return Err(flaw(format!("it is of version {version}, which this program does not read")));
            }
            _ => return Err(flaw("it does not begin as such files do")),
        }
        let head = match next(&mut rest) {
            Next::Record(record) => decode::<Head>(HEAD, record),
            Next::End | Next::Changed => None,
        };
        let head = head.ok_or_else(|| flaw("its beginning is broken"))?;
        let program = head.program.clone();
        let setting = head.into_setting();
        let start = bytes.len() - rest.0.len();
        let index = index(bytes);
        let key = |&(at, moment, time): &(u64, u64, f64)| Some(Key { moment, time, at: usize::try_from(at).ok()? });
        let keys = index.as_ref().map_or_else(Vec::new, |index| index.keys.iter().filter_map(key).collect());
        Ok(Self { setting, program, moments: index.map(|index| index.moments), keys, bytes, start })
    }

    /// Who was where from one time to another, seconds, both included.
    ///
    /// # Errors
    /// A record is not what was written. One that the file ends in is left out.
    pub fn between(&self, from: f64, to: f64) -> Result<Tracks, Flaw> {
        let first = self.keys.iter().rfind(|key| key.time <= from).map_or(self.start, |key| key.at);
        let mut records = Records::from(self, first);
        let mut tracks = Tracks { setting: self.setting.clone(), ..Tracks::default() };
        while let Some((record, moment)) = records.next()? {
            if moment.time > to {
                break;
            }
            if moment.time >= from {
                let spots: Option<Vec<Spot>> = moment.states.iter().map(|state| state.spot(moment.time)).collect();
                tracks.spots.extend(spots.ok_or_else(|| broken(record.at))?);
            }
        }
        if let Some(most) = tracks.spots.iter().map(|spot| spot.group).max() {
            self.name(most, &mut tracks.setting.groups)?;
        }
        Ok(tracks)
    }

    /// How many bytes there are up to the end of the last whole moment, and where which moment is.
    ///
    /// # Errors
    /// A record is not what was written.
    pub(super) fn whole(&self) -> Result<(u64, Index), Flaw> {
        let mut records = Records::from(self, self.start);
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

    /// Groups without a name are called by their index.
    fn name(&self, most: u32, groups: &mut Vec<String>) -> Result<(), Flaw> {
        if most as usize > groups.len() + self.bytes.len() {
            return Err(flaw(format!("somebody is in group {most}, and there are {}", groups.len())));
        }
        groups.extend((groups.len() as u32..=most).map(|group| group.to_string()));
        Ok(())
    }
}

/// The moments of a file, one after the other.
struct Records<'a> {
    contents: &'a Contents<'a>,
    /// What comes after the last moment.
    rest: Rest<'a>,
    last: Option<Moment>,
    memory: Memory,
}

/// Where a moment is.
struct Record {
    /// The byte at which it begins.
    at: usize,
    /// Whether it stands by itself.
    key: bool,
}

impl<'a> Records<'a> {
    /// Those from a byte on.
    fn from(contents: &'a Contents<'a>, at: usize) -> Self {
        let rest = Rest(contents.bytes.get(at..).unwrap_or_default());
        Self { contents, rest, last: None, memory: Memory::default() }
    }

    /// The byte behind the last moment.
    fn at(&self) -> usize {
        self.contents.bytes.len() - self.rest.0.len()
    }

    /// The next moment; none at the end of them.
    fn next(&mut self) -> Result<Option<(Record, &Moment)>, Flaw> {
        let (at, mut rest) = (self.at(), self.rest);
        let record = match next(&mut rest) {
            Next::Record(record) => record,
            // what was cut ends like this, what is complete does not
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

/// The index at the end of a complete file.
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

fn broken(at: usize) -> Flaw {
    flaw(format!("its record at byte {at} is broken"))
}

fn flaw(why: impl Into<String>) -> Flaw {
    Flaw { line: None, why: why.into(), hint: Some(HINT) }
}

//! Records, and those other than frames.

use super::pack::Rest;
use crate::Setting;
use crate::formats::PROGRAM;
use glam::DVec2;
use serde::{Deserialize, Serialize};
use throng::{Obstacle, Walkable};

/// The first bytes of every file; the last of them is the version.
pub(super) const MAGIC: [u8; 8] = *b"\x89throng\x01";
/// The last bytes of a complete file, after the position of its index.
pub(super) const END: [u8; 8] = *b"gnorht\x89\n";

/// The kind of the record of constant data.
pub(super) const HEAD: u8 = b'H';
/// The kind of the index record.
pub(super) const INDEX: u8 = b'I';

/// Constant data of the file.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Head {
    /// The program and its version.
    pub(super) program: String,
    title: String,
    groups: Vec<String>,
    walkable: Vec<Walkable>,
    obstacles: Vec<Obstacle>,
    in_space: bool,
    origin: DVec2,
}

impl Head {
    pub(super) fn of(setting: &Setting) -> Self {
        let Setting { title, groups, walkable, obstacles, in_space, origin, .. } = setting.clone();
        Self { program: PROGRAM.to_owned(), title, groups, walkable, obstacles, in_space, origin }
    }

    pub(super) fn into_setting(self) -> Setting {
        let Self { program: _, title, groups, walkable, obstacles, in_space, origin } = self;
        Setting { title, groups, walkable, obstacles, in_space, origin, ..Setting::default() }
    }
}

/// The positions of key frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Index {
    /// Number of frames.
    pub(super) moments: u64,
    /// Time of the last frame, seconds.
    pub(super) last: f64,
    /// Key frames: offset in the file, index of the frame, time.
    pub(super) keys: Vec<(u64, u64, f64)>,
}

/// Returns a record of a kind and a value.
pub(super) fn encode(kind: u8, what: &impl Serialize) -> Vec<u8> {
    postcard::to_extend(what, vec![kind]).expect("memory takes everything")
}

/// Returns the value of a record of a kind; `None` if the record does not hold it.
pub(super) fn decode<'a, T: Deserialize<'a>>(kind: u8, record: &'a [u8]) -> Option<T> {
    let (first, what) = record.split_first()?;
    if *first != kind {
        return None;
    }
    postcard::from_bytes(what).ok()
}

/// Returns the prefix of a record: its length and its checksum.
pub(super) fn prefix(record: &[u8]) -> [u8; 8] {
    let mut prefix = [0; 8];
    prefix[..4].copy_from_slice(&(record.len() as u32).to_le_bytes());
    prefix[4..].copy_from_slice(&crc32fast::hash(record).to_le_bytes());
    prefix
}

/// The next record of a file.
pub(super) enum Next<'a> {
    Record(&'a [u8]),
    /// The file ends here, or within a record.
    End,
    /// A record is complete, but its bytes have changed.
    Changed,
}

/// Reads the next record.
pub(super) fn next<'a>(rest: &mut Rest<'a>) -> Next<'a> {
    let mut after = *rest;
    let (Some(length), Some(sum)) = (after.array(), after.array()) else { return Next::End };
    let Some(record) = after.take(u32::from_le_bytes(length) as usize) else { return Next::End };
    if crc32fast::hash(record) != u32::from_le_bytes(sum) {
        return Next::Changed;
    }
    *rest = after;
    Next::Record(record)
}

//! Records, and those of them that are no moments.

use super::pack::Rest;
use crate::Setting;
use crate::formats::PROGRAM;
use glam::DVec2;
use serde::{Deserialize, Serialize};
use throng::{Obstacle, Walkable};

/// How every file begins; the last byte is the version.
pub(super) const MAGIC: [u8; 8] = *b"\x89throng\x01";
/// How a complete file ends, after the place of its index.
pub(super) const END: [u8; 8] = *b"gnorht\x89\n";

/// The record of what stays the same.
pub(super) const HEAD: u8 = b'H';
/// The record of where which moment is.
pub(super) const INDEX: u8 = b'I';

/// What stays the same.
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

/// Where which moment is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Index {
    /// Moments in all.
    pub(super) moments: u64,
    /// Time of the last, seconds.
    pub(super) last: f64,
    /// Those that stand by themselves: byte of the file, number of the moment, time.
    pub(super) keys: Vec<(u64, u64, f64)>,
}

/// Appends the kind of a record and what it says.
pub(super) fn encode(kind: u8, what: &impl Serialize) -> Vec<u8> {
    postcard::to_extend(what, vec![kind]).expect("memory takes everything")
}

/// What a record of a kind says; `None` if it is none.
pub(super) fn decode<'a, T: Deserialize<'a>>(kind: u8, record: &'a [u8]) -> Option<T> {
    let (first, what) = record.split_first()?;
    if *first != kind {
        return None;
    }
    postcard::from_bytes(what).ok()
}

/// What stands in front of a record: its length and its checksum.
pub(super) fn prefix(record: &[u8]) -> [u8; 8] {
    let mut prefix = [0; 8];
    prefix[..4].copy_from_slice(&(record.len() as u32).to_le_bytes());
    prefix[4..].copy_from_slice(&crc32fast::hash(record).to_le_bytes());
    prefix
}

/// What comes next.
pub(super) enum Next<'a> {
    Record(&'a [u8]),
    /// The file ends here, or in a record that is not whole.
    End,
    /// A record is whole, and is not what was written.
    Changed,
}

/// The next record.
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

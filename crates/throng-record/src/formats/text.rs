//! Tables of people as plain text: columns between blanks, comments behind `#`.

use super::{Flaw, Reading};
use crate::tracks::{RADIUS, Spot, Tracks};
use glam::{DVec2, Vec3};
use std::borrow::Cow;
use throng::Status;

/// What to do where a file counts frames and nobody says how many a second has.
pub const RATE_HINT: &str = "say how many frames a second has, such as --frame-rate 25 (`Reading::rate`)";

/// The text of a file. Comments are in whatever encoding: what cannot be read of them does not matter, and no number has
/// such bytes.
pub fn text(bytes: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes))
}

/// What the comments say, one a line.
pub fn comments(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| line.trim_start().strip_prefix('#'))
}

/// The lines that say something, with their numbers from 1.
pub fn lines(text: &str) -> impl Iterator<Item = Fields<'_>> {
    let lines = text.lines().enumerate().map(|(at, line)| (at + 1, line.trim()));
    let said = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    said.map(|(line, text)| Fields { line, fields: text.split_whitespace().collect() })
}

/// The fields of one line.
pub struct Fields<'a> {
    /// Its number, from 1.
    pub line: usize,
    /// What stands between blanks.
    pub fields: Vec<&'a str>,
}

impl Fields<'_> {
    /// Something is wrong with this line.
    pub fn flaw(&self, why: String, hint: &'static str) -> Flaw {
        Flaw { line: Some(self.line), why, hint: Some(hint) }
    }

    /// A finite number; `what` it is, for the error.
    pub fn number(&self, at: usize, what: &str, hint: &'static str) -> Result<f64, Flaw> {
        let Some(field) = self.fields.get(at) else {
            return Err(self.flaw(format!("there is no {what}: only {} columns", self.fields.len()), hint));
        };
        let value = field.parse().ok().filter(|value: &f64| value.is_finite());
        value.ok_or_else(|| self.flaw(format!("`{field}` is no number for {what}"), hint))
    }

    /// Somebody's number, which may be written as `1.0` too.
    pub fn person(&self, at: usize, hint: &'static str) -> Result<u32, Flaw> {
        let value = self.number(at, "the id", hint)?;
        let whole = person(value);
        whole.ok_or_else(|| self.flaw(format!("`{}` is no number of a person", self.fields[at]), hint))
    }
}

/// A number of a person: whole, from 0.
pub fn person(value: f64) -> Option<u32> {
    (value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value)).then_some(value as u32)
}

/// Frames a second: as it is said by people, else by the file.
pub fn rate(file: Option<f64>, reading: &Reading) -> Result<f64, Flaw> {
    let rate = reading.rate.or(file).filter(|&rate| rate > 0.0 && rate.is_finite());
    let missing = || Flaw {
        line: None,
        why: "it counts frames, but does not say how many a second has".into(),
        hint: Some(RATE_HINT),
    };
    rate.ok_or_else(missing)
}

/// Somebody who walks on the ground, who was somewhere.
pub fn walker(number: u32, time: f64, place: DVec2) -> Spot {
    Spot {
        number,
        group: 0,
        time,
        place: place.extend(0.0),
        velocity: Vec3::ZERO,
        heading: 0.0,
        radius: RADIUS,
        status: Status::Walking,
    }
}

/// Trajectories of people of one group without a name; `velocities`: whether the spots have them.
pub fn people(spots: Vec<Spot>, velocities: bool) -> Result<Tracks, Flaw> {
    if spots.is_empty() {
        return Err(Flaw {
            line: None,
            why: "nobody is in it".into(),
            hint: Some("give a file with at least one row of a person"),
        });
    }
    let mut tracks = Tracks { spots, ..Tracks::default() };
    tracks.setting.groups.push(String::new());
    tracks.sort();
    tracks.complete(!velocities, true);
    Ok(tracks)
}

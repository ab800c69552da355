//! Trajectories as plain text: columns separated by blanks, comments after `#`.

use super::{FormatFlaw, Reading};
use crate::trajectories::{RADIUS, Sample, Trajectories};
use glam::{DVec2, Vec3};
use std::borrow::Cow;
use throng::Status;

/// The hint for files that count frames without a frame rate.
pub const RATE_HINT: &str = "state the frame rate, such as --frame-rate 25 (`Reading::rate`)";

/// Decodes the text of a file. Comments may have any encoding: undecodable bytes in them do not matter, and numbers
/// contain none.
pub fn text(bytes: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes))
}

/// Returns the comments, one per line.
pub fn comments(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| line.trim_start().strip_prefix('#'))
}

/// Returns the lines other than comments and empty lines, numbered from 1.
pub fn lines(text: &str) -> impl Iterator<Item = Fields<'_>> {
    let lines = text.lines().enumerate().map(|(at, line)| (at + 1, line.trim()));
    let said = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    said.map(|(line, text)| Fields { line, fields: text.split_whitespace().collect() })
}

/// The fields of a line.
pub struct Fields<'a> {
    /// The number of the line, from 1.
    pub line: usize,
    /// The texts between blanks.
    pub fields: Vec<&'a str>,
}

impl Fields<'_> {
    /// Returns an error of this line.
    pub fn flaw(&self, why: String, hint: &'static str) -> FormatFlaw {
        FormatFlaw { line: Some(self.line), why, hint: Some(hint) }
    }

    /// Returns a finite number; `what` names it in the error.
    pub fn number(&self, at: usize, what: &str, hint: &'static str) -> Result<f64, FormatFlaw> {
        let Some(field) = self.fields.get(at) else {
            return Err(self.flaw(format!("there is no {what}: only {} columns", self.fields.len()), hint));
        };
        let value = field.parse().ok().filter(|value: &f64| value.is_finite());
        value.ok_or_else(|| self.flaw(format!("`{field}` is no number for {what}"), hint))
    }

    /// Returns an agent number, which may be written as `1.0` too.
    pub fn person(&self, at: usize, hint: &'static str) -> Result<u32, FormatFlaw> {
        let value = self.number(at, "the id", hint)?;
        let whole = person(value);
        whole.ok_or_else(|| self.flaw(format!("`{}` is not an agent number", self.fields[at]), hint))
    }
}

/// Returns an agent number: a whole number from 0.
pub fn person(value: f64) -> Option<u32> {
    (value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value)).then_some(value as u32)
}

/// Returns the frame rate, frames per second: the rate of `reading`, else that of the file.
pub fn rate(file: Option<f64>, reading: &Reading) -> Result<f64, FormatFlaw> {
    let rate = reading.rate.or(file).filter(|&rate| rate > 0.0 && rate.is_finite());
    let missing = || FormatFlaw {
        line: None,
        why: "the file counts frames, but does not state the frame rate".into(),
        hint: Some(RATE_HINT),
    };
    rate.ok_or_else(missing)
}

/// Returns the sample of an agent that walks on the ground.
pub fn walker(number: u32, time: f64, place: DVec2) -> Sample {
    Sample {
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

/// Returns trajectories of a single group without a name. `velocities`: whether the samples have velocities.
pub fn people(spots: Vec<Sample>, velocities: bool) -> Result<Trajectories, FormatFlaw> {
    if spots.is_empty() {
        return Err(FormatFlaw {
            line: None,
            why: "the file has no agents".into(),
            hint: Some("give a file with at least one row of an agent"),
        });
    }
    let mut tracks = Trajectories { spots, ..Trajectories::default() };
    tracks.setting.groups.push(String::new());
    tracks.sort();
    tracks.complete(!velocities, true);
    Ok(tracks)
}

//! `obsmat.txt` of the crowd data of the University of Cyprus, as distributed by OpenTraj among others.
//!
//! A line holds a pedestrian at a frame, eight numbers separated by blanks: `frame id x z y vx vz vy`. The ground plane
//! is x and y, the third and the fifth column. Units are m and m/s. The file does not state the frame rate, but its
//! velocities imply one: UCY's videos have 25 frames per second, ETH's `seq_eth` has 15. The rate is 25 if the
//! velocities agree with it to a tenth, or imply no plausible rate of a video; else the implied rate, rounded to half a
//! frame per second.

use super::text::{lines, people, rate, text, walker};
use super::{Format, FormatFlaw, Reading};
use crate::consistency::{rounded, stated_over_displaced};
use crate::trajectories::{Sample, Trajectories};
use glam::DVec2;
use std::ops::RangeInclusive;

/// Read only.
pub(super) const FORMAT: Format = Format {
    ending: "txt",
    title: "people's trajectories as text: UCY's obsmat",
    columns: false,
    styles: &[],
    create: None,
    read: Some(read),
    figures: None,
    kept: false,
    sniff: Some(is),
};

const HINT: &str = "such a file has lines of `frame id x z y vx vz vy`";
/// Frame rate of most videos, frames per second.
const RATE: f64 = 25.0;
/// Greatest relative difference of two rates that agree.
const AGREE: f64 = 0.1;
/// Plausible frame rates of videos, frames per second.
const RATES: RangeInclusive<f64> = 5.0..=120.0;

/// Whether the first line has eight numbers.
fn is(bytes: &[u8]) -> bool {
    let text = text(&bytes[..bytes.len().min(4096)]);
    let first = lines(&text).next();
    first.is_some_and(|first| first.fields.len() == 8 && first.fields.iter().all(|field| field.parse::<f64>().is_ok()))
}

fn read(bytes: &[u8], reading: &Reading) -> Result<Trajectories, FormatFlaw> {
    let unit = reading.unit.unwrap_or(1.0);
    let mut spots = Vec::new();
    for fields in lines(&text(bytes)) {
        let number = |at, what| fields.number(at, what, HINT);
        let place = DVec2::new(number(2, "x")?, number(4, "y")?) * unit;
        let velocity = DVec2::new(number(5, "vx")?, number(7, "vy")?) * unit;
        let spot = walker(fields.person(1, HINT)?, number(0, "the frame")?, place);
        spots.push(Sample { velocity: velocity.as_vec2().extend(0.0), ..spot });
    }
    let mut tracks = people(spots, true)?;
    let found = found(&tracks.spots);
    if let (Some(found), None) = (found, reading.rate) {
        tracks.notes.push(format!(
            "the velocities imply {found} frames per second, not {RATE} as in most such files: {found} is used (--frame-rate)"
        ));
    }
    let rate = rate(found.or(Some(RATE)), reading)?;
    tracks.spots.iter_mut().for_each(|spot| spot.time /= rate);
    Ok(tracks)
}

/// Returns the frame rate that the velocities imply, if it is plausible and differs from the usual one. Times are frame
/// numbers.
fn found(spots: &[Sample]) -> Option<f64> {
    let found = stated_over_displaced(spots)?;
    (RATES.contains(&found) && (found / RATE - 1.0).abs() > AGREE).then(|| rounded(found))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    #[test]
    fn the_ground_is_the_third_and_the_fifth_column() {
        let text = b"  1.1e+01 2 3.5 0 -4.5 0.5 0 -1\n1 2 3.5 0 -4.1 0.5 0 -1\n";
        assert!(is(text) && !is(b"# a comment\n1 0 2.5 3.5 1.7\n") && !is(b"") && !is(b"a b c d e f g h"));
        let spots = read(text, &Reading::default()).unwrap().spots;
        assert_eq!((spots[1].number, spots[1].time, spots[1].place), (2, 0.44, DVec3::new(3.5, -4.5, 0.0)));
        assert_eq!(spots[0].velocity, Vec3::new(0.5, -1.0, 0.0));
        assert_eq!(read(b"1 1 0 0 0 0 0 0\n1 2 0 0 0 0 0\n", &Reading::default()).unwrap_err().line, Some(2));
    }
}

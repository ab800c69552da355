//! Limits of the numbers in trajectory files: code that uses them relies on these.

use crate::formats::FormatFlaw;
use crate::trajectories::{Sample, Trajectories};
use glam::DVec2;
use std::ops::RangeInclusive;
use throng::Obstacle;
use throng_scene::MAX_COORDINATE;

/// Greatest absolute time, seconds: 317 years, so seconds since 1970 fit.
const MAX_TIME: f64 = 1e10;

/// Greatest velocity, m/s: exceeds the distance of any two positions within the limits over a microsecond.
const MAX_VELOCITY: f64 = 1e15;

/// Greatest heading, radians: an `f32` of this size resolves hundredths.
const MAX_HEADING: f64 = 1e5;

/// Greatest radius of a body, metres, as in scenes.
const MAX_RADIUS: f64 = 1000.0;

const HINT: &str = "correct or remove the row; --unit (`Reading::unit`) states the unit of length, --frame-rate \
                    (`Reading::rate`) the frame rate";

/// Checks a sample.
///
/// # Errors
/// A number is not finite or out of its limits.
pub(crate) fn row(spot: &Sample) -> Result<(), FormatFlaw> {
    let Sample { number, time, place, velocity, heading, radius, .. } = *spot;
    let values = [
        ("the time", time, MAX_TIME),
        ("x", place.x, MAX_COORDINATE),
        ("y", place.y, MAX_COORDINATE),
        ("z", place.z, MAX_COORDINATE),
        ("the velocity along x", velocity.x.into(), MAX_VELOCITY),
        ("the velocity along y", velocity.y.into(), MAX_VELOCITY),
        ("the velocity along z", velocity.z.into(), MAX_VELOCITY),
        ("the heading", heading.into(), MAX_HEADING),
    ];
    let of = |name: &str| format!("{name} of agent {number} at {time} s");
    values.into_iter().try_for_each(|(name, value, most)| within(value, -most..=most, || of(name)))?;
    within(radius.into(), 0.0..=MAX_RADIUS, || of("the radius"))
}

/// Checks all samples and the place.
///
/// # Errors
/// A number is not finite or out of its limits.
pub(crate) fn tracks(tracks: &Trajectories) -> Result<(), FormatFlaw> {
    let setting = &tracks.setting;
    let point = |what: &str, p: &DVec2| {
        ["x", "y"].iter().zip(p.to_array()).try_for_each(|(name, value)| {
            within(value, -MAX_COORDINATE..=MAX_COORDINATE, || format!("{name} of a corner of {what}"))
        })
    };
    for area in &setting.walkable {
        area.holes.iter().flatten().chain(&area.outer).try_for_each(|p| point("the walkable area", p))?;
    }
    for obstacle in &setting.obstacles {
        let points = match obstacle {
            Obstacle::Polygon { corners: points } | Obstacle::Wall { points } => points.clone(),
            Obstacle::Circle { center, radius } => vec![*center - *radius, *center + *radius],
        };
        points.iter().try_for_each(|p| point("an obstacle", p))?;
    }
    point("the origin", &setting.origin)?;
    tracks.spots.iter().try_for_each(row)
}

/// Checks a number; `name` names it in the error.
fn within(value: f64, limits: RangeInclusive<f64>, name: impl Fn() -> String) -> Result<(), FormatFlaw> {
    if limits.contains(&value) {
        return Ok(());
    }
    let (least, most) = limits.into_inner();
    Err(FormatFlaw {
        line: None,
        why: format!("{} is {value:?}, but must be from {least} to {most}", name()),
        hint: Some(HINT),
    })
}

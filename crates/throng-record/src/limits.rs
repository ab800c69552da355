//! Limits of the numbers in files of trajectories: what comes after reading relies on them.

use crate::formats::Flaw;
use crate::tracks::{Spot, Tracks};
use glam::DVec2;
use throng::Obstacle;
use throng_scene::MAX_COORDINATE;

/// Greatest time, seconds: 317 years, so seconds since 1970 fit.
const MAX_TIME: f64 = 1e10;

/// Greatest velocity, m/s: more than any two places within the limits are apart, over a microsecond.
const MAX_VELOCITY: f64 = 1e15;

/// Greatest heading, radians: an `f32` of this size has still hundredths.
const MAX_HEADING: f64 = 1e5;

/// Greatest radius of a body, metres, as in scenes.
const MAX_RADIUS: f64 = 1000.0;

const HINT: &str = "correct or remove the row; --unit (`Reading::unit`) says the unit of length, --frame-rate \
                    (`Reading::rate`) how many frames a second has";

/// Checks one row.
///
/// # Errors
/// A number is not finite or out of its limits.
pub(crate) fn row(spot: &Spot) -> Result<(), Flaw> {
    let Spot { number, time, place, velocity, heading, radius, .. } = *spot;
    let values = [
        ("the time", time, MAX_TIME),
        ("x", place.x, MAX_COORDINATE),
        ("y", place.y, MAX_COORDINATE),
        ("z", place.z, MAX_COORDINATE),
        ("the velocity along x", velocity.x.into(), MAX_VELOCITY),
        ("the velocity along y", velocity.y.into(), MAX_VELOCITY),
        ("the velocity along z", velocity.z.into(), MAX_VELOCITY),
        ("the heading", heading.into(), MAX_HEADING),
        ("the radius", radius.into(), MAX_RADIUS),
    ];
    values
        .into_iter()
        .try_for_each(|(name, value, most)| within(value, most, || format!("{name} of agent {number} at {time} s")))
}

/// Checks all rows, and the place.
///
/// # Errors
/// A number is not finite or out of its limits.
pub(crate) fn tracks(tracks: &Tracks) -> Result<(), Flaw> {
    let setting = &tracks.setting;
    let point = |what: &str, p: &DVec2| {
        ["x", "y"]
            .iter()
            .zip(p.to_array())
            .try_for_each(|(name, value)| within(value, MAX_COORDINATE, || format!("{name} of a corner of {what}")))
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

/// Checks one number. `name` says of what it is.
fn within(value: f64, most: f64, name: impl Fn() -> String) -> Result<(), Flaw> {
    if value.abs() <= most {
        return Ok(());
    }
    Err(Flaw {
        line: None,
        why: format!("{} is {value:?}, but must be from -{most} to {most}", name()),
        hint: Some(HINT),
    })
}

//! Rings of ground: their outlines, and the stops of laps around them.

use super::limits::check_point;
use super::limits::{Limit, MAX_COORDINATE, check};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::registry::GoalContext;
use crate::scene::{Annulus, Lap};
use std::f64::consts::TAU;

/// Corners of each wall of a ring. The inner wall deviates from its circle by a thousandth of its radius.
const CORNERS: usize = 72;
/// Stops of a lap, each a sector of the ring. An agent arrives at a stop when it enters the sector.
pub(super) const SECTORS: usize = 8;

/// Checks the numbers of an annulus.
pub(super) fn check_annulus(path: &Path, ring: &Annulus) -> Result<(), Problem> {
    check_point(&path.key("center"), &ring.center)?;
    check(&path.key("inner"), ring.inner, Limit::UpTo(MAX_COORDINATE))?;
    check(&path.key("outer"), ring.outer, Limit::UpTo(MAX_COORDINATE))?;
    if ring.outer <= ring.inner {
        let message = format!("the outer radius, {}, is not more than the inner radius, {}", ring.outer, ring.inner);
        return Err(Problem::new(&path.key("outer"), Kind::OutOfRange, message).hint("make it larger than `inner`"));
    }
    Ok(())
}

/// Returns the ground of an annulus.
pub(super) fn ground(ring: &Annulus) -> throng::Walkable {
    let circle = |radius| (0..CORNERS).map(|k| point(ring, k as f64 / CORNERS as f64, radius)).collect();
    throng::Walkable { outer: circle(ring.outer), holes: vec![circle(ring.inner)] }
}

/// Returns the annulus of a lap: its own, or the walkable ground.
pub(super) fn of_lap(lap: &Lap, at: &GoalContext) -> Result<Annulus, Problem> {
    if let Some(ring) = &lap.ring {
        check_annulus(&at.path.key("ring"), ring)?;
    }
    lap.ring.or(at.ring).ok_or_else(|| {
        Problem::new(&at.path, Kind::MissingKey, "goal.lap has no ring, and the ground is not a ring")
            .hint("write goal.lap = { ring = { inner = 7, outer = 9 } }, or walkable.ring = { inner = 7, outer = 9 }")
    })
}

/// Returns the corners of the sectors of an annulus, counter-clockwise from the direction of +x.
pub(super) fn sectors(ring: &Annulus) -> Vec<Vec<DVec2>> {
    const PARTS: usize = CORNERS / SECTORS;
    let sector = |sector: usize| {
        let turn = |k: usize| (sector * PARTS + k) as f64 / CORNERS as f64;
        let outer = (0..=PARTS).map(|k| point(ring, turn(k), ring.outer));
        let inner = (0..=PARTS).rev().map(|k| point(ring, turn(k), ring.inner));
        outer.chain(inner).collect()
    };
    (0..SECTORS).map(sector).collect()
}

/// Returns the sectors in the order in which an agent that starts at `start` enters them.
pub(super) fn order(ring: &Annulus, clockwise: bool, start: DVec2) -> impl Iterator<Item = usize> {
    let offset = start - DVec2::from_array(ring.center);
    let turn = libm::atan2(offset.y, offset.x) / TAU;
    let first = ((turn - turn.floor()) * SECTORS as f64) as usize % SECTORS;
    (1..=SECTORS).map(move |k| (first + if clockwise { SECTORS - k } else { k }) % SECTORS)
}

/// Returns the point of a circle around the centre, `turn` turns counter-clockwise from +x.
fn point(ring: &Annulus, turn: f64, radius: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(TAU * turn);
    DVec2::from_array(ring.center) + radius * DVec2::new(cos, sin)
}

//! A place: obstacles and walkable areas in world coordinates, and the test whether a body fits.

use super::{Core, NearWalls, Obstacle, Walkable, Wall, Walls, crossing};
use crate::Error;
use crate::agent::Body;
use crate::navigate::union;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// The obstacles and walkable areas.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Walkable areas, disjoint. If empty, agents can walk everywhere.
    pub areas: Vec<Walkable>,
    /// Obstacles by index. A removed obstacle leaves a gap, so that ids stay valid.
    pub obstacles: Vec<Option<Obstacle>>,
}

impl Place {
    /// Returns the obstacles that were not removed.
    pub fn obstacles(&self) -> impl Iterator<Item = &Obstacle> {
        self.obstacles.iter().flatten()
    }

    /// Returns why the point is not on free ground; `None` if it is.
    pub fn blocked(&self, p: DVec2) -> Option<&'static str> {
        self.blocked_where(p, || self.obstacles().any(|obstacle| obstacle.covers(p)))
    }

    /// As [`blocked`](Self::blocked), with whether an obstacle covers the point.
    fn blocked_where(&self, p: DVec2, covered: impl FnOnce() -> bool) -> Option<&'static str> {
        if !self.areas.is_empty() && !self.areas.iter().any(|area| area.contains(p)) {
            return Some("it is outside the walkable area");
        }
        covered().then_some("it is inside an obstacle")
    }

    /// Returns why a body does not fit at its core, or `None` if it fits. `p` is in world coordinates; the core and
    /// `walls` are relative to the local origin.
    pub(crate) fn no_room_for(&self, p: DVec2, core: &Core, body: Body, walls: &Walls) -> Option<&'static str> {
        self.blocked_where(p, || walls.cover(core.center)).or_else(|| {
            let mut overlaps = false;
            walls.visit(core.center, f64::from(body.bounding_radius()), |wall| {
                let distance = match wall {
                    Wall::Edge(edge) => core.separation(&Core::segment(edge.start, edge.end)).distance,
                    Wall::Disc(disc) => core.separation(&Core::point(disc.center)).distance - disc.radius,
                };
                overlaps |= distance < f64::from(body.radius) * (1.0 - 1e-4);
            });
            overlaps.then_some("its body would overlap a wall")
        })
    }

    /// Returns why a disc does not fit at a point, or `None` if it fits. `walls` are those of this place, relative to
    /// `origin`.
    pub fn no_room(&self, p: DVec2, radius: f64, walls: &Walls, origin: DVec2) -> Option<&'static str> {
        self.blocked_where(p, || walls.cover(p - origin)).or_else(|| {
            // positions are rounded to `f32`: an overlap this small is rounding
            let slack = 1e-4 * radius;
            let distance = walls.distance(p - origin, radius, &mut NearWalls::default());
            (distance < radius - slack).then_some("its body would overlap a wall")
        })
    }
}

impl Walkable {
    /// Returns the union of areas as areas that do not overlap. A single area stays unchanged. Corners of several areas
    /// are rounded to a fine grid.
    ///
    /// # Errors
    /// [`Error::Shape`] for an outline that encloses nothing or crosses itself.
    pub fn union(areas: Vec<Self>) -> Result<Vec<Self>, Error> {
        for (index, area) in areas.iter().enumerate() {
            check_polygon(&format!("walkable area {}", index + 1), &area.outer)?;
            for (hole, corners) in area.holes.iter().enumerate() {
                check_polygon(&format!("hole {} of walkable area {}", hole + 1, index + 1), corners)?;
            }
        }
        union(areas).map_err(|error| Error::Shape { what: "the walkable areas".into(), why: error.to_string() })
    }

    /// Whether a point is on this ground.
    pub fn contains(&self, p: DVec2) -> bool {
        is_inside(&self.outer, p) && !self.holes.iter().any(|hole| is_inside(hole, p))
    }
}

/// Whether `p` is inside a simple polygon (even-odd rule).
pub fn is_inside(corners: &[DVec2], p: DVec2) -> bool {
    let mut inside = false;
    let mut before = match corners.last() {
        Some(&last) => last,
        None => return false,
    };
    for &corner in corners {
        if (corner.y > p.y) != (before.y > p.y) {
            let x = (before.x - corner.x) * (p.y - corner.y) / (before.y - corner.y) + corner.x;
            inside ^= p.x < x;
        }
        before = corner;
    }
    inside
}

/// Checks that a polygon encloses an area and does not cross itself.
///
/// # Errors
/// [`Error::Shape`] with the point where two of its edges cross, or another reason.
pub fn check_polygon(what: &str, corners: &[DVec2]) -> Result<(), Error> {
    let fail = |why: String| Err(Error::Shape { what: what.into(), why });
    if let Some(p) = corners.iter().find(|p| !p.is_finite()) {
        return fail(format!("the corner ({}, {}) is not a finite number", p.x, p.y));
    }
    let mut ring: Vec<DVec2> = corners.to_vec();
    ring.dedup();
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    let n = ring.len();
    if n < 3 {
        return fail(format!("a polygon needs at least 3 different corners, this has {n}"));
    }
    let edge = |i: usize| (ring[i], ring[(i + 1) % n]);
    // edges sorted by their left ends: only those that overlap in x are compared
    let mut order: Vec<usize> = (0..n).collect();
    let left = |i: usize| edge(i).0.x.min(edge(i).1.x);
    order.sort_by(|&i, &j| left(i).total_cmp(&left(j)).then(i.cmp(&j)));
    for (k, &i) in order.iter().enumerate() {
        let (a, b) = edge(i);
        for &j in order[k + 1..].iter().take_while(|&&j| left(j) <= a.x.max(b.x)) {
            let neighbours = (i + 1) % n == j || (j + 1) % n == i;
            let (c, d) = edge(j);
            if !neighbours && let Some(p) = crossing(a, b, c, d) {
                return fail(format!("its boundary crosses itself at ({:.3}, {:.3})", p.x, p.y));
            }
        }
    }
    let area: f64 = (0..n).map(|i| (edge(i).0 - ring[0]).perp_dot(edge(i).1 - ring[0])).sum();
    if area == 0.0 { fail("it encloses no area".into()) } else { Ok(()) }
}

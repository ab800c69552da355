//! Routes to the target, found by following the slope.

use super::{Smoothing, Spine, SwarmGuide};
use glam::Vec3;
use throng::Error;

/// Length of a step down the slope, in parts of a cube.
const STEP: f32 = 0.5;
/// Part of a step by which the route must get shorter.
const PROGRESS: f32 = 0.1;

impl SwarmGuide {
    /// Returns a route from a place to the target along which a body has room: down the slope in steps of half a cube;
    /// where a step would touch an obstacle, from cube to cube.
    ///
    /// # Errors
    /// [`Error::Shape`] for a start beyond the box, where a body has no room, or from which no route leads to the
    /// target.
    pub fn path(&self, from: Vec3) -> Result<Vec<Vec3>, Error> {
        let fail =
            |why: &str| Error::Shape { what: format!("the way from {from} to {}", self.target), why: why.into() };
        if self.space.cell_at(from).is_none() {
            return Err(fail("its start is beyond the box of space"));
        }
        let near = self.space.nearest(from);
        if near.distance < self.space.radius {
            let inside = "its start is inside an obstacle";
            return Err(fail(if near.is_inside() { inside } else { "a body has no room at its start" }));
        }
        let mut way = vec![from];
        let (mut here, mut node) = (from, None);
        loop {
            let close = here.distance(self.target) <= 2.0 * self.space.cell();
            if close && self.is_clear(here, self.target) {
                way.push(self.target);
                return Ok(way);
            }
            let next = match (self.downstep(here), node) {
                (Some(next), _) => (next, None),
                // from the centre of a cube to the centre of the next
                (None, Some(cell)) => match self.next(cell) {
                    Some(next) => (self.space.middle(next), Some(next)),
                    // the cubes around the target: it is visible, but a body may not have room
                    None if self.space.is_clear(here, self.target, 0.0) => (self.target, None),
                    None => return Err(fail("no way leads there")),
                },
                (None, None) => match self.by(here) {
                    Some((cell, _)) => (self.space.middle(cell), Some(cell)),
                    None => return Err(fail("no way leads there")),
                },
            };
            (here, node) = next;
            way.push(here);
            if here == self.target {
                return Ok(way);
            }
        }
    }

    /// Returns a smooth curve from a place to the target.
    ///
    /// # Errors
    /// As [`path`](Self::path); values of the smoothing out of their limits.
    pub fn spine(&self, from: Vec3, smoothing: Smoothing) -> Result<Spine, Error> {
        Spine::new(&self.space, &self.path(from)?, smoothing)
    }

    /// Whether a body moves straight from one place to another; a body that starts in contact with an obstacle comes no
    /// closer.
    fn is_clear(&self, from: Vec3, to: Vec3) -> bool {
        self.space.is_clear(from, to, 0.999 * self.space.radius)
    }

    /// Returns a step down the slope, if a body has room along it and the route gets shorter.
    fn downstep(&self, here: Vec3) -> Option<Vec3> {
        let step = STEP * self.space.cell();
        let next = here + self.downhill(here)? * step;
        let (_, before) = self.by(here)?;
        let (_, after) = self.by(next)?;
        let room = self.space.nearest(next).distance >= self.space.radius;
        (room && after <= before - PROGRESS * step && self.is_clear(here, next)).then_some(next)
    }

    /// Returns the linked cube with the shortest route, if it is shorter than from this cube.
    fn next(&self, cell: usize) -> Option<usize> {
        let (links, strides) = (self.space.links[cell], self.space.lattice.strides());
        let sides = (0..6).filter(|side| links >> side & 1 == 1);
        let beside = sides.map(|side| if side % 2 == 1 { cell + strides[side / 2] } else { cell - strides[side / 2] });
        let shortest = beside.reduce(|a, b| if self.lengths[b] < self.lengths[a] { b } else { a })?;
        (self.lengths[shortest] < self.lengths[cell]).then_some(shortest)
    }
}

//! Passages at the corners of a path, and the place where an agent that keeps its lateral position goes through them.

use super::Path;
use super::mesh::NavMesh;
use super::visible::CoverScratch;
use glam::DVec2;

/// Half of the maximum width of a passage, metres.
const WIDEST: f64 = 1.0;
/// Distance before a passage at which it counts as passed, metres.
const PASSED: f64 = 0.1;
/// Maximum ratio of the distance from the corner to the distance from the walls beside it.
const MITRE: f64 = 1.15;

/// Maximum distance to each side of a path at which its width is measured, and the spacing of the measurements, metres.
const BROAD: f64 = 5.0;
const BETWEEN_LOOKS: f64 = 0.25;

/// The bend of a path at a corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct CornerBend {
    corner: DVec2,
    /// Unit vector away from the corner, on the bisector of the directions in which the path comes and goes on.
    away: DVec2,
    /// Unit vector across `away`, in the direction of the path.
    along: DVec2,
    /// Metres from the corner for each metre from the walls.
    mitre: f64,
}

impl CornerBend {
    /// Returns the bend at the middle of three points; none if the path goes straight on.
    pub fn of([before, corner, after]: [DVec2; 3]) -> Option<Self> {
        let (come, go) = ((corner - before).try_normalize()?, (after - corner).try_normalize()?);
        let away = (come - go).try_normalize()?;
        let along = away.perp() * away.perp_dot(come).signum();
        Some(Self { corner, away, along, mitre: (1.0 / along.dot(come).max(1.0 / MITRE)) })
    }

    /// Whether an agent has passed the corner.
    pub fn is_passed(&self, at: DVec2) -> bool {
        (at - self.corner).dot(self.along) > -PASSED
    }

    /// Returns half of the width of the passage.
    pub fn half_width(&self, mesh: &NavMesh) -> f64 {
        0.5 * mesh.reach(self.corner, self.corner + self.away * (2.0 * WIDEST), &mut CoverScratch::default())
    }

    /// Returns the unit vector across the way from `at` to the corner, away from the wall that the path bends around.
    pub fn across(&self, at: DVec2) -> DVec2 {
        let across = (self.corner - at).perp().normalize_or_zero();
        if across.dot(self.away) < 0.0 { -across } else { across }
    }

    /// Returns the place where an agent that keeps `off` metres from the walls goes through.
    pub fn place(&self, off: f64, half_width: f64) -> DVec2 {
        self.corner + self.away * (off * self.mitre).min(half_width)
    }

    /// Whether the straight way from `at` to `to` passes farther from the corner than `place`.
    pub fn is_outside(&self, at: DVec2, to: DVec2, place: DVec2) -> bool {
        let way = to - at;
        way.perp_dot(place - at) * way.perp_dot(self.corner - at) > 0.0
    }
}

impl NavMesh {
    /// Returns the minimum width, metres from wall to wall, of the last `metres` of a path on the mesh; at most 2
    /// [`BROAD`].
    pub(crate) fn narrowest(&self, path: &Path, metres: f64) -> f64 {
        let (mut rest, mut scratch) = (metres, CoverScratch::default());
        let mut narrowest = 2.0 * BROAD;
        let starts = path.corners.iter().rev().skip(1).chain([&path.start]);
        for (&end, &start) in path.corners.iter().rev().zip(starts) {
            let Some(back) = (start - end).try_normalize() else { continue };
            let (length, across) = (start.distance(end).min(rest), back.perp());
            let looks = (length / BETWEEN_LOOKS).ceil() as u32;
            for look in 0..looks {
                let at = end + back * (f64::from(look) * BETWEEN_LOOKS);
                // more room than at the narrowest place so far does not matter
                let beside = across * BROAD.min(narrowest - 2.0 * self.radius());
                let [left, right] = [beside, -beside].map(|beside| self.reach(at, at + beside, &mut scratch));
                narrowest = narrowest.min(left + right + 2.0 * self.radius());
            }
            rest -= length;
            if rest <= 0.0 {
                break;
            }
        }
        narrowest
    }
}

/// Half of the widths of the passages at the corners of a path, measured when first needed.
#[derive(Clone, Debug, Default)]
pub(super) struct Passages(Vec<f64>);

impl Passages {
    /// Discards the widths from a corner on.
    pub fn forget_from(&mut self, index: usize) {
        self.0.truncate(index);
    }

    /// Returns the half width at a corner; the first call computes it.
    pub fn half_width(&mut self, index: usize, find: impl Fn() -> f64) -> f64 {
        if self.0.len() <= index {
            self.0.resize(index + 1, f64::NAN);
        }
        if self.0[index].is_nan() {
            self.0[index] = find();
        }
        self.0[index]
    }
}

impl PartialEq for Passages {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use crate::navigate::{NavMesh, PathSearch};
    use crate::space::Walkable;
    use glam::DVec2;

    /// Two rooms of 12 m by 12 m, and a door of 1.3 m in the wall of 0.2 m between them.
    fn rooms() -> NavMesh {
        let half = [(0.1, 6.0), (12.0, 6.0), (12.0, -6.0), (0.1, -6.0), (0.1, -0.65)];
        let other = half.iter().rev().map(|&(x, y)| (-x, y));
        let mut outer: Vec<DVec2> = [(0.1, 0.65)].into_iter().chain(half).map(DVec2::from).collect();
        outer.extend(other.map(DVec2::from));
        outer.push(DVec2::new(-0.1, 0.65));
        NavMesh::build(&[Walkable { outer, holes: vec![] }], &[], 0.15, (DVec2::ZERO, DVec2::ZERO)).unwrap()
    }

    #[test]
    fn a_door_is_the_narrowest_place() {
        let mesh = rooms();
        let narrowest = |from: [f64; 2], to: [f64; 2], metres: f64| {
            let path = mesh.path(&mut PathSearch::new(), from.into(), to.into()).unwrap();
            mesh.narrowest(&path, metres)
        };
        for from in [[-5.0, 0.0], [-5.0, 5.0], [-0.5, 5.0]] {
            let door = narrowest(from, [4.0, 0.0], 10.0);
            assert!((1.1..1.4).contains(&door), "through the door from {from:?}: {door}");
        }
        let room = narrowest([-5.0, 0.0], [4.0, 0.0], 3.0);
        assert!(room > 9.9, "beyond it there is room: {room}");
    }
}

//! Passages at the corners of a path: where an agent that keeps its lateral place goes through them.

use super::Path;
use super::mesh::NavMesh;
use glam::DVec2;

/// Half of the width that a passage has at most, metres.
const WIDEST: f64 = 1.0;
/// An agent this near to a passage has passed it, metres.
const PASSED: f64 = 0.1;
/// How much farther from the corner than from the walls beside it the place is, at most.
const MITRE: f64 = 1.15;

/// Metres to each side of a path up to which its width is measured, and between two places where it is.
const BROAD: f64 = 5.0;
const BETWEEN_LOOKS: f64 = 0.25;

/// How a path bends at a corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    corner: DVec2,
    /// Unit vector away from the corner, half way between the directions in which the path comes and goes on.
    away: DVec2,
    /// Unit vector across that, the way the path goes.
    along: DVec2,
    /// Metres from the corner for each metre from the walls.
    mitre: f64,
}

impl Bend {
    /// The bend at the middle one of three points; none if the path goes straight on.
    pub fn of([before, corner, after]: [DVec2; 3]) -> Option<Self> {
        let (come, go) = ((corner - before).try_normalize()?, (after - corner).try_normalize()?);
        let away = (come - go).try_normalize()?;
        let along = away.perp() * away.perp_dot(come).signum();
        Some(Self { corner, away, along, mitre: (1.0 / along.dot(come).max(1.0 / MITRE)) })
    }

    /// Whether an agent is beyond it.
    pub fn is_passed(&self, at: DVec2) -> bool {
        (at - self.corner).dot(self.along) > -PASSED
    }

    /// Half of the width of the passage.
    pub fn half_width(&self, mesh: &NavMesh) -> f64 {
        0.5 * mesh.reach(self.corner, self.corner + self.away * (2.0 * WIDEST))
    }

    /// Unit vector across the way from `at` to the corner, away from the wall that it bends round.
    pub fn across(&self, at: DVec2) -> DVec2 {
        let across = (self.corner - at).perp().normalize_or_zero();
        if across.dot(self.away) < 0.0 { -across } else { across }
    }

    /// Where an agent that is `off` metres from the walls goes through.
    pub fn place(&self, off: f64, half_width: f64) -> DVec2 {
        self.corner + self.away * (off * self.mitre).min(half_width)
    }

    /// Whether the straight way from `at` to `to` goes through farther out than `place`.
    pub fn is_outside(&self, at: DVec2, to: DVec2, place: DVec2) -> bool {
        let way = to - at;
        way.perp_dot(place - at) * way.perp_dot(self.corner - at) > 0.0
    }
}

impl NavMesh {
    /// Width of the narrowest place on the last metres of a path on the mesh, metres, from wall to wall; 2 [`BROAD`] at most.
    pub(crate) fn narrowest(&self, path: &Path, metres: f64) -> f64 {
        let mut left = metres;
        let mut narrowest = 2.0 * BROAD;
        let starts = path.corners.iter().rev().skip(1).chain([&path.start]);
        for (&end, &start) in path.corners.iter().rev().zip(starts) {
            let Some(back) = (start - end).try_normalize() else { continue };
            let (length, across) = (start.distance(end).min(left), back.perp() * BROAD);
            let looks = (length / BETWEEN_LOOKS).ceil() as u32;
            for look in 0..looks {
                let at = end + back * (f64::from(look) * BETWEEN_LOOKS);
                let free = self.reach(at, at + across) + self.reach(at, at - across) + 2.0 * self.radius();
                narrowest = narrowest.min(free);
            }
            left -= length;
            if left <= 0.0 {
                break;
            }
        }
        narrowest
    }
}

/// Half of the widths of the passages at the corners of a path, as far as they are known.
#[derive(Clone, Debug, Default)]
pub(super) struct Passages(Vec<f64>);

impl Passages {
    /// Forgets those at a corner and beyond.
    pub fn forget_from(&mut self, index: usize) {
        self.0.truncate(index);
    }

    /// That at a corner; it is found the first time.
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
    use crate::navigate::{NavMesh, Search};
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
            let path = mesh.path(&mut Search::new(), from.into(), to.into()).unwrap();
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

//! Passages at the corners of a path: where an agent that keeps its lateral place goes through them.

use super::mesh::NavMesh;
use glam::DVec2;

/// Half of the width that a passage has at most, metres.
const WIDEST: f64 = 1.0;
/// An agent this near to a passage has passed it, metres.
const PASSED: f64 = 0.1;
/// How much farther from the corner than from the walls beside it the place is, at most.
const MITRE: f64 = 1.15;

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

/// Half of the widths of the passages at the corners of a path, as far as they are known.
#[derive(Clone, Debug, Default)]
pub(super) struct Passages(Vec<f64>);

impl Passages {
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

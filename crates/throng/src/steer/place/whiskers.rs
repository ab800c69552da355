//! Whiskers: obstacle avoidance by a few rays, as gdx-ai has it (RaycastObstacleAvoidance).

use super::Barriers;
use crate::Error;
use crate::motion::{Steering, turned};
use crate::steer::{Behaviour, Reason, View, Why};
use std::f32::consts::PI;

/// A ray that an agent feels its way with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whisker {
    /// How far to the left of its centre it starts, metres; negative to the right.
    pub beside: f32,
    /// How far to the left of ahead it points, radians. Limit: -pi to pi.
    pub angle: f32,
    /// Its length, metres. Limit: > 0.
    pub length: f32,
}

/// Turns away from what its whiskers touch: goes to a point off the surface, before the nearest touch. Nothing to correct
/// while they touch nothing.
///
/// Cheap, but rays miss what is thin, and two that feel both sides of one thing may disagree in turn: put them into a
/// [`Hold`](crate::steer::Hold).  [`AvoidObstacles`](super::AvoidObstacles) misses nothing.
///
/// ```
/// use glam::Vec3;
/// use throng::space::surface::{Plane, SeenFrom};
/// use throng::steer::{Barriers, Behaviour, View, Whiskers, Why};
///
/// let wall = Plane::new(Vec3::X * 2.0, Vec3::new(-1.0, 1.0, 0.0))?;
/// let whiskers = Whiskers::fan(Barriers::default().with(wall, SeenFrom::Outside), 3.0, 1.0, 0.6);
/// let steering = whiskers.steer(&View::default(), &mut [], &mut Why::default()).expect("it is ahead");
/// assert!(steering.force.y > 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Whiskers {
    /// What it avoids.
    pub barriers: Barriers,
    /// The rays.
    pub whiskers: Vec<Whisker>,
    /// How far off the surface the point is that it goes to, metres. Limit: > 0.
    pub clearance: f32,
}

impl Whiskers {
    /// A single one ahead.
    pub fn single(barriers: Barriers, length: f32) -> Self {
        Self { barriers, whiskers: vec![Whisker { beside: 0.0, angle: 0.0, length }], clearance: 1.0 }
    }

    /// One ahead from each side, so far apart, metres.
    pub fn parallel(barriers: Barriers, length: f32, apart: f32) -> Self {
        let whiskers = [0.5, -0.5].map(|side| Whisker { beside: side * apart, angle: 0.0, length });
        Self { whiskers: whiskers.into(), ..Self::single(barriers, length) }
    }

    /// One ahead, and one to each side at an angle, radians, of another length.
    pub fn fan(barriers: Barriers, length: f32, side_length: f32, angle: f32) -> Self {
        let mut fan = Self::single(barriers, length);
        fan.whiskers.extend([angle, -angle].map(|angle| Whisker { beside: 0.0, angle, length: side_length }));
        fan
    }
}

/// Of touches as far away as this, within rounding, that of the first whisker counts.
const NEARER: f32 = 0.999;

impl Behaviour for Whiskers {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let basis = &view.motion.basis;
        let touch = |whisker: &Whisker| {
            let start = view.position() + basis.side * whisker.beside;
            let direction = turned(basis.forward, basis.up, whisker.angle);
            why.note(|| Reason::Feels(start + direction * whisker.length));
            self.barriers.ahead(start, direction, 0.0, whisker.length).map(|(_, hit)| hit)
        };
        let hit = self
            .whiskers
            .iter()
            .filter_map(touch)
            .reduce(|a, b| if b.distance < NEARER * a.distance { b } else { a })?;
        why.note(|| Reason::Expects(hit.point));
        // straight at a surface its normal says no side, but the hint does
        let off = view.passable(hit.free() + hit.steer_hint).normalize_or(-basis.forward);
        view.seek(hit.point + off * self.clearance, why)
    }

    fn check(&self) -> Result<(), Error> {
        for whisker in &self.whiskers {
            Error::unless(whisker.beside.is_finite(), "start of a whisker", whisker.beside, "finite")?;
            Error::unless((-PI..=PI).contains(&whisker.angle), "angle of a whisker", whisker.angle, "from -pi to pi")?;
            Error::unless_positive("length of a whisker", whisker.length)?;
        }
        Error::unless_positive("clearance", self.clearance)
    }
}

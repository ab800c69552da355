//! Whiskers: obstacle avoidance by a few rays, as in gdx-ai (RaycastObstacleAvoidance).

use std::f32::consts::PI;
use throng::Error;
use throng::motion::{Steering, turned};
use throng::steer::Barriers;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// A ray of a fixed length from the agent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whisker {
    /// Distance of its start to the left of the agent's centre, metres; negative to the right.
    pub beside: f32,
    /// Angle to the left of the forward direction, radians. Limit: -pi to pi.
    pub angle: f32,
    /// Length, metres. Limit: > 0.
    pub length: f32,
}

/// Turns away from surfaces that the whiskers touch: seeks a point off the surface at the nearest touch. Nothing to
/// correct while the whiskers touch nothing.
///
/// The behaviour is cheap, but rays miss thin obstacles, and two rays on both sides of one obstacle may disagree in
/// turn: put the whiskers into a [`Hold`](crate::Hold). [`AvoidObstacles`](super::AvoidObstacles) misses
/// nothing.
///
/// ```
/// use glam::Vec3;
/// use throng::space::surface::{Plane, SeenFrom};
/// use throng::steer::{Barriers, Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::Whiskers;
///
/// let wall = Plane::new(Vec3::X * 2.0, Vec3::new(-1.0, 1.0, 0.0))?;
/// let whiskers = Whiskers::fan(Barriers::default().with(wall, SeenFrom::Outside), 3.0, 1.0, 0.6);
/// let steering = whiskers.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()).expect("it is ahead");
/// assert!(steering.force.y > 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Whiskers {
    /// The obstacles.
    pub barriers: Barriers,
    /// The rays.
    pub whiskers: Vec<Whisker>,
    /// Distance of the sought point from the surface, metres. Limit: > 0.
    pub clearance: f32,
}

impl Whiskers {
    /// Returns a single whisker straight ahead.
    pub fn single(barriers: Barriers, length: f32) -> Self {
        Self { barriers, whiskers: vec![Whisker { beside: 0.0, angle: 0.0, length }], clearance: 1.0 }
    }

    /// Returns two whiskers straight ahead, one from each side, with a distance between them, metres.
    pub fn parallel(barriers: Barriers, length: f32, apart: f32) -> Self {
        let whiskers = [0.5, -0.5].map(|side| Whisker { beside: side * apart, angle: 0.0, length });
        Self { whiskers: whiskers.into(), ..Self::single(barriers, length) }
    }

    /// Returns one whisker straight ahead, and one to each side at an angle, radians, with a length of their own.
    pub fn fan(barriers: Barriers, length: f32, side_length: f32, angle: f32) -> Self {
        let mut fan = Self::single(barriers, length);
        fan.whiskers.extend([angle, -angle].map(|angle| Whisker { beside: 0.0, angle, length: side_length }));
        fan
    }
}

/// Touches at equal distances, within rounding: the touch of the first whisker counts.
const NEARER: f32 = 0.999;

impl Behaviour for Whiskers {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let basis = &view.motion.basis;
        let touch = |whisker: &Whisker| {
            let start = view.position() + basis.side * whisker.beside;
            let direction = turned(basis.forward, basis.up, whisker.angle);
            why.note(|| SteeringReason::Feels(start + direction * whisker.length));
            self.barriers.ahead(start, direction, 0.0, whisker.length).map(|(_, hit)| hit)
        };
        let hit = self
            .whiskers
            .iter()
            .filter_map(touch)
            .reduce(|a, b| if b.distance < NEARER * a.distance { b } else { a })?;
        why.note(|| SteeringReason::Expects(hit.point));
        // where the whisker meets the surface head-on the normal gives no side, but the hint does
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

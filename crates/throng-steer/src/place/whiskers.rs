//! Whiskers: obstacle avoidance by a few rays, as in gdx-ai (RaycastObstacleAvoidance).

use throng::Error;
use throng::motion::{Steering, turned};
use throng::parameters::{Angle, Value, parameters};
use throng::steer::{Barriers, Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// A whisker.
///
/// A ray of a fixed length from the agent.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whisker {
    /// Its length, metres.
    #[parameter(required, unit = "m", above = 0)]
    pub length: f32,
    /// Its angle to the left of ahead, degrees.
    #[parameter(unit = "°", least = -180, most = 180)]
    pub angle: Angle,
    /// Offset of its start to the left of the agent's centre, metres.
    #[parameter(unit = "m")]
    pub beside: f32,
}

/// Moves away from what its whiskers touch, as in gdx-ai.
///
/// It seeks a point off the surface at the nearest touch. Nothing to correct while the whiskers touch nothing.
///
/// The behaviour is cheap, but rays miss thin obstacles, and two rays on both sides of one obstacle may disagree in
/// turn: put the whiskers into a [`Hold`](crate::Hold). [`AvoidObstacles`](super::AvoidObstacles) misses
/// nothing.
///
/// ```
/// use glam::Vec3;
/// use throng::space::surface::{Plane, SeenFrom};
/// use throng::steer::{Barriers, Behaviour, SteeringInput, TraceRecorder};
/// use throng::parameters::Angle;
/// use throng_steer::Whiskers;
///
/// let wall = Plane::new(Vec3::X * 2.0, Vec3::new(-1.0, 1.0, 0.0))?;
/// let whiskers = Whiskers::fan(Barriers::default().with(wall, SeenFrom::Outside), 3.0, 1.0, Angle::degrees(35.0));
/// let steering = whiskers.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()).expect("it is ahead");
/// assert!(steering.force.y > 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Whiskers {
    /// The obstacles.
    #[parameter(absent = "everything")]
    pub obstacles: Barriers,
    /// The whiskers. Without them, one of 2 m ahead, and one of 1 m to each side, 35° from ahead.
    #[parameter(default = fan(2.0, 1.0, Angle::from_radians(0.61)))]
    pub rays: Vec<Whisker>,
    /// Distance of the point that it moves to from the touched surface, metres.
    #[parameter(default = 1.0, unit = "m", above = 0)]
    pub clearance: f32,
}

impl Whiskers {
    /// Returns a single whisker straight ahead.
    pub fn single(obstacles: Barriers, length: f32) -> Self {
        Self { obstacles, rays: vec![Whisker::new(length)], ..Self::default() }
    }

    /// Returns two whiskers straight ahead, one from each side, with a distance between them, metres.
    pub fn parallel(obstacles: Barriers, length: f32, apart: f32) -> Self {
        let rays = [0.5, -0.5].map(|side| Whisker { beside: side * apart, ..Whisker::new(length) });
        Self { obstacles, rays: rays.into(), ..Self::default() }
    }

    /// Returns one whisker straight ahead, and one to each side at an angle, with a length of their own.
    pub fn fan(obstacles: Barriers, length: f32, side_length: f32, angle: Angle) -> Self {
        Self { obstacles, rays: fan(length, side_length, angle), ..Self::default() }
    }
}

/// Returns one whisker straight ahead, and one to each side at an angle.
fn fan(length: f32, side_length: f32, angle: Angle) -> Vec<Whisker> {
    let right = Angle::from_radians(-angle.radians());
    let sides = [angle, right].map(|angle| Whisker { angle, ..Whisker::new(side_length) });
    [Whisker::new(length)].into_iter().chain(sides).collect()
}

/// Touches at equal distances, within rounding: the touch of the first whisker counts.
const NEARER: f32 = 0.999;

impl Behaviour for Whiskers {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let basis = &view.motion.basis;
        let touch = |whisker: &Whisker| {
            let start = view.position() + basis.side * whisker.beside;
            let direction = turned(basis.forward, basis.up, whisker.angle.radians());
            why.note(|| SteeringReason::Feels(start + direction * whisker.length));
            self.obstacles.ahead(start, direction, 0.0, whisker.length).map(|(_, hit)| hit)
        };
        let touches = self.rays.iter().filter_map(touch);
        let hit = touches.reduce(|a, b| if b.distance < NEARER * a.distance { b } else { a })?;
        why.note(|| SteeringReason::Hits { point: hit.point, normal: hit.free() });
        // where the whisker meets the surface head-on the normal gives no side, but the hint does
        let off = view.passable(hit.free() + hit.steer_hint).normalize_or(-basis.forward);
        view.seek(hit.point + off * self.clearance, why)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

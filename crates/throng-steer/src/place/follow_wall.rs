//! Wall following: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::course::Course;
use glam::Vec3;
use throng::Error;
use throng::motion::{Basis, Steering};
use throng::parameters::{Value, parameters};
use throng::steer::{Barriers, Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Moves along a wall (Reynolds 1999).
///
/// It moves along the nearest wall, at a distance. The wall stays on the left or the right hand, where it was first.
/// Nothing to correct where no wall is near.
///
/// The behaviour predicts the agent's position, or the point of a wall that the agent would hit before. It takes the
/// nearest point of the wall, goes out along the normal there and on along the wall, and seeks that place.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Motion;
/// use throng::space::surface::{Plane, SeenFrom};
/// use throng::steer::{Barriers, Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::FollowWall;
///
/// let wall = Plane::new(Vec3::Y * -1.0, Vec3::Y)?;
/// let follow = FollowWall { offset: 0.5, ..FollowWall::from(Barriers::default().with(wall, SeenFrom::Outside)) };
/// let view = SteeringInput { motion: Motion::moving(Vec3::ZERO, Vec3::X), ..SteeringInput::default() };
/// let steering = follow.steer(&view, &mut [0.0], &mut TraceRecorder::default()).expect("the wall is near");
/// assert!(steering.force.y < 0.0, "it is too far from it");
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct FollowWall {
    /// The walls.
    #[parameter(absent = "everything")]
    pub obstacles: Barriers,
    /// Distance between the wall and its centre, metres.
    #[parameter(default = 1.0, unit = "m", above = 0)]
    pub offset: f32,
    /// How far ahead it looks, seconds.
    #[parameter(default = 0.3, unit = "s", above = 0)]
    pub horizon: f32,
    /// Greatest distance of a wall that counts, metres.
    #[parameter(default = 5.0, unit = "m", above = 0, infinite)]
    pub range: f32,
}

impl From<Barriers> for FollowWall {
    fn from(obstacles: Barriers) -> Self {
        Self { obstacles, ..Self::default() }
    }
}

impl Behaviour for FollowWall {
    /// The hand on which the wall is: 1 left, -1 right; 0 if the agent follows no wall.
    fn memory(&self) -> usize {
        1
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [hand] = memory else { return None };
        let course = Course::new(view, 0.0, self.horizon);
        let here = self.obstacles.nearest(view.position()).filter(|here| here.distance.abs() <= self.range);
        let Some(here) = here else {
            *hand = 0.0;
            return None;
        };
        // the agent turns before it comes nearer than the offset to a wall across its way
        let reach = view.motion.speed() * self.horizon + self.offset;
        why.note(|| SteeringReason::Feels(view.position() + course.basis.forward * reach));
        let ahead = self.obstacles.ahead(view.position(), course.basis.forward, 0.0, reach).map(|(_, hit)| hit);
        let (point, free) = match ahead {
            Some(hit) => (hit.point, hit.free()),
            None => {
                let near = self.obstacles.nearest(view.motion.position_in(self.horizon))?;
                (near.point, near.free())
            }
        };
        let along = along(&course.basis, free, hand);
        let place = point + free * self.offset + along * self.offset.min(view.vehicle.max_speed * self.horizon);
        why.note(|| SteeringReason::Projects { from: view.motion.position_in(self.horizon), to: point });
        let force = view.seek(place, why)?.force;
        let surfaces = ahead.map(|hit| (hit.point, hit.free()));
        Some(course.held_off(force, surfaces.into_iter().chain([(here.point, here.free())])))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// An agent climbs or dives along a wall if the component of its direction along the wall is greater than this, and the
/// level part of that component is less than this part of it.
const STEEP: f32 = 0.5;

/// Cosine of the angle to the wall's level direction at which the angle counts as a right angle: then the agent turns
/// left, and has the wall on its right.
const STRAIGHT: f32 = 1e-4;

/// Returns the direction along a wall with this normal that keeps the wall on the same hand and the agent at its
/// height. An agent that goes up or down along the wall, or along a floor, keeps its direction.
fn along(basis: &Basis, free: Vec3, hand: &mut f32) -> Vec3 {
    let level = basis.up.cross(free).normalize_or_zero();
    let on = basis.forward.reject_from_normalized(free);
    if level == Vec3::ZERO || on.length() > STEEP && level.dot(on).abs() < STEEP * on.length() {
        return on.normalize_or(basis.forward);
    }
    // `level` leads on with the wall on the right
    if *hand == 0.0 {
        *hand = if level.dot(basis.forward) > -STRAIGHT { -1.0 } else { 1.0 };
    }
    level * -*hand
}

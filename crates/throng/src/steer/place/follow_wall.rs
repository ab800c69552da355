//! Wall following: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::Barriers;
use super::course::Course;
use crate::Error;
use crate::motion::{Basis, Steering};
use crate::steer::{Behaviour, Reason, View, Why};
use glam::Vec3;

/// Goes along the nearest wall at a distance, with the wall on its left or right hand, wherever it first had it. Nothing to
/// correct where no wall is near.
///
/// It expects to be somewhere soon, or at the wall that it would run into before; from the point of the wall nearest to
/// that it goes out along the normal, and on along the wall.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Motion;
/// use throng::space::surface::{Plane, SeenFrom};
/// use throng::steer::{Barriers, Behaviour, FollowWall, View, Why};
///
/// let wall = Plane::new(Vec3::Y * -1.0, Vec3::Y)?;
/// let follow = FollowWall { offset: 0.5, ..FollowWall::from(Barriers::default().with(wall, SeenFrom::Outside)) };
/// let view = View { motion: Motion::moving(Vec3::ZERO, Vec3::X), ..View::default() };
/// let steering = follow.steer(&view, &mut [0.0], &mut Why::default()).expect("the wall is near");
/// assert!(steering.force.y < 0.0, "it is too far from it");
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct FollowWall {
    /// The walls.
    pub barriers: Barriers,
    /// How far from the wall its centre goes, metres. Limit: > 0.
    pub offset: f32,
    /// How far ahead it looks, seconds. Limit: > 0.
    pub seconds: f32,
    /// How near a wall must be, metres. Limit: > 0.
    pub range: f32,
}

impl From<Barriers> for FollowWall {
    fn from(barriers: Barriers) -> Self {
        Self { barriers, offset: 1.0, seconds: 0.3, range: 5.0 }
    }
}

impl Behaviour for FollowWall {
    /// On which hand it has the wall: 1 left, -1 right; 0 if it follows none.
    fn memory(&self) -> usize {
        1
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let [hand] = memory else { return None };
        let course = Course::new(view, 0.0, self.seconds);
        let here = self.barriers.nearest(view.position()).filter(|here| here.distance.abs() <= self.range);
        let Some(here) = here else {
            *hand = 0.0;
            return None;
        };
        // it turns when it would come nearer than that to a wall across its way
        let reach = view.motion.speed() * self.seconds + self.offset;
        why.note(|| Reason::Feels(view.position() + course.basis.forward * reach));
        let ahead = self.barriers.ahead(view.position(), course.basis.forward, 0.0, reach).map(|(_, hit)| hit);
        let (point, free) = match ahead {
            Some(hit) => (hit.point, hit.free()),
            None => {
                let near = self.barriers.nearest(view.motion.position_in(self.seconds))?;
                (near.point, near.free())
            }
        };
        let along = along(&course.basis, free, hand);
        let place = point + free * self.offset + along * self.offset.min(view.vehicle.max_speed * self.seconds);
        why.note(|| Reason::Expects(point));
        let force = view.seek(place, why)?.force;
        let surfaces = ahead.map(|hit| (hit.point, hit.free()));
        Some(course.held_off(force, surfaces.into_iter().chain([(here.point, here.free())])))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("offset from the wall", self.offset)?;
        Error::unless_positive("horizon", self.seconds)?;
        Error::unless(self.range > 0.0, "range", self.range, "greater than 0")
    }
}

/// Who goes along a wall by more than this part of its way, and less than this part of that level, climbs or dives.
const STEEP: f32 = 0.5;

/// Cosine of the angle to a wall's level within rounding of a right angle: then it turns left, and has the wall on its right.
const STRAIGHT: f32 = 1e-4;

/// The direction along a wall of this normal that keeps it on the same hand, at the same height; who goes up or down along
/// it, or along a floor, goes on so.
fn along(basis: &Basis, free: Vec3, hand: &mut f32) -> Vec3 {
    let level = basis.up.cross(free).normalize_or_zero();
    let on = basis.forward.reject_from_normalized(free);
    if level == Vec3::ZERO || on.length() > STEEP && level.dot(on).abs() < STEEP * on.length() {
        return on.normalize_or(basis.forward);
    }
    // level leads on with the wall on the right
    if *hand == 0.0 {
        *hand = if level.dot(basis.forward) > -STRAIGHT { -1.0 } else { 1.0 };
    }
    level * -*hand
}

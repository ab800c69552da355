//! Obstacle avoidance: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::course::Course;
use glam::Vec3;
use std::f32::consts::PI;
use throng::Error;
use throng::motion::{Steering, angle_between, turned};
use throng::parameters::{Value, parameters};
use throng::space::surface::PathIntersection;
use throng::steer::{Barriers, Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Avoids obstacles in its way (Reynolds 1999).
///
/// Nothing to correct while the way ahead is free and the way back to the preferred direction is free of the obstacle
/// that was passed.
///
/// The way ahead is the cylinder that the body sweeps in some seconds. The nearest obstacle in it counts. The agent
/// turns to the side that costs less: a smaller turn past the obstacle, and a smaller turn back to the preferred
/// direction. It turns more the nearer the obstacle is, and brakes where turning is not enough. It keeps to that side
/// of that obstacle for a while, unless the other side becomes better by a fifth: this prevents hesitation. An agent on
/// the wrong side of a surface comes back first.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Motion;
/// use throng::space::surface::{SeenFrom, Sphere};
/// use throng::steer::{Barriers, Behaviour, SteeringInput, Target, TraceRecorder};
/// use throng_steer::{AvoidObstacles, Priority, Seek};
///
/// let pillar = Sphere::new(Vec3::new(3.0, 0.1, 0.0), 1.0)?;
/// let avoid = AvoidObstacles::from(Barriers::default().with(pillar, SeenFrom::Outside));
/// let view = SteeringInput { motion: Motion::moving(Vec3::ZERO, Vec3::X), ..SteeringInput::default() };
/// let steering = avoid.steer(&view, &mut [0.0; 4], &mut TraceRecorder::default()).expect("it is in the way");
/// assert!(steering.force.y < 0.0, "past it on the right");
/// let walk = Priority { epsilon: 0.0, parts: vec![avoid.into(), Seek { target: Target::Goal }.into()] };
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct AvoidObstacles {
    /// The obstacles.
    #[parameter(absent = "everything")]
    pub obstacles: Barriers,
    /// The target: it decides the side on which the agent passes. If it does not exist, straight ahead.
    #[parameter(default = Target::Goal)]
    pub towards: Target,
    /// How far ahead it looks, seconds; farther if it turns slowly.
    #[parameter(default = HORIZON, unit = "s", above = 0)]
    pub horizon: f32,
    /// Gap between its body and obstacles, metres.
    #[parameter(default = 0.15, unit = "m", least = 0)]
    pub gap: f32,
    /// Seconds for which it keeps to a side of an obstacle that is no longer in the way.
    #[parameter(default = KEEPS, unit = "s", least = 0)]
    pub keeps: f32,
}

impl From<Barriers> for AvoidObstacles {
    fn from(obstacles: Barriers) -> Self {
        Self { obstacles, ..Self::default() }
    }
}

/// Default look-ahead, seconds.
const HORIZON: f32 = 2.0;
/// Default time for which a side is kept, seconds.
const KEEPS: f32 = 1.5;

/// Factor on the cost of the side that is kept.
const KEPT: f32 = 0.8;
/// Costs that differ by less are equal within rounding: the first counts.
const EQUAL: f32 = 1e-3;
/// Angle between two directions that are tried, radians.
const STEP: f32 = PI / 12.0;
/// Number of directions that are tried on a side.
const TRIES: u8 = 11;
/// Least speed in passing, as a part of the top speed.
const SLOW: f32 = 0.5;

impl Behaviour for AvoidObstacles {
    fn memory(&self) -> usize {
        Passing::MEMORY
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let preferred = self.towards.find(view).map(|mark| view.to(mark.position));
        let Self { ref obstacles, horizon, gap, keeps, .. } = *self;
        Passing { obstacles, horizon, gap, keeps }.avoid(preferred, view, memory, why)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// How an agent passes obstacles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passing<'o> {
    obstacles: &'o Barriers,
    horizon: f32,
    gap: f32,
    keeps: f32,
}

impl<'o> Passing<'o> {
    /// The obstacle that was avoided last, counted from 1; the seconds for which the side is still kept; the side, as
    /// left and up.
    pub const MEMORY: usize = 4;

    /// Returns how an agent passes obstacles with a gap, metres.
    pub const fn with_gap(obstacles: &'o Barriers, gap: f32) -> Self {
        Self { obstacles, horizon: HORIZON, gap, keeps: KEEPS }
    }

    /// Steers round obstacles on the way to a preferred direction; straight ahead if it is `None`.
    pub fn avoid(
        &self,
        preferred: Option<Vec3>,
        view: &SteeringInput<'_>,
        memory: &mut [f32],
        why: &mut TraceRecorder<'_>,
    ) -> Option<Steering> {
        let [which, left, side @ ..] = memory else { return None };
        *left = (*left - view.seconds).max(0.0);
        let course = self.course(view, preferred);
        let preferred = preferred.and_then(Vec3::try_normalize).unwrap_or(course.basis.forward);
        let kept = |index| {
            let side = course.basis.to_world(Vec3::new(0.0, side[0], side[1]));
            (*left > 0.0 && *which == (index + 1) as f32).then_some(side)
        };
        // within the gap of one obstacle the swept cylinder touches that obstacle and hides what comes after it; its
        // axis does not
        let beyond = self.obstacles.ahead(view.position(), course.basis.forward, 0.0, course.reach);
        why.note(|| SteeringReason::Cylinder {
            from: view.position(),
            to: view.position() + course.basis.forward * course.reach,
            radius: course.radius,
        });
        let here = self.obstacles.nearest(view.position()).map(|here| (here.point, here.free()));
        let near = beyond.map(|(_, hit)| (hit.point, hit.free())).into_iter().chain(here);
        let Some((index, hit)) = self.ahead(view, &course, course.basis.forward) else {
            // an agent that turned back to its goal at once would meet the same obstacle again
            let (index, hit) = self.ahead(view, &course, preferred)?;
            let direction = self.way_out(view, &course, preferred, kept(index)?)?.0;
            *left = self.keeps;
            why.note(|| SteeringReason::Aim(view.position() + direction * course.reach));
            let force = view.reach(direction * view.vehicle.max_speed).force;
            return Some(course.held_off(force, near.chain([(hit.point, hit.free())])));
        };
        why.note(|| SteeringReason::Hits { point: hit.point, normal: hit.free() });
        if self.obstacles.0[index].forbids(hit.vehicle_outside) {
            return view.go(view.passable(hit.steer_hint));
        }
        let (chosen, direction) = self.choose(view, &course, kept(index), hit.free(), preferred);
        let local = course.basis.to_local(chosen);
        (*which, *left) = ((index + 1) as f32, self.keeps);
        side.copy_from_slice(&[local.y, local.z]);
        why.note(|| SteeringReason::Aim(view.position() + direction * course.reach));
        let urgency = 1.0 - hit.distance / course.reach.max(f32::MIN_POSITIVE);
        let speed = view.motion.speed().max(SLOW * view.vehicle.max_speed);
        let force = view.reach(direction * speed).force * urgency;
        Some(course.held_off(force, near.chain([(hit.point, hit.free())])))
    }

    /// Returns the way ahead, no farther than the goal if the agent can stop there.
    fn course<'a>(&self, view: &'a SteeringInput<'a>, preferred: Option<Vec3>) -> Course<'a> {
        let mut course = Course::new(view, self.gap, self.horizon);
        let needed = Course::new(view, self.gap, 0.0).reach;
        course.reach = course.reach.min(preferred.map_or(f32::INFINITY, Vec3::length).max(needed));
        course
    }

    /// Returns the first obstacle in a direction.
    fn ahead(
        &self,
        view: &SteeringInput<'_>,
        course: &Course<'_>,
        direction: Vec3,
    ) -> Option<(usize, PathIntersection)> {
        self.obstacles.ahead(view.position(), direction, course.radius, course.reach)
    }

    /// Returns the side to pass on and the direction that leads past, at the lowest cost. The cost is the turn now and
    /// the turn after that to the preferred direction. If no direction is free, the agent turns back.
    fn choose(
        &self,
        view: &SteeringInput<'_>,
        course: &Course<'_>,
        kept: Option<Vec3>,
        free: Vec3,
        preferred: Vec3,
    ) -> (Vec3, Vec3) {
        let forward = course.basis.forward;
        let aside = course.aside(free);
        let across = forward.cross(aside);
        let sides = [aside, -aside, across, -across];
        let sides = if view.is_on_ground() { &sides[..2] } else { &sides };
        let costs = kept.into_iter().map(|side| (side, KEPT)).chain(sides.iter().map(|&side| (side, 1.0)));
        let ways = costs.map(|(side, part)| {
            let (direction, angle) = self.way_out(view, course, forward, side).unwrap_or((-forward, 2.0 * PI));
            (side, direction, (angle + angle_between(direction, preferred)) * part)
        });
        let best = ways.reduce(|a, b| if b.2 < a.2 - EQUAL { b } else { a });
        best.map_or((aside, -forward), |(side, direction, _)| (side, direction))
    }

    /// Returns the first free direction, turning from `from` to a side of the course, and the angle of that turn.
    fn way_out(&self, view: &SteeringInput<'_>, course: &Course<'_>, from: Vec3, side: Vec3) -> Option<(Vec3, f32)> {
        let axis = course.basis.forward.cross(side);
        let tries = (1..=TRIES).map(|k| f32::from(k) * STEP).map(|angle| (turned(from, axis, angle), angle));
        tries.into_iter().find(|&(direction, _)| self.ahead(view, course, direction).is_none())
    }
}

//! Obstacle avoidance: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::Barriers;
use super::course::Course;
use crate::Error;
use crate::motion::{Steering, angle_between, turned};
use crate::space::surface::PathIntersection;
use crate::steer::{Behaviour, Reason, Target, View, Why};
use glam::Vec3;
use std::f32::consts::PI;

/// Goes round what is in the way. Nothing to correct while the way ahead is free, and that back to where it would like to
/// go from what it went round.
///
/// The way ahead is the cylinder that its body sweeps in some seconds. Of all that is in it the nearest counts. It turns
/// to the side where less of a turn leads past, and nearer to where it would like to go; the more the nearer the obstacle
/// is, and it brakes where turning is not enough. It keeps to that side of that obstacle for a while, unless the other
/// becomes a fifth better: so it does not hesitate. Who is on the wrong side comes back first.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Motion;
/// use throng::space::surface::{SeenFrom, Sphere};
/// use throng::steer::{AvoidObstacles, Barriers, Behaviour, Priority, Seek, Target, View, Why};
///
/// let pillar = Sphere::new(Vec3::new(3.0, 0.1, 0.0), 1.0)?;
/// let avoid = AvoidObstacles::from(Barriers::default().with(pillar, SeenFrom::Outside));
/// let view = View { motion: Motion::moving(Vec3::ZERO, Vec3::X), ..View::default() };
/// let steering = avoid.steer(&view, &mut [0.0; 4], &mut Why::default()).expect("it is in the way");
/// assert!(steering.force.y < 0.0, "past it on the right");
/// let walk = Priority { epsilon: 0.0, parts: vec![avoid.into(), Seek { target: Target::Goal }.into()] };
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct AvoidObstacles {
    /// What it avoids.
    pub barriers: Barriers,
    /// Where it would like to go; straight ahead if that is not there.
    pub towards: Target,
    /// How far ahead it looks, seconds at its present speed; farther if it turns slowly. Limit: > 0.
    pub seconds: f32,
    /// How far from obstacles its body stays, metres. Limit: >= 0.
    pub gap: f32,
    /// How long it keeps to a side of an obstacle once that is no longer in the way, seconds. Limit: >= 0.
    pub keeps: f32,
}

impl From<Barriers> for AvoidObstacles {
    fn from(barriers: Barriers) -> Self {
        Self { barriers, towards: Target::Goal, seconds: 2.0, gap: 0.15, keeps: 1.5 }
    }
}

/// How much less the side that it keeps to costs.
const KEPT: f32 = 0.8;
/// Costs that differ by less are the same, within rounding: the first counts.
const EQUAL: f32 = 1e-3;
/// By how much directions that it tries differ, radians.
const STEP: f32 = PI / 12.0;
/// How many it tries on a side.
const TRIES: u8 = 11;
/// Part of the top speed at least with which it goes round.
const SLOW: f32 = 0.5;

impl Behaviour for AvoidObstacles {
    /// Which obstacle it last avoided, counted from 1; for how many seconds it still keeps to a side of it; which, as left
    /// and up.
    fn memory(&self) -> usize {
        4
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let wish = self.towards.find(view).map(|mark| view.to(mark.position));
        self.avoid(wish, view, memory, why)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("horizon", self.seconds)?;
        Error::unless(self.gap >= 0.0, "gap", self.gap, "0 or more")?;
        Error::unless(self.keeps >= 0.0, "time that a side is kept", self.keeps, "0 or more")
    }
}

impl AvoidObstacles {
    /// Goes round what is in the way on the way that it would like to go, straight ahead if there is none.
    pub(super) fn avoid(
        &self,
        wish: Option<Vec3>,
        view: &View<'_>,
        memory: &mut [f32],
        why: &mut Why<'_>,
    ) -> Option<Steering> {
        let [which, left, side @ ..] = memory else { return None };
        *left = (*left - view.seconds).max(0.0);
        let course = self.course(view, wish);
        let wish = wish.and_then(Vec3::try_normalize).unwrap_or(course.basis.forward);
        let kept = |index| {
            let side = course.basis.to_world(Vec3::new(0.0, side[0], side[1]));
            (*left > 0.0 && *which == (index + 1) as f32).then_some(side)
        };
        // within the gap of one obstacle the way ahead touches that, whatever comes after it: its middle does not
        let beyond = self.barriers.ahead(view.position(), course.basis.forward, 0.0, course.reach);
        why.note(|| Reason::Feels(view.position() + course.basis.forward * course.reach));
        let here = self.barriers.nearest(view.position()).map(|here| (here.point, here.free()));
        let near = beyond.map(|(_, hit)| (hit.point, hit.free())).into_iter().chain(here);
        let Some((index, hit)) = self.ahead(view, &course, course.basis.forward) else {
            // who turned back to its goal at once would meet the same obstacle again
            let (index, hit) = self.ahead(view, &course, wish)?;
            let direction = self.way_out(view, &course, wish, kept(index)?)?.0;
            *left = self.keeps;
            why.note(|| Reason::Aim(view.position() + direction * course.reach));
            let force = view.reach(direction * view.vehicle.max_speed).force;
            return Some(course.held_off(force, near.chain([(hit.point, hit.free())])));
        };
        why.note(|| Reason::Expects(hit.point));
        if self.barriers.0[index].forbids(hit.vehicle_outside) {
            return view.go(view.passable(hit.steer_hint));
        }
        let (chosen, direction) = self.choose(view, &course, kept(index), hit.free(), wish);
        let local = course.basis.to_local(chosen);
        (*which, *left) = ((index + 1) as f32, self.keeps);
        side.copy_from_slice(&[local.y, local.z]);
        why.note(|| Reason::Aim(view.position() + direction * course.reach));
        let urgency = 1.0 - hit.distance / course.reach.max(f32::MIN_POSITIVE);
        let speed = view.motion.speed().max(SLOW * view.vehicle.max_speed);
        let force = view.reach(direction * speed).force * urgency;
        Some(course.held_off(force, near.chain([(hit.point, hit.free())])))
    }

    /// The way ahead, no farther than the goal, if it can stop there.
    fn course<'a>(&self, view: &'a View<'a>, wish: Option<Vec3>) -> Course<'a> {
        let mut course = Course::new(view, self.gap, self.seconds);
        let needed = Course::new(view, self.gap, 0.0).reach;
        course.reach = course.reach.min(wish.map_or(f32::INFINITY, Vec3::length).max(needed));
        course
    }

    /// What is in the way in a direction.
    fn ahead(&self, view: &View<'_>, course: &Course<'_>, direction: Vec3) -> Option<(usize, PathIntersection)> {
        self.barriers.ahead(view.position(), direction, course.radius, course.reach)
    }

    /// The side to pass on, and the direction that leads past: the one that costs least. It costs by how much it turns now,
    /// and by how much after that to where it would like to go. Where nothing is free it turns back.
    fn choose(&self, view: &View<'_>, course: &Course<'_>, kept: Option<Vec3>, free: Vec3, wish: Vec3) -> (Vec3, Vec3) {
        let forward = course.basis.forward;
        let aside = course.aside(free);
        let across = forward.cross(aside);
        let sides = [aside, -aside, across, -across];
        let sides = if view.is_on_ground() { &sides[..2] } else { &sides };
        let costs = kept.into_iter().map(|side| (side, KEPT)).chain(sides.iter().map(|&side| (side, 1.0)));
        let ways = costs.map(|(side, part)| {
            let (direction, angle) = self.way_out(view, course, forward, side).unwrap_or((-forward, 2.0 * PI));
            (side, direction, (angle + angle_between(direction, wish)) * part)
        });
        let best = ways.reduce(|a, b| if b.2 < a.2 - EQUAL { b } else { a });
        best.map_or((aside, -forward), |(side, direction, _)| (side, direction))
    }

    /// The first direction that is free if it turns to a side of its course, starting from another direction, and by how
    /// much it turns.
    fn way_out(&self, view: &View<'_>, course: &Course<'_>, from: Vec3, side: Vec3) -> Option<(Vec3, f32)> {
        let axis = course.basis.forward.cross(side);
        let tries = (1..=TRIES).map(|k| f32::from(k) * STEP).map(|angle| (turned(from, axis, angle), angle));
        tries.into_iter().find(|&(direction, _)| self.ahead(view, course, direction).is_none())
    }
}

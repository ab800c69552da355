//! What a behaviour sees: one agent and what is near it.

use super::{Mark, Why};
use crate::motion::{Locomotion, Motion, Steering, Vehicle, angle_between, part_in, turned_towards};
use crate::random::Dice;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::fmt::Debug;

/// Another agent, seen from the one that steers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// Its centre, from the agent's, metres.
    pub offset: Vec3,
    /// Its velocity, m/s.
    pub velocity: Vec3,
    /// Which way it faces, a vector of length 1.
    pub forward: Vec3,
    /// Radius of its body, metres.
    pub radius: f32,
    /// Its own number.
    pub number: u32,
    /// Index of its group.
    pub group: usize,
}

/// Something that happened: a bang, a shout.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// Where.
    pub position: Vec3,
    /// When, seconds since the start.
    pub time: f64,
}

/// Finds agents wherever they are.
///
/// ```
/// use throng::steer::{Mark, Others, Target, View};
/// #[derive(Debug)]
/// struct Twins;
/// impl Others for Twins {
///     fn find(&self, number: u32) -> Option<Mark> {
///         (number < 2).then(Mark::default)
///     }
/// }
/// let view = View { others: &Twins, ..View::default() };
/// assert!(Target::Agent(1).find(&view).is_some() && Target::Agent(2).find(&view).is_none());
/// ```
pub trait Others: Debug + Sync {
    /// The agent with this number, as it is at the start of the step; `None` if it is not there.
    fn find(&self, number: u32) -> Option<Mark>;
}

/// Nobody else is there.
impl Others for () {
    fn find(&self, _: u32) -> Option<Mark> {
        None
    }
}

/// What a behaviour sees, frozen at the start of the step. The default is a pedestrian at the origin that faces +x, alone.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// Where the agent is and how it moves.
    pub motion: Motion,
    /// What its body can do.
    pub vehicle: Vehicle,
    /// Radius of its body, metres.
    pub radius: f32,
    /// Index of its group.
    pub group: usize,
    /// Its place in the [formation](super::KeepFormation) of its group.
    pub slot: usize,
    /// Where its own journey leads next.
    pub goal: Option<Vec3>,
    /// Others near it, nearest first.
    pub neighbours: &'a [Neighbour],
    /// Anybody else.
    pub others: &'a dyn Others,
    /// What happened lately.
    pub events: &'a [Event],
    /// The figures of the world's [rules](crate::Rules), in their order.
    pub figures: &'a [f64],
    /// Seconds since the start.
    pub time: f64,
    /// Seconds of the step, > 0.
    pub seconds: f32,
    /// What its random numbers depend on; its own number among that.
    pub dice: Dice,
}

impl Default for View<'_> {
    fn default() -> Self {
        Self {
            motion: Motion::default(),
            vehicle: Vehicle::default(),
            radius: 0.2,
            group: 0,
            slot: 0,
            goal: None,
            neighbours: &[],
            others: &(),
            events: &[],
            figures: &[],
            time: 0.0,
            seconds: 0.02,
            dice: Dice::default(),
        }
    }
}

impl View<'_> {
    /// Where the agent is.
    pub fn position(&self) -> Vec3 {
        self.motion.position
    }

    /// Its velocity.
    pub fn velocity(&self) -> Vec3 {
        self.motion.velocity
    }

    /// Which way it faces.
    pub fn forward(&self) -> Vec3 {
        self.motion.basis.forward
    }

    /// Whether it moves in the plane.
    pub fn is_on_ground(&self) -> bool {
        self.vehicle.locomotion == Locomotion::Ground
    }

    /// What is left of a vector for who moves in the plane.
    pub fn passable(&self, vector: Vec3) -> Vec3 {
        if self.is_on_ground() { vector.with_z(0.0) } else { vector }
    }

    /// The way to a place, along the ground for who moves there.
    pub fn to(&self, place: Vec3) -> Vec3 {
        self.passable(place - self.position())
    }

    /// Steering to a velocity: "desired velocity - velocity", in newtons.
    pub fn reach(&self, velocity: Vec3) -> Steering {
        self.vehicle.force_towards(&self.motion, velocity, self.seconds).into()
    }

    /// Steering to the top speed in a direction of any length; `None` if it has none.
    pub fn go(&self, direction: Vec3) -> Option<Steering> {
        Some(self.reach(direction.try_normalize()? * self.vehicle.max_speed))
    }

    /// Steering to the top speed in a direction of any length that turns with the agent, as a rudder does: it turns as fast
    /// as it would at first if the direction stayed. `None` if it has none.
    pub fn turn(&self, direction: Vec3) -> Option<Steering> {
        let (forward, direction) = (self.forward(), direction.try_normalize()?);
        let part = self.seconds / self.vehicle.response.max(self.seconds);
        let ahead = turned_towards(forward, direction, angle_between(forward, direction) * part, self.motion.basis.up);
        let faster = (self.vehicle.max_speed - self.motion.speed()) * part_in(self.seconds, self.vehicle.response);
        let change = ahead * (self.motion.speed() + faster) - self.velocity();
        Some((change * (self.vehicle.mass / self.seconds)).into())
    }

    /// Steering by all of the force in a direction whose length says how much it matters: `full` or more is all; `None` if
    /// it has no length.
    pub fn urge(&self, direction: Vec3, full: f32) -> Option<Steering> {
        let direction = self.passable(direction);
        let length = direction.length();
        (length > 0.0).then(|| (direction * (self.vehicle.max_force / length.max(full))).into())
    }

    /// Steering by all of the force to a side, of any length: it turns the way by as much as that force does in the step, but
    /// leaves the speed, however long the step is. Who hardly moves is pushed. `None` if the side has no length.
    pub(super) fn veer(&self, side: Vec3) -> Option<Steering> {
        let side = self.passable(side).try_normalize()?;
        let (force, mass) = (self.vehicle.max_force, self.vehicle.mass);
        let (speed, change) = (self.motion.speed(), force * self.seconds / mass);
        if speed <= change {
            return Some((side * force).into());
        }
        let turned = turned_towards(self.velocity() / speed, side, change / speed, self.motion.basis.up) * speed;
        Some(((turned - self.velocity()) * (mass / self.seconds)).into())
    }

    /// The velocity that steering leads to; the present one if there is nothing to correct.
    pub fn wish(&self, steering: Option<Steering>) -> Vec3 {
        let force = steering.map_or(Vec3::ZERO, |steering| steering.force);
        self.vehicle.velocity_of(&self.motion, force, self.seconds)
    }

    /// Steers towards a place at the top speed.
    pub(super) fn seek(&self, place: Vec3, why: &mut Why<'_>) -> Option<Steering> {
        why.note(|| super::Reason::Aim(place));
        self.go(self.to(place))
    }

    /// Steers away from a place at the top speed; from exactly there, back where it came from.
    pub(super) fn flee(&self, place: Vec3, why: &mut Why<'_>) -> Option<Steering> {
        why.note(|| super::Reason::Expects(place));
        let away = -self.to(place);
        self.go(if away == Vec3::ZERO { self.forward() } else { away })
    }
}

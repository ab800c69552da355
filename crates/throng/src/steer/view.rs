//! The input of a behaviour: one agent and its surroundings.

use super::{Kinematics, TraceRecorder};
use crate::motion::{Locomotion, Motion, Steering, Vehicle, angle_between, part_in, turned_towards};
use crate::random::Rng;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::fmt::Debug;

/// A neighbour, as the steered agent perceives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteeringNeighbour {
    /// Centre, relative to that of the steered agent, metres.
    pub offset: Vec3,
    /// Velocity, m/s.
    pub velocity: Vec3,
    /// Forward direction, a vector of length 1.
    pub forward: Vec3,
    /// Body radius, metres.
    pub radius: f32,
    /// Number of the agent.
    pub number: u32,
    /// Index of the group.
    pub group: usize,
}

/// Something that happened at a place and a time, such as a bang or a shout.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stimulus {
    /// Place, metres.
    pub position: Vec3,
    /// Time, seconds since the start.
    pub time: f64,
}

/// Finds any agent by its number, near or far.
///
/// ```
/// use throng::steer::{Kinematics, AgentQuery, Target, SteeringInput};
/// #[derive(Debug)]
/// struct Twins;
/// impl AgentQuery for Twins {
///     fn find(&self, number: u32) -> Option<Kinematics> {
///         (number < 2).then(Kinematics::default)
///     }
/// }
/// let view = SteeringInput { others: &Twins, ..SteeringInput::default() };
/// assert!(Target::Agent(1).find(&view).is_some() && Target::Agent(2).find(&view).is_none());
/// ```
pub trait AgentQuery: Debug + Sync {
    /// Returns the agent with this number as it is at the start of the step; `None` if there is none.
    fn find(&self, number: u32) -> Option<Kinematics>;

    /// Returns the slot of an agent in the formation of its group: the number of agents of the group with lower numbers.
    fn slot(&self, number: u32) -> usize {
        let _ = number;
        0
    }
}

/// A world without other agents.
impl AgentQuery for () {
    fn find(&self, _: u32) -> Option<Kinematics> {
        None
    }
}

/// The input of a behaviour, frozen at the start of the step. Places are in metres from the [origin of the agent's
/// group](crate::Group::origin): world coordinates, unless the group says otherwise. The default is a pedestrian at the origin that faces +x,
/// without neighbours.
#[derive(Clone, Copy, Debug)]
pub struct SteeringInput<'a> {
    /// Position and motion of the agent.
    pub motion: Motion,
    /// The limits of its body.
    pub vehicle: Vehicle,
    /// Body radius, metres.
    pub radius: f32,
    /// Index of the agent's group.
    pub group: usize,
    /// The next point of the agent's own journey.
    pub goal: Option<Vec3>,
    /// The agent's neighbours, nearest first.
    pub neighbours: &'a [SteeringNeighbour],
    /// All other agents, by number.
    pub others: &'a dyn AgentQuery,
    /// Recent stimuli.
    pub stimuli: &'a [Stimulus],
    /// The figures of the world's [rules](crate::Rules), in their order.
    pub figures: &'a [f64],
    /// Seconds since the start.
    pub time: f64,
    /// Length of the step, seconds, > 0.
    pub seconds: f32,
    /// The counter-based random number generator; it holds the agent's number.
    pub rng: Rng,
}

impl Default for SteeringInput<'_> {
    fn default() -> Self {
        Self {
            motion: Motion::default(),
            vehicle: Vehicle::default(),
            radius: 0.2,
            group: 0,
            goal: None,
            neighbours: &[],
            others: &(),
            stimuli: &[],
            figures: &[],
            time: 0.0,
            seconds: 0.02,
            rng: Rng::default(),
        }
    }
}

impl SteeringInput<'_> {
    /// Returns the position of the agent.
    #[inline]
    pub fn position(&self) -> Vec3 {
        self.motion.position
    }

    /// Returns the velocity of the agent.
    #[inline]
    pub fn velocity(&self) -> Vec3 {
        self.motion.velocity
    }

    /// Returns the forward direction of the agent.
    #[inline]
    pub fn forward(&self) -> Vec3 {
        self.motion.basis.forward
    }

    /// Returns the slot of the agent in the formation of its group, in the order of numbers.
    pub fn slot(&self) -> usize {
        self.others.slot(self.rng.number)
    }

    /// Whether the agent moves in the plane.
    #[inline]
    pub fn is_on_ground(&self) -> bool {
        self.vehicle.locomotion == Locomotion::Ground
    }

    /// Returns the part of a vector along which the agent can move: the horizontal part if the agent moves in the
    /// plane.
    #[inline]
    pub fn passable(&self, vector: Vec3) -> Vec3 {
        if self.is_on_ground() { vector.with_z(0.0) } else { vector }
    }

    /// Returns the offset to a place, horizontal if the agent moves in the plane.
    #[inline]
    pub fn to(&self, place: Vec3) -> Vec3 {
        self.passable(place - self.position())
    }

    /// Returns the steering to a velocity: "desired velocity - velocity", in newtons.
    #[inline]
    pub fn reach(&self, velocity: Vec3) -> Steering {
        self.vehicle.force_towards(&self.motion, velocity, self.seconds).into()
    }

    /// Returns the steering to the top speed in a direction of any length; `None` if the length is 0.
    #[inline]
    pub fn go(&self, direction: Vec3) -> Option<Steering> {
        Some(self.reach(direction.try_normalize()? * self.vehicle.max_speed))
    }

    /// Returns the steering to the top speed in a direction of any length, as a force that turns with the agent as a
    /// rudder does. The agent turns throughout the step as fast as it would at first if the direction stayed. `None` if
    /// the length of the direction is 0.
    pub fn turn(&self, direction: Vec3) -> Option<Steering> {
        let (forward, direction) = (self.forward(), direction.try_normalize()?);
        let part = self.seconds / self.vehicle.response.max(self.seconds);
        let ahead = turned_towards(forward, direction, angle_between(forward, direction) * part, self.motion.basis.up);
        let faster = (self.vehicle.max_speed - self.motion.speed()) * part_in(self.seconds, self.vehicle.response);
        let change = ahead * (self.motion.speed() + faster) - self.velocity();
        Some((change * (self.vehicle.mass / self.seconds)).into())
    }

    /// Returns a steering in a direction. The length of the direction scales the force: `full` or more gives the whole
    /// force. `None` if the length is 0.
    #[inline]
    pub fn urge(&self, direction: Vec3, full: f32) -> Option<Steering> {
        let direction = self.passable(direction);
        let length = direction.length();
        (length > 0.0).then(|| (direction * (self.vehicle.max_force / length.max(full))).into())
    }

    /// Returns a steering with the whole force to a side, of any length. It turns the velocity by the angle that this
    /// force gives in the step and keeps the speed, however long the step is. An agent that hardly moves is pushed
    /// sideways. `None` if the length of the side is 0.
    pub fn veer(&self, side: Vec3) -> Option<Steering> {
        let side = self.passable(side).try_normalize()?;
        let (force, mass) = (self.vehicle.max_force, self.vehicle.mass);
        let (speed, change) = (self.motion.speed(), force * self.seconds / mass);
        if speed <= change {
            return Some((side * force).into());
        }
        let turned = turned_towards(self.velocity() / speed, side, change / speed, self.motion.basis.up) * speed;
        Some(((turned - self.velocity()) * (mass / self.seconds)).into())
    }

    /// Returns the velocity that a steering leads to; the present velocity if there is nothing to correct.
    pub fn chosen(&self, steering: Option<Steering>) -> Vec3 {
        let force = steering.map_or(Vec3::ZERO, |steering| steering.force);
        self.vehicle.velocity_of(&self.motion, force, self.seconds)
    }

    /// Steers towards a place at the top speed.
    pub fn seek(&self, place: Vec3, why: &mut TraceRecorder<'_>) -> Option<Steering> {
        why.note(|| super::SteeringReason::Aim(place));
        self.go(self.to(place))
    }

    /// Steers away from a place at the top speed; forward if the agent is exactly there.
    pub fn flee(&self, place: Vec3, why: &mut TraceRecorder<'_>) -> Option<Steering> {
        why.note(|| super::SteeringReason::Shuns(place));
        let away = -self.to(place);
        self.go(if away == Vec3::ZERO { self.forward() } else { away })
    }
}

//! Evasion of several agents: steerToEvadeAllDefenders of OpenSteer's capture the flag.

use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, TraceRecorder};

/// Moves away from the predicted positions of several agents.
///
/// The more the nearer they are, and less from agents that are left behind. Nothing to correct while no such agent is
/// perceived. The defaults are OpenSteer's numbers.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, SteeringNeighbour, TraceRecorder};
/// use throng_steer::EvadeAll;
/// let other = |y: f32| SteeringNeighbour {
///     offset: Vec3::new(3.0, y, 0.0), velocity: Vec3::ZERO, forward: Vec3::X, radius: 0.2, number: 1, group: 1,
/// };
/// let view = SteeringInput { neighbours: &[other(1.0), other(2.0)], ..SteeringInput::default() };
/// let steering = EvadeAll::default().steer(&view, &mut [], &mut TraceRecorder::default()).expect("there are two");
/// assert!(steering.force.x < 0.0 && steering.force.y < 0.0);
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EvadeAll {
    /// The agents.
    #[parameter(default = GroupFilter::OtherGroups)]
    pub groups: GroupFilter,
    /// How far ahead positions are predicted: a part of the time in which it would reach them itself.
    #[parameter(default = 0.5, least = 0)]
    pub ahead: f32,
    /// Distance of an agent, metres, within which it uses all of the force.
    #[parameter(default = 4.0, unit = "m", above = 0)]
    pub near: f32,
    /// Weight of agents that it has left behind.
    #[parameter(default = 0.5, least = 0, most = 1)]
    pub behind: f32,
}

/// Least speed in the prediction, as a part of the top speed.
const SLOW: f32 = 0.2;

/// Returns the predicted position of a neighbour, relative to the agent, after a part of the time in which the agent
/// would reach the neighbour's present position.
pub(super) fn expected(view: &SteeringInput<'_>, other: &SteeringNeighbour, part: f32) -> Vec3 {
    let speed = view.motion.speed().max(SLOW * view.vehicle.max_speed);
    view.passable(other.offset + other.velocity * (part * other.offset.length() / speed))
}

impl EvadeAll {
    /// Returns the direction away from all of the agents. Its length is the urgency: 1 for one agent at the distance
    /// [`near`](Self::near).
    pub(super) fn away(&self, view: &SteeringInput<'_>, why: &mut TraceRecorder<'_>) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for other in view.neighbours.iter().filter(|other| self.groups.counts(view, other)) {
            let then = expected(view, other, self.ahead);
            why.note(|| SteeringReason::Expects { now: view.position() + other.offset, then: view.position() + then });
            let left_behind = view.forward().dot(other.offset) < -2.0 * view.radius;
            let weight =
                self.near / other.offset.length().max(view.radius) * if left_behind { self.behind } else { 1.0 };
            sum -= then.normalize_or(view.forward()) * weight;
        }
        sum
    }
}

impl Behaviour for EvadeAll {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        view.urge(self.away(view, why), 1.0)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

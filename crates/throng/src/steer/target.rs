//! The targets of behaviours: places and agents.

use super::{SteeringInput, SteeringNeighbour};
use crate::motion::Basis;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// The position and motion of a target. Metres, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Kinematics {
    /// Centre.
    pub position: Vec3,
    /// Velocity.
    pub velocity: Vec3,
    /// Orientation.
    pub basis: Basis,
    /// Body radius.
    pub radius: f32,
}

impl Kinematics {
    /// Returns the kinematics of a neighbour, which is taken to be upright.
    #[inline]
    pub fn of(view: &SteeringInput<'_>, other: &SteeringNeighbour) -> Self {
        Self {
            position: view.position() + other.offset,
            velocity: other.velocity,
            basis: Basis::facing(other.forward),
            radius: other.radius,
        }
    }

    /// Returns the position after some seconds at constant velocity.
    #[inline]
    pub fn position_in(&self, seconds: f32) -> Vec3 {
        self.position + self.velocity * seconds
    }
}

/// Which other agents count, by group.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GroupFilter {
    /// All agents.
    #[default]
    All,
    /// The agents of the agent's own group.
    OwnGroup,
    /// The agents of all other groups.
    OtherGroups,
    /// The agents of the group with this index.
    Group(usize),
}

impl GroupFilter {
    /// Whether a neighbour counts.
    #[inline]
    pub fn counts(self, view: &SteeringInput<'_>, other: &SteeringNeighbour) -> bool {
        match self {
            Self::All => true,
            Self::OwnGroup => other.group == view.group,
            Self::OtherGroups => other.group != view.group,
            Self::Group(index) => other.group == index,
        }
    }
}

/// The target of a behaviour.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Target, SteeringInput};
/// let view = SteeringInput { goal: Some(Vec3::Y), ..SteeringInput::default() };
/// assert_eq!(Target::Goal.find(&view).map(|mark| mark.position), Some(Vec3::Y));
/// assert_eq!(Target::Agent(7).find(&view), None, "it is not there");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A place.
    Point(Vec3),
    /// The next point of the agent's own journey; its last goal once it has arrived.
    Goal,
    /// The agent with this number. An agent is never its own target.
    Agent(u32),
    /// The nearest neighbour that counts.
    Nearest(GroupFilter),
}

impl Target {
    /// Returns the position and motion of the target; `None` if the target does not exist or is not seen.
    pub fn find(self, view: &SteeringInput<'_>) -> Option<Kinematics> {
        let at = |position| Kinematics { position, ..Kinematics::default() };
        match self {
            Self::Point(place) => Some(at(place)),
            Self::Goal => view.goal.map(at),
            Self::Agent(number) if number == view.rng.number => None,
            Self::Agent(number) => view.others.find(number),
            Self::Nearest(groups) => {
                let other = view.neighbours.iter().find(|other| groups.counts(view, other))?;
                Some(Kinematics::of(view, other))
            }
        }
    }
}

//! Whom or what behaviours steer by.

use super::{Neighbour, View};
use crate::motion::Basis;
use glam::Vec3;

/// Somebody or something to steer by: where it is and how it moves. Metres, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mark {
    /// Its centre.
    pub position: Vec3,
    /// Its velocity.
    pub velocity: Vec3,
    /// Which way it faces.
    pub basis: Basis,
    /// Radius of its body.
    pub radius: f32,
}

impl Mark {
    /// A neighbour, taken to be upright.
    pub fn of(view: &View<'_>, other: &Neighbour) -> Self {
        Self {
            position: view.position() + other.offset,
            velocity: other.velocity,
            basis: Basis::facing(other.forward),
            radius: other.radius,
        }
    }

    /// Where it will be in so many seconds if it keeps its velocity.
    pub fn position_in(&self, seconds: f32) -> Vec3 {
        self.position + self.velocity * seconds
    }
}

/// Which others count, by group.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Who {
    /// Everybody.
    #[default]
    Anybody,
    /// Those of the agent's own group.
    OwnGroup,
    /// Those of all other groups.
    OtherGroups,
    /// Those of the group with this index.
    Group(usize),
}

impl Who {
    /// Whether a neighbour counts.
    pub fn counts(self, view: &View<'_>, other: &Neighbour) -> bool {
        match self {
            Self::Anybody => true,
            Self::OwnGroup => other.group == view.group,
            Self::OtherGroups => other.group != view.group,
            Self::Group(index) => other.group == index,
        }
    }
}

/// Whom or what a behaviour steers by.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Target, View};
/// let view = View { goal: Some(Vec3::Y), ..View::default() };
/// assert_eq!(Target::Goal.find(&view).map(|mark| mark.position), Some(Vec3::Y));
/// assert_eq!(Target::Agent(7).find(&view), None, "it is not there");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A place.
    Point(Vec3),
    /// Where the agent's own journey leads next; its last goal if it has arrived.
    Goal,
    /// The agent with this number; for itself it is nobody.
    Agent(u32),
    /// The nearest neighbour that counts.
    Nearest(Who),
}

impl Target {
    /// Where it is and how it moves; `None` if it is not there, or not seen.
    pub fn find(self, view: &View<'_>) -> Option<Mark> {
        let at = |position| Mark { position, ..Mark::default() };
        match self {
            Self::Point(place) => Some(at(place)),
            Self::Goal => view.goal.map(at),
            Self::Agent(number) if number == view.dice.number => None,
            Self::Agent(number) => view.others.find(number),
            Self::Nearest(who) => {
                let other = view.neighbours.iter().find(|other| who.counts(view, other))?;
                Some(Mark::of(view, other))
            }
        }
    }
}

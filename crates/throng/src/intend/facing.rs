//! The directions that agents face.

use super::steering::Planned;
use super::velocities::Velocities;
use crate::motion::faces;
use glam::{Vec2, Vec3};

/// What determines the directions that agents face.
#[derive(Clone, Copy)]
pub(crate) struct Facing<'a> {
    /// The preferred velocity of each agent.
    pub preferred: &'a Velocities,
    /// The planned motion of each agent with a behaviour or a vehicle; empty if there is none.
    pub planned: &'a Planned,
}

impl Facing<'_> {
    /// Returns the direction that an agent without a vehicle turns to at this velocity: the facing that its behaviour
    /// requests, or its direction of motion.
    pub fn direction(&self, row: usize, velocity: Vec2, max_turn_rate: f32) -> Vec2 {
        let requested = self.planned.faces.get(row) == Some(&true);
        if requested {
            self.planned.attitude[row].basis.forward.truncate()
        } else {
            faces(velocity, self.preferred.ground[row], max_turn_rate)
        }
    }

    /// Whether the velocity of an agent is the one that it planned.
    pub fn is_as_planned(&self, row: usize, velocity: Vec3) -> bool {
        velocity == self.preferred.at(row)
    }
}

//! 3a. How soon an agent comes to the velocity that it would like.

use super::World;
use crate::agent::Group;
use glam::Vec2;

/// Part of the relaxation time in which an agent comes to the velocity across its way: a step to the side.
const SIDEWAYS: f32 = 0.5;

impl World {
    /// The velocity that the local model is to prefer for an agent. One that looks ahead comes to the velocity that it would
    /// like in its relaxation time: a = (wanted - v) / time, an implicit step of Euler; across its way in half of the time,
    /// so streams that cross do not sweep it aside. At the end of its way it brakes as hard as it must. Helbing, Molnár, Social force model for pedestrian dynamics, PRE 51:4282 (1995), equation 2.
    #[inline]
    pub(super) fn relaxed(&self, row: usize, seconds: f32) -> Vec2 {
        let (agents, wanted) = (&self.agents, self.step.preferred.ground[row]);
        let group = &self.groups[agents.group[row].index()];
        if !group.relaxes() || !self.step.shown[row].way.walks() || agents.script[row].is_some() {
            return wanted;
        }
        let (velocity, way) = (agents.velocity[row], self.step.shown[row].way.direction);
        let change = wanted - velocity;
        let along = way * change.dot(way);
        let part = |time: f32| seconds / (seconds + time);
        let relaxed =
            velocity + along * part(group.relaxation_time) + (change - along) * part(SIDEWAYS * group.relaxation_time);
        relaxed.clamp_length_max(self.arriving(row, &agents.travel[row], seconds))
    }
}

impl Group {
    /// Whether its agents come to the velocities that they would like in their relaxation time.
    fn relaxes(&self) -> bool {
        self.relaxation_time > 0.0 && self.walks_by_looking_ahead() && !self.model.relaxes()
    }

    /// Whether its agents walk where they look ahead. It is false where a field governs them: they would leave its flow at every
    /// bend.
    pub(super) fn walks_by_looking_ahead(&self) -> bool {
        self.look_ahead && self.steering.is_none() && self.field.is_none()
    }
}

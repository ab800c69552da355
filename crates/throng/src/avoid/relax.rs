//! Relaxation of the velocity towards the preferred velocity.

use super::avoidance::Avoiding;
use crate::agent::Group;
use glam::Vec2;

/// Part of the relaxation time that applies to the velocity across the path: a step to the side is quicker.
const SIDEWAYS: f32 = 0.5;

impl Avoiding<'_> {
    /// Returns the velocity that the local model is to approach. The velocity of an agent that looks ahead relaxes to
    /// the preferred velocity: a = (preferred - v) / time, as an implicit Euler step (Helbing, Molnár, Social force
    /// model for pedestrian dynamics, PRE 51:4282 (1995), equation 2). Across the path the time is half of the
    /// relaxation time, so crossing streams do not sweep the agent aside. At the end of its path the agent brakes as
    /// hard as it must. A vehicle has a response of its own, and a command of the program is the velocity to approach.
    #[inline]
    pub fn relaxed_velocity(&self, row: usize, seconds: f32) -> Vec2 {
        let (agents, wanted) = (&self.state.agents, self.preferred.ground[row]);
        let group = &self.state.local_groups[agents.group[row].index()];
        let is_led = agents.script[row].is_some() || agents.commanded[row].is_some();
        if is_led || !group.relaxes() || agents.vehicle[row].is_some() || !self.around.way(row).walks() {
            return wanted;
        }
        let (velocity, way) = (agents.velocity[row], self.around.way(row).direction);
        let change = wanted - velocity;
        let along = way * change.dot(way);
        let part = |time: f32| seconds / (seconds + time);
        let relaxed =
            velocity + along * part(group.relaxation_time) + (change - along) * part(SIDEWAYS * group.relaxation_time);
        relaxed.clamp_length_max(self.around.arriving(row, agents.travel[row].turn, seconds))
    }
}

impl Group {
    /// Whether the velocities of its agents relax to the preferred velocities in the relaxation time.
    fn relaxes(&self) -> bool {
        self.relaxation_time > 0.0 && self.walks_by_looking_ahead() && !self.model.relaxes()
    }

    /// Whether its agents walk by looking ahead. Agents that a field governs do not: they would leave its flow at every
    /// bend.
    pub(crate) fn walks_by_looking_ahead(&self) -> bool {
        self.look_ahead && self.guidance.is_journey()
    }
}

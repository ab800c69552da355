//! The right of way between two agents.

use crate::navigate::Surroundings;
use crate::world::State;

/// Extra avoidance share, beyond 0.5, of the agent farther from the common goal, and of an agent that stands or steps
/// aside.
pub(crate) const YIELD_TO_FIRST: f32 = 0.15;
pub(crate) const YIELD_AT_REST: f32 = 0.3;

impl State {
    /// Returns the avoidance share of an agent towards another agent that avoids it too.
    pub(crate) fn share(&self, row: usize, other: usize, yields: f32) -> f32 {
        let priority = 0.5 * (self.agents.priority[other] - self.agents.priority[row]);
        (0.5 + priority + yields).clamp(0.0, 1.0)
    }
}

impl Surroundings<'_> {
    /// Returns the extra avoidance share of an agent, beyond 0.5; the other agent has the negative of it. A walking
    /// agent goes before a standing one, unless the standing agent is at the goal of both. In a standoff, an agent that
    /// steps aside yields to an agent that goes first. Of two agents with the same goal, the agent with the shorter
    /// remaining distance goes first: this prevents stable arches at doors.
    pub fn yields(&self, row: usize, other: usize) -> f32 {
        let agents = &self.state.agents;
        let (mine, theirs) = (&self.shown[row].way, &self.shown[other].way);
        let turn = |row: usize| agents.travel[row].turn.rank();
        match (mine.walks(), theirs.walks(), mine.same_goal(theirs)) {
            (true, true, _) if turn(row) * turn(other) < 0 => YIELD_AT_REST * turn(other) as f32,
            (true, true, true) => {
                let lead = mine.remaining - theirs.remaining;
                YIELD_TO_FIRST * (lead / (agents.radius[row] + agents.radius[other])).clamp(-1.0, 1.0)
            }
            (false, true, false) => YIELD_AT_REST,
            (true, false, false) => -YIELD_AT_REST,
            _ => 0.0,
        }
    }
}

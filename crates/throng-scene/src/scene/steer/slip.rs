//! Moving past agents that are in the way.

use super::{GroupFilter, Target, parameters};

parameters! {
    /// Moves away from the predicted positions of several agents; the nearer a position is, the more.
    #[derive(Default)]
    EvadeAll {
        /// The agents. Without it, those of other groups.
        groups: Option<GroupFilter>,
        /// How far ahead positions are predicted: a part of the time in which it would reach them itself. Without it,
        /// 0.5. Limit: >= 0.
        ahead: Option<f64>,
        /// Distance of an agent, metres, within which it uses all of the force. Without it, 4. Limit: > 0.
        near: Option<f64>,
        /// Weight of agents that it has left behind. Without it, 0.5. Limit: 0 to 1.
        behind: Option<f64>,
    }
    /// Moves to a target while the corridor to it is clear, and else away from the agents in the corridor.
    SlipThrough {
        /// The target.
        target: Target,
        /// The agents it moves past, and how it evades them.
        evade: Option<EvadeAll>,
        /// How far ahead it predicts agents in the corridor: a part of the time in which it would reach them itself.
        /// Without it, 0.3. Limit: >= 0.
        ahead: Option<f64>,
        /// Extent of the corridor to either side, in radii of its body. Without it, 8. Limit: > 0.
        width: Option<f64>,
        /// Greatest angle between its direction and straight ahead, degrees. Without it, 45. Limit: > 0 to 180.
        turn: Option<f64>,
    }
}

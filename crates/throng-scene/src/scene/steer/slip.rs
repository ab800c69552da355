//! Past others who are in the way.

use super::{Target, Who, parameters};

parameters! {
    /// Goes away from where all of them will be, the more the nearer they are.
    #[derive(Default)]
    EvadeAll {
        /// Whom. Without it, those of other groups.
        who: Option<Who>,
        /// How far ahead it looks: a part of the time in which it would be there itself. Without it, 0.5. Limit: >= 0.
        ahead: Option<f64>,
        /// How near another is, metres, from whom it goes away with all of the force. Without it, 4. Limit: > 0.
        near: Option<f64>,
        /// How much those count whom it has left behind. Without it, 0.5. Limit: 0 to 1.
        behind: Option<f64>,
    }
    /// Goes to a target while the corridor there is clear, and out of the way of those who close it while it is not.
    SlipThrough {
        /// Where to.
        target: Target,
        /// Past whom, and how it keeps away from them.
        evade: Option<EvadeAll>,
        /// How far ahead it looks for who will be in the corridor: a part of the time in which it would be there itself.
        /// Without it, 0.3. Limit: >= 0.
        ahead: Option<f64>,
        /// How far the corridor reaches to either side, radii of its body. Without it, 8. Limit: > 0.
        width: Option<f64>,
        /// The most that its way leads aside from ahead, degrees. Without it, 45. Limit: > 0 to 180.
        turn: Option<f64>,
    }
}

//! Typed names. They stay valid while what they name exists, whatever is added or removed around it.

use serde::{Deserialize, Serialize};

/// Names one agent. A removed agent's id names nobody, ever again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct AgentId {
    pub(crate) slot: u32,
    pub(crate) generation: u32,
}

macro_rules! index_id {
    ($(#[$meta:meta])* $name:ident) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        pub struct $name(pub(crate) u32);

        impl $name {
            /// Position in the world's table of these, in the order they were added.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

index_id!(
    /// Names a [`Group`](crate::Group).
    GroupId
);
index_id!(
    /// Names a [`Goal`](crate::Goal).
    GoalId
);
index_id!(
    /// Names a [`Journey`](crate::Journey).
    JourneyId
);
index_id!(
    /// Names an [`Obstacle`](crate::Obstacle).
    ObstacleId
);
index_id!(
    /// Names a [`Script`](crate::Script).
    ScriptId
);

impl GroupId {
    /// The group every world has from the start.
    pub const DEFAULT: Self = Self(0);
}

impl JourneyId {
    /// The journey without stops: stay where you are. Every world has it.
    pub const STAY: Self = Self(0);
}

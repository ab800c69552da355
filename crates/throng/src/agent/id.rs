//! Typed ids. An id stays valid while its object exists, whatever is added or removed.

use serde::{Deserialize, Serialize};

/// The id of an agent. The id of a removed agent is never used again.
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
            /// Returns the index of the object in the world, in the order in which objects were added.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

index_id!(
    /// The id of a [`Group`](crate::Group).
    GroupId
);
index_id!(
    /// The id of a [`Goal`](crate::Goal).
    GoalId
);
index_id!(
    /// The id of a [`Journey`](crate::Journey).
    JourneyId
);
index_id!(
    /// The id of an [`Obstacle`](crate::Obstacle).
    ObstacleId
);
index_id!(
    /// The id of a [`Script`](crate::Script).
    ScriptId
);

impl GroupId {
    /// The group that every world has from the start.
    pub const DEFAULT: Self = Self(0);
}

impl JourneyId {
    /// The journey without stops, on which agents stay where they are. Every world has it.
    pub const STAY: Self = Self(0);
}

//! The stages of a sub-step, for profiling.

/// A stage of a sub-step. [`World::step_in_stages`](crate::World::step_in_stages) reports the end of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// 1. Neighbour search. It includes the work of a step before its first sub-step: agents enter, and the number of
    ///    sub-steps is chosen.
    Perceive,
    /// 2. Paths and preferred velocities.
    Intend,
    /// 3. Avoidance: chosen velocities.
    Avoid,
    /// 4. Guard: targets without overlaps.
    Guard,
    /// 5. Motion: positions, headings, arrivals and exits.
    Move,
}

impl Stage {
    /// All stages, in order.
    pub const ALL: [Self; 5] = [Self::Perceive, Self::Intend, Self::Avoid, Self::Guard, Self::Move];

    /// Returns the name of the stage, one word in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Perceive => "perceive",
            Self::Intend => "intend",
            Self::Avoid => "avoid",
            Self::Guard => "guard",
            Self::Move => "move",
        }
    }
}

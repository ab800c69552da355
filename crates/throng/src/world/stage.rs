//! The stages of a sub-step, for those who want to know where the time goes.

/// A stage of a sub-step. [`World::step_in_stages`](super::World::step_in_stages) tells when each has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// 1. Who is near. What a step does before its first sub-step counts here too: who enters, how many sub-steps.
    Perceive,
    /// 2. How do I get there.
    Intend,
    /// 3. What is safe.
    Avoid,
    /// 4. What is certain.
    Guard,
    /// 5. Move: positions, headings, arrivals, exits.
    Move,
}

impl Stage {
    /// All of them, in order.
    pub const ALL: [Self; 5] = [Self::Perceive, Self::Intend, Self::Avoid, Self::Guard, Self::Move];

    /// Its name, one word in lower case.
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

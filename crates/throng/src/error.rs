//! The errors of building and changing a world.

use glam::DVec2;

/// An error of building or changing a world.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A number is outside its limits.
    #[error("{what} is {value}, but must be {limit}")]
    Limit {
        /// The name of the number.
        what: &'static str,
        /// The value that was given.
        value: f64,
        /// The values that are permitted.
        limit: &'static str,
    },
    /// An id that does not exist in this world.
    #[error("there is no {what} with index {index}: add it to the world first")]
    Unknown {
        /// The kind of object that the id should name.
        what: &'static str,
        /// Its index.
        index: usize,
    },
    /// No group has this name.
    #[error("there is no group `{name}`")]
    NoGroup {
        /// The name.
        name: String,
    },
    /// An agent has been removed, by an exit or by the program.
    #[error("the agent has been removed: its id is no longer valid")]
    Gone,
    /// Two agents have the same number.
    #[error("the number {number} is taken: numbers name agents and must differ")]
    NumberTaken {
        /// The number.
        number: u32,
    },
    /// An agent would start inside an obstacle or outside the walkable area.
    #[error("an agent of radius {radius} cannot be at ({}, {}): {why}", at.x, at.y)]
    NoRoom {
        /// The position, world coordinates.
        at: DVec2,
        /// The radius of the agent.
        radius: f32,
        /// What occupies the position.
        why: &'static str,
    },
    /// An invalid shape, or parameters that contradict each other.
    #[error("{what}: {why}")]
    Shape {
        /// The name of the shape or object.
        what: String,
        /// Why it is invalid.
        why: String,
    },
    /// A crowd that several worlds cannot step together with the bits of one world.
    #[error("the crowd cannot be divided among several worlds: {what}")]
    Undivided {
        /// The group, and the reason.
        what: String,
    },
    /// A saved state that this world cannot continue.
    #[error("this is not a saved state of this world: {why}")]
    Snapshot {
        /// What does not match.
        why: String,
    },
}

impl Error {
    /// Returns [`Error::Limit`] unless a condition holds.
    ///
    /// # Errors
    /// The condition does not hold.
    pub fn unless(holds: bool, what: &'static str, value: impl Into<f64>, limit: &'static str) -> Result<(), Self> {
        if holds { Ok(()) } else { Err(Self::Limit { what, value: value.into(), limit }) }
    }

    /// Returns [`Error::Limit`] unless a number is greater than 0 and finite.
    ///
    /// # Errors
    /// The number is not greater than 0 and finite.
    pub fn unless_positive(what: &'static str, value: f32) -> Result<(), Self> {
        Self::unless(value > 0.0 && value.is_finite(), what, value, "greater than 0 and finite")
    }

    /// Returns [`Error::Limit`] unless a number is finite.
    ///
    /// # Errors
    /// The number is not finite.
    pub fn unless_finite(what: &'static str, value: f64) -> Result<(), Self> {
        Self::unless(value.is_finite(), what, value, "finite")
    }
}

//! What can be wrong with what a world is given.

use glam::DVec2;

/// What can be wrong with what a world is given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A number is out of its limits.
    #[error("{what} is {value}, but must be {limit}")]
    Limit {
        /// Which number.
        what: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        limit: &'static str,
    },
    /// An id names nothing in this world.
    #[error("there is no {what} with index {index}: add it to the world first")]
    Unknown {
        /// What kind of thing it should name.
        what: &'static str,
        /// Its index.
        index: usize,
    },
    /// There is no group of a name.
    #[error("there is no group `{name}`")]
    NoGroup {
        /// The name.
        name: String,
    },
    /// An agent has been removed, by an exit or by the program.
    #[error("the agent has been removed: ids of agents that leave name nobody any more")]
    Gone,
    /// Two agents with the same number.
    #[error("the number {number} is taken: numbers name agents and must differ")]
    NumberTaken {
        /// The number.
        number: u32,
    },
    /// An agent would start where it cannot be.
    #[error("an agent of radius {radius} cannot be at ({}, {}): {why}", at.x, at.y)]
    NoRoom {
        /// Where.
        at: DVec2,
        /// Its radius.
        radius: f32,
        /// What is in the way.
        why: &'static str,
    },
    /// A shape that encloses nothing, or not one thing.
    #[error("{what}: {why}")]
    Shape {
        /// Which shape.
        what: String,
        /// What is wrong with it.
        why: String,
    },
    /// A saved state that this world cannot continue.
    #[error("this is not a saved state of this world: {why}")]
    Snapshot {
        /// What does not fit.
        why: String,
    },
}

impl Error {
    pub(crate) fn unless(
        holds: bool,
        what: &'static str,
        value: impl Into<f64>,
        limit: &'static str,
    ) -> Result<(), Self> {
        if holds { Ok(()) } else { Err(Self::Limit { what, value: value.into(), limit }) }
    }

    pub(crate) fn unless_positive(what: &'static str, value: f32) -> Result<(), Self> {
        Self::unless(value > 0.0 && value.is_finite(), what, value, "greater than 0 and finite")
    }

    pub(crate) fn unless_not_negative(what: &'static str, value: f32) -> Result<(), Self> {
        Self::unless(value >= 0.0 && value.is_finite(), what, value, "at least 0 and finite")
    }

    pub(crate) fn unless_finite(what: &'static str, value: f64) -> Result<(), Self> {
        Self::unless(value.is_finite(), what, value, "finite")
    }
}

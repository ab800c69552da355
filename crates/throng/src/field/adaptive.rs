//! Fields that change with where people are.

use super::Field;
use crate::Error;
use glam::Vec2;
use std::sync::Arc;

/// What a field does that changes with where people are: every so often the [`World`](crate::World) tells it where they are, and
/// it makes another of itself that holds until the next time. What it remembers in between is part of the world's state, so
/// that saved worlds go on with the same bits.
pub trait Adaptive: Send + Sync {
    /// What is wrong with its parameters, if anything is.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter.
    fn check(&self) -> Result<(), Error>;

    /// Seconds from one time to the next. Limit: > 0.
    fn interval(&self) -> f64;

    /// What it remembers before the first time.
    fn memory(&self) -> Vec<f32>;

    /// Looks at where everybody is, metres from the world's origin, in the order of their numbers.
    fn notice(&self, memory: &mut [f32], people: &[Vec2]);

    /// The field that holds with such a memory.
    fn adapted(&self, memory: &[f32]) -> Arc<dyn Field>;
}

//! Fields that change with the positions of the agents.

use super::Field;
use crate::Error;
use glam::Vec2;
use std::sync::Arc;

/// A field that changes with the positions of the agents. At a fixed interval the [`World`](crate::World) passes it the
/// positions, and it returns the field that applies until the next update. Its memory is part of the world's state, so
/// a saved world continues with the same bits.
pub trait Adaptive: Send + Sync {
    /// Checks the parameters.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter.
    fn check(&self) -> Result<(), Error>;

    /// Seconds between two updates. Limit: > 0.
    fn interval(&self) -> f64;

    /// Returns the memory before the first update.
    fn memory(&self) -> Vec<f32>;

    /// Updates the memory from the positions of all agents, metres from the origin, in the order of their
    /// numbers.
    fn notice(&self, memory: &mut [f32], people: &[Vec2]);

    /// Returns the field for this memory.
    fn adapted(&self, memory: &[f32]) -> Arc<dyn Field>;
}

//! Fields that change with where people are.

use super::Field;
use glam::Vec2;
use std::sync::Arc;

/// What a field does that changes with where people are: every so often the [`World`](crate::World) tells it where they are, and
/// it makes another of itself that holds until the next time. What it remembers in between is part of the world's state, so
/// that saved worlds go on with the same bits.
pub trait Adaptive: Send + Sync {
    /// Seconds from one time to the next. Limit: > 0.
    fn interval(&self) -> f64;

    /// What it remembers before the first time.
    fn memory(&self) -> Vec<f32>;

    /// Looks at where everybody is, metres from the world's origin, in the order of their numbers.
    fn notice(&self, memory: &mut [f32], people: &[Vec2]);

    /// The field that holds with such a memory.
    fn adapted(&self, memory: &[f32]) -> Arc<dyn Field>;
}

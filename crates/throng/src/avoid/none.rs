//! No avoidance at all: what the guard alone does, and what there is to compare with.

use super::{LocalModel, View, Workspace};
use glam::Vec2;

/// No avoidance: everybody takes the preferred velocity, and the [guard](crate::guard) stops them in time.
///
/// ```
/// use throng::{Group, avoid::Unavoiding};
/// let group = Group { model: std::sync::Arc::new(Unavoiding), ..Group::default() };
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Unavoiding;

impl LocalModel for Unavoiding {
    fn velocity(&self, view: &View<'_>, _: &mut Workspace) -> Vec2 {
        view.preferred.clamp_length_max(view.max_speed)
    }

    fn avoids(&self) -> bool {
        false
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }
}

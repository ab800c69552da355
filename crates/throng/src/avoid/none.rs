//! No avoidance: the baseline for comparisons. It shows the work of the guard alone.

use super::{AvoidanceInput, LocalModel, Workspace};
use glam::Vec2;

/// No avoidance: the chosen velocity is the preferred one, and the [guard](crate::guard) stops agents before they
/// overlap.
///
/// ```
/// use throng::{Group, avoid::NoAvoidance};
/// let group = Group { model: std::sync::Arc::new(NoAvoidance), ..Group::default() };
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NoAvoidance;

impl LocalModel for NoAvoidance {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        view.preferred.clamp_length_max(view.max_speed)
    }

    fn avoids(&self) -> bool {
        false
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }
}

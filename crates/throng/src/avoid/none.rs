//! No avoidance: the baseline for comparisons. It shows the work of the guard alone.

use super::{AvoidanceInput, LocalModel, Workspace};
use crate::parameters::parameters;
use glam::Vec2;

/// No avoidance: only the guard keeps agents apart.
///
/// ```
/// use throng::{Group, avoid::NoAvoidance};
/// let group = Group { model: std::sync::Arc::new(NoAvoidance), ..Group::default() };
/// ```
#[parameters(name = "none")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoAvoidance;

impl LocalModel for NoAvoidance {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        view.preferred.clamp_length_max(view.max_speed)
    }

    fn avoids(&self) -> bool {
        false
    }

    fn neighbour_distance(&self) -> f32 {
        5.0
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }
}

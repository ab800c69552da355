//! Hybrid reciprocal velocity obstacles: Snape, van den Berg, Guy, Manocha, The hybrid reciprocal velocity obstacle,
//! IEEE Transactions on Robotics 27(4), 2011.
//!
//! Two agents that share the avoidance may still choose different sides. So the reciprocal velocity obstacle is widened
//! on the side on which the agent should not pass, up to the leg of the plain velocity obstacle: passing on that side
//! costs all of the avoidance. The velocity is found by [ClearPath](super::closest_outside).

use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Forbidden, LocalModel, Workspace, closest_outside};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;

/// Hybrid reciprocal velocity obstacles (Snape, van den Berg, Guy, Manocha, 2011): two agents agree on the side on which
/// they pass. For few agents.
///
/// ```
/// use throng::avoid::Hrvo;
/// let model = Hrvo { time_horizon_obstacles: 1.0 };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hrvo {
    /// Seconds ahead for which a velocity must be safe from obstacles.
    #[parameter(default = 0.7, unit = "s", above = 0)]
    pub time_horizon_obstacles: f32,
}

impl LocalModel for Hrvo {
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2 {
        workspace.forbid(view, self.time_horizon_obstacles, |other| hybrid(view.velocity, other, view.step));
        closest_outside(&workspace.forbidden, view.max_speed, view.preferred)
    }

    fn explain(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec<AvoidanceReason> {
        workspace.forbid(view, self.time_horizon_obstacles, |other| hybrid(view.velocity, other, view.step));
        workspace.reasons().collect()
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.time_horizon_obstacles * max_speed + radius
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// Returns the hybrid reciprocal velocity obstacle of one neighbour for an agent of the given velocity. For a neighbour
/// that is too close it is a half-plane that leads apart.
pub fn hybrid(velocity: Vec2, other: &AvoidanceNeighbour, step: f32) -> Forbidden {
    let AvoidanceNeighbour { offset, share, .. } = *other;
    if other.touches() {
        return Forbidden::RightOf(other.half_plane(velocity, 1.0, step));
    }
    let (left, right) = other.legs();
    let relative = velocity - other.velocity;
    let opening = right.perp_dot(left);
    // intersection of a leg of the reciprocal velocity obstacle, on the side to pass, and the other leg of the plain
    // one
    let apex = if offset.perp_dot(relative) > 0.0 {
        right * ((1.0 - share) * relative.perp_dot(left) / opening)
    } else {
        left * (-(1.0 - share) * relative.perp_dot(right) / opening)
    };
    Forbidden::Cone { apex: other.velocity + apex, right, left }
}

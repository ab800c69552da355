//! Velocity obstacles: Fiorini, Shiller, Motion planning in dynamic environments using velocity obstacles, IJRR 17(7)
//! 1998.
//!
//! A neighbour that keeps its velocity forbids a cone of velocities: those that lead to a collision within the time
//! horizon. The agent takes the permitted velocity closest to the preferred one and does all of the avoidance. If both
//! of two agents do so, their conflict is gone in the next step and both turn back: they oscillate. [`Rvo`](super::Rvo)
//! prevents that.

use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Forbidden, LocalModel, Workspace, closest_outside};
use crate::Error;
use glam::Vec2;

/// Velocity obstacles, solved exactly by [`closest_outside`].
///
/// ```
/// use throng::avoid::Vo;
/// let wary = Vo { time_horizon: 4.0, ..Vo::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vo {
    /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from walls. Limit: > 0.
    pub time_horizon_obstacles: f32,
}

impl Default for Vo {
    fn default() -> Self {
        Self { time_horizon: 2.0, time_horizon_obstacles: 0.7 }
    }
}

impl LocalModel for Vo {
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2 {
        self.forbid(view, workspace);
        closest_outside(&workspace.forbidden, view.max_speed, view.preferred)
    }

    fn explain(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec<AvoidanceReason> {
        self.forbid(view, workspace);
        workspace.reasons().collect()
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.time_horizon_obstacles * max_speed + radius
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("time horizon", self.time_horizon)?;
        Error::unless_positive("time horizon of obstacles", self.time_horizon_obstacles)
    }
}

impl Vo {
    fn forbid(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) {
        workspace.forbid(view, self.time_horizon_obstacles, |other| {
            let all = AvoidanceNeighbour { share: 1.0, room: 1.0, ..*other };
            Forbidden::truncated(view.velocity, &all, self.time_horizon, view.step)
        });
    }
}

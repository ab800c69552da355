//! Velocity obstacles: Fiorini, Shiller, Motion planning in dynamic environments using velocity obstacles, IJRR 17(7)
//! 1998.
//!
//! A neighbour that keeps its velocity forbids a cone of velocities: those that lead to a collision within the time
//! horizon. The agent takes the permitted velocity closest to the preferred one. An agent that does all of the avoidance
//! oscillates: if both of two agents do so, their conflict is gone in the next step and both turn back.

use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Forbidden, LocalModel, Workspace, closest_outside};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;

/// Velocity obstacles (Fiorini, Shiller, 1998): every agent takes all of the avoidance, and oscillates.
///
/// It finds gaps between neighbours that the half-planes of [`Orca`](super::Orca) hide. Where no velocity is free it
/// drops the constraints of the farthest neighbours first.
///
/// ```
/// use throng::avoid::Vo;
/// let wary = Vo { time_horizon: 4.0, ..Vo::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vo {
    /// Seconds ahead for which a velocity must be safe from other agents.
    #[parameter(default = 2.0, unit = "s", above = 0)]
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from obstacles.
    #[parameter(default = 0.7, unit = "s", above = 0)]
    pub time_horizon_obstacles: f32,
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
        self.check_limits()
    }
}

impl Vo {
    fn forbid(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) {
        workspace.forbid(view, self.time_horizon_obstacles, |other| {
            let other = AvoidanceNeighbour { share: 1.0, room: 1.0, ..*other };
            Forbidden::truncated(view.velocity, &other, self.time_horizon, view.step)
        });
    }
}

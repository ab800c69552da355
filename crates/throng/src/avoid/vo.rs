//! Velocity obstacles: Fiorini, Shiller, Motion planning in dynamic environments using velocity obstacles, IJRR 17(7)
//! 1998; and their reciprocal form of Guy et al., ClearPath: highly parallel collision avoidance for multi-agent
//! simulation, SCA 2009.
//!
//! A neighbour that keeps its velocity forbids a cone of velocities: those that lead to a collision within the time
//! horizon. The agent takes the permitted velocity closest to the preferred one. An agent that does all of the avoidance
//! oscillates: if both of two agents do so, their conflict is gone in the next step and both turn back. Reciprocal
//! agents each do their share.

use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Forbidden, LocalModel, Workspace, closest_outside};
use crate::Error;
use glam::Vec2;
use std::fmt;

/// Velocity obstacles that end at a time horizon, solved exactly by [`closest_outside`].
///
/// It finds gaps between neighbours that the half-planes of [`Orca`](super::Orca) hide. Where no velocity is free it
/// drops the constraints of the farthest neighbours first.
///
/// ```
/// use throng::avoid::Vo;
/// let wary = Vo { time_horizon: 4.0, ..Vo::default() };
/// let shares = Vo::clear_path();
/// assert!(shares.reciprocal && !wary.reciprocal);
/// ```
#[derive(Clone, Copy, PartialEq)]
pub struct Vo {
    /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from walls. Limit: > 0.
    pub time_horizon_obstacles: f32,
    /// Whether the agent leaves its neighbours their shares of the avoidance, instead of doing all of it.
    pub reciprocal: bool,
}

/// Its name is that of the model in the papers.
impl fmt::Debug for Vo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(if self.reciprocal { "ClearPath" } else { "Vo" })
            .field("time_horizon", &self.time_horizon)
            .field("time_horizon_obstacles", &self.time_horizon_obstacles)
            .finish()
    }
}

impl Default for Vo {
    fn default() -> Self {
        Self { time_horizon: 2.0, time_horizon_obstacles: 0.7, reciprocal: false }
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
    /// Returns the model of ClearPath (the paper's FVO): reciprocal velocity obstacles.
    pub fn clear_path() -> Self {
        Self { reciprocal: true, ..Self::default() }
    }

    fn forbid(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) {
        workspace.forbid(view, self.time_horizon_obstacles, |other| {
            let all = || AvoidanceNeighbour { share: 1.0, room: 1.0, ..*other };
            let other = if self.reciprocal { *other } else { all() };
            Forbidden::truncated(view.velocity, &other, self.time_horizon, view.step)
        });
    }
}

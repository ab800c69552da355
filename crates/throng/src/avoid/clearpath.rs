//! Reciprocal velocity obstacles with a time horizon: Guy et al., ClearPath: highly parallel collision avoidance for
//! multi-agent simulation, SCA 2009.
//!
//! The model is that of [velocity obstacles](super::Vo), but each of two agents does its share of the avoidance, so that
//! they do not oscillate.

use super::{AvoidanceInput, AvoidanceReason, Forbidden, LocalModel, Workspace, closest_outside};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;

/// Reciprocal velocity obstacles that end at a time horizon, solved exactly (ClearPath; Guy et al., 2009): it finds
/// gaps between neighbours that the half-planes of ORCA hide.
///
/// Where no velocity is free it drops the constraints of the farthest neighbours first.
///
/// ```
/// use throng::avoid::ClearPath;
/// let wary = ClearPath { time_horizon: 4.0, ..ClearPath::default() };
/// ```
#[parameters(name = "clearpath")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearPath {
    /// Seconds ahead for which a velocity must be safe from other agents.
    #[parameter(default = 2.0, unit = "s", above = 0)]
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from obstacles.
    #[parameter(default = 0.7, unit = "s", above = 0)]
    pub time_horizon_obstacles: f32,
}

impl LocalModel for ClearPath {
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

impl ClearPath {
    fn forbid(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) {
        workspace.forbid(view, self.time_horizon_obstacles, |other| {
            Forbidden::truncated(view.velocity, other, self.time_horizon, view.step)
        });
    }
}

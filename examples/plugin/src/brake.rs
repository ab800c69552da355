//! The local model `brake`.

use glam::Vec2;
use throng::Error;
use throng::avoid::{AvoidanceInput, AvoidanceReason, Cause, HalfPlane, LocalModel, Workspace};
use throng::parameters::{Value, parameters};

/// Keeps its direction, and brakes for the first agent that it would meet.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brake {
    /// Seconds ahead within which it brakes.
    #[parameter(default = 2.0, unit = "s", above = 0, most = 20)]
    pub time_horizon: f32,
    /// The part of its preferred speed that it always keeps, so that no agent waits for ever.
    #[parameter(default = 0.05, least = 0, most = 1)]
    pub creep: f32,
}

impl LocalModel for Brake {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        let preferred = view.preferred.clamp_length_max(view.max_speed);
        let (_, seconds) = self.first(view);
        preferred * (seconds / self.time_horizon).clamp(self.creep, 1.0)
    }

    fn is_random(&self) -> bool {
        false
    }

    /// Returns the agent that it brakes for, as the half-plane of the velocities that are slow enough.
    fn explain(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec<AvoidanceReason> {
        let (Some(index), _) = self.first(view) else { return Vec::new() };
        let point = self.velocity(view, workspace);
        let direction = view.preferred.normalize_or(Vec2::X).perp();
        vec![AvoidanceReason::Permits(Cause::Neighbour(index), HalfPlane { point, direction })]
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl Brake {
    /// Returns the neighbour that it would meet first within the time horizon, if any, and the seconds until then.
    fn first(&self, view: &AvoidanceInput<'_>) -> (Option<usize>, f32) {
        let mut first = (None, self.time_horizon);
        for (index, other) in view.neighbours.iter().enumerate() {
            let seconds = other.time_to_collision(view.preferred - other.velocity);
            if seconds < first.1 {
                first = (Some(index), seconds);
            }
        }
        first
    }
}

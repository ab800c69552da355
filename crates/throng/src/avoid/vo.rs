//! Velocity obstacles: Fiorini, Shiller, Motion planning in dynamic environments using velocity obstacles, IJRR 17(7)
//! 1998.
//!
//! A neighbour that keeps its velocity forbids a cone of velocities: those that lead to a collision within the time
//! horizon. The agent takes the permitted velocity closest to the preferred one, and all of the avoiding on itself. Two
//! who both do so see their conflict gone in the next step and turn back: they oscillate. That is what
//! [`Rvo`](super::Rvo) mends.

use super::{LocalModel, View, Workspace, sampling::cheapest};
use crate::Error;
use glam::Vec2;

/// Velocity obstacles, searched by adaptive sampling: the velocity is as good as any of a coarse pattern, refined; a better
/// one in a narrow gap between cones can be missed.
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
    fn velocity(&self, view: &View<'_>, _: &mut Workspace) -> Vec2 {
        cheapest(view.preferred, view.velocity, view.max_speed, |v| {
            let others =
                view.neighbours.iter().map(|n| n.time_to_collision(v - n.velocity) / self.time_horizon);
            let walls = view.time_to_walls(v, view.radius) / self.time_horizon_obstacles;
            let time = others.fold(walls, f32::min);
            // where no velocity is free, the one that is for longest: worse than any free one
            let forbidden = if time < 1.0 { 4.0 * view.max_speed / time.max(0.05) } else { 0.0 };
            v.distance(view.preferred) + forbidden
        })
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.time_horizon_obstacles * max_speed + radius
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("time horizon", self.time_horizon)?;
        Error::unless_positive("time horizon of obstacles", self.time_horizon_obstacles)
    }
}

//! Reciprocal velocity obstacles: van den Berg, Lin, Manocha, Reciprocal velocity obstacles for real-time multi-agent
//! navigation, ICRA 2008.
//!
//! Each of two takes its share of the avoiding: a velocity v is judged by what both would have if the other did the
//! same, v / share + (1 - 1 / share) of the present one. The velocity of least penalty is taken: weight / time to
//! collision + distance from the preferred one (section V), so that there is one in any crowd. Walls do nothing: all
//! of the avoiding falls on the agent, within a shorter horizon of their own.

use super::{LocalModel, View, Workspace, sampling::cheapest};
use crate::Error;
use glam::Vec2;

/// Reciprocal velocity obstacles, searched by adaptive sampling.
///
/// ```
/// use throng::avoid::Rvo;
/// let shy = Rvo { weight: 2.0, ..Rvo::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rvo {
    /// Weight of the time to a collision against the distance from the preferred velocity, metres: small is aggressive,
    /// large is shy. Limit: > 0.
    pub weight: f32,
    /// Collisions farther ahead count for nothing, seconds. Limit: > 0.
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from walls. Limit: > 0.
    pub time_horizon_obstacles: f32,
}

impl Default for Rvo {
    fn default() -> Self {
        Self { weight: 1.0, time_horizon: 5.0, time_horizon_obstacles: 0.7 }
    }
}

/// The least share: with none at all an agent would not see the other.
const LEAST_SHARE: f32 = 0.1;

impl LocalModel for Rvo {
    fn velocity(&self, view: &View<'_>, _: &mut Workspace) -> Vec2 {
        cheapest(view.preferred, view.velocity, view.max_speed, |v| {
            let others = view.neighbours.iter().map(|n| {
                let share = n.share.max(LEAST_SHARE);
                let judged = v / share + view.velocity * (1.0 - 1.0 / share);
                n.time_to_collision(judged - n.velocity)
            });
            let time = others.fold(f32::INFINITY, f32::min);
            let walls = view.time_to_walls(v, view.radius);
            let penalty = |time: f32, horizon: f32| if time < horizon { self.weight / time.max(1e-3) } else { 0.0 };
            v.distance(view.preferred)
                + penalty(time, self.time_horizon).max(penalty(walls, self.time_horizon_obstacles))
        })
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.time_horizon_obstacles * max_speed + radius
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("weight", self.weight)?;
        Error::unless_positive("time horizon", self.time_horizon)?;
        Error::unless_positive("time horizon of obstacles", self.time_horizon_obstacles)
    }
}

//! The collision-free speed model: Tordeux, Chraibi, Seyfried, Collision-free speed model for pedestrian dynamics,
//! Traffic and Granular Flow '15, 2016 (arXiv 1512.05597), as in JuPedSim's `CollisionFreeSpeedModel`.
//!
//! A first-order model: it chooses a direction, and a speed along it.
//!
//! - Direction: `e = normalise(e0 + sum A exp(-gap / B) n)` over neighbours and walls, with `e0` the direction of the
//!   preferred velocity and `n` the unit vector away from the neighbour or wall.
//! - Speed: `v = clamp(s / T, 0, v0)`, with `s` the gap to the nearest neighbour ahead within the width of both bodies.
//!
//! In single file this gives the fundamental diagram: density 1 / (2 r + v T). Known faults: a neighbour abreast at
//! contact counts as ahead, so bodies form arches at doors narrower than two bodies; directions change at once; two
//! agents that meet stop before they turn.

use super::separation::exponential;
use super::{AvoidanceInput, AvoidanceReason, Cause, HalfPlane, LocalModel, Workspace};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;

/// The collision-free speed model (Tordeux, Chraibi, Seyfried, 2016), as in JuPedSim: the speed follows from the gap
/// ahead.
///
/// ```
/// use throng::avoid::CollisionFreeSpeed;
/// let hasty = CollisionFreeSpeed { time_gap: 0.5, ..CollisionFreeSpeed::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CollisionFreeSpeed {
    /// Seconds that an agent stays behind the neighbour ahead (T).
    #[parameter(default = 1.0, unit = "s", above = 0)]
    pub time_gap: f32,
    /// Influence of a neighbour at contact on the direction, relative to the preferred direction (a).
    #[parameter(default = 8.0, least = 0)]
    pub strength: f32,
    /// Metres of gap over which that influence falls to 1/e (D).
    #[parameter(default = 0.1, unit = "m", above = 0)]
    pub range: f32,
    /// As `strength`, for obstacles.
    #[parameter(default = 5.0, least = 0)]
    pub strength_obstacles: f32,
    /// As `range`, for obstacles.
    #[parameter(default = 0.02, unit = "m", above = 0)]
    pub range_obstacles: f32,
}

impl LocalModel for CollisionFreeSpeed {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        let direction = self.direction(view);
        let gap = view.headway(direction).map_or(f32::INFINITY, |(_, gap)| gap);
        direction * optimal_speed(view, gap, self.time_gap)
    }

    fn explain(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec<AvoidanceReason> {
        let mut reasons: Vec<AvoidanceReason> =
            self.pushes(view).map(|(cause, push)| AvoidanceReason::Push(cause, push)).collect();
        reasons.extend(speed_limit(view, self.direction(view), self.time_gap));
        reasons
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius + RANGES * self.range_obstacles
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// Number of ranges of an exponential beyond which a wall is ignored: there it has fallen to 5e-5.
pub(super) const RANGES: f32 = 10.0;

impl CollisionFreeSpeed {
    /// Returns what each neighbour and each wall adds to the direction.
    fn pushes(&self, view: &AvoidanceInput<'_>) -> impl Iterator<Item = (Cause, Vec2)> {
        let neighbours = view.others().map(|(cause, other)| {
            let (distance, away) = other.separation();
            let strength = 2.0 * other.share * self.strength;
            (cause, away * exponential(strength, distance - other.radii, self.range))
        });
        let walls = view.walls().map(|(cause, distance, away)| {
            (cause, away * exponential(self.strength_obstacles, distance - view.radius, self.range_obstacles))
        });
        neighbours.chain(walls)
    }

    fn direction(&self, view: &AvoidanceInput<'_>) -> Vec2 {
        let ahead = view.preferred.normalize_or_zero();
        (ahead + self.pushes(view).map(|(_, push)| push).sum::<Vec2>()).normalize_or(ahead)
    }
}

/// Returns the speed of an agent for the gap ahead, metres, and the time gap, seconds.
pub(super) fn optimal_speed(view: &AvoidanceInput<'_>, gap: f32, time_gap: f32) -> f32 {
    (gap / time_gap).clamp(0.0, view.preferred.length().min(view.max_speed))
}

/// Returns the half-plane of velocities that the neighbour ahead permits to an agent that walks along `direction`.
pub(super) fn speed_limit(view: &AvoidanceInput<'_>, direction: Vec2, time_gap: f32) -> Option<AvoidanceReason> {
    let (cause, gap) = view.headway(direction)?;
    let point = direction * (gap / time_gap).max(0.0);
    Some(AvoidanceReason::Permits(cause, HalfPlane { point, direction: direction.perp() }))
}

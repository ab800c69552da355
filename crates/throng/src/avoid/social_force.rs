//! The social force model: Helbing, Molnar, Social force model for pedestrian dynamics, Physical Review E 51, 1995
//! (arXiv cond-mat/9805244).
//!
//! Accelerations, m/s^2:
//!
//! - towards the preferred velocity `p`: `(p - v) / tau` (eq. 2);
//! - from a neighbour: the negative gradient of `V0 exp(-b / sigma)` (eq. 3, 13), with `b` the semi-minor axis of the
//!   ellipse that has as foci the neighbour's centre and its centre after `anticipation_time` (eq. 4). It is multiplied
//!   by `out_of_view` if the neighbour is outside the angle of view about the preferred direction (eq. 7, 8);
//! - from a wall: the negative gradient of `U0 exp(-d / R)` (eq. 5, 13), with `d` the distance of the centre.
//!
//! The fluctuations and attractions of the paper are left out. Distances are between centres and do not depend on the
//! radii. Known faults: forces do not depend on whether a collision is ahead; two agents that meet push each other back
//! before they turn.

use super::collision_free_speed::RANGES;
use super::separation::exponential;
use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Cause, LocalModel, Workspace};
use crate::Error;
use crate::parameters::{Angle, Value, parameters};
use glam::Vec2;

/// The social force model (Helbing, Molnár, 1995). Distances are between centres.
///
/// ```
/// use throng::avoid::SocialForce;
/// let all_round = SocialForce { out_of_view: 1.0, ..SocialForce::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SocialForce {
    /// Seconds to reach the preferred velocity (the paper's tau).
    #[parameter(default = 0.5, unit = "s", above = 0)]
    pub relaxation_time: f32,
    /// Strength of the potential of a neighbour, m^2/s^2 (V0).
    #[parameter(default = 2.1, unit = "m²/s²", least = 0)]
    pub strength: f32,
    /// Range of that potential, metres (sigma).
    #[parameter(default = 0.3, unit = "m", above = 0)]
    pub range: f32,
    /// How far ahead a neighbour needs room for its step, seconds (Delta t).
    #[parameter(default = 2.0, unit = "s", least = 0)]
    pub anticipation_time: f32,
    /// Strength of the potential of an obstacle, m^2/s^2 (U0).
    #[parameter(default = 10.0, unit = "m²/s²", least = 0)]
    pub strength_obstacles: f32,
    /// Range of that potential, metres (R).
    #[parameter(default = 0.2, unit = "m", above = 0)]
    pub range_obstacles: f32,
    /// Angle of view, degrees (2 phi).
    #[parameter(default = Angle::degrees(200.0), unit = "°", least = 0, most = 360)]
    pub view_angle: Angle,
    /// Weight of neighbours outside the angle of view (c).
    #[parameter(default = 0.5, least = 0, most = 1)]
    pub out_of_view: f32,
}

/// Least semi-minor axis, metres. It is zero on the path of a neighbour.
const LEAST_AXIS: f32 = 1e-3;

impl LocalModel for SocialForce {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        view.relaxed(self.pushes(view).map(|(_, push)| push).sum(), self.relaxation_time)
    }

    fn relaxes(&self) -> bool {
        true
    }

    fn parts_bodies(&self) -> bool {
        true
    }

    fn explain(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec<AvoidanceReason> {
        self.pushes(view).map(|(cause, push)| AvoidanceReason::Push(cause, push)).collect()
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius.max(RANGES * self.range_obstacles)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl SocialForce {
    /// Returns the acceleration by each neighbour and each wall.
    fn pushes(&self, view: &AvoidanceInput<'_>) -> impl Iterator<Item = (Cause, Vec2)> {
        let ahead = view.preferred.normalize_or_zero();
        let least_cosine = libm::cosf(0.5 * self.view_angle.radians());
        let neighbours = view.others().map(move |(cause, other)| {
            let push = self.repulsion(&other);
            let seen = ahead.dot(-push) >= push.length() * least_cosine;
            let weight = if seen { 1.0 } else { self.out_of_view };
            (cause, push * (2.0 * other.share * weight))
        });
        let walls = view.walls().map(|(cause, distance, away)| {
            let strength = self.strength_obstacles / self.range_obstacles;
            (cause, away * exponential(strength, distance, self.range_obstacles))
        });
        neighbours.chain(walls)
    }

    /// Returns the negative gradient of a neighbour's potential.
    fn repulsion(&self, other: &AvoidanceNeighbour) -> Vec2 {
        let (distance, away) = other.separation();
        let (place, way) = (away * distance, other.velocity * self.anticipation_time);
        let to_end = place - way;
        let sum = distance.abs() + to_end.length();
        let axis = 0.5 * (sum * sum - way.length_squared()).max(0.0).sqrt();
        let axis = axis.max(LEAST_AXIS);
        let gradient = (away + to_end.normalize_or_zero()) * (sum / (4.0 * axis));
        gradient * exponential(self.strength / self.range, axis, self.range)
    }
}

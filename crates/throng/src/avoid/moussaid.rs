//! A social force model fitted to experiments: Moussaid, Helbing, Garnier, Johansson, Combe, Theraulaz, Experimental
//! study of the behavioural mechanisms underlying self-organization in human crowds, Proceedings of the Royal Society B
//! 276, 2009.
//!
//! Accelerations, m/s^2:
//!
//! - towards the preferred velocity `p`: `(p - v) / tau`;
//! - from a neighbour: let `e_ij` be the unit vector to the neighbour, `D = lambda (v_i - v_j) + e_ij` the direction of
//!   the interaction, `theta` the angle from `D` to `e_ij`, and `B = gamma |D|`. Braking along `-D` is
//!   `A exp(-d / B - (n' B theta)^2)`. Turning across `D`, away from the neighbour, is `A exp(-d / B - (n B theta)^2)`;
//! - from a wall: `a exp(-d / b)`.
//!
//! Distances are between centres and do not depend on the radii. `side_preference` resolves ties to the right, as in
//! the paper: the side is that of `theta + B side_preference`.

use super::collision_free_speed::RANGES;
use super::separation::exponential;
use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Cause, LocalModel, Workspace};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;

/// The social force model measured in experiments (Moussaïd et al., 2009). Distances are between centres.
///
/// ```
/// use throng::avoid::Moussaid2009;
/// let keeps_left = Moussaid2009 { side_preference: -0.005, ..Moussaid2009::default() };
/// ```
#[parameters(name = "moussaid_2009")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moussaid2009 {
    /// Seconds to reach the preferred velocity (the paper's tau).
    #[parameter(default = 0.54, unit = "s", above = 0)]
    pub relaxation_time: f32,
    /// Greatest acceleration by one neighbour, m/s^2 (A).
    #[parameter(default = 4.5, unit = "m/s²", least = 0)]
    pub strength: f32,
    /// Range of an interaction with a direction of length 1, metres (gamma).
    #[parameter(default = 0.35, unit = "m", above = 0)]
    pub gamma: f32,
    /// Weight of the relative velocity against the direction to the neighbour, s/m (lambda).
    #[parameter(default = 2.0, unit = "s/m", least = 0)]
    pub lambda: f32,
    /// How narrow the angle is in which neighbours make the agent turn, 1/m (n).
    #[parameter(default = 2.0, unit = "1/m", least = 0)]
    pub turning: f32,
    /// How narrow the angle is in which neighbours make the agent brake, 1/m (n').
    #[parameter(default = 3.0, unit = "1/m", least = 0)]
    pub braking: f32,
    /// Preference for passing on the right, 1/m (epsilon); negative: on the left.
    #[parameter(default = 0.005, unit = "1/m")]
    pub side_preference: f32,
    /// Acceleration at the surface of an obstacle, m/s^2 (a).
    #[parameter(default = 3.0, unit = "m/s²", least = 0)]
    pub strength_obstacles: f32,
    /// Range of that acceleration, metres (b).
    #[parameter(default = 0.1, unit = "m", above = 0)]
    pub range_obstacles: f32,
}

impl LocalModel for Moussaid2009 {
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

impl Moussaid2009 {
    /// Returns the acceleration by each neighbour and each wall.
    fn pushes(&self, view: &AvoidanceInput<'_>) -> impl Iterator<Item = (Cause, Vec2)> {
        let neighbours = view.neighbours.iter().enumerate().map(|(index, other)| {
            (Cause::Neighbour(index), self.interaction(view.velocity, other) * (2.0 * other.share))
        });
        let walls = view.walls().map(|(cause, distance, away)| {
            (cause, away * exponential(self.strength_obstacles, distance, self.range_obstacles))
        });
        neighbours.chain(walls)
    }

    fn interaction(&self, velocity: Vec2, other: &AvoidanceNeighbour) -> Vec2 {
        let (distance, away) = other.separation();
        let interaction = (velocity - other.velocity) * self.lambda - away;
        let length = interaction.length();
        if length < 1e-6 {
            return Vec2::ZERO;
        }
        let along = interaction / length;
        let theta = libm::atan2f(along.perp_dot(-away), along.dot(-away));
        let range = self.gamma * length;
        let part = |narrow: f32| {
            let angle = narrow * range * theta;
            exponential(self.strength, distance + range * angle * angle, range)
        };
        let side = if theta + range * self.side_preference >= 0.0 { -along.perp() } else { along.perp() };
        side * part(self.turning) - along * part(self.braking)
    }
}

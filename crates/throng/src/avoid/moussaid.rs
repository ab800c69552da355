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
use glam::Vec2;

/// The social force model of Moussaid et al., 2009.
///
/// ```
/// use throng::avoid::Moussaid2009;
/// let keeps_left = Moussaid2009 { side_preference: -0.005, ..Moussaid2009::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moussaid2009 {
    /// Time constant of the approach to the preferred velocity, seconds, the paper's tau. Limit: > 0.
    pub relaxation_time: f32,
    /// Greatest acceleration by one neighbour, m/s^2, the paper's A. Limit: >= 0.
    pub strength: f32,
    /// Range of an interaction with a direction `D` of length 1, metres. Limit: > 0.
    pub gamma: f32,
    /// Weight of the relative velocity relative to the direction to the neighbour, s/m. Limit: >= 0.
    pub lambda: f32,
    /// Narrowness of the angle in which neighbours make the agent turn, 1/m, the paper's n. Limit: >= 0.
    pub turning: f32,
    /// Narrowness of the angle in which neighbours make the agent brake, 1/m, the paper's n'. Limit: >= 0.
    pub braking: f32,
    /// Preference for passing on the right, 1/m, the paper's epsilon; negative: on the left. Limit: finite.
    pub side_preference: f32,
    /// Acceleration at the surface of a wall, m/s^2, the paper's a. Limit: >= 0.
    pub strength_obstacles: f32,
    /// Range of the repulsion by walls, metres, the paper's b. Limit: > 0.
    pub range_obstacles: f32,
}

impl Default for Moussaid2009 {
    /// The values of the paper.
    fn default() -> Self {
        Self {
            relaxation_time: 0.54,
            strength: 4.5,
            gamma: 0.35,
            lambda: 2.0,
            turning: 2.0,
            braking: 3.0,
            side_preference: 0.005,
            strength_obstacles: 3.0,
            range_obstacles: 0.1,
        }
    }
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
        Error::unless_positive("relaxation time", self.relaxation_time)?;
        Error::unless_not_negative("strength", self.strength)?;
        Error::unless_positive("gamma", self.gamma)?;
        Error::unless_not_negative("lambda", self.lambda)?;
        Error::unless_not_negative("turning", self.turning)?;
        Error::unless_not_negative("braking", self.braking)?;
        Error::unless_finite("side preference", self.side_preference.into())?;
        Error::unless_not_negative("strength of obstacles", self.strength_obstacles)?;
        Error::unless_positive("range of obstacles", self.range_obstacles)
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

//! The anticipation velocity model: Xu, Chraibi, Seyfried, Anticipation in a velocity-based model for pedestrian
//! dynamics, Transportation Research Part C 133, 2021, with the walls of JuPedSim's `AnticipationVelocityModel`.
//!
//! Like the [collision-free speed model](super::CollisionFreeSpeed), the model chooses a direction, and a speed along
//! it from the gap ahead. The direction anticipates:
//!
//! - Neighbours in front of the preferred or of the present direction count (eq. 1).
//! - Each pushes the agent across the preferred direction `e0`, away from the side on which the neighbour will be after
//!   the anticipation time `ta` (eq. 5). The strength is `A (1 + (1 - e0 . ej) / 2) exp(-max(0, gap - c ta) / B)` (eq.
//!   3, 4), with `ej` the neighbour's direction and `c` the speed at which the two approach.
//! - The direction relaxes towards the sum within the reaction time (eq. 7).
//! - Walls within `wall_buffer` deflect the direction so that the agent glides along them.
//!
//! Known faults: discs form arches at doors up to 1.3 m wide. If a neighbour changes sides in the prediction, the push
//! changes sign at once.

use super::collision_free_speed::{optimal_speed, speed_limit};
use super::separation::exponential;
use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Cause, LocalModel, Workspace};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;

/// The anticipation velocity model (Xu, Chraibi, Seyfried, 2021), as in JuPedSim: the speed follows from the gap ahead,
/// the direction from the predicted positions of neighbours.
///
/// ```
/// use throng::avoid::AnticipationVelocity;
/// let farsighted = AnticipationVelocity { anticipation_time: 2.0, ..AnticipationVelocity::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnticipationVelocity {
    /// Seconds that an agent stays behind the neighbour ahead (T).
    #[parameter(default = 1.06, unit = "s", above = 0)]
    pub time_gap: f32,
    /// How far ahead positions are predicted, seconds (ta).
    #[parameter(default = 1.0, unit = "s", least = 0)]
    pub anticipation_time: f32,
    /// Seconds in which the direction completes all but 1/e of a change (tr).
    #[parameter(default = 0.3, unit = "s", above = 0)]
    pub reaction_time: f32,
    /// Influence of a neighbour at contact on the direction, relative to the preferred direction (k).
    #[parameter(default = 8.0, least = 0)]
    pub strength: f32,
    /// Metres of predicted gap over which that influence falls to 1/e (D).
    #[parameter(default = 0.1, unit = "m", above = 0)]
    pub range: f32,
    /// Gap to an obstacle, metres, within which an agent does not walk towards it (JuPedSim).
    #[parameter(default = 0.1, unit = "m", least = 0)]
    pub wall_buffer: f32,
    /// How strongly such an agent turns away from the obstacle (JuPedSim).
    #[parameter(default = 0.3, least = 0)]
    pub wall_pushout: f32,
}

/// Least speed, m/s, at which the velocity defines the present direction. Below it the heading does.
const WALKING: f32 = 0.05;

impl LocalModel for AnticipationVelocity {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        let direction = self.direction(view);
        let gap = view.headway(direction).map_or(f32::INFINITY, |(_, gap)| gap);
        self.glide(view, direction) * optimal_speed(view, gap, self.time_gap)
    }

    fn relaxes(&self) -> bool {
        true
    }

    fn explain(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec<AvoidanceReason> {
        let mut reasons: Vec<AvoidanceReason> =
            self.pushes(view).map(|(cause, push)| AvoidanceReason::Push(cause, push)).collect();
        reasons.extend(speed_limit(view, self.direction(view), self.time_gap));
        reasons
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius + self.wall_buffer
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl AnticipationVelocity {
    /// Returns what each neighbour adds to the direction.
    fn pushes(&self, view: &AvoidanceInput<'_>) -> impl Iterator<Item = (Cause, Vec2)> {
        let (ahead, present) = (view.preferred.normalize_or_zero(), present(view));
        view.others().filter_map(move |(cause, other)| Some((cause, self.push(view, &other, ahead, present)?)))
    }

    fn push(&self, view: &AvoidanceInput<'_>, other: &AvoidanceNeighbour, ahead: Vec2, present: Vec2) -> Option<Vec2> {
        let (distance, away) = other.separation();
        if ahead.dot(away) > 0.0 && present.dot(away) > 0.0 {
            return None;
        }
        let approach = (other.velocity - view.velocity).dot(away);
        let gap = (distance - other.radii - approach * self.anticipation_time).max(0.0);
        let theirs = other.velocity.try_normalize().unwrap_or(other.preferred.normalize_or_zero());
        let strength = 2.0 * other.share * self.strength * (1.0 + 0.5 * (1.0 - ahead.dot(theirs)));
        let predicted = away * -distance + other.velocity * self.anticipation_time;
        let left = ahead.perp();
        let side = if left.dot(predicted) >= 0.0 { -left } else { left };
        Some(side * exponential(strength, gap, self.range))
    }

    /// Returns the new direction, without regard to walls.
    fn direction(&self, view: &AvoidanceInput<'_>) -> Vec2 {
        let (ahead, present) = (view.preferred.normalize_or_zero(), present(view));
        let wanted = (ahead + self.pushes(view).map(|(_, push)| push).sum::<Vec2>()).normalize_or(ahead);
        if ahead.dot(wanted) * ahead.dot(present) < 0.0 {
            return wanted;
        }
        let part = 1.0 - libm::expf(-view.step / self.reaction_time);
        present.lerp(wanted, part).normalize_or(wanted)
    }

    /// Returns the direction, turned along the walls that are near.
    fn glide(&self, view: &AvoidanceInput<'_>, direction: Vec2) -> Vec2 {
        let near = view.walls().filter(|&(_, distance, _)| distance <= view.radius + self.wall_buffer);
        let gliding = near.fold(direction, |direction, (_, _, away)| {
            let towards = -direction.dot(away);
            if towards > 0.0 { direction + away * (towards + self.wall_pushout) } else { direction }
        });
        gliding.normalize_or_zero()
    }
}

/// Returns the direction in which the agent walks or, below [`WALKING`], faces.
fn present(view: &AvoidanceInput<'_>) -> Vec2 {
    let speed = view.velocity.length();
    if speed >= WALKING {
        return view.velocity / speed;
    }
    let (sin, cos) = libm::sincosf(view.heading);
    Vec2::new(cos, sin)
}

//! Context steering: Fray, Context steering: behavior-driven steering at the macro scale, Game AI Pro 2, 2015, chapter
//! 18.

use super::weighted_sum::{WeightedParts, check_weights};
use crate::approach::time_to_touch;
use glam::Vec3;
use std::f32::consts::{FRAC_PI_4, TAU};
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::{Steering, turned};
use throng::parameters::{Value, parameters};
use throng::steer::{
    Barriers, Behaviour, BoxedBehaviour, GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, TraceRecorder,
    words_of_parts,
};

/// Moves in the direction with the greatest interest minus danger (Fray 2015).
///
/// The direction is one of several. Opposite preferred velocities do not cancel out, as they do in a [`WeightedSum`](crate::WeightedSum), and an obstacle in one
/// direction leaves the rest free.
///
/// The interest of a direction comes from the parts: the greatest weight times preferred speed times the cosine of the
/// angle between the direction and the preferred velocity. Its danger comes from neighbours and obstacles in the way:
/// the sooner the contact, the greater the danger. The candidates are the directions of the parts and directions at
/// equal angles all round. The agent goes the slower the more dangerous the best direction is. It keeps its direction
/// unless another is better by a fifth: this prevents hesitation.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::Target;
/// use throng_steer::{ContextSteering, Seek};
/// let tree = |x: f32| (1.0, Seek { target: Target::Point(Vec3::X * x) }.into());
/// let squirrel = ContextSteering::new(vec![tree(9.0), tree(-8.0)]);
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct ContextSteering {
    /// The parts: their forces are the interest. Limit: 16 parts.
    #[parameter(name = "of", required, from = WeightedParts)]
    pub parts: Vec<(f32, BoxedBehaviour)>,
    /// Number of directions in the horizontal plane; agents that fly evaluate as many again above and below it.
    #[parameter(default = 16, least = 4, most = 64)]
    pub directions: usize,
    /// Seconds beyond which a collision is no danger.
    #[parameter(default = 2.0, unit = "s", above = 0)]
    pub horizon: f32,
    /// The agents that are a danger.
    pub groups: GroupFilter,
    /// The obstacles that are a danger.
    #[parameter(name = "obstacles", absent = "everything")]
    pub barriers: Barriers,
}

/// Greatest number of parts.
const MOST_PARTS: usize = 16;
/// Bonus of the present direction, as a part of its value.
const KEPT: f32 = 0.2;

impl Behaviour for ContextSteering {
    fn memory(&self) -> usize {
        words_of_parts(self.parts.iter().map(|(_, part)| part))
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let mut facing = None;
        let mut chosen_velocities = [None; MOST_PARTS];
        for (index, (chosen, (weight, part))) in chosen_velocities.iter_mut().zip(&self.parts).enumerate() {
            *chosen = part.steer_as(index, view, &mut memory, why).map(|said| {
                facing = facing.or(said.facing);
                (*weight, view.passable(view.chosen(Some(said))))
            });
        }
        let chosen_velocities = chosen_velocities.iter().flatten();
        let speed = chosen_velocities.clone().map(|(_, chosen)| chosen.length()).reduce(f32::max)?;
        let interest = |direction: Vec3| {
            chosen_velocities.clone().map(|(weight, chosen)| weight * chosen.dot(direction)).fold(0.0, f32::max)
        };
        let wanted = chosen_velocities.clone().filter_map(|(_, chosen)| chosen.try_normalize());
        let going = view.velocity().normalize_or_zero();
        let weighed = wanted.chain(self.all_round(view)).map(|direction| {
            let safe = 1.0 - self.danger(view, direction * speed);
            let keeps = 1.0 + KEPT * going.dot(direction).max(0.0);
            (interest(direction) * safe * keeps, direction * (speed * safe))
        });
        let best = weighed.reduce(|a, b| if b.0 > a.0 { b } else { a });
        let chosen = best.filter(|best| best.0 > 0.0).map_or(Vec3::ZERO, |best| best.1);
        why.note(|| SteeringReason::Wishes(chosen));
        Some(Steering { facing, ..view.reach(chosen) })
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.parts.iter().for_each(|(_, part)| part.fields(see));
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        let parts = self.parts.len();
        Error::unless(parts <= MOST_PARTS, "number of parts", parts as f64, "16 at most")?;
        check_weights(&self.parts)
    }
}

impl ContextSteering {
    /// Returns directions all round, from ahead to the left.
    fn all_round<'v>(&'v self, view: &'v SteeringInput<'_>) -> impl Iterator<Item = Vec3> + 'v {
        let basis = &view.motion.basis;
        let rises = if view.is_on_ground() { &[0.0][..] } else { &[0.0, FRAC_PI_4, -FRAC_PI_4] };
        rises.iter().flat_map(move |&rise| {
            let ahead = turned(basis.forward, basis.side, -rise);
            (0..self.directions).map(move |k| turned(ahead, basis.up, TAU * k as f32 / self.directions as f32))
        })
    }

    /// Returns the danger of a velocity, 0 to 1.
    fn danger(&self, view: &SteeringInput<'_>, velocity: Vec3) -> f32 {
        let touch = |other: &SteeringNeighbour| {
            let relative = other.velocity - velocity;
            let time = time_to_touch(other.offset, relative, view.radius + other.radius);
            // a neighbour that touches already is no danger if the velocity leads away from it
            if time == 0.0 && other.offset.dot(relative) >= 0.0 { f32::INFINITY } else { time }
        };
        let others = view.neighbours.iter().filter(|other| self.groups.counts(view, other)).map(touch);
        let speed = velocity.length();
        let ahead = self.barriers.ahead(view.position(), velocity, view.radius, speed * self.horizon);
        // nor is an obstacle that contains the agent if the velocity leads out of it
        let ahead = ahead.filter(|(_, hit)| hit.distance > 0.0 || hit.steer_hint.dot(velocity) <= 0.0);
        let first = others.chain(ahead.map(|(_, hit)| hit.distance / speed)).fold(f32::INFINITY, f32::min);
        (1.0 - first / self.horizon).clamp(0.0, 1.0)
    }
}

//! Context steering: Fray, Context steering: behavior-driven steering at the macro scale, Game AI Pro 2, 2015, chapter 18.

use super::weighted_sum::check_weights;
use crate::Error;
use crate::motion::{Steering, turned};
use crate::steer::approach::time_to_touch;
use crate::steer::{Barriers, Behaviour, Branch, Neighbour, Reason, View, Who, Why, behaviour};
use glam::Vec3;
use std::f32::consts::{FRAC_PI_4, TAU};

/// Goes in one direction of many, the most interesting less its danger: opposite wishes do not cancel out, as they do in a
/// [`WeightedSum`](crate::steer::WeightedSum), and what is in the way of one leaves the others.
///
/// How interesting a direction is, its parts say: the greatest weight times the speed at which one would like to go there, by
/// the cosine of the angle between. How dangerous it is, who and what is in the way says, the more the sooner they would be
/// touched. It weighs the directions that the parts would like and others evenly all round, and goes the slower the more
/// dangerous the best is. It keeps to where it goes unless another is better by a fifth: so it does not hesitate.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{ContextSteering, Seek, Target};
/// let trees = [Vec3::X * 9.0, Vec3::X * -8.0].map(|tree| (1.0, Seek { target: Target::Point(tree) }.into()));
/// let squirrel = ContextSteering::new(trees.into());
/// ```
#[derive(Clone, Debug)]
pub struct ContextSteering {
    /// Weights, and parts. Limit: weights >= 0; 16 parts.
    pub parts: Vec<(f32, Branch)>,
    /// How many directions it weighs all round; those who fly as many again above and below. Limit: 4 to 64.
    pub directions: usize,
    /// In how many seconds a touch is no danger yet. Limit: > 0.
    pub horizon: f32,
    /// Who is in the way.
    pub who: Who,
    /// What is in the way.
    pub barriers: Barriers,
}

impl ContextSteering {
    /// Sixteen directions, and who is in the way within 2 s.
    pub fn new(parts: Vec<(f32, Branch)>) -> Self {
        Self { parts, directions: 16, horizon: 2.0, who: Who::Anybody, barriers: Barriers::default() }
    }
}

/// How many parts it can have.
const MOST_PARTS: usize = 16;
/// How much more the direction counts in which it goes.
const KEPT: f32 = 0.2;

impl Behaviour for ContextSteering {
    fn memory(&self) -> usize {
        behaviour::words(self.parts.iter().map(|(_, part)| part))
    }

    fn steer(&self, view: &View<'_>, mut memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let mut facing = None;
        let mut wishes = [None; MOST_PARTS];
        for (index, (wish, (weight, part))) in wishes.iter_mut().zip(&self.parts).enumerate() {
            *wish = part.steer_as(index, view, &mut memory, why).map(|said| {
                facing = facing.or(said.facing);
                (*weight, view.passable(view.wish(Some(said))))
            });
        }
        let wishes = wishes.iter().flatten();
        let speed = wishes.clone().map(|(_, wish)| wish.length()).reduce(f32::max)?;
        let interest =
            |direction: Vec3| wishes.clone().map(|(weight, wish)| weight * wish.dot(direction)).fold(0.0, f32::max);
        let wanted = wishes.clone().filter_map(|(_, wish)| wish.try_normalize());
        let going = view.velocity().normalize_or_zero();
        let weighed = wanted.chain(self.all_round(view)).map(|direction| {
            let safe = 1.0 - self.danger(view, direction * speed);
            let keeps = 1.0 + KEPT * going.dot(direction).max(0.0);
            (interest(direction) * safe * keeps, direction * (speed * safe))
        });
        let best = weighed.reduce(|a, b| if b.0 > a.0 { b } else { a });
        let wish = best.filter(|best| best.0 > 0.0).map_or(Vec3::ZERO, |best| best.1);
        why.note(|| Reason::Wishes(wish));
        Some(Steering { facing, ..view.reach(wish) })
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless((4..=64).contains(&self.directions), "directions", self.directions as f64, "from 4 to 64")?;
        Error::unless_positive("horizon", self.horizon)?;
        let parts = self.parts.len();
        Error::unless(parts <= MOST_PARTS, "number of parts", parts as f64, "16 at most")?;
        check_weights(&self.parts)
    }
}

impl ContextSteering {
    /// Directions all round, from ahead to the left.
    fn all_round<'v>(&'v self, view: &'v View<'_>) -> impl Iterator<Item = Vec3> + 'v {
        let basis = &view.motion.basis;
        let rises = if view.is_on_ground() { &[0.0][..] } else { &[0.0, FRAC_PI_4, -FRAC_PI_4] };
        rises.iter().flat_map(move |&rise| {
            let ahead = turned(basis.forward, basis.side, -rise);
            (0..self.directions).map(move |k| turned(ahead, basis.up, TAU * k as f32 / self.directions as f32))
        })
    }

    /// How dangerous a velocity is, 0 to 1.
    fn danger(&self, view: &View<'_>, velocity: Vec3) -> f32 {
        let touch = |other: &Neighbour| {
            let relative = other.velocity - velocity;
            let time = time_to_touch(other.offset, relative, view.radius + other.radius);
            // who touches already is no danger where they part
            if time == 0.0 && other.offset.dot(relative) >= 0.0 { f32::INFINITY } else { time }
        };
        let others = view.neighbours.iter().filter(|other| self.who.counts(view, other)).map(touch);
        let speed = velocity.length();
        let ahead = self.barriers.ahead(view.position(), velocity, view.radius, speed * self.horizon);
        // nor is what it is inside of on the way out
        let ahead = ahead.filter(|(_, hit)| hit.distance > 0.0 || hit.steer_hint.dot(velocity) <= 0.0);
        let first = others.chain(ahead.map(|(_, hit)| hit.distance / speed)).fold(f32::INFINITY, f32::min);
        (1.0 - first / self.horizon).clamp(0.0, 1.0)
    }
}

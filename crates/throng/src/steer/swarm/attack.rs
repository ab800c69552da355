//! Aggression: they go for a prey, some ahead of the others.

use super::guide::{Guide, Wish, check_amount, check_range};
use crate::Error;
use crate::steer::{Dice, Neighbour, Target, View, Who};
use glam::Vec3;

/// Chases a prey: aims where it will be in the time in which they could be there, and flies straighter the nearer it is. Some lead; the
/// others go with the leaders they see, and where they see none, with those about them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attack {
    /// Whom.
    pub prey: Target,
    /// How near it must be, metres. Limit: > 0.
    pub within: f32,
    /// How fast, m/s. Limit: >= 0.
    pub speed: f32,
    /// Within this distance of it, metres, the noise fades. Limit: > 0.
    pub near: f32,
    /// What part of the noise is left at the prey. Limit: 0 to 1.
    pub calm: f32,
    /// How many lead: part of all. Limit: 0 to 1.
    pub leaders: f32,
    /// How far the others look for those they go with, metres. Limit: >= 0.
    pub follow: f32,
}

impl From<Target> for Attack {
    fn from(prey: Target) -> Self {
        Self { prey, within: f32::INFINITY, speed: 1.5, near: 1.0, calm: 0.2, leaders: 1.0, follow: 0.0 }
    }
}

impl Attack {
    /// Whether the one with these dice leads: always the same.
    fn leads(&self, dice: Dice) -> bool {
        dice.at(0).draw(2) < self.leaders
    }

    /// Where those lead whom it goes with: to the middle of the leaders, or else along with its neighbours.
    fn followed(&self, view: &View<'_>) -> Vec3 {
        let seen = |other: &&Neighbour| {
            Who::OwnGroup.counts(view, other) && other.offset.length_squared() <= self.follow * self.follow
        };
        let (mut middle, mut leaders, mut along) = (Vec3::ZERO, 0.0, Vec3::ZERO);
        for other in view.neighbours.iter().filter(seen) {
            if self.leads(Dice { number: other.number, ..view.dice }) {
                (middle, leaders) = (middle + other.offset, leaders + 1.0);
            }
            along += other.velocity;
        }
        let way = if leaders > 0.0 { middle } else { along };
        way.normalize_or_zero() * self.speed
    }
}

impl Guide for Attack {
    fn reach(&self) -> f32 {
        let sees = matches!(self.prey, Target::Nearest(_)) && self.within.is_finite();
        if sees { self.follow.max(self.within) } else { self.follow }
    }

    fn guide(&self, view: &View<'_>, _: &mut [f32], wish: &mut Wish) {
        let Some(prey) = self.prey.find(view) else { return };
        let distance = view.to(prey.position).length();
        if distance > self.within {
            return;
        }
        wish.noise *= self.calm + (1.0 - self.calm) * (distance / self.near).min(1.0);
        wish.velocity += if self.leads(view.dice) {
            let there = prey.position_in(distance / view.vehicle.max_speed);
            view.to(there).normalize_or_zero() * self.speed
        } else {
            self.followed(view)
        };
    }

    fn check(&self) -> Result<(), Error> {
        check_range("distance of the prey", self.within)?;
        check_amount("speed of the attack", self.speed)?;
        Error::unless_positive("distance of calm", self.near)?;
        Error::unless((0.0..=1.0).contains(&self.calm), "noise at the prey", self.calm, "from 0 to 1")?;
        Error::unless((0.0..=1.0).contains(&self.leaders), "part that leads", self.leaders, "from 0 to 1")?;
        check_amount("distance of those followed", self.follow)
    }
}

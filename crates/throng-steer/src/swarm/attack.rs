//! Aggression: a swarm chases a prey, some insects ahead of the rest.

use super::guide::{Guide, GuideOutput, check_amount, check_range};
use glam::Vec3;
use throng::Error;
use throng::steer::{GroupFilter, Rng, SteeringInput, SteeringNeighbour, Target};

/// Chases a prey: an insect aims at the predicted position of the prey at the time of arrival, and flies straighter the
/// nearer it is. Some insects lead. The rest follow the leaders that they perceive, or fly along with their neighbours
/// if they perceive no leader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attack {
    /// The prey.
    pub prey: Target,
    /// Distance of the prey within which it is chased, metres. Limit: > 0.
    pub within: f32,
    /// Speed, m/s. Limit: >= 0.
    pub speed: f32,
    /// Distance from the prey within which the noise fades, metres. Limit: > 0.
    pub near: f32,
    /// Part of the noise that is left at the prey. Limit: 0 to 1.
    pub calm: f32,
    /// Part of the insects that lead. Limit: 0 to 1.
    pub leaders: f32,
    /// Distance within which the rest look for insects to follow, metres. Limit: >= 0.
    pub follow: f32,
}

impl From<Target> for Attack {
    fn from(prey: Target) -> Self {
        Self { prey, within: f32::INFINITY, speed: 1.5, near: 1.0, calm: 0.2, leaders: 1.0, follow: 0.0 }
    }
}

impl Attack {
    /// Whether the insect with this random number generator leads; the same in every step.
    fn leads(&self, rng: Rng) -> bool {
        rng.at(0).draw(2) < self.leaders
    }

    /// Returns the velocity of a follower: to the mean position of the leaders nearby, or along with its neighbours.
    fn followed(&self, view: &SteeringInput<'_>) -> Vec3 {
        let seen = |other: &&SteeringNeighbour| {
            GroupFilter::OwnGroup.counts(view, other) && other.offset.length_squared() <= self.follow * self.follow
        };
        let (mut middle, mut leaders, mut along) = (Vec3::ZERO, 0.0, Vec3::ZERO);
        for other in view.neighbours.iter().filter(seen) {
            if self.leads(Rng { number: other.number, ..view.rng }) {
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

    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        let Some(prey) = self.prey.find(view) else { return };
        let distance = view.to(prey.position).length();
        if distance > self.within {
            return;
        }
        chosen.noise *= self.calm + (1.0 - self.calm) * (distance / self.near).min(1.0);
        chosen.velocity += if self.leads(view.rng) {
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

//! Aggression: a swarm chases a prey, some insects ahead of the rest.

use super::guide::{Guide, GuideOutput};
use glam::Vec3;
use throng::Error;
use throng::parameters::{Value, parameters};
use throng::steer::{GroupFilter, Rng, SteeringInput, SteeringNeighbour, Target};

/// Attacks a target.
///
/// An insect aims at the predicted position of the prey at the time of arrival, and flies straighter the
/// nearer it is. Some insects lead. The rest follow the leaders that they perceive, or fly along with their neighbours
/// if they perceive no leader.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attack {
    /// The prey.
    #[parameter(required)]
    pub prey: Target,
    /// Greatest distance at which it attacks, metres. Without it, any distance.
    #[parameter(default = f32::INFINITY, infinite, unit = "m", above = 0)]
    pub within: f32,
    /// Speed of the attack, m/s.
    #[parameter(default = 1.5, unit = "m/s", least = 0)]
    pub speed: f32,
    /// Distance to the prey within which the noise fades, metres.
    #[parameter(default = 1.0, unit = "m", above = 0)]
    pub near: f32,
    /// Part of the noise that is left at the prey.
    #[parameter(default = 0.2, least = 0, most = 1)]
    pub calm: f32,
    /// Part of the agents that lead.
    #[parameter(default = 1.0, least = 0, most = 1)]
    pub leaders: f32,
    /// Height of the point that it attacks above the prey's position, metres.
    #[parameter(default = 0.0, unit = "m", least = 0)]
    pub height: f32,
    /// Distance within which the other agents look for agents to follow, metres.
    #[parameter(default = 0.0, unit = "m", least = 0)]
    pub follow: f32,
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
        let Some(mut prey) = self.prey.find(view) else { return };
        prey.position += Vec3::Z * self.height;
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
        self.check_limits()
    }
}

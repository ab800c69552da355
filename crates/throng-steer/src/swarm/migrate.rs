//! Migration: together along a path, within a range of heights.

use super::guide::{Guide, GuideOutput};
use glam::Vec3;
use std::sync::Arc;
use throng::Error;
use throng::parameters::{Value, parameters};
use throng::space::Pathway;
use throng::steer::{GroupFilter, SteeringInput, SteeringNeighbour};

/// Migrates along a path.
///
/// An insect flies along the path, and back to its spine from outside: the global field round an optimised trajectory. The insects
/// gather at the end of an open path.
#[parameters]
#[derive(Clone, Debug, PartialEq)]
pub struct Migrate {
    /// The path, by its name; inside its radius no guide draws to its centre line.
    #[parameter(required)]
    pub path: Arc<Pathway>,
    /// Speed along the path, m/s.
    #[parameter(default = 1.5, unit = "m/s", least = 0)]
    pub speed: f32,
    /// Speed back to the path for every metre outside of it, 1/s.
    #[parameter(default = 1.0, unit = "1/s", least = 0)]
    pub rate: f32,
}

impl Guide for Migrate {
    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        let near = self.path.nearest(view.position());
        let to = view.to(near.point);
        chosen.velocity += to.normalize_or_zero() * (self.rate * near.outside.max(0.0));
        if self.path.is_cyclic() || near.along < self.path.length() {
            chosen.velocity += view.passable(near.tangent) * self.speed;
        }
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// Matches the velocity of near agents, as locusts do.
///
/// It adds a multiple of the difference between their mean velocity and the insect's velocity.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Align {
    /// Reach, metres.
    #[parameter(default = 0.5, unit = "m", least = 0)]
    pub distance: f32,
    /// Weight of the match.
    #[parameter(default = 0.5, least = 0)]
    pub weight: f32,
}

impl Guide for Align {
    fn reach(&self) -> f32 {
        self.distance
    }

    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        let seen = |other: &&SteeringNeighbour| {
            GroupFilter::OwnGroup.counts(view, other) && other.offset.length_squared() <= self.distance * self.distance
        };
        let (mut sum, mut count) = (Vec3::ZERO, 0.0);
        for other in view.neighbours.iter().filter(seen) {
            (sum, count) = (sum + other.velocity, count + 1.0);
        }
        if count > 0.0 {
            chosen.velocity += (sum / count - view.velocity()) * self.weight;
        }
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// Stays between two heights.
#[parameters(check = <Self as Guide>::check)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightBand {
    /// The lower height, metres.
    #[parameter(required, unit = "m")]
    pub low: f32,
    /// The upper height, metres. Limit: at least `low`.
    #[parameter(required, unit = "m")]
    pub high: f32,
    /// Speed back into the band for every metre outside of it, 1/s.
    #[parameter(default = 1.0, unit = "1/s", least = 0)]
    pub rate: f32,
}

impl Guide for HeightBand {
    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        let z = view.position().z;
        chosen.velocity += view.passable(Vec3::Z * ((z.clamp(self.low, self.high) - z) * self.rate));
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        Error::unless(self.high >= self.low, "high", self.high, "at least low")
    }
}

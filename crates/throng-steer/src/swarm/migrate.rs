//! Migration: together along a path, within a range of heights.

use super::guide::{Guide, GuideOutput, check_amount};
use glam::Vec3;
use std::sync::Arc;
use throng::Error;
use throng::space::Pathway;
use throng::steer::{GroupFilter, SteeringInput, SteeringNeighbour};

/// Flies along a path, and back to its spine from outside: the global field round an optimised trajectory. The insects
/// gather at the end of an open path.
#[derive(Clone, Debug, PartialEq)]
pub struct Migrate {
    /// The path; within its radius there is no attraction to the spine.
    pub path: Arc<Pathway>,
    /// Speed along the path, m/s. Limit: >= 0.
    pub speed: f32,
    /// Speed back to the path per metre outside of it, 1/s. Limit: >= 0.
    pub rate: f32,
}

impl Migrate {
    /// Returns the migration along a path.
    pub fn new(path: Pathway) -> Self {
        Self { path: Arc::new(path), speed: 1.0, rate: 2.0 }
    }
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
        check_amount("speed along the path", self.speed)?;
        check_amount("rate back to the path", self.rate)
    }
}

/// Aligns with the neighbours, as locusts do: adds a multiple of the difference between their mean velocity and the
/// insect's velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Align {
    /// Distance of the neighbours that count, metres. Limit: >= 0.
    pub distance: f32,
    /// Factor on the difference. Limit: >= 0.
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
        check_amount("distance of alignment", self.distance)?;
        check_amount("weight of alignment", self.weight)
    }
}

/// Keeps insects between two heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightBand {
    /// Least height, metres. Limit: finite.
    pub low: f32,
    /// Greatest height, metres. Limit: >= low.
    pub high: f32,
    /// Speed back per metre outside, 1/s. Limit: >= 0.
    pub rate: f32,
}

impl Guide for HeightBand {
    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        let z = view.position().z;
        chosen.velocity += view.passable(Vec3::Z * ((z.clamp(self.low, self.high) - z) * self.rate));
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_finite("lowest height", self.low.into())?;
        Error::unless(self.high >= self.low, "greatest height", self.high, "at least the lowest")?;
        check_amount("rate back to the height", self.rate)
    }
}

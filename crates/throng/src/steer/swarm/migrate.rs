//! Migration: along a path, together, at a height.

use super::guide::{Guide, Wish, check_amount};
use crate::Error;
use crate::space::Pathway;
use crate::steer::{Neighbour, View, Who};
use glam::Vec3;
use std::sync::Arc;

/// Flies along a path, and to its spine where it is off it: the global field round an optimised trajectory. At the end of an open path
/// they gather.
#[derive(Clone, Debug, PartialEq)]
pub struct Migrate {
    /// The path; within its radius nothing draws to the spine.
    pub path: Arc<Pathway>,
    /// How fast along it, m/s. Limit: >= 0.
    pub speed: f32,
    /// How fast back to it for every metre that they are outside of it, 1/s. Limit: >= 0.
    pub rate: f32,
}

impl Migrate {
    /// Along a path.
    pub fn new(path: Pathway) -> Self {
        Self { path: Arc::new(path), speed: 1.0, rate: 2.0 }
    }
}

impl Guide for Migrate {
    fn guide(&self, view: &View<'_>, _: &mut [f32], wish: &mut Wish) {
        let near = self.path.nearest(view.position());
        let to = view.to(near.point);
        wish.velocity += to.normalize_or_zero() * (self.rate * near.outside.max(0.0));
        if self.path.is_cyclic() || near.along < self.path.length() {
            wish.velocity += view.passable(near.tangent) * self.speed;
        }
    }

    fn check(&self) -> Result<(), Error> {
        check_amount("speed along the path", self.speed)?;
        check_amount("rate back to the path", self.rate)
    }
}

/// Flies as those about it do, as locusts: the difference from the mean of their velocities, so many times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Align {
    /// How far they look, metres. Limit: >= 0.
    pub distance: f32,
    /// How much. Limit: >= 0.
    pub weight: f32,
}

impl Guide for Align {
    fn reach(&self) -> f32 {
        self.distance
    }

    fn guide(&self, view: &View<'_>, _: &mut [f32], wish: &mut Wish) {
        let seen = |other: &&Neighbour| {
            Who::OwnGroup.counts(view, other) && other.offset.length_squared() <= self.distance * self.distance
        };
        let (mut sum, mut count) = (Vec3::ZERO, 0.0);
        for other in view.neighbours.iter().filter(seen) {
            (sum, count) = (sum + other.velocity, count + 1.0);
        }
        if count > 0.0 {
            wish.velocity += (sum / count - view.velocity()) * self.weight;
        }
    }

    fn check(&self) -> Result<(), Error> {
        check_amount("distance of alignment", self.distance)?;
        check_amount("weight of alignment", self.weight)
    }
}

/// Keeps between two heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightBand {
    /// Not below, metres. Limit: finite.
    pub low: f32,
    /// Not above, metres. Limit: >= low.
    pub high: f32,
    /// How fast back for every metre beyond, 1/s. Limit: >= 0.
    pub rate: f32,
}

impl Guide for HeightBand {
    fn guide(&self, view: &View<'_>, _: &mut [f32], wish: &mut Wish) {
        let z = view.position().z;
        wish.velocity += view.passable(Vec3::Z * ((z.clamp(self.low, self.high) - z) * self.rate));
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_finite("lowest height", self.low.into())?;
        Error::unless(self.high >= self.low, "greatest height", self.high, "at least the lowest")?;
        check_amount("rate back to the height", self.rate)
    }
}

//! Aggregation: a swarm stays together over a marker.

use super::guide::{Guide, Wish, check_amount};
use crate::Error;
use crate::steer::{Target, View};

/// Is drawn to a marker, the more the farther it is from it: midges over a stone. Strong noise spreads them about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aggregate {
    /// What they gather at.
    pub marker: Target,
    /// How fast they are for every metre that they are too far off, 1/s. Limit: >= 0.
    pub rate: f32,
    /// Within this distance of it, metres, nothing draws them. Limit: >= 0.
    pub beyond: f32,
}

impl From<Target> for Aggregate {
    fn from(marker: Target) -> Self {
        Self { marker, rate: 1.0, beyond: 0.0 }
    }
}

impl Guide for Aggregate {
    fn guide(&self, view: &View<'_>, _: &mut [f32], wish: &mut Wish) {
        let Some(marker) = self.marker.find(view) else { return };
        let offset = view.to(marker.position);
        let distance = offset.length();
        if distance > self.beyond {
            wish.velocity += offset * (self.rate * (distance - self.beyond) / distance);
        }
    }

    fn check(&self) -> Result<(), Error> {
        check_amount("rate of aggregation", self.rate)?;
        check_amount("radius of aggregation", self.beyond)
    }
}

//! Aggregation: a swarm stays above a marker.

use super::guide::{Guide, GuideOutput, check_amount};
use throng::Error;
use throng::steer::{SteeringInput, Target};

/// Attracts insects to a marker, the more the farther they are from it: midges over a stone. Strong noise spreads them
/// about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aggregate {
    /// The marker.
    pub marker: Target,
    /// Speed per metre of excess distance, 1/s. Limit: >= 0.
    pub rate: f32,
    /// Distance within which the marker does not attract, metres. Limit: >= 0.
    pub beyond: f32,
}

impl From<Target> for Aggregate {
    fn from(marker: Target) -> Self {
        Self { marker, rate: 1.0, beyond: 0.0 }
    }
}

impl Guide for Aggregate {
    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        let Some(marker) = self.marker.find(view) else { return };
        let offset = view.to(marker.position);
        let distance = offset.length();
        if distance > self.beyond {
            chosen.velocity += offset * (self.rate * (distance - self.beyond) / distance);
        }
    }

    fn check(&self) -> Result<(), Error> {
        check_amount("rate of aggregation", self.rate)?;
        check_amount("radius of aggregation", self.beyond)
    }
}

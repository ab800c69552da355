//! Aggregation: a swarm stays above a marker.

use super::guide::{Guide, GuideOutput};
use throng::Error;
use throng::parameters::{Value, parameters};
use throng::steer::{SteeringInput, Target};

/// Gathers at a marker.
///
/// Midges over a stone: the farther an insect is from the marker, the more the marker attracts it. Strong noise spreads
/// the insects about it.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aggregate {
    /// The marker.
    #[parameter(required)]
    pub marker: Target,
    /// Speed for every metre beyond the distance `beyond`, 1/s.
    #[parameter(default = 1.0, unit = "1/s", least = 0)]
    pub rate: f32,
    /// Distance within which the marker does not attract, metres.
    #[parameter(default = 0.0, unit = "m", least = 0)]
    pub beyond: f32,
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
        self.check_limits()
    }
}

//! Escape: insects burst away from a predator.

use super::guide::{Guide, GuideOutput};
use glam::Vec3;
use throng::Error;
use throng::parameters::{Value, parameters};
use throng::steer::{SteeringInput, Target};

/// Flees from a predator.
///
/// An insect bursts away from a predator nearby, and continues for a moment with decreasing speed. Meanwhile the guides before it
/// in the list have less effect, and none while the predator is near.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Escape {
    /// The predator.
    #[parameter(required)]
    pub predator: Target,
    /// Distance of the predator at which it flees, metres.
    #[parameter(default = 1.0, unit = "m", above = 0)]
    pub within: f32,
    /// Speed of the escape, m/s.
    #[parameter(default = 2.0, unit = "m/s", least = 0)]
    pub speed: f32,
    /// How long it continues to flee once the predator is no longer near, seconds.
    #[parameter(default = 0.5, unit = "s", least = 0)]
    pub memory: f32,
}

impl Guide for Escape {
    /// The direction, and the seconds that are left.
    fn memory(&self) -> usize {
        4
    }

    fn reach(&self) -> f32 {
        if matches!(self.predator, Target::Nearest(_)) { self.within } else { 0.0 }
    }

    fn guide(&self, view: &SteeringInput<'_>, memory: &mut [f32], chosen: &mut GuideOutput) {
        let [x, y, z, left] = memory else { return };
        let from = self.predator.find(view).map(|predator| -view.to(predator.position));
        let urgency = match from.filter(|from| from.length_squared() <= self.within * self.within) {
            Some(from) => {
                [*x, *y, *z] = from.normalize_or(view.forward()).to_array();
                *left = self.memory;
                1.0
            }
            None if *left > 0.0 => {
                *left = (*left - view.seconds).max(0.0);
                // `left` is greater than 0, so `memory` is not 0
                *left / self.memory
            }
            None => return,
        };
        chosen.velocity = chosen.velocity * (1.0 - urgency) + Vec3::new(*x, *y, *z) * (self.speed * urgency);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

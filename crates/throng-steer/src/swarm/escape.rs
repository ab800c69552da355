//! Escape: insects burst away from a predator.

use super::guide::{Guide, GuideOutput, check_amount};
use glam::Vec3;
use throng::Error;
use throng::steer::{SteeringInput, Target};

/// Bursts away from a predator nearby, and continues for a moment with decreasing speed. Meanwhile the guides before it
/// in the list have less effect, and none while the predator is near.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Escape {
    /// The predator.
    pub predator: Target,
    /// Distance of the predator that starts the escape, metres. Limit: > 0.
    pub within: f32,
    /// Speed, m/s. Limit: >= 0.
    pub speed: f32,
    /// How long the escape continues after the predator is no longer near, seconds. Limit: >= 0.
    pub memory: f32,
}

impl From<Target> for Escape {
    fn from(predator: Target) -> Self {
        Self { predator, within: 1.0, speed: 2.0, memory: 0.5 }
    }
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
        Error::unless_positive("distance of the predator", self.within)?;
        check_amount("speed of the escape", self.speed)?;
        check_amount("memory of the escape", self.memory)
    }
}

//! Escape: they burst away from a predator.

use super::guide::{Guide, Wish, check_amount};
use crate::Error;
use crate::steer::{Target, View};
use glam::Vec3;

/// Bursts away from a predator that comes near, and goes on so for a moment, ever slower. As long as that lasts, guides before it in the
/// list do not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Escape {
    /// From whom.
    pub predator: Target,
    /// How near it must come, metres. Limit: > 0.
    pub within: f32,
    /// How fast, m/s. Limit: >= 0.
    pub speed: f32,
    /// How long it goes on once the predator is no longer near, seconds. Limit: >= 0.
    pub memory: f32,
}

impl From<Target> for Escape {
    fn from(predator: Target) -> Self {
        Self { predator, within: 1.0, speed: 2.0, memory: 0.5 }
    }
}

impl Guide for Escape {
    /// Where to, and how many seconds are left.
    fn memory(&self) -> usize {
        4
    }

    fn reach(&self) -> f32 {
        if matches!(self.predator, Target::Nearest(_)) { self.within } else { 0.0 }
    }

    fn guide(&self, view: &View<'_>, memory: &mut [f32], wish: &mut Wish) {
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
                // a memory of zero is never left
                *left / self.memory
            }
            None => return,
        };
        wish.velocity = wish.velocity * (1.0 - urgency) + Vec3::new(*x, *y, *z) * (self.speed * urgency);
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("distance of the predator", self.within)?;
        check_amount("speed of the escape", self.speed)?;
        check_amount("memory of the escape", self.memory)
    }
}

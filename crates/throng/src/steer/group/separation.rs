//! Separation: Reynolds, Steering behaviors for autonomous characters, GDC 1999; Flocks, herds, and schools, SIGGRAPH 1987.

use super::Neighbourhood;
use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Neighbour, View, Why};
use glam::Vec3;

/// How the push of a neighbour falls off with its distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// By the distance (Reynolds 1999, OpenSteer).
    #[default]
    Inverse,
    /// By the square of the distance: better damped (Reynolds 1987).
    InverseSquare,
}

/// Keeps away from those who are near: away from each, the more the nearer it is.
///
/// ```
/// use throng::steer::{Neighbourhood, Separation};
/// let near = Neighbourhood { distance: 1.5, ..Neighbourhood::default() };
/// let polite = Separation { near, ..Separation::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// From whom.
    pub near: Neighbourhood,
    /// How their push falls off.
    pub falloff: Falloff,
    /// How long the sum of pushes is, 1/m (or 1/m²), from which it has all of the force; 0: always all, as OpenSteer has it,
    /// and then it may tremble. One neighbour at 1 m is 1. Limit: >= 0.
    pub full: f32,
}

impl Default for Separation {
    fn default() -> Self {
        Self {
            near: Neighbourhood { distance: 2.0, ..Neighbourhood::default() },
            falloff: Falloff::default(),
            full: 2.0,
        }
    }
}

impl Behaviour for Separation {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        self.near.tell(view, why);
        let push = |other: &Neighbour| {
            let distance_squared = other.offset.length_squared();
            match self.falloff {
                _ if distance_squared == 0.0 => aside(view, other),
                Falloff::Inverse => other.offset * (-1.0 / distance_squared),
                Falloff::InverseSquare => other.offset * (-1.0 / (distance_squared * distance_squared.sqrt())),
            }
        };
        view.urge(self.near.of(view).map(push).sum(), self.full)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.full >= 0.0, "full push", self.full, "0 or more")?;
        self.near.check()
    }
}

/// A way out for two in exactly one place: one goes left, the other right.
pub(super) fn aside(view: &View<'_>, other: &Neighbour) -> Vec3 {
    if view.dice.number < other.number { view.motion.basis.side } else { -view.motion.basis.side }
}

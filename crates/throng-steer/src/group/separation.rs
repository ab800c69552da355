//! Separation: Reynolds, Steering behaviors for autonomous characters, GDC 1999; Flocks, herds, and schools, SIGGRAPH
//! 1987.

use super::Neighbourhood;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, SteeringNeighbour, TraceRecorder};

/// How the repulsion by a neighbour decreases with the distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// By the distance (Reynolds 1999, OpenSteer).
    #[default]
    Inverse,
    /// By the square of the distance: better damped (Reynolds 1987).
    InverseSquare,
}

/// Steers away from each neighbour, the more the nearer the neighbour is.
///
/// ```
/// use throng_steer::{Neighbourhood, Separation};
/// let near = Neighbourhood { distance: 1.5, ..Neighbourhood::default() };
/// let polite = Separation { near, ..Separation::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// The neighbourhood.
    pub near: Neighbourhood,
    /// How the repulsion decreases.
    pub falloff: Falloff,
    /// Length of the sum of repulsions, 1/m (or 1/m²), from which on the force is the vehicle's top force; 0: always
    /// the top force, as in OpenSteer, which may cause jitter. One neighbour at 1 m gives 1. Limit: >= 0.
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
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.near.tell(view, why);
        let push = |other: &SteeringNeighbour| {
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

/// Returns opposite sides for two agents at exactly the same position: left for the agent with the smaller number,
/// right for the other agent.
pub(super) fn aside(view: &SteeringInput<'_>, other: &SteeringNeighbour) -> Vec3 {
    if view.rng.number < other.number { view.motion.basis.side } else { -view.motion.basis.side }
}

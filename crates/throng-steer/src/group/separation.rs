//! Separation: Reynolds, Steering behaviors for autonomous characters, GDC 1999; Flocks, herds, and schools, SIGGRAPH
//! 1987.

use super::Neighbourhood;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringNeighbour, TraceRecorder};

/// How the repulsion of a neighbour falls off.
#[parameters]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// With the distance (Reynolds 1999, OpenSteer).
    #[default]
    Inverse,
    /// With the square of the distance: better damped (Reynolds 1987).
    InverseSquare,
}

/// Keeps away from near neighbours (Reynolds 1999).
///
/// The nearer a neighbour is, the greater is the force away from it.
///
/// ```
/// use throng_steer::{Neighbourhood, Separation};
/// let near = Neighbourhood { distance: 1.5, ..Neighbourhood::default() };
/// let polite = Separation { near, ..Separation::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// The neighbours. Without it, all within 2 m.
    #[parameter(default = Neighbourhood { distance: 2.0, ..Neighbourhood::default() })]
    pub near: Neighbourhood,
    /// How the repulsion falls off.
    pub falloff: Falloff,
    /// Length of the sum of repulsions from which on it uses all of the force; one neighbour at 1 m has length 1; 0: it
    /// always does.
    ///
    /// To use all of the force always, as in OpenSteer, may cause jitter.
    #[parameter(default = 2.0, least = 0)]
    pub full: f32,
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
        self.check_limits()
    }
}

/// Returns opposite sides for two agents at exactly the same position: left for the agent with the smaller number,
/// right for the other agent.
pub(super) fn aside(view: &SteeringInput<'_>, other: &SteeringNeighbour) -> Vec3 {
    if view.rng.number < other.number { view.motion.basis.side } else { -view.motion.basis.side }
}

//! Unaligned collision avoidance as in OpenSteer: steerToAvoidNeighbors.

use super::CloseAvoidance;
use crate::approach::nearest_time;
use std::f32::consts::FRAC_1_SQRT_2;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, TraceRecorder};

/// Turns aside from the first neighbour that will come too near, as OpenSteer does.
///
/// It uses the whole force, and keeps the speed. [`UnalignedAvoidance`](super::UnalignedAvoidance) changes the speed too.
///
/// Neighbours that are too close already come first ([`CloseAvoidance`]). The agent passes a neighbour that comes
/// towards it, or that goes the same way, on the free side. Where two ways cross, the faster agent passes behind the
/// slower.
///
/// ```
/// use throng::steer::GroupFilter;
/// use throng_steer::AvoidNeighbours;
/// let walker = AvoidNeighbours { groups: GroupFilter::All, horizon: 3.0 };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AvoidNeighbours {
    /// The neighbours.
    pub groups: GroupFilter,
    /// How far ahead it looks, seconds.
    #[parameter(default = 3.0, unit = "s", above = 0)]
    pub horizon: f32,
}

impl Behaviour for AvoidNeighbours {
    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let close = CloseAvoidance { groups: self.groups, gap: 0.0 };
        close.steer(view, memory, why).or_else(|| self.turn(view, why))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl AvoidNeighbours {
    fn turn(&self, view: &SteeringInput<'_>, why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let (time, threat) = first_threat(view, self.groups, self.horizon, 0.0)?;
        note_threat(view, time, threat, why);
        let side = view.motion.basis.side;
        let parallel = view.forward().dot(threat.forward);
        let on = if parallel < -FRAC_1_SQRT_2 {
            (threat.offset + threat.velocity * time).dot(side)
        } else if parallel > FRAC_1_SQRT_2 {
            threat.offset.dot(side)
        } else if threat.velocity.length() <= view.motion.speed() {
            threat.velocity.dot(side)
        } else {
            return None;
        };
        // on neither side: to the right
        view.veer(if on >= 0.0 { -side } else { side })
    }
}

/// Returns the first neighbour that will come nearer than `gap` to the agent's body within the horizon, seconds, if
/// both keep their velocities, and the time of the closest approach. Of neighbours at equal times the nearest counts.
pub(super) fn first_threat<'a>(
    view: &SteeringInput<'a>,
    groups: GroupFilter,
    horizon: f32,
    gap: f32,
) -> Option<(f32, &'a SteeringNeighbour)> {
    let mut first = None;
    let mut least = horizon;
    for other in view.neighbours.iter().filter(|other| groups.counts(view, other)) {
        let velocity = other.velocity - view.velocity();
        let time = nearest_time(other.offset, velocity);
        let near = (other.offset + velocity * time).length() < view.radius + other.radius + gap;
        if near && time > 0.0 && time < least {
            (least, first) = (time, Some((time, other)));
        }
    }
    first
}

/// Records where the two agents will be.
pub(super) fn note_threat(
    view: &SteeringInput<'_>,
    seconds: f32,
    other: &SteeringNeighbour,
    why: &mut TraceRecorder<'_>,
) {
    why.note(|| SteeringReason::Threat {
        number: other.number,
        seconds,
        own: view.motion.position_in(seconds),
        theirs: view.position() + other.offset + other.velocity * seconds,
    });
}

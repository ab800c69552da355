//! Unaligned collision avoidance: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::avoid_neighbours::{first_threat, note_threat};
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, GroupFilter, SteeringInput, SteeringNeighbour, Target, TraceRecorder};

/// Turns, brakes or speeds up for the first neighbour that will come too near (Reynolds 1999).
///
/// The change of velocity is such that both agents are apart by a gap at their closest approach. A neighbour that the
/// agent touches comes first. On an exact collision course the agent goes to the right.
///
/// ```
/// use throng::steer::GroupFilter;
/// use throng_steer::UnalignedAvoidance;
/// let walker = UnalignedAvoidance { groups: GroupFilter::All, horizon: 4.0, gap: 0.2, destination: None };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnalignedAvoidance {
    /// The neighbours.
    pub groups: GroupFilter,
    /// How far ahead it looks, seconds.
    #[parameter(default = 3.0, unit = "s", above = 0)]
    pub horizon: f32,
    /// Gap between bodies that pass each other, metres.
    #[parameter(default = 0.1, unit = "m", least = 0)]
    pub gap: f32,
    /// The target at which it stops: what would happen beyond it does not count. Without it, all counts.
    pub destination: Option<Target>,
}

impl UnalignedAvoidance {
    /// Returns how far ahead it looks, seconds: at most until it is at its destination.
    fn horizon(&self, view: &SteeringInput<'_>) -> f32 {
        let distance =
            self.destination.and_then(|target| target.find(view)).map(|target| view.to(target.position).length());
        distance
            .map_or(self.horizon, |distance| self.horizon.min(distance / view.velocity().length().max(f32::EPSILON)))
    }
}

/// Part of the sum of radii and gap below which the closest approach counts as exact: then there is no side on which to
/// pass.
const EXACT: f32 = 0.01;

impl Behaviour for UnalignedAvoidance {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let touches = |other: &&SteeringNeighbour| {
            self.groups.counts(view, other) && other.offset.length() < view.radius + other.radius
        };
        let touching = view.neighbours.iter().find(touches).map(|other| (0.0, other));
        let (time, threat) = touching.or_else(|| first_threat(view, self.groups, self.horizon(view), self.gap))?;
        note_threat(view, time, threat, why);
        let apart = view.radius + threat.radius + self.gap;
        let miss = -view.passable(threat.offset + (threat.velocity - view.velocity()) * time);
        let away = if miss.length() > EXACT * apart { miss.normalize() } else { -view.motion.basis.side };
        let time = time.max(view.vehicle.response).max(view.seconds);
        let chosen = view.velocity() + away * ((apart - miss.length()).max(0.0) / time);
        Some(view.reach(chosen.clamp_length_max(view.vehicle.max_speed)))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

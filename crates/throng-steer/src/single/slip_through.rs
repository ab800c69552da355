//! Slipping past defenders to a goal: the seeker of OpenSteer's capture the flag.

use super::evade_all::{EvadeAll, expected};
use throng::Error;
use throng::motion::{Steering, angle_between, turned_towards};
use throng::parameters::{Angle, Value, parameters};
use throng::steer::{Behaviour, GroupFilter, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Moves past the defenders of a target.
///
/// It goes to the target at the top speed while the corridor there is clear. While it is not, the agent also evades the
/// agents that close it. The agent turns gradually and never turns back. Nothing to correct if the target does not
/// exist. The defaults are OpenSteer's numbers: past all agents of other groups.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, SteeringNeighbour, Target, TraceRecorder};
/// use throng_steer::SlipThrough;
/// let defender = SteeringNeighbour {
///     offset: Vec3::new(5.0, 0.5, 0.0), velocity: Vec3::ZERO, forward: -Vec3::X, radius: 0.2, number: 1, group: 1,
/// };
/// let slip = SlipThrough::new(Target::Point(Vec3::X * 20.0));
/// let alone = SteeringInput::default();
/// let met = SteeringInput { neighbours: &[defender], ..alone };
/// assert!(slip.is_clear(&alone) && !slip.is_clear(&met));
/// let steering = slip.steer(&met, &mut [], &mut TraceRecorder::default()).expect("it is on its way");
/// assert!(steering.force.y < 0.0, "past it on the other side");
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipThrough {
    /// The target.
    #[parameter(required)]
    pub target: Target,
    /// The agents it moves past, and how it evades them.
    pub evade: EvadeAll,
    /// How far ahead it predicts agents in the corridor: a part of the time in which it would reach them itself.
    #[parameter(default = 0.3, least = 0)]
    pub ahead: f32,
    /// Extent of the corridor to either side, in radii of its body.
    #[parameter(default = 8.0, above = 0)]
    pub width: f32,
    /// Greatest angle between its direction and straight ahead, degrees.
    #[parameter(default = Angle::degrees(45.0), unit = "°", above = 0, most = 180)]
    pub turn: Angle,
}

/// Cosine of the angle from which on the target is to the side.
const ASIDE: f32 = std::f32::consts::FRAC_1_SQRT_2;

impl SlipThrough {
    /// Sets the groups of agents to slip past.
    pub fn past(self, groups: GroupFilter) -> Self {
        Self { evade: EvadeAll { groups, ..self.evade }, ..self }
    }

    /// Whether no agent is, or soon will be, between the agent and its target; agents safely behind do not count.
    pub fn is_clear(&self, view: &SteeringInput<'_>) -> bool {
        let Some(offset) = self.target.find(view).map(|mark| view.to(mark.position)) else { return true };
        let (radius, length) = (view.radius, offset.length());
        let Some(way) = offset.try_normalize() else { return true };
        let target_aside = view.forward().dot(way).abs() < ASIDE;
        let closes = |then: glam::Vec3| {
            let (along, front) = (then.dot(way), then.dot(view.forward()));
            let across = then.reject_from_normalized(way).length();
            let behind = front < -4.0 * radius || target_aside && front < -2.0 * radius;
            !behind && across < self.width * radius && (-2.0 * radius..=length).contains(&along)
        };
        let mut others = view.neighbours.iter().filter(|other| self.evade.groups.counts(view, other));
        !others.any(|other| closes(expected(view, other, self.ahead)))
    }
}

impl Behaviour for SlipThrough {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let target = self.target.find(view)?.position;
        why.note(|| SteeringReason::Aim(target));
        let seek = view.to(target).normalize_or_zero();
        let away = if self.is_clear(view) { glam::Vec3::ZERO } else { self.evade.away(view, why) };
        let chosen = (seek + away).try_normalize()?;
        let forward = view.forward();
        let angle = angle_between(forward, chosen).min(self.turn.radians());
        view.go(turned_towards(forward, chosen, angle, view.motion.basis.up))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

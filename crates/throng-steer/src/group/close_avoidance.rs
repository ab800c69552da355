//! Avoidance of neighbours that are too close already: OpenSteer's steerToAvoidCloseNeighbors.

use super::separation::aside;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, GroupFilter, SteeringInput, SteeringReason, TraceRecorder};

/// Turns aside from a neighbour that is too close, as OpenSteer does.
///
/// It turns from the nearest one, with the whole force.
///
/// ```
/// use throng::steer::GroupFilter;
/// use throng_steer::CloseAvoidance;
/// let careful = CloseAvoidance { groups: GroupFilter::All, gap: 0.1 };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloseAvoidance {
    /// The neighbours.
    pub groups: GroupFilter,
    /// Least gap between bodies, metres.
    #[parameter(unit = "m", least = 0)]
    pub gap: f32,
}

impl Behaviour for CloseAvoidance {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let mut all = view.neighbours.iter().filter(|other| self.groups.counts(view, other));
        let close = all.find(|other| other.offset.length() < self.gap + view.radius + other.radius)?;
        why.note(|| SteeringReason::Regards(close.number));
        let away = view.passable(-view.motion.basis.lateral(close.offset));
        // a neighbour right ahead or behind has no side
        let away = if away.length() > 1e-3 * view.radius { away } else { aside(view, close) };
        view.veer(away)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

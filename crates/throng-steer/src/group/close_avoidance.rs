//! Avoidance of neighbours that are too close already: OpenSteer's steerToAvoidCloseNeighbors.

use super::separation::aside;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, GroupFilter, SteeringInput, SteeringReason, TraceRecorder};

/// Turns aside, with the whole force, from the nearest neighbour that is too close.
///
/// ```
/// use throng::steer::GroupFilter;
/// use throng_steer::CloseAvoidance;
/// let careful = CloseAvoidance { groups: GroupFilter::All, gap: 0.1 };
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CloseAvoidance {
    /// The agents to avoid.
    pub groups: GroupFilter,
    /// Least distance between bodies, metres. Limit: >= 0.
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
        Error::unless(self.gap >= 0.0, "gap", self.gap, "0 or more")
    }
}

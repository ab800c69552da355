//! Guidance along a field.

use super::guide::{Guide, GuideOutput};
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::parameters::{Value, parameters};
use throng::steer::{SteeringInput, SteeringReason, TraceRecorder};

/// Follows a field: wind, a path to a goal.
#[parameters]
#[derive(Clone)]
pub struct Flow {
    /// The field.
    #[parameter(name = "flow", required)]
    pub field: Arc<dyn Field>,
    /// Weight of the field.
    #[parameter(default = 1.0, least = 0)]
    pub weight: f32,
}

impl Flow {
    /// Returns the guide with the whole velocity of a field.
    pub fn of(field: impl Field + 'static) -> Self {
        Self::new(Arc::new(field) as Arc<dyn Field>)
    }
}

impl Guide for Flow {
    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        chosen.velocity += self.field.velocity(view.position(), view.time) * self.weight;
    }

    fn tell(&self, view: &SteeringInput<'_>, why: &mut TraceRecorder<'_>) {
        let place = view.position();
        why.note(|| SteeringReason::Samples { place, velocity: self.field.velocity(place, view.time) * self.weight });
        tell_spine(&*self.field, why);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl fmt::Debug for Flow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Flow").field("weight", &self.weight).finish_non_exhaustive()
    }
}

/// Records the curve along which a field leads.
pub(crate) fn tell_spine(field: &dyn Field, why: &mut TraceRecorder<'_>) {
    if !why.is_requested() {
        return;
    }
    let Some(spine) = field.spine() else { return };
    for ends in spine.points.windows(2) {
        why.note(|| SteeringReason::Stretch { from: ends[0], to: ends[1], radius: spine.radius });
    }
}

//! Guidance along a field.

use super::guide::{Guide, GuideOutput, check_amount};
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::steer::SteeringInput;

/// Adds the velocity of a field: wind, a sketched field, a flow to a goal.
#[derive(Clone)]
pub struct Flow {
    /// The field.
    pub field: Arc<dyn Field>,
    /// Weight of the field's velocity. Limit: >= 0.
    pub weight: f32,
}

impl Flow {
    /// Returns the guide with the whole velocity of a field.
    pub fn new(field: impl Field + 'static) -> Self {
        Self { field: Arc::new(field), weight: 1.0 }
    }
}

impl Guide for Flow {
    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        chosen.velocity += self.field.velocity(view.position(), view.time) * self.weight;
    }

    fn check(&self) -> Result<(), Error> {
        check_amount("weight of a flow", self.weight)
    }
}

impl fmt::Debug for Flow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Flow").field("weight", &self.weight).finish_non_exhaustive()
    }
}

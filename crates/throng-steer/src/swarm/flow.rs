//! Guidance along a field.

use super::guide::{Guide, GuideOutput};
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::parameters::{Value, parameters};
use throng::steer::SteeringInput;

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

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl fmt::Debug for Flow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Flow").field("weight", &self.weight).finish_non_exhaustive()
    }
}

//! Along a field.

use super::guide::{Guide, Wish, check_amount};
use crate::Error;
use crate::field::Field;
use crate::steer::View;
use std::fmt;
use std::sync::Arc;

/// Goes with a field: wind, a way sketched, a flow to a goal.
#[derive(Clone)]
pub struct Flow {
    /// The field.
    pub field: Arc<dyn Field>,
    /// How much of it. Limit: >= 0.
    pub weight: f32,
}

impl Flow {
    /// With all of a field.
    pub fn new(field: impl Field + 'static) -> Self {
        Self { field: Arc::new(field), weight: 1.0 }
    }
}

impl Guide for Flow {
    fn guide(&self, view: &View<'_>, _: &mut [f32], wish: &mut Wish) {
        wish.velocity += self.field.velocity(view.position(), view.time) * self.weight;
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

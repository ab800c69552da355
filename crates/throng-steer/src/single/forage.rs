//! Forage: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Wander".

use crate::Wander;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, Target, TraceRecorder, check_parts};

/// Wanders until it sees its food, then moves there (Reynolds 1999).
///
/// ```
/// use throng::steer::{GroupFilter, Target};
/// use throng_steer::Forage;
/// let bird = Forage::new(Target::Nearest(GroupFilter::Group(2)), 8.0_f32);
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Forage {
    /// The food.
    #[parameter(required)]
    pub food: Target,
    /// Distance at which it sees the food, metres.
    #[parameter(required, unit = "m", above = 0)]
    pub range: f32,
    /// The behaviour until then. Without it, it wanders.
    #[parameter(default = Wander::default().into())]
    pub of: BoxedBehaviour,
}

impl Behaviour for Forage {
    fn memory(&self) -> usize {
        self.of.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let food = self.food.find(view).filter(|food| view.to(food.position).length() <= self.range);
        match food {
            Some(food) => view.seek(food.position, why),
            None => self.of.steer_as(0, view, &mut memory, why),
        }
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.of.fields(see);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        check_parts([&self.of])
    }
}

//! Forage: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Wander".

use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, Target, TraceRecorder, check_parts};

/// Looks for food: wanders until it perceives food, then goes there.
///
/// ```
/// use throng::steer::{GroupFilter, Target};
/// use throng_steer::{Forage, Wander};
/// let bird = Forage { food: Target::Nearest(GroupFilter::Group(2)), range: 8.0, wander: Wander::default().into() };
/// ```
#[derive(Clone, Debug)]
pub struct Forage {
    /// The food.
    pub food: Target,
    /// Distance at which the agent perceives food, metres. Limit: > 0.
    pub range: f32,
    /// The behaviour until then.
    pub wander: BoxedBehaviour,
}

impl Behaviour for Forage {
    fn memory(&self) -> usize {
        self.wander.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let food = self.food.find(view).filter(|food| view.to(food.position).length() <= self.range);
        match food {
            Some(food) => view.seek(food.position, why),
            None => self.wander.steer_as(0, view, &mut memory, why),
        }
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.range > 0.0, "range of sight", self.range, "greater than 0")?;
        check_parts([&self.wander])
    }
}

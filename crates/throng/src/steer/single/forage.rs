//! Forage: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Wander".

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Branch, Target, View, Why, behaviour};

/// Looks for food: wanders until it sees some, then goes there.
///
/// ```
/// use throng::steer::{Forage, Target, Wander, Who};
/// let bird = Forage { food: Target::Nearest(Who::Group(2)), range: 8.0, wander: Wander::default().into() };
/// ```
#[derive(Clone, Debug)]
pub struct Forage {
    /// What it looks for.
    pub food: Target,
    /// How near it must be to see it, metres. Limit: > 0.
    pub range: f32,
    /// What it does until then.
    pub wander: Branch,
}

impl Behaviour for Forage {
    fn memory(&self) -> usize {
        self.wander.words()
    }

    fn steer(&self, view: &View<'_>, mut memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let food = self.food.find(view).filter(|food| view.to(food.position).length() <= self.range);
        match food {
            Some(food) => view.seek(food.position, why),
            None => self.wander.steer_as(0, view, &mut memory, why),
        }
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.range > 0.0, "range of sight", self.range, "greater than 0")?;
        behaviour::check([&self.wander])
    }
}

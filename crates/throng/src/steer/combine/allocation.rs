//! Prioritised acceleration allocation: Reynolds, Flocks, herds, and schools, SIGGRAPH 1987, "Arbitrating independent
//! behaviors".

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Branch, View, Why, behaviour};
use glam::Vec3;

/// Forces are granted in order until there is none left: the lengths of all that is granted add up to a budget at most. In
/// an emergency the first have all of it.
///
/// ```
/// use throng::steer::{Allocation, Flocking, Seek, Separation, Target};
/// let parts = vec![Separation::default().into(), Flocking::default().into(), Seek { target: Target::Goal }.into()];
/// let bird = Allocation { budget: 0.9, parts };
/// ```
#[derive(Clone, Debug)]
pub struct Allocation {
    /// How much there is, as a part of the vehicle's top force. Limit: > 0 to 1.
    pub budget: f32,
    /// The parts, the most important first.
    pub parts: Vec<Branch>,
}

impl Behaviour for Allocation {
    fn memory(&self) -> usize {
        behaviour::words(&self.parts)
    }

    fn steer(&self, view: &View<'_>, mut memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let mut budget = Budget(self.budget * view.vehicle.max_force);
        let mut sum = None;
        for (index, part) in self.parts.iter().enumerate() {
            if budget.0 <= 0.0 {
                break;
            }
            if let Some(said) = part.steer_as(index, view, &mut memory, why) {
                sum = Some(super::add(sum, Steering { force: budget.grant(said.force), ..said }));
            }
        }
        sum
    }

    fn check(&self) -> Result<(), Error> {
        let right = self.budget > 0.0 && self.budget <= 1.0;
        Error::unless(right, "budget", self.budget, "greater than 0, up to 1")?;
        behaviour::check(&self.parts)
    }
}

/// What there is left to grant.
pub(in crate::steer) struct Budget(pub f32);

impl Budget {
    /// As much of a vector as there is left.
    pub fn grant(&mut self, wish: Vec3) -> Vec3 {
        let granted = wish.clamp_length_max(self.0.max(0.0));
        self.0 -= wish.length();
        granted
    }
}

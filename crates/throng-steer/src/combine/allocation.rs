//! Prioritised acceleration allocation: Reynolds, Flocks, herds, and schools, SIGGRAPH 1987, "Arbitrating independent
//! behaviors".

use glam::Vec3;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{
    Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, TraceRecorder, check_parts, words_of_parts,
};

/// The force is a budget: the parts take from it in order (Reynolds 1987).
///
/// Grants forces in order until the budget is used up: the lengths of the granted forces add up to the budget at most.
/// In an emergency the first parts take the whole budget.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{Allocation, Flocking, Seek, Separation};
/// let parts = vec![Separation::default().into(), Flocking::default().into(), Seek { target: Target::Goal }.into()];
/// let bird = Allocation { budget: 0.9, parts };
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Allocation {
    /// The budget, as a part of the vehicle's greatest force.
    #[parameter(default = 1.0, above = 0, most = 1)]
    pub budget: f32,
    /// The parts, the most important first.
    #[parameter(name = "of", required)]
    pub parts: Vec<BoxedBehaviour>,
}

impl Behaviour for Allocation {
    fn memory(&self) -> usize {
        words_of_parts(&self.parts)
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let mut budget = Budget(self.budget * view.vehicle.max_force);
        let mut sum = None;
        for (index, part) in self.parts.iter().enumerate() {
            if budget.0 <= 0.0 {
                break;
            }
            if let Some(said) = part.steer_as(index, view, &mut memory, why) {
                let force = budget.grant(said.force);
                why.note(|| SteeringReason::Adds(force / view.vehicle.mass));
                sum = Some(super::add(sum, Steering { force, ..said }));
            }
        }
        sum
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.parts.iter().for_each(|part| part.fields(see));
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        check_parts(&self.parts)
    }
}

/// The rest of the budget.
pub(crate) struct Budget(pub f32);

impl Budget {
    /// Returns a vector, shortened to the rest of the budget if it is longer, and reduces the budget.
    pub fn grant(&mut self, chosen: Vec3) -> Vec3 {
        let granted = chosen.clamp_length_max(self.0.max(0.0));
        self.0 -= chosen.length();
        granted
    }
}

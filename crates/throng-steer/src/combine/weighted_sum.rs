//! Weighted sum: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Combining behaviors".

use super::add;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::parameters;
use throng::steer::{
    Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, TraceRecorder, check_parts, words_of_parts,
};

/// The sum of all parts, each times its weight (Reynolds 1999).
///
/// Cheap and smooth, but opposite forces cancel out.
///
/// ```
/// use throng_steer::{MoveForward, Wander, WeightedSum};
/// let stroll = WeightedSum(vec![(0.5, MoveForward { part: 1.0 }.into()), (1.0, Wander::default().into())]);
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct WeightedSum(
    /// Weights and parts. Limit: weights >= 0.
    #[parameter(from = WeightedParts)]
    pub Vec<(f32, BoxedBehaviour)>,
);

/// A part of a sum.
#[parameters]
pub(super) struct Weighted {
    /// Factor of its force.
    #[parameter(default = 1.0, least = 0)]
    weight: f32,
    /// The behaviour of this part.
    #[parameter(required)]
    of: BoxedBehaviour,
}

/// Parts as files write them.
#[parameters]
pub(super) struct WeightedParts(Vec<Weighted>);

impl From<WeightedParts> for Vec<(f32, BoxedBehaviour)> {
    fn from(WeightedParts(parts): WeightedParts) -> Self {
        parts.into_iter().map(|Weighted { weight, of }| (weight, of)).collect()
    }
}

impl Behaviour for WeightedSum {
    fn memory(&self) -> usize {
        words_of_parts(self.0.iter().map(|(_, part)| part))
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let mut sum = None;
        for (index, (weight, part)) in self.0.iter().enumerate() {
            if let Some(said) = part.steer_as(index, view, &mut memory, why) {
                let force = said.force * *weight;
                why.note(|| SteeringReason::Adds(force / view.vehicle.mass));
                sum = Some(add(sum, Steering { force, ..said }));
            }
        }
        sum
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.0.iter().for_each(|(_, part)| part.fields(see));
    }

    fn check(&self) -> Result<(), Error> {
        check_weights(&self.0)
    }
}

/// Checks weights and parts.
pub(super) fn check_weights(parts: &[(f32, BoxedBehaviour)]) -> Result<(), Error> {
    for &(weight, _) in parts {
        Error::unless(weight >= 0.0 && weight.is_finite(), "weight", weight, "0 or more and finite")?;
    }
    check_parts(parts.iter().map(|(_, part)| part))
}

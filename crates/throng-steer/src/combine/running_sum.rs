//! Weighted truncated running sum: Buckland, Programming game AI by example, 2005, chapter 3 (yuka's manager).

use super::add;
use super::weighted_sum::{WeightedParts, check_weights};
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::parameters;
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, TraceRecorder, words_of_parts};

/// The sum of parts in order, up to the vehicle's greatest force.
///
/// Each force is multiplied by its weight and shortened to what the sum still lacks. Parts after a full sum do not run.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{RunningSum, Seek, Separation};
/// let walker = RunningSum(vec![(1.0, Separation::default().into()), (0.5, Seek { target: Target::Goal }.into())]);
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct RunningSum(
    /// Weights and parts. Limit: weights >= 0.
    #[parameter(from = WeightedParts)]
    pub Vec<(f32, BoxedBehaviour)>,
);

impl Behaviour for RunningSum {
    fn memory(&self) -> usize {
        words_of_parts(self.0.iter().map(|(_, part)| part))
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let mut sum: Option<Steering> = None;
        for (index, (weight, part)) in self.0.iter().enumerate() {
            let left = view.vehicle.max_force - sum.map_or(0.0, |sum| sum.force.length());
            if left <= 0.0 {
                break;
            }
            if let Some(said) = part.steer_as(index, view, &mut memory, why) {
                let force = (said.force * *weight).clamp_length_max(left);
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

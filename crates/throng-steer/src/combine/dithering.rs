//! Prioritised dithering: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Combining behaviors".

use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, TraceRecorder, check_parts, words_of_parts};

/// The first part that has something to correct, of parts drawn at random (Reynolds 1999).
///
/// Each part has a probability. So even the least important part has its turn, at the cost of one part in most steps.
///
/// ```
/// use throng_steer::{AvoidNeighbours, Dithering, Wander};
/// let parts = vec![(0.9, AvoidNeighbours::default().into()), (1.0, Wander::default().into())];
/// let pedestrian = Dithering { every: 0.1, parts };
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Dithering {
    /// Seconds for which a draw holds; 0: each step draws again.
    #[parameter(default = 0.1, unit = "s", least = 0)]
    pub every: f32,
    /// The probabilities and parts, the most important first. Limit: probabilities from 0 to 1.
    #[parameter(name = "of", required, from = ProbableParts)]
    pub parts: Vec<(f32, BoxedBehaviour)>,
}

/// A part that is evaluated with a probability.
#[parameters]
struct Probable {
    /// The probability.
    #[parameter(default = 1.0, least = 0, most = 1)]
    probability: f32,
    /// The behaviour of this part.
    #[parameter(required)]
    of: BoxedBehaviour,
}

/// Parts as files write them.
#[parameters]
struct ProbableParts(Vec<Probable>);

impl From<ProbableParts> for Vec<(f32, BoxedBehaviour)> {
    fn from(ProbableParts(parts): ProbableParts) -> Self {
        parts.into_iter().map(|Probable { probability, of }| (probability, of)).collect()
    }
}

impl Behaviour for Dithering {
    fn memory(&self) -> usize {
        words_of_parts(self.parts.iter().map(|(_, part)| part))
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let holds = || (view.time / f64::from(self.every)).floor() as u64;
        let rng = if self.every > 0.0 { view.rng.at(holds()) } else { view.rng };
        for (index, (probability, part)) in self.parts.iter().enumerate() {
            if rng.draw(index as u32) >= *probability {
                part.take(&mut memory);
            } else if let Some(said) = part.steer_as(index, view, &mut memory, why) {
                return Some(said);
            }
        }
        None
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.parts.iter().for_each(|(_, part)| part.fields(see));
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        for &(probability, _) in &self.parts {
            Error::unless((0.0..=1.0).contains(&probability), "probability", probability, "from 0 to 1")?;
        }
        check_parts(self.parts.iter().map(|(_, part)| part))
    }
}

//! Prioritised dithering: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Combining behaviors".

use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, TraceRecorder, check_parts, words_of_parts};

/// Runs each part with a probability, in order; the first part that runs and has anything to correct sets the steering.
/// So even the least important part has its turn, at the cost of one part in most steps.
///
/// ```
/// use throng_steer::{AvoidNeighbours, Dithering, Wander};
/// let parts = vec![(0.9, AvoidNeighbours::default().into()), (1.0, Wander::default().into())];
/// let pedestrian = Dithering { every: 0.1, parts };
/// ```
#[derive(Clone, Debug)]
pub struct Dithering {
    /// Seconds for which a draw holds, so that the result does not depend on the time step; 0: a draw in every step.
    /// Limit: >= 0.
    pub every: f32,
    /// Probabilities and parts, the most important first. Limit: probabilities from 0 to 1.
    pub parts: Vec<(f32, BoxedBehaviour)>,
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

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.every >= 0.0, "time that draws hold", self.every, "0 or more")?;
        for &(probability, _) in &self.parts {
            Error::unless((0.0..=1.0).contains(&probability), "probability", probability, "from 0 to 1")?;
        }
        check_parts(self.parts.iter().map(|(_, part)| part))
    }
}

//! Decisions every few steps: Reynolds, Big fast crowds on PS3, Sandbox 2006; OpenSteer's "think frequency".

use glam::Vec3;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Evaluates a part only at intervals, and keeps its result in between.
///
/// The first interval of an agent is random, so that
/// agents do not run in the same steps.
///
/// ```
/// use throng_steer::{Amortised, Flocking};
/// let thrifty = Amortised { every: 0.1, of: Flocking::default().into() };
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Amortised {
    /// Seconds between two evaluations.
    #[parameter(required, unit = "s", above = 0)]
    pub every: f32,
    /// The part.
    #[parameter(required)]
    pub of: BoxedBehaviour,
}

/// Words of memory without those of the part.
const OWN: usize = 10;

impl Behaviour for Amortised {
    /// Seconds since the last run, and the interval to the next; whether there is a steering, whether it has a facing;
    /// the force and the facing.
    fn memory(&self) -> usize {
        OWN + self.of.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let (own, mut memory) = memory.split_at_mut(OWN);
        let [since, until, says, faces, kept @ ..] = own else { return None };
        *since += view.seconds;
        // run in the step nearest to the due time
        if *until > 0.0 && *since + 0.5 * view.seconds < *until {
            let facing = (*faces > 0.0).then(|| Vec3::from_slice(&kept[3..]));
            let kept = Vec3::from_slice(kept);
            why.note(|| SteeringReason::Keeps(kept));
            return (*says > 0.0).then_some(Steering { force: kept, facing });
        }
        *until = if *until > 0.0 { self.every } else { self.every * view.rng.draw(0) };
        *since = 0.0;
        // the steering holds until the next run
        let view = SteeringInput { seconds: until.max(view.seconds), ..*view };
        let said = self.of.steer_as(0, &view, &mut memory, why);
        *says = if said.is_some() { 1.0 } else { 0.0 };
        let Steering { force, facing } = said.unwrap_or_default();
        *faces = if facing.is_some() { 1.0 } else { 0.0 };
        kept[..3].copy_from_slice(&force.to_array());
        kept[3..].copy_from_slice(&facing.unwrap_or_default().to_array());
        said
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.of.fields(see);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        self.of.check()
    }
}

//! Priority: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Combining behaviors".

use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, TraceRecorder, check_parts, words_of_parts};

/// The first part that has something to correct (Reynolds 1999).
///
/// ```
/// use throng::steer::{GroupFilter, Target};
/// use throng_steer::{Flee, Priority, Wander};
/// let shy = Flee { panic_distance: 4.0, ..Flee::new(Target::Nearest(GroupFilter::OtherGroups)) };
/// let deer = Priority { epsilon: 0.01, parts: vec![shy.into(), Wander::default().into()] };
/// ```
#[parameters(list = parts)]
#[derive(Clone, Debug)]
pub struct Priority {
    /// A force no greater than this, newtons, counts as nothing to correct, unless it turns the agent.
    #[parameter(default = 0.0, unit = "N", least = 0)]
    pub epsilon: f32,
    /// The parts, the most important first.
    #[parameter(name = "of", required)]
    pub parts: Vec<BoxedBehaviour>,
}

impl Behaviour for Priority {
    fn memory(&self) -> usize {
        words_of_parts(&self.parts)
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let mut parts = self.parts.iter().enumerate();
        parts.find_map(|(index, part)| {
            let said = part.steer_as(index, view, &mut memory, why)?;
            (said.facing.is_some() || said.force.length() > self.epsilon).then_some(said)
        })
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.parts.iter().for_each(|part| part.fields(see));
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        check_parts(&self.parts)
    }
}

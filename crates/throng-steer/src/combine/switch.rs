//! Switching from one behaviour to another: Reynolds, Steering behaviors for autonomous characters, GDC 1999,
//! "Combining behaviors"; a finite state machine.

use super::Condition;
use super::condition::ConditionInput;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::steer::{
    Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, TraceRecorder, check_parts, words_of_parts,
};

/// A state machine of behaviours: one behaviour at a time. The first state is the initial state.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{Arrive, Condition, State, Switch, Wander};
/// let market = Target::Point(glam::Vec3::X * 20.0);
/// let shopper = Switch(vec![
///     State { behaviour: Wander::default().into(), exits: vec![(Condition::After(30.0), 1)] },
///     State { behaviour: Arrive::new(market).into(), exits: vec![(Condition::Done, 0)] },
/// ]);
/// ```
#[derive(Clone, Debug)]
pub struct Switch(
    /// The states. Limit: one at least.
    pub Vec<State>,
);

/// A state of a [`Switch`].
#[derive(Clone, Debug)]
pub struct State {
    /// The behaviour in this state. Whenever the state is entered the behaviour begins with empty memory.
    pub behaviour: BoxedBehaviour,
    /// Conditions and the states that they lead to; the first condition that holds counts. Limit: indices of states.
    pub exits: Vec<(Condition, usize)>,
}

/// Words of memory without those of the states.
const OWN: usize = 3;

impl Behaviour for Switch {
    /// The state, the seconds in it, and whether its behaviour had nothing to correct.
    fn memory(&self) -> usize {
        OWN + words_of_parts(self.branches())
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let (own, mut memory) = memory.split_at_mut(OWN);
        let [state, since, done] = own else { return None };
        let standing = ConditionInput { since: *since, done: *done > 0.0 };
        let holds = |(index, (condition, _)): &(usize, &(Condition, usize))| {
            condition.holds(&SteeringInput { rng: view.rng.branch(self.0.len() + index), ..*view }, standing)
        };
        let next = self.0[*state as usize].exits.iter().enumerate().find(holds).map(|(_, (_, next))| *next);
        let index = next.unwrap_or(*state as usize);
        self.branches().take(index).for_each(|other| {
            other.take(&mut memory);
        });
        if next.is_some() {
            (*state, *since) = (index as f32, 0.0);
            memory[..self.0[index].behaviour.words()].fill(0.0);
        }
        why.note(|| SteeringReason::State(index));
        let said = self.0[index].behaviour.steer_as(index, view, &mut memory, why);
        *since += view.seconds;
        *done = if said.is_none() { 1.0 } else { 0.0 };
        said
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.branches().for_each(|part| part.fields(see));
    }

    fn check(&self) -> Result<(), Error> {
        let states = self.0.len();
        Error::unless(states > 0, "number of states", states as f64, "1 or more")?;
        for (condition, next) in self.0.iter().flat_map(|state| &state.exits) {
            Error::unless(*next < states, "state to go to", *next as f64, "less than the number of states")?;
            condition.check()?;
        }
        check_parts(self.branches())
    }
}

impl Switch {
    fn branches(&self) -> impl Iterator<Item = &BoxedBehaviour> {
        self.0.iter().map(|state| &state.behaviour)
    }
}

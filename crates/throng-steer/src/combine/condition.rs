//! Conditions of the transitions of a [`Switch`](super::Switch).

use crate::Neighbourhood;
use throng::Error;
use throng::parameters::Value;
use throng::steer::{SteeringInput, Target};

/// A condition on one agent in one step. Limit: numbers >= 0, except those of figures.
///
/// ```
/// use throng::steer::{GroupFilter, Target};
/// use throng_steer::Condition;
/// let safe = Condition::Farther(Target::Nearest(GroupFilter::OtherGroups), 8.0);
/// let rested = Condition::All(vec![safe, Condition::After(5.0)]);
/// assert!(rested.check().is_ok());
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Condition {
    /// The target exists and is nearer than this, metres.
    Nearer(Target, f32),
    /// The target is farther than this, metres, or does not exist.
    Farther(Target, f32),
    /// The agent has been in the state for this time, seconds.
    After(f32),
    /// At least this number of agents is in a neighbourhood.
    Crowded(Neighbourhood, usize),
    /// The behaviour of the state had nothing to correct in its last step.
    Done,
    /// Random, with this mean rate, 1/s.
    Chance(f32),
    /// A [figure](SteeringInput::figures) of the world's rules, by its index, is from the first number to the second. Limit: the
    /// first is not greater.
    Figure(usize, f64, f64),
    /// The inner condition does not hold.
    Not(Box<Condition>),
    /// All conditions hold.
    All(Vec<Condition>),
    /// At least one condition holds.
    Any(Vec<Condition>),
}

/// The situation of the present state.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConditionInput {
    /// Seconds in the state.
    pub since: f32,
    /// Whether its behaviour had nothing to correct.
    pub done: bool,
}

impl Condition {
    /// Whether the condition holds. The random numbers depend on the position in the list of exits.
    pub(super) fn holds(&self, view: &SteeringInput<'_>, standing: ConditionInput) -> bool {
        let away = |target: &Target| target.find(view).map(|mark| view.to(mark.position).length());
        let part = |index: usize, condition: &Self| {
            condition.holds(&SteeringInput { rng: view.rng.branch(index), ..*view }, standing)
        };
        match self {
            Self::Nearer(target, distance) => away(target).is_some_and(|away| away < *distance),
            Self::Farther(target, distance) => away(target).is_none_or(|away| away > *distance),
            Self::After(seconds) => standing.since >= *seconds,
            Self::Crowded(near, least) => near.of(view).take(*least).count() == *least,
            Self::Done => standing.done,
            Self::Chance(rate) => view.rng.draw(0) < 1.0 - libm::expf(-rate * view.seconds),
            Self::Figure(index, least, most) => {
                view.figures.get(*index).is_some_and(|figure| (*least..=*most).contains(figure))
            }
            Self::Not(condition) => !part(0, condition),
            Self::All(conditions) => conditions.iter().enumerate().all(|(index, one)| part(index, one)),
            Self::Any(conditions) => conditions.iter().enumerate().any(|(index, one)| part(index, one)),
        }
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// [`Error::Limit`] names the number.
    pub fn check(&self) -> Result<(), Error> {
        match self {
            Self::Nearer(_, least) | Self::Farther(_, least) | Self::After(least) | Self::Chance(least) => {
                Error::unless(*least >= 0.0, "number of a condition", *least, "0 or more")
            }
            Self::Crowded(near, _) => near.check_limits(),
            Self::Figure(_, least, most) => {
                Error::unless(least <= most, "most of a figure", *most, "the least or more")
            }
            Self::Done => Ok(()),
            Self::Not(condition) => condition.check(),
            Self::All(conditions) | Self::Any(conditions) => conditions.iter().try_for_each(Self::check),
        }
    }
}

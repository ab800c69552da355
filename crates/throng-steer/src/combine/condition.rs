//! Conditions of the transitions of a [`Switch`](super::Switch).

use crate::Neighbourhood;
use throng::Error;
use throng::parameters::{FigureName, Value, parameters};
use throng::steer::{SteeringInput, Target};

/// A condition for one agent in one step.
///
/// ```
/// use throng::steer::{GroupFilter, Target};
/// use throng_steer::Condition;
/// let safe = Condition::Farther { target: Target::Nearest(GroupFilter::OtherGroups), than: 8.0 };
/// let rested = Condition::All(vec![safe, Condition::After(5.0)]);
/// assert!(rested.check().is_ok());
/// ```
#[parameters]
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Condition {
    /// A target exists, and is nearer than a distance.
    Nearer {
        /// The target.
        #[parameter(required)]
        target: Target,
        /// The distance, metres.
        #[parameter(required, unit = "m", least = 0)]
        than: f32,
    },
    /// A target is farther than a distance, or does not exist.
    Farther {
        /// The target.
        #[parameter(required)]
        target: Target,
        /// The distance, metres.
        #[parameter(required, unit = "m", least = 0)]
        than: f32,
    },
    /// The state has lasted for this many seconds.
    #[parameter(unit = "s", least = 0)]
    After(f32),
    /// A number of neighbours is near.
    Crowded {
        /// The neighbourhood. Without it, the reach of the neighbour search.
        near: Neighbourhood,
        /// The least number.
        #[parameter(required)]
        least: usize,
    },
    /// The behaviour of the state had nothing to correct in its last step.
    Done,
    /// At random, this many times a second on average.
    #[parameter(unit = "1/s", least = 0)]
    Chance(f32),
    /// A figure of the rules is within bounds.
    ///
    /// The figures are in [`SteeringInput::figures`].
    Figure {
        /// The name of the figure; in code its index.
        #[parameter(required, from = FigureName)]
        of: usize,
        /// Lower bound. Without it, none.
        #[parameter(default = f64::NEG_INFINITY, infinite)]
        at_least: f64,
        /// Upper bound. Without it, none.
        #[parameter(default = f64::INFINITY, infinite)]
        at_most: f64,
    },
    /// The condition does not hold.
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
            Self::Nearer { target, than } => away(target).is_some_and(|away| away < *than),
            Self::Farther { target, than } => away(target).is_none_or(|away| away > *than),
            Self::After(seconds) => standing.since >= *seconds,
            Self::Crowded { near, least } => near.of(view).take(*least).count() == *least,
            Self::Done => standing.done,
            Self::Chance(rate) => view.rng.draw(0) < 1.0 - libm::expf(-rate * view.seconds),
            Self::Figure { of, at_least, at_most } => {
                view.figures.get(*of).is_some_and(|figure| (*at_least..=*at_most).contains(figure))
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
        self.check_limits()?;
        match self {
            Self::Figure { at_least, at_most, .. } => {
                Error::unless(at_least <= at_most, "at_most", *at_most, "at_least or more")
            }
            Self::Not(condition) => condition.check(),
            Self::All(conditions) | Self::Any(conditions) => conditions.iter().try_for_each(Self::check),
            _ => Ok(()),
        }
    }
}

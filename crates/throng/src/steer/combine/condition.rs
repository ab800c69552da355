//! When a [`Switch`](super::Switch) goes from one state to another.

use crate::Error;
use crate::steer::{Neighbourhood, Target, View};

/// Something that holds or not, for one agent in one step. Limit: numbers >= 0, but those of figures.
///
/// ```
/// use throng::steer::{Condition, Target, Who};
/// let safe = Condition::Farther(Target::Nearest(Who::OtherGroups), 8.0);
/// let rested = Condition::All(vec![safe, Condition::After(5.0)]);
/// assert!(rested.check().is_ok());
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Condition {
    /// A target is there, and nearer than so many metres.
    Nearer(Target, f32),
    /// A target is farther than so many metres, or not there.
    Farther(Target, f32),
    /// It has been in the state for so many seconds.
    After(f32),
    /// There are at least so many in a neighbourhood.
    Crowded(Neighbourhood, usize),
    /// The behaviour of the state had nothing to correct in its last step.
    Done,
    /// By chance, so many times a second on average.
    Chance(f32),
    /// A [figure](View::figures) of the world's rules, by its index, is from the first number to the second. Limit: the
    /// first is not greater.
    Figure(usize, f64, f64),
    /// The other does not hold.
    Not(Box<Condition>),
    /// All hold.
    All(Vec<Condition>),
    /// One holds at least.
    Any(Vec<Condition>),
}

/// How it is with a state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    /// For how many seconds.
    pub since: f32,
    /// Whether its behaviour had nothing to correct.
    pub done: bool,
}

impl Condition {
    /// Whether it holds. Random numbers are those of its place in the list of exits.
    pub(super) fn holds(&self, view: &View<'_>, standing: Standing) -> bool {
        let away = |target: &Target| target.find(view).map(|mark| view.to(mark.position).length());
        let part = |index: usize, condition: &Self| {
            condition.holds(&View { dice: view.dice.branch(index), ..*view }, standing)
        };
        match self {
            Self::Nearer(target, distance) => away(target).is_some_and(|away| away < *distance),
            Self::Farther(target, distance) => away(target).is_none_or(|away| away > *distance),
            Self::After(seconds) => standing.since >= *seconds,
            Self::Crowded(near, least) => near.of(view).take(*least).count() == *least,
            Self::Done => standing.done,
            Self::Chance(rate) => view.dice.draw(0) < 1.0 - libm::expf(-rate * view.seconds),
            Self::Figure(index, least, most) => {
                view.figures.get(*index).is_some_and(|figure| (*least..=*most).contains(figure))
            }
            Self::Not(condition) => !part(0, condition),
            Self::All(conditions) => conditions.iter().enumerate().all(|(index, one)| part(index, one)),
            Self::Any(conditions) => conditions.iter().enumerate().any(|(index, one)| part(index, one)),
        }
    }

    /// What is wrong with the numbers, if anything is.
    ///
    /// # Errors
    /// [`Error::Limit`] names the number.
    pub fn check(&self) -> Result<(), Error> {
        match self {
            Self::Nearer(_, least) | Self::Farther(_, least) | Self::After(least) | Self::Chance(least) => {
                Error::unless(*least >= 0.0, "number of a condition", *least, "0 or more")
            }
            Self::Crowded(near, _) => near.check(),
            Self::Figure(_, least, most) => {
                Error::unless(least <= most, "most of a figure", *most, "the least or more")
            }
            Self::Done => Ok(()),
            Self::Not(condition) => condition.check(),
            Self::All(conditions) | Self::Any(conditions) => conditions.iter().try_for_each(Self::check),
        }
    }
}

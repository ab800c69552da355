//! The legs of all journeys, side by side: what an agent on its way needs to know of its stop, in one look.

use super::{Goal, Journey};
use crate::agent::{GoalId, JourneyId};
use glam::DVec2;

/// A leg of a journey.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    pub goal: GoalId,
    /// The point, or the middle of the area.
    pub middle: DVec2,
    /// The distance that counts as there; `None` for an area.
    pub tolerance: Option<f32>,
    /// Who is farther from the middle than this is not there.
    pub reach: f32,
    /// The altitude to be at there; `None`: any.
    pub altitude: Option<f64>,
    /// Whether the journey ends there.
    pub is_last: bool,
}

/// The legs of all journeys. They follow from journeys and goals, which never change.
#[derive(Clone, Debug, Default)]
pub(crate) struct Legs {
    /// Where the legs of each journey end.
    ends: Vec<u32>,
    legs: Vec<Leg>,
    lead_up: bool,
}

impl Legs {
    pub fn new(journeys: &[Journey], goals: &[Goal]) -> Self {
        let mut legs = Self::default();
        journeys.iter().for_each(|journey| legs.add(journey, goals));
        legs
    }

    /// Adds those of the next journey.
    pub fn add(&mut self, journey: &Journey, goals: &[Goal]) {
        self.legs.extend((0usize..).zip(&journey.stops).map(|(leg, stop)| {
            let goal = &goals[stop.goal.index()];
            Leg {
                goal: stop.goal,
                middle: goal.middle(),
                tolerance: goal.tolerance(),
                reach: goal.reach(),
                altitude: goal.altitude(),
                is_last: !journey.repeat && leg + 1 == journey.stops.len(),
            }
        }));
        self.ends.push(self.legs.len() as u32);
        self.lead_up |= journey.stops.iter().any(|stop| goals[stop.goal.index()].altitude().is_some());
    }

    /// Whether any leads to a place in the air.
    pub fn lead_up(&self) -> bool {
        self.lead_up
    }

    /// A leg of a journey; none once it has ended.
    #[inline]
    pub fn of(&self, journey: JourneyId, leg: u32) -> Option<&Leg> {
        let start = journey.index().checked_sub(1).map_or(0, |before| self.ends[before]);
        let at = start.checked_add(leg).filter(|&at| at < self.ends[journey.index()])?;
        self.legs.get(at as usize)
    }
}

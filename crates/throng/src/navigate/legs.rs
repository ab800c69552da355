//! The legs of all journeys in one list: all that an agent on its way needs to know about its stop.

use super::{Goal, Journey};
use crate::agent::{GoalId, JourneyId};
use glam::DVec2;

/// A leg of a journey.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    pub goal: GoalId,
    /// The point, or the middle of the area.
    pub middle: DVec2,
    /// The distance that counts as arrived; `None` for an area.
    pub tolerance: Option<f32>,
    /// An agent farther from the middle than this has not arrived.
    pub reach: f32,
    /// The altitude of the goal; `None`: any.
    pub altitude: Option<f64>,
    /// Whether the journey ends there.
    pub is_last: bool,
}

impl Leg {
    fn new(journey: &Journey, leg: usize, goals: &[Goal]) -> Self {
        let id = journey.stops[leg].goal;
        let goal = &goals[id.index()];
        Self {
            goal: id,
            middle: goal.middle(),
            tolerance: goal.tolerance(),
            reach: goal.reach(),
            altitude: goal.altitude(),
            is_last: !journey.repeat && leg + 1 == journey.stops.len(),
        }
    }
}

/// The legs of all journeys. They are computed from journeys and goals; [`update`](Self::update)
/// follows a changed goal.
#[derive(Clone, Debug, Default)]
pub(crate) struct Legs {
    /// The end of each journey's legs.
    ends: Vec<u32>,
    legs: Vec<Leg>,
    /// How many legs lead to a place in the air.
    up: usize,
}

impl Legs {
    pub fn new(journeys: &[Journey], goals: &[Goal]) -> Self {
        let mut legs = Self::default();
        journeys.iter().for_each(|journey| legs.add(journey, goals));
        legs
    }

    /// Adds the legs of the next journey.
    pub fn add(&mut self, journey: &Journey, goals: &[Goal]) {
        let start = self.legs.len();
        self.legs.extend((0..journey.stops.len()).map(|leg| Leg::new(journey, leg, goals)));
        self.ends.push(self.legs.len() as u32);
        self.up += self.legs[start..].iter().filter(|leg| leg.altitude.is_some()).count();
    }

    /// Updates the legs of a journey after its goals have changed.
    pub fn update(&mut self, id: JourneyId, journey: &Journey, goals: &[Goal]) {
        let start = self.start(id) as usize;
        for (leg, old) in self.legs[start..].iter_mut().take(journey.stops.len()).enumerate() {
            let new = Leg::new(journey, leg, goals);
            self.up = self.up + usize::from(new.altitude.is_some()) - usize::from(old.altitude.is_some());
            *old = new;
        }
    }

    /// Whether a leg leads to a place in the air.
    pub fn lead_up(&self) -> bool {
        self.up > 0
    }

    /// Returns a leg of a journey; none once the journey has ended.
    #[inline]
    pub fn of(&self, journey: JourneyId, leg: u32) -> Option<&Leg> {
        let at = self.start(journey).checked_add(leg).filter(|&at| at < self.ends[journey.index()])?;
        self.legs.get(at as usize)
    }

    #[inline]
    fn start(&self, journey: JourneyId) -> u32 {
        journey.index().checked_sub(1).map_or(0, |before| self.ends[before])
    }
}

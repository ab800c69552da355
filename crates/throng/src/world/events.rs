//! What happened in the last step, agent by agent.

use super::{State, World};
use crate::agent::AgentId;

/// Something that happened to an agent in the last step: [`World::events`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Seconds since the start, at the end of the sub-step in which it happened.
    pub time: f64,
    /// The agent. The id is no longer valid after [`EventKind::Left`].
    pub agent: AgentId,
    /// The agent's number.
    pub number: u32,
    /// What happened.
    pub kind: EventKind,
}

/// What can happen to an agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum EventKind {
    /// A [scheduled](World::schedule_agent) agent entered.
    Entered,
    /// The agent's route no longer held, and it has a new one.
    Replanned,
    /// Nothing has brought the agent nearer to its goal for 10 s: [`Hindrance::Blocked`](crate::Hindrance::Blocked).
    Stuck,
    /// The agent's goal cannot be reached: [`World::stranded`] has the reason.
    Stranded,
    /// The agent came to the end of its journey.
    Arrived,
    /// The agent reached an [exit](crate::Goal::Exit) and was removed.
    Left,
}

impl World {
    /// Returns the events of the last step, in the order of time, of agents' numbers, and of [`EventKind`].
    ///
    /// ```
    /// use throng::{Agent, EventKind, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let id = world.add_agent(Agent::at([0.0, 0.0]).goal([2.0, 0.0]))?;
    /// let arrived = (0..600).find(|_| {
    ///     world.step();
    ///     world.events().iter().any(|event| event.agent == id && event.kind == EventKind::Arrived)
    /// });
    /// assert!(arrived.is_some());
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn events(&self) -> &[Event] {
        &self.state.events
    }
}

impl State {
    /// Notes that something happened to the agent of a row. What happens to a ghost, its own world notes.
    pub(crate) fn happened(&mut self, row: usize, kind: EventKind, time: f64) {
        if row >= self.own().end {
            return;
        }
        let event = Event { time, agent: self.id(row), number: self.agents.number[row], kind };
        self.events.push(event);
    }

    /// Brings the events of a step into their order.
    pub(crate) fn sort_events(&mut self) {
        self.events.sort_by(|a, b| a.time.total_cmp(&b.time).then((a.number, a.kind).cmp(&(b.number, b.kind))));
    }
}

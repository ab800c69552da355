//! The counts and the summary of a run.

use super::{State, World};
use crate::agent::{Hindered, Hindrance, Status};
use crate::intend::{Trace, TraceRequest};
use crate::summary::{Counts, Summary, Totals, Trips};

impl World {
    /// Returns what hinders the agent of a row of [`relative_columns`](Self::relative_columns), as of the last check, at most
    /// half a second ago.
    pub fn hindrance(&self, row: usize) -> Hindrance {
        self.state.hindrance(row)
    }

    /// Records traces of the requested agents in every step from now on. Nothing else changes.
    ///
    /// ```
    /// use glam::Vec3;
    /// use throng::agent::Guidance;
    /// use throng::steer::{SteeringReason, Target};
    /// use throng_steer::Seek;
    /// use throng::{Agent, TraceRequest, Group, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let seek = Seek { target: Target::Point(Vec3::X * 9.0) };
    /// let group = world.add_group(Group { guidance: Guidance::behaviour(seek), ..Group::default() })?;
    /// world.add_agent(Agent { group, number: Some(7), ..Agent::default() })?;
    /// world.request_traces(TraceRequest::All);
    /// world.step();
    /// let trace = &world.relative_traces()[0];
    /// assert_eq!((trace.number, trace.entries[0].reason), (7, SteeringReason::Aim(Vec3::X * 9.0)));
    /// assert!(trace.steering.x > 0.0 && trace.preferred.x > 0.0);
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn request_traces(&mut self, request: TraceRequest) {
        self.state.traced = request;
        self.step.intend.forget_traces();
    }

    /// Returns the traces of the last sub-step for the [requested](Self::request_traces) agents, by number.
    pub fn relative_traces(&self) -> &[Trace] {
        self.step.intend.traces()
    }

    /// Returns how many agents there are, how many have arrived and how many are hindered, without scripted agents. It
    /// is cheap enough for every frame of a recording.
    pub fn counts(&self) -> Counts {
        let (present, removed) = (self.state.walkers().count(), self.state.tally.removed as usize);
        Counts {
            agents: present + self.state.schedule.len() + removed,
            arrived: self.state.in_place() + removed,
            removed,
            present,
            hindered: self.state.hindered(),
        }
    }

    /// Returns the statistics of the run so far. Scripted agents do not count, but agents that they touch do.
    pub fn summary(&self) -> Summary {
        self.summary_of(&self.state.totals())
    }

    /// Returns the summary of all worlds of a division from their merged totals.
    pub(crate) fn summary_of(&self, totals: &Totals) -> Summary {
        totals.summary(self.state.schedule.len(), self.state.steps, self.state.time())
    }
}

impl State {
    /// Returns the rows of the agents without a script: the agents that are counted.
    fn walkers(&self) -> impl Iterator<Item = usize> {
        (0..self.agents.len()).filter(|&row| self.agents.script[row].is_none())
    }

    /// Returns the number of agents present that are in place at the end of their journeys.
    fn in_place(&self) -> usize {
        self.walkers().filter(|&row| self.agents.status[row] == Status::Arrived).count()
    }

    /// Returns what a summary is computed from.
    pub(crate) fn totals(&self) -> Totals {
        let agents = &self.agents;
        let mut trips = Trips::default();
        self.walkers().for_each(|row| trips.add(&agents.trip(row), agents.preferred_speed[row]));
        Totals {
            present: self.walkers().count(),
            arrived: self.in_place(),
            resting: self.walkers().filter(|&row| agents.speed(row) < 0.05).count(),
            stranded: self.walkers().filter(|&row| agents.status[row] == Status::Stranded).count(),
            hindered: self.hindered(),
            trips,
            tally: self.tally.clone(),
        }
    }

    fn hindered(&self) -> Hindered {
        Hindered::of(self.walkers().map(|row| self.hindrance(row)))
    }
}

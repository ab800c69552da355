//! The counts and the summary of a run.

use super::{State, World};
use crate::agent::{Hindered, Hindrance, Status};
use crate::intend::{Trace, TraceRequest};
use crate::summary::{Counts, Ended, Summary};

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
        let (present, removed) = (self.state.walkers().count(), self.state.tally.removed.len());
        Counts {
            agents: present + self.state.schedule.len() + removed,
            arrived: self.state.arrived_now(),
            removed,
            present,
            hindered: self.state.hindered(),
        }
    }

    /// Returns the statistics of the run so far. Scripted agents do not count, but agents that they touch do.
    pub fn summary(&self) -> Summary {
        let agents = &self.state.agents;
        let trips = self.state.walkers().map(|row| {
            (agents.number[row], Ended { trip: agents.trip(row), preferred_speed: agents.preferred_speed[row] })
        });
        let resting = self.state.walkers().filter(|&row| agents.speed(row) < 0.05).count();
        let stranded = self.state.walkers().filter(|&row| agents.status[row] == Status::Stranded).count();
        let hindered = self.state.hindered();
        let summary = Summary {
            agents: self.state.walkers().count() + self.state.schedule.len() + self.state.tally.removed.len(),
            arrived: self.state.arrived_now(),
            resting,
            hindered,
            stranded,
            stuck: hindered.blocked + hindered.oscillating + stranded,
            time: self.state.time(),
            steps: self.state.steps,
            ..Summary::default()
        };
        self.state.tally.summarise(trips.collect(), summary)
    }
}

impl State {
    /// Returns the rows of the agents without a script: the agents that are counted.
    fn walkers(&self) -> impl Iterator<Item = usize> {
        (0..self.agents.len()).filter(|&row| self.agents.script[row].is_none())
    }

    /// Returns the number of agents in place at the end of their journeys, including agents removed by exits.
    fn arrived_now(&self) -> usize {
        let in_place = self.walkers().filter(|&row| self.agents.status[row] == Status::Arrived);
        in_place.count() + self.tally.removed.len()
    }

    fn hindered(&self) -> Hindered {
        Hindered::of(self.walkers().map(|row| self.hindrance(row)))
    }
}

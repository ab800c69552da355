//! The counts and the summary of a run.

use super::{State, World};
use crate::agent::{Hindered, Status};
use crate::summary::{Counts, Ended, Summary};

impl World {
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

//! The counts and the summary of a run.

use super::World;
use crate::agent::{Hindered, Status};
use crate::summary::{Counts, Ended, Summary};

impl World {
    /// Returns the rows of the agents without a script: the agents that are counted.
    fn walkers(&self) -> impl Iterator<Item = usize> {
        (0..self.agents.len()).filter(|&row| self.agents.script[row].is_none())
    }

    /// Returns how many agents there are, how many have arrived and how many are hindered, without scripted agents. It
    /// is cheap enough for every frame of a recording.
    pub fn counts(&self) -> Counts {
        let (present, removed) = (self.walkers().count(), self.tally.removed.len());
        Counts {
            agents: present + self.schedule.len() + removed,
            arrived: self.arrived_now(),
            removed,
            present,
            hindered: self.hindered(),
        }
    }

    /// Returns the number of agents in place at the end of their journeys, including agents removed by exits.
    fn arrived_now(&self) -> usize {
        let in_place = self.walkers().filter(|&row| self.agents.status[row] == Status::Arrived);
        in_place.count() + self.tally.removed.len()
    }

    fn hindered(&self) -> Hindered {
        Hindered::of(self.walkers().map(|row| self.hindrance(row)))
    }

    /// Returns the statistics of the run so far. Scripted agents do not count, but agents that they touch do.
    pub fn summary(&self) -> Summary {
        let agents = &self.agents;
        let trips = self.walkers().map(|row| {
            (agents.number[row], Ended { trip: agents.trip(row), preferred_speed: agents.preferred_speed[row] })
        });
        let resting = self.walkers().filter(|&row| agents.speed(row) < 0.05).count();
        let stranded = self.walkers().filter(|&row| agents.status[row] == Status::Stranded).count();
        let hindered = self.hindered();
        let summary = Summary {
            agents: self.walkers().count() + self.schedule.len() + self.tally.removed.len(),
            arrived: self.arrived_now(),
            resting,
            hindered,
            stranded,
            stuck: hindered.blocked + hindered.oscillating + stranded,
            time: self.time(),
            steps: self.steps,
            ..Summary::default()
        };
        self.tally.summarise(trips.collect(), summary)
    }
}

//! Statistics of a run.

use crate::agent::{Hindered, TripStatistics};
use serde::{Deserialize, Serialize};

/// The numbers of agents: in all, arrived, removed, present and hindered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Agents in all: present, removed by exits, and scheduled to enter.
    pub agents: usize,
    /// Agents in place at the end of their journeys, including agents removed by exits.
    pub arrived: usize,
    /// Agents removed by exits.
    pub removed: usize,
    /// Agents present now.
    pub present: usize,
    /// Agents present that make no progress, by the hindrance.
    pub hindered: Hindered,
}

/// Statistics of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Agents in all: present, removed by exits, and scheduled to enter.
    pub agents: usize,
    /// Agents in place at the end of their journeys, including agents removed by exits. An agent that was pushed out of
    /// its area or off its point counts again when it is back.
    pub arrived: usize,
    /// Agents removed by exits.
    pub removed: usize,
    /// Agents present that stand still (below 0.05 m/s).
    pub resting: usize,
    /// Agents present that make no progress, by the hindrance.
    pub hindered: Hindered,
    /// Agents present that cannot reach their goals.
    pub stranded: usize,
    /// Agents present that are blocked, oscillate, or cannot reach their goals.
    pub stuck: usize,
    /// How often an agent walked for 30 seconds without progress ([`Hindrance`](crate::agent::Hindrance)) in the whole
    /// run. More than 0 is a failure of the engine.
    pub without_progress_30s: u64,
    /// Seconds simulated.
    pub time: f64,
    /// Mean over the arrived agents of travel time divided by the time of the shortest path at preferred speed.
    pub time_ratio: f64,
    /// Mean over the arrived agents of the distance walked divided by the length of the shortest path.
    pub path_ratio: f64,
    /// Least distance of two centres divided by the sum of the radii, in the whole run. At 1 two agents touched.
    /// Infinite if no two agents ever came within reach of each other.
    pub least_separation: f64,
    /// Least distance of a centre to a wall, or to a [solid](crate::Group::solid) of its group, divided by the radius,
    /// in the whole run. Infinite if no agent came near one. Walls do not count for an agent that has a script and no
    /// guard, because nothing keeps it on walkable ground.
    pub least_wall_separation: f64,
    /// Overlaps by more than 1e-4 of a radius, counted in every sub-step: pairs of bodies, and bodies with walls or
    /// solids. Walls count as for `least_wall_separation`.
    pub overlaps: u64,
    /// How often agents that blocked each other agreed on which of them step aside.
    pub standoffs: u64,
    /// Share of agent-steps in which the guard changed the motion by more than a hundredth.
    pub guard_share: f64,
    /// Share of agent-steps in which the guard made an agent accelerate harder than its limit, braking excluded: a
    /// motion is within the limits if the agent reaches it by braking as hard as necessary and then accelerating within
    /// its limit.
    pub pushed_share: f64,
    /// Share of the time spent walking in which agents moved away from the direction of their path faster than 0.1 m/s,
    /// sampled twice a second.
    pub backwards_share: f64,
    /// Mean over agents of the rate at which the heading turns while they walk, degrees a second.
    pub heading_change_deg_per_s: f64,
    /// Mean over agents of the rate at which the direction of motion turns while they walk, degrees a second. It shows
    /// jitter, which headings smooth out. Motion below 0.1 m/s does not count.
    pub course_change_deg_per_s: f64,
    /// Steps made.
    pub steps: u64,
    /// Sub-steps made in all steps.
    pub sub_steps: u64,
    /// Sub-steps summed over agents.
    pub agent_steps: u64,
}

/// The counters of a running world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Tally {
    pub sub_steps: u64,
    pub agent_steps: u64,
    pub guard_changed: u64,
    /// Agent-steps in which the guard made an agent accelerate harder than its limit, as in `Summary::pushed_share`.
    pub pushed: u64,
    /// Samples of walking agents, and the samples that found an agent moving backwards.
    pub looks: u64,
    pub backwards: u64,
    pub overlaps: u64,
    pub standoffs: u64,
    pub without_progress_30s: u64,
    pub least_separation: f64,
    pub least_wall_separation: f64,
    /// Trips of the agents that exits removed, with their numbers.
    pub removed: Vec<(u32, Ended)>,
}

/// The statistics of a trip, and the agent's preferred speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ended {
    pub trip: TripStatistics,
    pub preferred_speed: f32,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            sub_steps: 0,
            agent_steps: 0,
            guard_changed: 0,
            pushed: 0,
            looks: 0,
            backwards: 0,
            overlaps: 0,
            standoffs: 0,
            without_progress_30s: 0,
            least_separation: f64::INFINITY,
            least_wall_separation: f64::INFINITY,
            removed: Vec::new(),
        }
    }
}

impl Tally {
    /// Completes a summary with the statistics of all trips. Sums run in the order of the agents' numbers, so rounding
    /// does not depend on the order of rows.
    pub(crate) fn summarise(&self, mut trips: Vec<(u32, Ended)>, mut summary: Summary) -> Summary {
        trips.extend(&self.removed);
        trips.sort_by_key(|&(number, _)| number);
        let mean = |values: &[f64]| values.iter().sum::<f64>() / (values.len().max(1) as f64);
        let arrived = |&(_, ended): &(u32, Ended)| {
            let Ended { trip, preferred_speed } = ended;
            let free = trip.shortest / f64::from(preferred_speed);
            // agents that started at their goals have no ratio
            let time = trip.arrived? - trip.entered;
            (trip.shortest > 1e-3 && free > 0.0).then(|| (time / free, trip.walked / trip.shortest))
        };
        let (times, paths): (Vec<f64>, Vec<f64>) = trips.iter().filter_map(arrived).unzip();
        let a_second = |radians: fn(&TripStatistics) -> f64| {
            let on_way = trips.iter().map(|(_, ended)| &ended.trip).filter(|trip| trip.on_way > 0.0);
            let all: Vec<f64> = on_way.map(|trip| (radians(trip) / trip.on_way).to_degrees()).collect();
            mean(&all)
        };
        summary.time_ratio = mean(&times);
        summary.path_ratio = mean(&paths);
        summary.heading_change_deg_per_s = a_second(|trip| trip.turned);
        summary.course_change_deg_per_s = a_second(|trip| trip.course_turned);
        summary.removed = self.removed.len();
        summary.least_separation = self.least_separation;
        summary.least_wall_separation = self.least_wall_separation;
        summary.overlaps = self.overlaps;
        summary.standoffs = self.standoffs;
        summary.without_progress_30s = self.without_progress_30s;
        let share = |part: u64, all: u64| part as f64 / (all.max(1) as f64);
        summary.guard_share = share(self.guard_changed, self.agent_steps);
        summary.pushed_share = share(self.pushed, self.agent_steps);
        summary.backwards_share = share(self.backwards, self.looks);
        summary.sub_steps = self.sub_steps;
        summary.agent_steps = self.agent_steps;
        summary
    }
}

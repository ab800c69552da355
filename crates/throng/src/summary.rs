//! How a run went, in figures.

use crate::agent::{Hindered, Trip};
use serde::{Deserialize, Serialize};

/// How many agents there are, how many have arrived, and how many are hindered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Agents in all: present, removed by exits, and still to enter.
    pub agents: usize,
    /// Agents that are in place at the end of their journeys, those removed by exits included.
    pub arrived: usize,
    /// Agents that exits removed.
    pub removed: usize,
    /// Agents that are there now.
    pub present: usize,
    /// Agents present that do not get on, by what hinders them.
    pub hindered: Hindered,
}

/// How a run went, in figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Agents in all: present, removed by exits, and still to enter.
    pub agents: usize,
    /// Agents that are in place at the end of their journeys, those removed by exits included. An agent that was pushed
    /// out of its area, or off its point, is not in place until it is back.
    pub arrived: usize,
    /// Agents that exits removed.
    pub removed: usize,
    /// Agents present that stand still (below 0.05 m/s).
    pub resting: usize,
    /// Agents present that do not get on, by what hinders them.
    pub hindered: Hindered,
    /// Agents present whose goal is out of reach.
    pub stranded: usize,
    /// Agents present that are blocked, oscillate, or whose goal is out of reach.
    pub stuck: usize,
    /// How often an agent walked for 30 seconds without getting on ([`Hindrance`](crate::agent::Hindrance)), ever. More
    /// than 0 is a failure of the engine.
    pub without_progress_30s: u64,
    /// Seconds simulated.
    pub time: f64,
    /// Mean over the arrived of their time over the time of the shortest way at preferred speed.
    pub time_ratio: f64,
    /// Mean over the arrived of the way they walked over the shortest way.
    pub path_ratio: f64,
    /// Least distance of two centres over the sum of their radii, ever. 1: they touched. Infinite if no two ever
    /// came within reach of each other.
    pub least_separation: f64,
    /// Least distance of a centre to a wall, or to a [solid](crate::Group::solid) of its group, over the radius, ever.
    /// Infinite if no agent came near one. Walls do not count for an agent that has a script and no guard: nothing keeps it on the ground.
    pub least_wall_separation: f64,
    /// Pairs of bodies, and bodies and walls or solids, that overlapped by more than 1e-4 of a radius, counted every sub-step; walls as for
    /// `least_wall_separation`.
    pub overlaps: u64,
    /// How often people who blocked each other's ways agreed who steps aside.
    pub standoffs: u64,
    /// Share of agent-steps in which the guard changed the motion by more than a hundredth.
    pub guard_share: f64,
    /// Share of agent-steps in which the guard made an agent accelerate harder than it can, braking aside: any motion counts as
    /// within its limits that it can get to by braking as hard as need be, and then accelerating as its limit allows.
    pub pushed_share: f64,
    /// Share of the time on their way in which agents moved away from where their ways lead, faster than 0.1 m/s; looked at
    /// twice a second.
    pub backwards_share: f64,
    /// Mean over agents of the turning of their headings while on their way, degrees a second.
    pub heading_change_deg_per_s: f64,
    /// Mean over agents of the turning of their direction of motion while on their way, degrees a second: trembling,
    /// which headings smooth out. Motion below 0.1 m/s does not count.
    pub course_change_deg_per_s: f64,
    /// Steps made.
    pub steps: u64,
    /// Sub-steps made: what steps were divided into.
    pub sub_steps: u64,
    /// Moves of one agent by one sub-step.
    pub agent_steps: u64,
}

/// What is counted while a world runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Tally {
    pub sub_steps: u64,
    pub agent_steps: u64,
    pub guard_changed: u64,
    /// Of these, how many the guard made accelerate harder than they can.
    pub pushed: u64,
    /// Looks at agents on their way, and those that found one moving backwards.
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

/// A trip, and the speed it was meant to have.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ended {
    pub trip: Trip,
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
    /// Completes a summary with the figures of all trips. Sums run in the order of the agents' numbers.
    pub(crate) fn summarise(&self, mut trips: Vec<(u32, Ended)>, mut summary: Summary) -> Summary {
        trips.extend(&self.removed);
        trips.sort_by_key(|&(number, _)| number);
        let mean = |values: &[f64]| values.iter().sum::<f64>() / (values.len().max(1) as f64);
        let arrived = |&(_, ended): &(u32, Ended)| {
            let Ended { trip, preferred_speed } = ended;
            let free = trip.shortest / f64::from(preferred_speed);
            // those who began at their goals have no ratio
            let time = trip.arrived? - trip.entered;
            (trip.shortest > 1e-3 && free > 0.0).then(|| (time / free, trip.walked / trip.shortest))
        };
        let (times, paths): (Vec<f64>, Vec<f64>) = trips.iter().filter_map(arrived).unzip();
        let a_second = |radians: fn(&Trip) -> f64| {
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

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

/// The counters of a running world. Those of the worlds of a division [merge](Self::merge) into those of the undivided
/// world.
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
    /// Number of agents that exits removed.
    pub removed: u64,
    /// The trips of these agents.
    pub trips: Trips,
}

/// What a summary is computed from, apart from what all worlds of a division share. Those of the worlds
/// [merge](Self::merge) into those of the undivided world.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Totals {
    /// Agents present: all, at the end of their journeys, at rest, and those that cannot reach their goals.
    pub present: usize,
    pub arrived: usize,
    pub resting: usize,
    pub stranded: usize,
    pub hindered: Hindered,
    /// The trips of the agents present.
    pub trips: Trips,
    pub tally: Tally,
}

impl Totals {
    /// Adds those of another world of the same division.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.present += other.present;
        self.arrived += other.arrived;
        self.resting += other.resting;
        self.stranded += other.stranded;
        self.hindered.merge(other.hindered);
        self.trips.merge(&other.trips);
        self.tally.merge(&other.tally);
    }

    /// Returns the summary after `steps` of in all `time` seconds, with this number of agents scheduled to enter.
    pub(crate) fn summary(&self, scheduled: usize, steps: u64, time: f64) -> Summary {
        let (tally, mut trips) = (&self.tally, self.trips);
        trips.merge(&tally.trips);
        let removed = tally.removed as usize;
        let share = |part: u64, all: u64| part as f64 / (all.max(1) as f64);
        Summary {
            agents: self.present + scheduled + removed,
            arrived: self.arrived + removed,
            removed,
            resting: self.resting,
            hindered: self.hindered,
            stranded: self.stranded,
            stuck: self.hindered.blocked + self.hindered.oscillating + self.stranded,
            without_progress_30s: tally.without_progress_30s,
            time,
            time_ratio: trips.time_ratio.value(),
            path_ratio: trips.path_ratio.value(),
            least_separation: tally.least_separation,
            least_wall_separation: tally.least_wall_separation,
            overlaps: tally.overlaps,
            standoffs: tally.standoffs,
            guard_share: share(tally.guard_changed, tally.agent_steps),
            pushed_share: share(tally.pushed, tally.agent_steps),
            backwards_share: share(tally.backwards, tally.looks),
            heading_change_deg_per_s: trips.heading_change.value(),
            course_change_deg_per_s: trips.course_change.value(),
            steps,
            sub_steps: tally.sub_steps,
            agent_steps: tally.agent_steps,
        }
    }
}

/// A mean as a sum of whole numbers, which does not depend on the order of the values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Mean {
    /// The sum, in parts of 2^-40.
    sum: i128,
    count: u64,
}

impl Mean {
    const PARTS: f64 = (1u64 << 40) as f64;

    fn add(&mut self, value: f64) {
        // the sum of 2^32 values, each of 64 bits, fits into 128 bits
        self.sum += i128::from((value * Self::PARTS) as i64);
        self.count += 1;
    }

    fn merge(&mut self, other: Self) {
        self.sum += other.sum;
        self.count += other.count;
    }

    fn value(self) -> f64 {
        self.sum as f64 / Self::PARTS / (self.count.max(1) as f64)
    }
}

/// Means over trips, as [`Summary`] describes them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Trips {
    time_ratio: Mean,
    path_ratio: Mean,
    heading_change: Mean,
    course_change: Mean,
}

impl Trips {
    /// Adds the trip of an agent with this preferred speed.
    pub(crate) fn add(&mut self, trip: &TripStatistics, preferred_speed: f32) {
        let free = trip.shortest / f64::from(preferred_speed);
        // agents that started at their goals have no ratio
        if let Some(arrived) = trip.arrived.filter(|_| trip.shortest > 1e-3 && free > 0.0) {
            self.time_ratio.add((arrived - trip.entered) / free);
            self.path_ratio.add(trip.walked / trip.shortest);
        }
        if trip.on_way > 0.0 {
            self.heading_change.add((trip.turned / trip.on_way).to_degrees());
            self.course_change.add((trip.course_turned / trip.on_way).to_degrees());
        }
    }

    fn merge(&mut self, other: &Self) {
        self.time_ratio.merge(other.time_ratio);
        self.path_ratio.merge(other.path_ratio);
        self.heading_change.merge(other.heading_change);
        self.course_change.merge(other.course_change);
    }
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
            removed: 0,
            trips: Trips::default(),
        }
    }
}

impl Tally {
    /// Adds the counters of another world of the same division.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.agent_steps += other.agent_steps;
        self.guard_changed += other.guard_changed;
        self.pushed += other.pushed;
        self.looks += other.looks;
        self.backwards += other.backwards;
        self.overlaps += other.overlaps;
        self.standoffs += other.standoffs;
        self.without_progress_30s += other.without_progress_30s;
        self.least_separation = self.least_separation.min(other.least_separation);
        self.least_wall_separation = self.least_wall_separation.min(other.least_wall_separation);
        self.removed += other.removed;
        self.trips.merge(&other.trips);
    }
}

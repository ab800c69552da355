//! Sleep: parts of a crowd in which nothing can change skip sub-steps, with the same bits as without sleep.
//!
//! The result of a sub-step for an agent depends on its own state and the state of the agents near it. An agent is
//! *still* in a sub-step if it does not walk, its state is the same to the bit before and after, and no pass of the
//! guard moved it. A still agent is still in the next sub-step too unless an agent near it was not still. A block of 64
//! rows sleeps if all its agents were still and no other agent that was not still is near enough to matter. An agent that was
//! removed, or jumped to a far place, also counts where it was. An agent is near enough within the sum of two distances:
//!
//! - twice the neighbour distance. An agent that was not still changes the chosen velocities of the agents that see it,
//!   so these may move. Sleeping agents must not see a moving agent, because its separation from them would have to be
//!   measured.
//! - one contact distance for each relaxation of the guard: each may push one more agent.
//!
//! The data of a stage for a block stay as they are while the block sleeps. On the scalar path no agent sleeps: it is
//! the reference.
//!
//! In a world of a division the stages before the guard leave out [ghosts](crate::halo) as they leave out rows that
//! sleep.

use crate::agent::Status;
use crate::parallel::{self, Parts, WORD, Words};
use crate::simd::ones;
use crate::world::State;
use glam::Vec2;
use std::ops::Range;

/// The sleep state of all blocks. By default no agent is known to be still.
#[derive(Clone, Debug, Default)]
pub(crate) struct SleepBlocks {
    /// Agents that were still in the last sub-step, one bit for each row.
    still: Vec<u64>,
    /// Blocks that sleep in this sub-step; empty if none does.
    asleep: Vec<bool>,
    /// Positions from which agents have gone since, other than by motion.
    gone: Vec<Vec2>,
    unrest: ActiveSquares,
    /// Seconds of the last sub-step and whether it was guarded; `None` if sleep was not possible.
    made: Option<(f32, bool)>,
    /// The first of the rows that are ghosts in this sub-step, if there are any.
    first_ghost: Option<usize>,
}

/// Squares of the ground that contain agents that were not still.
#[derive(Clone, Debug, Default)]
struct ActiveSquares {
    low: Vec2,
    high: Vec2,
    width: f32,
    columns: usize,
    squares: Vec<bool>,
}

/// Greatest number of squares along the ground, and squares along the distance that matters.
const SQUARES: f32 = 256.0;
const FINE: f32 = 4.0;

impl SleepBlocks {
    /// Wakes all agents.
    pub fn end(&mut self) {
        self.still.clear();
        self.asleep.clear();
    }

    /// Includes ghosts, for the guard and the stages after it.
    pub fn include_ghosts(&mut self) {
        self.first_ghost = None;
    }

    /// Records that an agent has gone from a position to a far one. It was not still.
    pub fn note_left(&mut self, at: Vec2) {
        self.gone.push(at);
    }

    /// Records that the agent of a row, at a position, is removed. The agent of the last row takes its row.
    pub fn remove(&mut self, row: usize, last: usize, at: Vec2) {
        self.gone.push(at);
        if let Some(part) = self.still.get_mut(row / WORD) {
            *part &= !(1 << (row % WORD));
        }
        if let Some(part) = self.still.get_mut(last / WORD) {
            *part = 0;
        }
    }

    /// Whether a block of 64 rows sleeps.
    #[inline]
    pub fn sleeps(&self, part: usize) -> bool {
        self.asleep.get(part) == Some(&true)
    }

    /// Returns the blocks that sleep; blocks beyond the end do not.
    pub fn asleep(&self) -> &[bool] {
        &self.asleep
    }

    /// Whether all agents sleep.
    pub fn all_asleep(&self) -> bool {
        !self.asleep.is_empty() && self.asleep.iter().all(|&asleep| asleep)
    }

    /// Whether the stages before the guard leave out a row: it sleeps, or it is a ghost.
    #[inline]
    fn is_left_out(&self, row: usize) -> bool {
        self.sleeps(row / WORD) || self.first_ghost.is_some_and(|first| row >= first)
    }

    /// Whether all agents of a sub-step are awake, and none is a ghost.
    fn leaves_out_none(&self) -> bool {
        self.asleep.is_empty() && self.first_ghost.is_none()
    }

    /// Returns the ranges of rows within a range that do not sleep and are no ghosts.
    pub fn awake(&self, rows: Range<usize>) -> impl Iterator<Item = Range<usize>> + '_ {
        let mut at = rows.start;
        let end = rows.end.min(self.first_ghost.unwrap_or(rows.end));
        let mut skip = move |asleep: bool| {
            while at < end && self.sleeps(at / WORD) == asleep {
                at = ((at / WORD + 1) * WORD).min(end);
            }
            at
        };
        std::iter::from_fn(move || {
            let range = skip(true)..skip(false);
            (!range.is_empty()).then_some(range)
        })
    }

    /// Calls `work` for each range of rows that does not sleep, without ghosts, with its part of `all`.
    pub fn each<P: Parts>(&self, rows: Range<usize>, all: P, mut work: impl FnMut(Range<usize>, P)) {
        if self.leaves_out_none() {
            return work(rows, all);
        }
        let (mut left, mut at) = (all, rows.start);
        for range in self.awake(rows) {
            let (part, later) = left.split(range.start - at).1.split(range.len());
            at = range.end;
            left = later;
            work(range, part);
        }
    }

    /// As [`each`](Self::each), for indices in the order of the grid.
    pub fn each_place<P: Parts>(
        &self,
        order: &[u32],
        places: Range<usize>,
        all: P,
        mut work: impl FnMut(Range<usize>, P),
    ) {
        if self.leaves_out_none() {
            return work(places, all);
        }
        let (mut left, mut at) = (all, places.start);
        let is_left_out = |row: u32| self.is_left_out(row as usize);
        for rows in order[places].chunk_by(|&a, &b| is_left_out(a) == is_left_out(b)) {
            let (part, later) = left.split(rows.len());
            let range = at..at + rows.len();
            at = range.end;
            left = later;
            if !is_left_out(rows[0]) {
                work(range, part);
            }
        }
    }
}

impl ActiveSquares {
    /// Records these places only, in squares of at least this width.
    fn note(&mut self, places: impl Iterator<Item = Vec2> + Clone, width: f32) {
        let (low, high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        (self.low, self.high) = places.clone().fold((low, high), |(low, high), at| (low.min(at), high.max(at)));
        let size = (self.high - self.low).max(Vec2::ZERO);
        self.width = width.max(size.max_element() / SQUARES);
        self.columns = (size.x / self.width) as usize + 1;
        self.squares.clear();
        self.squares.resize(self.columns * ((size.y / self.width) as usize + 1), false);
        for at in places {
            let square = self.row(at.y) * self.columns + self.column(at.x);
            self.squares[square] = true;
        }
    }

    /// Whether a box touches a square that contains a recorded place.
    fn touches(&self, low: Vec2, high: Vec2) -> bool {
        let overlaps = low.cmple(self.high).all() && self.low.cmple(high).all();
        overlaps
            && (self.row(low.y)..=self.row(high.y)).any(|row| {
                let squares = row * self.columns..(row + 1) * self.columns;
                self.squares[squares][self.column(low.x)..=self.column(high.x)].contains(&true)
            })
    }

    /// Returns the column of a coordinate, or the nearest column. It never falls as the coordinate rises.
    fn column(&self, x: f32) -> usize {
        (((x - self.low.x) / self.width) as usize).min(self.columns - 1)
    }

    fn row(&self, y: f32) -> usize {
        (((y - self.low.y) / self.width) as usize).min(self.squares.len() / self.columns - 1)
    }
}

/// Returns the rows of a block, of `count` rows in all.
fn rows_of(part: usize, count: usize) -> Range<usize> {
    part * WORD..count.min((part + 1) * WORD)
}

impl SleepBlocks {
    /// Finds the blocks that sleep in the sub-step that begins. The guard has `passes`. `no_overlap` tells whether no
    /// agent of a block overlapped anything in the last sub-step.
    pub fn fall_asleep(&mut self, state: &State, seconds: f32, passes: usize, no_overlap: impl Fn(usize) -> bool) {
        let made = state.may_sleep().then_some((seconds, state.is_guarded()));
        if made.is_none() || made != self.made {
            self.end();
            self.made = made;
        }
        self.find_asleep(state, seconds, passes, no_overlap);
        self.gone.clear();
        self.first_ghost = (state.others.ghosts > 0).then_some(state.own().end);
    }

    fn find_asleep(&mut self, state: &State, seconds: f32, passes: usize, no_overlap: impl Fn(usize) -> bool) {
        let (positions, count) = (&state.agents.position, state.agents.len());
        let Self { still, asleep, gone, unrest, .. } = self;
        asleep.clear();
        let parts = 0..count.div_ceil(WORD);
        let all_still = |part: usize| {
            let still = still.get(part).copied().unwrap_or(0);
            still.count_ones() as usize == rows_of(part, count).len() && no_overlap(part)
        };
        if !parts.clone().any(all_still) {
            return;
        }
        let moved = (0..count).filter(|&row| still.get(row / WORD).is_none_or(|part| part >> (row % WORD) & 1 == 0));
        let distance = state.distance_that_matters(seconds, passes);
        unrest.note(moved.map(|row| positions[row]).chain(gone.iter().copied()), distance / FINE);
        asleep.extend(parts.map(|part| {
            all_still(part) && {
                let places = &positions[rows_of(part, count)];
                let (low, high) =
                    places.iter().fold((places[0], places[0]), |(low, high), &at| (low.min(at), high.max(at)));
                !unrest.touches(low - distance, high + distance)
            }
        }));
    }

    /// Records which agents are still in this sub-step, before motion. `is_still` tells it of an agent that does not walk.
    pub fn note_still(&mut self, state: &State, is_still: impl Fn(usize) -> bool + Sync) {
        if self.made.is_none() {
            return;
        }
        let count = state.agents.len();
        let Self { still, asleep, .. } = self;
        still.resize(count.div_ceil(WORD), 0);
        parallel::ranges(Words(still), |rows, Words(still)| {
            for (part, still) in (rows.start / WORD..).zip(still).filter(|&(part, _)| asleep.get(part) != Some(&true)) {
                let status = &state.agents.status[rows_of(part, count)];
                let stands = |bits, &status: &Status| bits << 1 | u64::from(status != Status::Walking);
                let standing = status.iter().rev().fold(0, stands);
                let moving = |&at: &usize| !is_still(part * WORD + at);
                *still = ones(standing).filter(moving).fold(standing, |still, at| still & !(1 << at));
            }
        });
    }
}

impl State {
    /// Whether agents can sleep: all are discs on the ground with a local model that draws no random numbers and no
    /// limit on turning.
    fn may_sleep(&self) -> bool {
        let agents = &self.agents;
        self.lanes_to_move().is_some()
            // ghosts change between sub-steps
            && !self.others.are_there
            // traces need the neighbour data of every step
            && !self.traced.any()
            && agents.script.uniform() == Some(None)
            && agents.tracking_error.uniform() == Some(0.0)
            && self.groups_in_use().all(|group| !group.model.is_random() && group.solid.0.is_empty())
    }

    /// Returns the distance from an agent that was not still beyond which a sub-step is certain to repeat the last one.
    fn distance_that_matters(&self, seconds: f32, passes: usize) -> f32 {
        let most = |all: &[f32]| all.iter().copied().fold(0.0, f32::max);
        let reach = most(self.agents.max_speed.values()) * seconds;
        let contact = 2.0 * (most(self.agents.radius.values()) + reach);
        let looks = self.groups_in_use().map(|group| group.neighbour_distance).fold(0.0, f32::max);
        // a little more, for rounding
        1.01 * (2.0 * looks + 2.0 * reach + passes as f32 * contact) + 0.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::avoid::Vo;
    use crate::motion::WrapAround;
    use crate::perceive::SimdLevel;
    use crate::{Agent, Goal, Group, Journey, Obstacle, Settings, Stop, SubSteps, World};
    use glam::{DVec2, Vec3};
    use proptest::prelude::*;
    use std::sync::Arc;

    #[derive(Clone, Debug)]
    enum RowChange {
        Add(DVec2),
        Remove(usize),
        Solid(DVec2),
        SaveAndLoad,
        Sort,
        FacePlaces,
    }

    /// Seventy agents side by side.
    #[derive(Clone, Debug)]
    struct Cluster {
        /// Distance between neighbours, metres.
        spacing: f64,
        /// Whether the agents first walk to the middle of the cluster.
        gathers: bool,
        /// Velocity at the start, m/s.
        velocity: f32,
    }

    #[derive(Clone, Debug)]
    struct Crowd {
        clusters: Vec<Cluster>,
        walkers: Vec<(DVec2, DVec2)>,
        changes: Vec<(u64, RowChange)>,
        guard: bool,
        /// Some agents have a shorter neighbour distance, a lower speed and a larger radius.
        mixed: bool,
        /// Some agents have another local model.
        odd: bool,
        /// Whether agents wrap around a ball: most clusters are within it, and most walkers leave it.
        wraps: bool,
        sub_steps: SubSteps,
    }

    fn place() -> impl Strategy<Value = DVec2> {
        // in and around the clusters
        (0u8..5, -16.0f64..16.0, -8.0f64..8.0).prop_map(|(k, x, y)| DVec2::new(35.0 * f64::from(k) + x, y))
    }

    fn change() -> impl Strategy<Value = RowChange> {
        prop_oneof![
            2 => place().prop_map(RowChange::Add),
            3 => (0usize..1000).prop_map(RowChange::Remove),
            1 => place().prop_map(RowChange::Solid),
            1 => Just(RowChange::SaveAndLoad),
            1 => Just(RowChange::Sort),
            1 => Just(RowChange::FacePlaces),
        ]
    }

    fn crowd() -> impl Strategy<Value = Crowd> {
        let cluster = (0.35f64..1.5, prop::bool::weighted(0.3), prop_oneof![3 => Just(0.0f32), 1 => 0.0f32..1.0]);
        let cluster = cluster.prop_map(|(spacing, gathers, velocity)| Cluster { spacing, gathers, velocity });
        let sub_steps = prop_oneof![3 => Just(SubSteps::Fixed(1)), 1 => Just(SubSteps::Auto)];
        (
            prop::collection::vec(cluster, 1..6),
            prop::collection::vec((place(), place()), 0..4),
            prop::collection::vec((0u64..120, change()), 0..4),
            (any::<bool>(), prop::bool::weighted(0.3), prop::bool::weighted(0.1), prop::bool::weighted(0.3), sub_steps),
        )
            .prop_map(|(clusters, walkers, changes, (guard, mixed, odd, wraps, sub_steps))| Crowd {
                clusters,
                walkers,
                changes,
                guard,
                mixed,
                odd,
                wraps,
                sub_steps,
            })
    }

    fn world(crowd: &Crowd, instructions: SimdLevel) -> World {
        let settings = Settings { step: 0.05, sub_steps: crowd.sub_steps, ..Settings::default() };
        let mut world = World::new(settings).unwrap();
        world.set_simd_level(instructions);
        let ball = WrapAround { center: Vec3::X * 70.0, radius: 72.5 };
        let wrap_around = crowd.wraps.then_some(ball);
        let usual = Group { guard: crowd.guard, neighbour_distance: 2.0, wrap_around, ..Group::default() };
        let other = Group { neighbours: 4, neighbour_distance: 1.5, ..usual.clone() };
        let usual_group = world.add_group(usual.clone()).unwrap();
        let other = world.add_group(if crowd.mixed { other } else { usual.clone() }).unwrap();
        let odd = world.add_group(Group { model: Arc::new(Vo::default()), ..usual }).unwrap();
        let journey = |world: &mut World, at: DVec2| {
            let goal = world.add_goal(Goal::Point { at, tolerance: 0.3 }).unwrap();
            world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap()
        };
        for (k, cluster) in crowd.clusters.iter().enumerate() {
            let middle = DVec2::new(35.0 * k as f64, 0.0);
            let gathering = journey(&mut world, middle);
            for at in 0..70u32 {
                let mut agent = Agent {
                    position: (middle + (DVec2::new(f64::from(at % 10), f64::from(at / 10)) - 4.5) * cluster.spacing)
                        .extend(0.0),
                    velocity: Vec2::new(0.0, cluster.velocity),
                    group: usual_group,
                    radius: 0.2,
                    ..Agent::default()
                };
                if cluster.gathers {
                    agent.journey = gathering;
                }
                if crowd.mixed && at % 7 == 0 {
                    (agent.group, agent.radius) = (other, 0.25);
                    agent.motor.set_max_speed(1.5);
                }
                if crowd.odd && at == 69 {
                    agent.group = odd;
                }
                world.add_agent(agent).unwrap();
            }
        }
        for &(position, to) in &crowd.walkers {
            let journey = journey(&mut world, to);
            world
                .add_agent(Agent { position: position.extend(0.0), journey, group: usual_group, ..Agent::default() })
                .unwrap();
        }
        world
    }

    fn make(change: &RowChange, crowd: &Crowd, world: &mut World) {
        match *change {
            RowChange::Add(position) => {
                let _ = world.add_agent(Agent::at(position));
            }
            RowChange::Remove(nth) => {
                world.remove_agent(world.id(nth % world.state.agents.len()));
            }
            RowChange::Solid(center) => {
                let _ = world.add_obstacle(Obstacle::Circle { center, radius: 0.5 });
            }
            RowChange::SaveAndLoad => {
                let bytes = world.save();
                let instructions = world.state.instructions;
                *world = self::world(crowd, instructions);
                world.load(&bytes).unwrap();
            }
            RowChange::Sort => world.sort_rows(),
            RowChange::FacePlaces => {
                let all: Vec<_> = (0..world.state.agents.len()).map(|row| world.id(row)).collect();
                world.face_ways(&all);
            }
        }
    }

    /// Advances a crowd with and without sleep and compares the two. Returns the number of rows that slept, summed over
    /// all steps.
    fn compare(crowd: &Crowd, steps: u64) -> Result<usize, TestCaseError> {
        let [mut resting, mut plain] = [SimdLevel::Best, SimdLevel::Plain].map(|one| world(crowd, one));
        let mut slept = 0;
        for step in 0..steps {
            for (_, change) in crowd.changes.iter().filter(|&&(when, _)| when == step) {
                make(change, crowd, &mut resting);
                make(change, crowd, &mut plain);
            }
            resting.step();
            plain.step();
            slept += WORD * resting.step.sleep.asleep.iter().filter(|&&asleep| asleep).count();
            prop_assert!(plain.step.sleep.asleep.is_empty(), "no agent sleeps on the scalar path");
            prop_assert!(resting.save() == plain.save(), "after {step} steps");
        }
        Ok(slept)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn sleep_does_not_change_the_bits(crowd in crowd()) {
            compare(&crowd, 150)?;
        }
    }

    #[test]
    fn still_agents_sleep_until_an_agent_comes() {
        let still = Cluster { spacing: 1.0, gathers: false, velocity: 0.0 };
        let gathers = Cluster { gathers: true, ..still.clone() };
        let mut crowd = Crowd {
            clusters: vec![still.clone(), still, gathers],
            walkers: vec![],
            changes: vec![],
            guard: true,
            mixed: false,
            odd: false,
            wraps: false,
            sub_steps: SubSteps::Fixed(1),
        };
        let all = compare(&crowd, 400).unwrap();
        assert!(all > 150 * 390, "at least two clusters sleep: {all}");
        crowd.walkers = vec![(DVec2::new(-10.0, 0.0), DVec2::new(80.0, 0.0))];
        let some = compare(&crowd, 400).unwrap();
        assert!(some > 64 * 100 && some < all, "{some} of {all}");
        // from beyond the last cluster to the first
        (crowd.wraps, crowd.walkers) = (true, vec![(DVec2::new(120.0, 6.0), DVec2::new(200.0, 6.0))]);
        let wrapped = compare(&crowd, 600).unwrap();
        assert!(wrapped > 64 * 100 && wrapped < 150 * 600, "{wrapped}");
    }
}

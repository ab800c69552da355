//! Rest: parts of a crowd in which nothing can change are left out of a sub-step, with the bits of making it.
//!
//! What a sub-step makes of somebody follows from their own state and that of those near them. *Still* is who is not on the
//! way, comes out of a sub-step as they went into it, to the bit, and was not moved by the guard in any of its passes. They
//! come out of the next in the same way unless somebody near was not still. A part of 64 rows sleeps if all of them were
//! still and nobody was otherwise so near that it could matter:
//!
//! - within twice how far people look: somebody who was not still changes what others wish who see them; and those who
//!   sleep see nobody who moves, else how near they come would have to be measured;
//! - and beyond by as many contacts as the guard has passes: with each it may push one the next.
//!
//! What a stage knows of a part stays as it is while the part sleeps. One by one nobody sleeps: it is the reference.

use super::World;
use super::advance::SEEN;
use crate::agent::{Status, Value};
use crate::guard::PASSES;
use crate::lanes::ones;
use crate::parallel::{self, Parts, WORD, Words};
use glam::Vec2;
use std::ops::Range;

/// Who rests. The default: nobody is known to.
#[derive(Clone, Debug, Default)]
pub(super) struct Rest {
    /// Who was still in the last sub-step, a bit each.
    still: Vec<u64>,
    /// Which parts sleep in this one; empty: none.
    asleep: Vec<bool>,
    /// Where people were who were removed since.
    gone: Vec<Vec2>,
    unrest: Unrest,
    /// Seconds of the last sub-step and whether it was guarded, if anybody could rest.
    made: Option<(f32, bool)>,
    /// Whether nobody has moved, come or gone since that was asked last.
    unchanged: bool,
}

/// Squares of the ground in which somebody was not still.
#[derive(Clone, Debug, Default)]
struct Unrest {
    low: Vec2,
    high: Vec2,
    width: f32,
    columns: usize,
    squares: Vec<bool>,
}

/// Squares from one end of the ground to the other, at most, and to the distance that matters.
const SQUARES: f32 = 256.0;
const FINE: f32 = 4.0;

impl Rest {
    /// Wakes everybody up.
    pub fn end(&mut self) {
        self.still.clear();
        self.asleep.clear();
        self.unchanged = false;
    }

    /// Notes that an agent is added, in a row of its own.
    pub fn add(&mut self) {
        self.unchanged = false;
    }

    /// Whether nobody has moved, come or gone since this was asked last.
    pub fn unchanged(&mut self) -> bool {
        std::mem::replace(&mut self.unchanged, true)
    }

    /// Notes that the agent of a row at a place is removed: that of the last row takes its row.
    pub fn remove(&mut self, row: usize, last: usize, at: Vec2) {
        self.unchanged = false;
        self.gone.push(at);
        if let Some(part) = self.still.get_mut(row / WORD) {
            *part &= !(1 << (row % WORD));
        }
        if let Some(part) = self.still.get_mut(last / WORD) {
            *part = 0;
        }
    }

    /// Whether 64 rows sleep.
    #[inline]
    pub fn sleeps(&self, part: usize) -> bool {
        self.asleep.get(part) == Some(&true)
    }

    /// Which parts sleep; none beyond the end.
    pub fn asleep(&self) -> &[bool] {
        &self.asleep
    }

    /// Whether everybody sleeps.
    pub fn is_everybodys(&self) -> bool {
        !self.asleep.is_empty() && self.asleep.iter().all(|&asleep| asleep)
    }

    /// The rows of a range that do not sleep, range by range.
    pub fn awake(&self, rows: Range<usize>) -> impl Iterator<Item = Range<usize>> + '_ {
        let mut at = rows.start;
        let mut skip = move |asleep: bool| {
            while at < rows.end && self.sleeps(at / WORD) == asleep {
                at = ((at / WORD + 1) * WORD).min(rows.end);
            }
            at
        };
        std::iter::from_fn(move || {
            let range = skip(true)..skip(false);
            (!range.is_empty()).then_some(range)
        })
    }

    /// Calls `work` for the rows of a range that do not sleep, each time with their part of `all`.
    pub fn each<P: Parts>(&self, rows: Range<usize>, all: P, mut work: impl FnMut(Range<usize>, P)) {
        if self.asleep.is_empty() {
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

    /// The same for places, by the rows that are there.
    pub fn each_place<P: Parts>(
        &self,
        order: &[u32],
        places: Range<usize>,
        all: P,
        mut work: impl FnMut(Range<usize>, P),
    ) {
        if self.asleep.is_empty() {
            return work(places, all);
        }
        let (mut left, mut at) = (all, places.start);
        for rows in order[places].chunk_by(|&a, &b| self.sleeps(a as usize / WORD) == self.sleeps(b as usize / WORD)) {
            let (part, later) = left.split(rows.len());
            let range = at..at + rows.len();
            at = range.end;
            left = later;
            if !self.sleeps(rows[0] as usize / WORD) {
                work(range, part);
            }
        }
    }
}

impl Unrest {
    /// Notes these places, and no others, in squares of at least some width.
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

    /// Whether a box touches a square with one of the places.
    fn touches(&self, low: Vec2, high: Vec2) -> bool {
        let overlaps = low.cmple(self.high).all() && self.low.cmple(high).all();
        overlaps
            && (self.row(low.y)..=self.row(high.y)).any(|row| {
                let squares = row * self.columns..(row + 1) * self.columns;
                self.squares[squares][self.column(low.x)..=self.column(high.x)].contains(&true)
            })
    }

    /// The column of a coordinate, or the nearest one. It never falls as the coordinate rises.
    fn column(&self, x: f32) -> usize {
        (((x - self.low.x) / self.width) as usize).min(self.columns - 1)
    }

    fn row(&self, y: f32) -> usize {
        (((y - self.low.y) / self.width) as usize).min(self.squares.len() / self.columns - 1)
    }
}

/// The rows of a part, of so many.
fn rows_of(part: usize, count: usize) -> Range<usize> {
    part * WORD..count.min((part + 1) * WORD)
}

impl World {
    /// Finds out who sleeps in the sub-step that begins.
    pub(super) fn fall_asleep(&mut self, seconds: f32) {
        let mut rest = std::mem::take(&mut self.step.rest);
        self.note_groups();
        // as `is_guarded` will say
        let guarded = self.agents.group.uniform().is_none_or(|group| self.groups[group.index()].guard);
        let made = self.may_rest().then_some((seconds, guarded));
        if made.is_none() || made != rest.made {
            rest.end();
            rest.made = made;
        }
        self.find_asleep(&mut rest, seconds);
        rest.gone.clear();
        rest.unchanged &= rest.is_everybodys();
        self.step.rest = rest;
    }

    fn find_asleep(&self, rest: &mut Rest, seconds: f32) {
        let (positions, count) = (&self.agents.position, self.agents.len());
        let Rest { still, asleep, gone, unrest, .. } = rest;
        asleep.clear();
        let parts = 0..count.div_ceil(WORD);
        let all_still = |part: usize| {
            let still = still.get(part).copied().unwrap_or(0);
            still.count_ones() as usize == rows_of(part, count).len() && self.step.measured[part].no_overlap()
        };
        if !parts.clone().any(all_still) {
            return;
        }
        let moved = (0..count).filter(|&row| still.get(row / WORD).is_none_or(|part| part >> (row % WORD) & 1 == 0));
        let distance = self.distance_that_matters(seconds);
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

    /// Whether anybody can rest: discs on the ground that go by plain ORCA and turn as they like.
    fn may_rest(&self) -> bool {
        let agents = &self.agents;
        self.lanes_to_move().is_some()
            // who tells why needs to have looked
            && !self.asked.anybody()
            && agents.script.uniform() == Some(None)
            && agents.tracking_error.uniform() == Some(0.0)
            && self.groups_in_use().all(|group| group.model.as_orca().is_some() && group.solid.0.is_empty())
    }

    /// How far from somebody who was not still the sub-step is sure to be that of the last.
    fn distance_that_matters(&self, seconds: f32) -> f32 {
        let most = |all: &[f32]| all.iter().copied().fold(0.0, f32::max);
        let reach = most(self.agents.max_speed.values()) * seconds;
        let contact = 2.0 * (most(self.agents.radius.values()) + reach);
        let looks = self.groups_in_use().map(|group| group.neighbour_distance).fold(0.0, f32::max);
        // a little more, for rounding
        1.01 * (2.0 * looks + 2.0 * reach + PASSES as f32 * contact) + 0.1
    }

    /// Notes who is still in this sub-step, before anybody moves.
    pub(super) fn note_still(&mut self, seconds: f32) {
        let mut rest = std::mem::take(&mut self.step.rest);
        if rest.made.is_some() {
            let (world, count) = (&*self, self.agents.len());
            let Rest { still, asleep, .. } = &mut rest;
            still.resize(count.div_ceil(WORD), 0);
            parallel::ranges(Words(still), |rows, Words(still)| {
                for (part, still) in
                    (rows.start / WORD..).zip(still).filter(|&(part, _)| asleep.get(part) != Some(&true))
                {
                    let status = &world.agents.status[rows_of(part, count)];
                    let stands = |bits, &status: &Status| bits << 1 | u64::from(status != Status::Walking);
                    let standing = status.iter().rev().fold(0, stands);
                    let first = part * WORD;
                    let pushed = if world.is_guarded() { world.step.guard.moved(part) } else { 0 };
                    let is_pushed = |at: usize| pushed >> at & 1 == 1 && world.is_displaced(first + at);
                    let moving = |&at: &usize| is_pushed(at) || !world.is_still(first + at, seconds);
                    *still = ones(standing).filter(moving).fold(standing, |still, at| still & !(1 << at));
                }
            });
        }
        self.step.rest = rest;
    }

    /// Whether the guard lets an agent end the sub-step at another place than it began.
    fn is_displaced(&self, row: usize) -> bool {
        !self.step.targets[row].position.same(self.agents.position[row])
    }

    /// Whether a row that does not walk will be after this sub-step as it was before, if the guard has not moved it.
    fn is_still(&self, row: usize, seconds: f32) -> bool {
        let Self { agents, step, .. } = self;
        let (velocity, at) = (step.wishes.ground[row], agents.position[row]);
        !step.shown[row].way.may_change()
            && velocity.same(agents.velocity[row])
            // a motion that is below what positions resolve is none
            && (at + velocity * seconds).same(at)
            && velocity.length() < SEEN
            && agents.travel[row].is_settled()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::avoid::Vo;
    use crate::perceive::Instructions;
    use crate::{Agent, Goal, Group, Journey, Obstacle, Settings, Stop, SubSteps};
    use glam::DVec2;
    use proptest::prelude::*;
    use std::sync::Arc;

    #[derive(Clone, Debug)]
    enum Change {
        Add(DVec2),
        Remove(usize),
        Solid(DVec2),
        SaveAndLoad,
        Sort,
        FacePlaces,
    }

    /// Seventy people side by side.
    #[derive(Clone, Debug)]
    struct Cluster {
        /// Metres from one to the next.
        spacing: f64,
        /// Whether they go to its middle first.
        gathers: bool,
        /// What they begin with.
        velocity: f32,
    }

    #[derive(Clone, Debug)]
    struct Crowd {
        clusters: Vec<Cluster>,
        walkers: Vec<(DVec2, DVec2)>,
        changes: Vec<(u64, Change)>,
        guard: bool,
        /// Some look less far, or are slower, larger.
        mixed: bool,
        /// Some go by another model.
        odd: bool,
        sub_steps: SubSteps,
    }

    fn place() -> impl Strategy<Value = DVec2> {
        // in and round the clusters
        (0u8..5, -16.0f64..16.0, -8.0f64..8.0).prop_map(|(k, x, y)| DVec2::new(35.0 * f64::from(k) + x, y))
    }

    fn change() -> impl Strategy<Value = Change> {
        prop_oneof![
            2 => place().prop_map(Change::Add),
            3 => (0usize..1000).prop_map(Change::Remove),
            1 => place().prop_map(Change::Solid),
            1 => Just(Change::SaveAndLoad),
            1 => Just(Change::Sort),
            1 => Just(Change::FacePlaces),
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
            (any::<bool>(), prop::bool::weighted(0.3), prop::bool::weighted(0.1), sub_steps),
        )
            .prop_map(|(clusters, walkers, changes, (guard, mixed, odd, sub_steps))| Crowd {
                clusters,
                walkers,
                changes,
                guard,
                mixed,
                odd,
                sub_steps,
            })
    }

    fn world(crowd: &Crowd, instructions: Instructions) -> World {
        let settings = Settings { step: 0.05, sub_steps: crowd.sub_steps, ..Settings::default() };
        let mut world = World::new(settings).unwrap();
        world.use_instructions(instructions);
        let usual = Group { guard: crowd.guard, neighbour_distance: 2.0, ..Group::default() };
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
                    position: middle + (DVec2::new(f64::from(at % 10), f64::from(at / 10)) - 4.5) * cluster.spacing,
                    velocity: Vec2::new(0.0, cluster.velocity),
                    group: usual_group,
                    radius: 0.2,
                    ..Agent::default()
                };
                if cluster.gathers {
                    agent.journey = gathering;
                }
                if crowd.mixed && at % 7 == 0 {
                    (agent.group, agent.radius, agent.max_speed) = (other, 0.25, 1.5);
                }
                if crowd.odd && at == 69 {
                    agent.group = odd;
                }
                world.add_agent(agent).unwrap();
            }
        }
        for &(position, to) in &crowd.walkers {
            let journey = journey(&mut world, to);
            world.add_agent(Agent { position, journey, group: usual_group, ..Agent::default() }).unwrap();
        }
        world
    }

    fn make(change: &Change, crowd: &Crowd, world: &mut World) {
        match *change {
            Change::Add(position) => {
                let _ = world.add_agent(Agent { position, ..Agent::default() });
            }
            Change::Remove(nth) => {
                world.remove_agent(world.id(nth % world.agents.len()));
            }
            Change::Solid(center) => {
                let _ = world.add_obstacle(Obstacle::Circle { center, radius: 0.5 });
            }
            Change::SaveAndLoad => {
                let bytes = world.save();
                let instructions = world.instructions;
                *world = self::world(crowd, instructions);
                world.load(&bytes).unwrap();
            }
            Change::Sort => world.sort_rows(),
            Change::FacePlaces => {
                let all: Vec<_> = (0..world.agents.len()).map(|row| world.id(row)).collect();
                world.face_ways(&all);
            }
        }
    }

    /// Moves a crowd on, both with and without rest; gives how many rows slept, of all steps.
    fn compare(crowd: &Crowd, steps: u64) -> Result<usize, TestCaseError> {
        let [mut resting, mut plain] = [Instructions::Best, Instructions::Plain].map(|one| world(crowd, one));
        let mut slept = 0;
        for step in 0..steps {
            for (_, change) in crowd.changes.iter().filter(|&&(when, _)| when == step) {
                make(change, crowd, &mut resting);
                make(change, crowd, &mut plain);
            }
            resting.step();
            plain.step();
            slept += WORD * resting.step.rest.asleep.iter().filter(|&&asleep| asleep).count();
            prop_assert!(plain.step.rest.asleep.is_empty(), "one by one nobody sleeps");
            prop_assert!(resting.save() == plain.save(), "after {step} steps");
        }
        Ok(slept)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn resting_gives_the_bits_of_going_on(crowd in crowd()) {
            compare(&crowd, 150)?;
        }
    }

    #[test]
    fn who_rests_sleeps_until_somebody_comes() {
        let still = Cluster { spacing: 1.0, gathers: false, velocity: 0.0 };
        let gathers = Cluster { gathers: true, ..still.clone() };
        let mut crowd = Crowd {
            clusters: vec![still.clone(), still, gathers],
            walkers: vec![],
            changes: vec![],
            guard: true,
            mixed: false,
            odd: false,
            sub_steps: SubSteps::Fixed(1),
        };
        let all = compare(&crowd, 400).unwrap();
        assert!(all > 150 * 390, "two clusters and more: {all}");
        crowd.walkers = vec![(DVec2::new(-10.0, 0.0), DVec2::new(80.0, 0.0))];
        let some = compare(&crowd, 400).unwrap();
        assert!(some > 64 * 100 && some < all, "{some} of {all}");
    }
}

//! Measures how close bodies come to each other, to walls and to solids.

use crate::agent::Columns;
use crate::guard::{Guarded, Solids};
use crate::parallel::{self, WORD, Words};
use crate::perceive::Perceived;
use crate::simd::ones;
use crate::sleep::SleepBlocks;
use crate::space::{Core, Walls};
use crate::world::State;

/// The measurements, as in [`Tally`](crate::summary::Tally).
#[derive(Clone, Copy, Debug)]
struct Measured {
    least_separation: f64,
    least_wall_separation: f64,
    overlaps: u64,
    /// Discs with a greater approximate separation neither overlap nor are the nearest pair.
    looks_below: f32,
}

/// Measures how close bodies come to each other, to walls and to solids.
#[derive(Clone, Debug, Default)]
pub(super) struct Measure {
    /// By blocks of 64 rows.
    blocks: Vec<Measured>,
}

impl Measure {
    /// Whether no body of a block overlapped another body, a wall or a solid in the last sub-step.
    pub fn no_overlap(&self, block: usize) -> bool {
        self.blocks[block].overlaps == 0
    }

    /// Measures how close bodies come to each other, to walls and to solids.
    pub fn run(
        &mut self,
        state: &mut State,
        seen: Perceived<'_>,
        safe: Guarded<'_>,
        close_pairs: &[(u32, u32)],
        sleep: &SleepBlocks,
    ) {
        // without guarded agents no contacts are collected, so the neighbour lists are used
        let (own, guarded) = (state.own().end, state.is_guarded());
        let State { agents, walls, tally, .. } = state;
        if sleep.all_asleep() {
            return;
        }
        let before = Measured {
            least_separation: tally.least_separation,
            least_wall_separation: tally.least_wall_separation,
            overlaps: 0,
            looks_below: looks_below(tally.least_separation),
        };
        self.blocks.clear();
        self.blocks.resize(agents.len().div_ceil(WORD), before);
        let (contacts, solids, near) = (safe.contacts, safe.solids, seen.near);
        let discs_only = seen.discs_only;
        let counts = |row: usize| row < own && !sleep.sleeps(row / WORD);
        let measure = |measured: &mut Measured, first: usize| {
            // pairs are listed before their rows are read, so that the reads overlap
            let (mut pairs, mut count) = ([(0, 0); PAIRS], 0);
            for (row, close) in near.close_from(seen.grid.order(), first).filter(|&(row, _)| counts(row as usize)) {
                // contacts cover every pair that can touch; of the remaining pairs the nearest is enough
                let close = if guarded { &close[..1] } else { close };
                for &other in close {
                    if count == PAIRS {
                        measured.pairs(agents, &pairs, (discs_only, guarded));
                        count = 0;
                    }
                    pairs[count] = (row, other);
                    count += 1;
                }
            }
            measured.pairs(agents, &pairs[..count], (discs_only, guarded));
            let part = first / WORD;
            if sleep.sleeps(part) {
                return;
            }
            for row in ones(contacts.touching(part)).map(|at| first + at).filter(|&row| row < own) {
                contacts.of(row).iter().for_each(|&other| measured.pair(agents, row, other as usize, discs_only));
                // an unguarded script may lead through walls and above the ground
                let is_kept = agents.script[row].is_none() || safe.guarded[row];
                if is_kept && !contacts.is_off_walls(row) {
                    measured.walls(agents, row, walls, (contacts.edges_of(row), contacts.discs_of(row)));
                }
            }
            for row in ones(solids.near(part)).map(|at| first + at).filter(|&row| row < own) {
                measured.solid(agents, row, solids);
            }
        };
        parallel::ranges(Words(&mut self.blocks), |rows, Words(all)| {
            rows.step_by(WORD).zip(all).for_each(|(first, measured)| measure(measured, first));
        });
        let mut near = before;
        for &(row, other) in close_pairs {
            let (row, other) = (row as usize, other as usize);
            if guarded {
                // contacts count the overlaps
                near.separation(agents, row, other);
            } else {
                near.pair(agents, row, other, discs_only);
            }
        }
        for measured in self.blocks.iter().chain([&near]) {
            tally.least_separation = tally.least_separation.min(measured.least_separation);
            tally.least_wall_separation = tally.least_wall_separation.min(measured.least_wall_separation);
            tally.overlaps += measured.overlaps;
        }
    }
}

impl State {
    /// Returns the distance of two agents at the start of a sub-step above which they can neither overlap at its end
    /// nor be nearer than any pair before.
    pub(crate) fn close_enough_to_measure(&self, seconds: f32) -> f32 {
        let agents = &self.agents;
        let most = |all: &[f32]| all.iter().copied().fold(0.0, f32::max);
        if !agents.all_discs() {
            return f32::INFINITY;
        }
        let (radius, reach) = (most(agents.radius.values()), most(agents.max_speed.values()) * seconds);
        2.001 * (radius * looks_below(self.tally.least_separation) + reach)
    }
}

impl Measured {
    /// Measures the separation of neighbours, and counts overlaps if no agent is guarded.
    fn pairs(&mut self, agents: &Columns, pairs: &[(u32, u32)], (discs_only, guarded): (bool, bool)) {
        for (row, other) in pairs.iter().map(|&(row, other)| (row as usize, other as usize)) {
            if !discs_only || self.is_near(agents, row, other) {
                let separation = self.separation(agents, row, other);
                let counts = !guarded && agents.number[row] < agents.number[other];
                self.overlaps += u64::from(counts && separation < TOUCH);
            }
        }
    }

    /// Measures the separation of two agents and counts an overlap; each pair once, for the agent with the lower
    /// number.
    #[inline]
    fn pair(&mut self, agents: &Columns, row: usize, other: usize, discs_only: bool) {
        if (!discs_only || self.is_near(agents, row, other)) && agents.number[row] < agents.number[other] {
            let separation = self.separation(agents, row, other);
            self.overlaps += u64::from(separation < TOUCH);
        }
    }

    /// Whether two discs may overlap or be nearer than any pair before. The test uses ground distances, without a
    /// square root or a division, because it is false for most pairs.
    #[inline]
    fn is_near(&self, agents: &Columns, row: usize, other: usize) -> bool {
        let limit = (agents.radius[row] + agents.radius[other]) * self.looks_below;
        agents.position[row].distance_squared(agents.position[other]) <= limit * limit
    }

    /// Returns the separation of two agents, and records the least one.
    fn separation(&mut self, agents: &Columns, row: usize, other: usize) -> f64 {
        let separation = agents.separation(row, other);
        if separation < self.least_separation {
            self.least_separation = separation;
            self.looks_below = looks_below(separation);
        }
        separation
    }

    fn walls(&mut self, agents: &Columns, row: usize, walls: &Walls, (edges, discs): (&[u32], &[u32])) {
        let at = agents.position[row].as_dvec2();
        let core = (!agents.is_disc(row)).then(|| agents.core_of(row));
        let edges = edges.iter().map(|&i| walls.edges()[i as usize]);
        let edges = edges.map(|edge| match &core {
            None => edge.nearest(at).distance(at),
            Some(core) => core.separation(&Core::segment(edge.start, edge.end)).distance,
        });
        let discs = discs.iter().map(|&i| walls.discs()[i as usize]);
        let discs = discs.map(|disc| match &core {
            None => disc.center.distance(at) - disc.radius,
            Some(core) => core.separation(&Core::point(disc.center)).distance - disc.radius,
        });
        if let Some(distance) = edges.chain(discs).min_by(f64::total_cmp) {
            self.apart(distance / f64::from(agents.radius[row]));
        }
    }

    /// Measures the separation from solids. A body counts as its bounding ball.
    fn solid(&mut self, agents: &Columns, row: usize, solids: &Solids) {
        let room = solids.room(row, agents.position[row].extend(agents.altitude[row]));
        self.apart(f64::from(room - agents.core[row].length()) / f64::from(agents.radius[row]));
    }

    /// Records the separation of an agent from a wall or a solid.
    fn apart(&mut self, separation: f64) {
        self.least_wall_separation = self.least_wall_separation.min(separation);
        self.overlaps += u64::from(separation < TOUCH);
    }
}

/// Pairs that are measured together.
const PAIRS: usize = 128;

/// Separation below which bodies overlap. A smaller difference from 1 is rounding.
const TOUCH: f64 = 1.0 - 1e-4;

fn looks_below(least_separation: f64) -> f32 {
    least_separation.max(1.0) as f32 * 1.0001
}

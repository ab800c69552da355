//! The guard itself: who is looked at when.
//!
//! Relaxing and clamping change few, and what is found about a row depends on its own target and on those of the rows
//! it could touch only. So a pass looks at those rows only for which one of these changed since they were looked at
//! last; everybody else would be found as before.

use super::cores::Cores;
use super::safe::is_safe;
use super::solid::Solid;
use super::{Bodies, Contacts, Pose, cell, relax};
use crate::avoid::{Line, Plane};
use crate::lanes::ones;
use crate::parallel::{self, WORD, Words};
use crate::space::Walls;
use glam::Vec3;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Rounds of certification after which everybody who is still free is clamped.
pub(super) const ROUNDS: usize = 8;

/// What the guard did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Agents whose displacement it changed by more than a hundredth.
    pub changed: usize,
    /// Agents it clamped to their cells.
    pub clamped: usize,
    /// Rounds of certification.
    pub rounds: usize,
}

/// The guard, with the memory it keeps from step to step.
#[derive(Clone, Debug, Default)]
pub struct Guard {
    parts: Vec<Part>,
    waiting: Vec<Waiting>,
    scratch: Vec<Scratch>,
    cores: Cores,
}

/// What is known of a part of the rows. A set of rows is a word, a bit a row.
#[derive(Clone, Debug, Default)]
struct Part {
    /// Who gets a new target in this pass.
    moving: u64,
    /// Who was ever looked at.
    seen: u64,
    /// Whose target ever changed.
    moved: u64,
    clamped: u64,
    /// Whose motion is not what was wished.
    changed: u64,
}

/// Memory for some parts.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    /// New targets of those who get one in this pass, row by row.
    targets: Vec<Pose>,
    /// One agent's cell.
    pub lines: Vec<Line>,
    pub planes: Vec<Plane>,
    pub sides: Vec<cell::Side>,
}

/// The rows of a part that the next pass looks at; any thread may add to them.
#[derive(Debug, Default)]
struct Waiting(AtomicU64);

impl Waiting {
    fn add(&self, rows: u64) {
        // most are there already
        if self.0.load(Ordering::Relaxed) & rows != rows {
            self.0.fetch_or(rows, Ordering::Relaxed);
        }
    }
}

impl Clone for Waiting {
    fn clone(&self) -> Self {
        Self(AtomicU64::new(self.0.load(Ordering::Relaxed)))
    }
}

impl Guard {
    /// Puts into `targets` what is certain: the motion to where each row `wished`, changed as little as can be.
    /// `contacts` must hold every pair and every wall that the bodies' reach lets meet.
    pub fn certify(
        &mut self,
        bodies: &Bodies<'_>,
        contacts: &Contacts,
        walls: &Walls,
        wished: impl Fn(usize) -> Pose + Sync,
        targets: &mut Vec<Pose>,
    ) -> Report {
        let count = bodies.positions.len();
        let Self { parts, waiting, scratch, cores } = self;
        cores.rebuild(bodies);
        let solid = Solid { bodies, contacts, walls, cores };
        let touching = |part: usize| contacts.touching(part) | bodies.solids.near(part);
        targets.resize(count, Pose::default());
        parts.resize_with(count.div_ceil(WORD), Part::default);
        waiting.clear();
        waiting.resize_with(parts.len(), Waiting::default);
        parallel::ranges((Words(parts), &mut targets[..]), |rows, (Words(parts), targets)| {
            for ((first, part), targets) in rows.step_by(WORD).zip(parts).zip(targets.chunks_mut(WORD)) {
                *part = Part::default();
                if bodies.rest(first / WORD) {
                    continue;
                }
                for (row, target) in (first..).zip(targets) {
                    let wish = wished(row);
                    *target = within_reach(row, bodies, wish);
                    part.changed |= u64::from(differs(row, bodies, wish, *target)) * bit(row);
                }
            }
        });
        let mut passes = Passes { contacts, parts, waiting, scratch, targets };
        passes.look_at(|at, _, targets| {
            let touching = rows(at, if bodies.rest(at) { 0 } else { touching(at) });
            touching.filter(|&row| !relax::is_clear(row, solid, targets)).fold(0, |some, row| some | bit(row))
        });
        for _ in 0..relax::ITERATIONS {
            passes.run(|_, _, row, targets| Some(relax::relaxed(row, solid, targets)));
        }
        passes.look_at(|_, part, _| part.seen);
        let mut report = Report::default();
        for round in 1..=ROUNDS + 1 {
            let last = round > ROUNDS;
            if last {
                passes.look_at(|at, _, _| touching(at));
            }
            let clamped = passes.run(|part, scratch, row, targets| {
                let free = part.clamped & bit(row) == 0;
                (free && (last || !is_safe(row, solid, targets))).then(|| {
                    part.clamped |= bit(row);
                    cell::clamp(row, solid, targets[row], scratch)
                })
            });
            if clamped == 0 {
                break;
            }
            report.rounds = round;
        }
        let moved = parts.iter().map(|part| part.moved.count_ones() as usize).sum();
        let note = |part_rows: Range<usize>, parts: &mut [Part]| {
            for (first, part) in part_rows.step_by(WORD).zip(parts) {
                for row in rows(first / WORD, part.moved) {
                    part.changed &= !bit(row);
                    part.changed |= u64::from(differs(row, bodies, wished(row), targets[row])) * bit(row);
                }
            }
        };
        parallel::ranges_if_busy(Words(parts), moved, scratch, |_, rows, Words(parts)| note(rows, parts));
        for part in parts {
            report.changed += part.changed.count_ones() as usize;
            report.clamped += part.clamped.count_ones() as usize;
        }
        report
    }

    /// Rows that any pass moved in the last step.
    pub(crate) fn moved_rows(&self) -> impl Iterator<Item = usize> {
        (0..).zip(&self.parts).flat_map(|(part, of)| rows(part, of.moved))
    }

    /// Those of 64 rows that any pass moved in the last step, a bit each.
    pub(crate) fn moved(&self, part: usize) -> u64 {
        self.parts[part].moved
    }
}

/// Puts into `targets` where each row wished to go, as far as it gets: nobody is held apart, nor gets into a solid.
pub(crate) fn unguarded(bodies: &Bodies<'_>, wished: impl Fn(usize) -> Pose + Sync, targets: &mut Vec<Pose>) {
    targets.resize(bodies.positions.len(), Pose::default());
    parallel::ranges(&mut targets[..], |rows, targets| {
        for (row, target) in rows.zip(targets) {
            *target = bodies.solids.lead(row, bodies, within_reach(row, bodies, wished(row)));
        }
    });
}

/// The same for those who are near a solid only: nobody else's target is touched.
pub(crate) fn led(bodies: &Bodies<'_>, wished: impl Fn(usize) -> Pose + Sync, targets: &mut Vec<Pose>) {
    targets.resize(bodies.positions.len(), Pose::default());
    parallel::ranges(&mut targets[..], |all, targets| {
        for row in all.clone().step_by(WORD).flat_map(|first| rows(first / WORD, bodies.solids.near(first / WORD))) {
            targets[row - all.start] = bodies.solids.lead(row, bodies, within_reach(row, bodies, wished(row)));
        }
    });
}

/// All parts and their targets.
struct Passes<'a> {
    contacts: &'a Contacts,
    parts: &'a mut [Part],
    waiting: &'a mut [Waiting],
    scratch: &'a mut Vec<Scratch>,
    targets: &'a mut [Pose],
}

impl Passes<'_> {
    /// Has the next pass look at those of each part that `whom` gives, too.
    fn look_at(&mut self, whom: impl Fn(usize, &Part, &[Pose]) -> u64 + Sync) {
        let targets = &*self.targets;
        parallel::ranges((Words(self.parts), Words(self.waiting)), |rows, (Words(parts), Words(waiting))| {
            for ((first, part), waiting) in rows.step_by(WORD).zip(parts).zip(waiting) {
                *waiting.0.get_mut() |= whom(first / WORD, part, targets);
            }
        });
    }

    /// Looks at all who wait, moves those for whom `target` has a new target, and has the next pass look at them again
    /// and at those whom they could touch. Gives how many have a new target, be it the same as before.
    fn run(&mut self, target: impl Fn(&mut Part, &mut Scratch, usize, &[Pose]) -> Option<Pose> + Sync) -> usize {
        let Self { contacts, parts, waiting, scratch, targets } = self;
        let busy = waiting.iter_mut().map(|waiting| waiting.0.get_mut().count_ones() as usize).sum();
        let both = (Words(parts), Words(waiting));
        parallel::ranges_if_busy(both, busy, scratch, |scratch, part_rows, (Words(parts), Words(waiting))| {
            scratch.targets.clear();
            for ((first, part), waiting) in part_rows.step_by(WORD).zip(parts).zip(waiting) {
                let looked_at = std::mem::take(waiting.0.get_mut());
                part.seen |= looked_at;
                part.moving = 0;
                for row in rows(first / WORD, looked_at) {
                    if let Some(pose) = target(part, scratch, row, targets) {
                        part.moving |= bit(row);
                        scratch.targets.push(pose);
                    }
                }
            }
        });
        // divided as before: the same ranges have the same memory
        let both = (Words(parts), &mut targets[..]);
        parallel::ranges_if_busy(both, busy, scratch, |scratch, part_rows, (Words(parts), targets)| {
            let mut poses = scratch.targets.iter();
            for ((first, part), targets) in part_rows.step_by(WORD).zip(parts).zip(targets.chunks_mut(WORD)) {
                for (row, &pose) in rows(first / WORD, part.moving).zip(&mut poses) {
                    let target = &mut targets[row % WORD];
                    if *target != pose {
                        part.moved |= bit(row);
                        for row in [row as u32].iter().chain(contacts.of(row)).map(|&row| row as usize) {
                            waiting[row / WORD].add(bit(row));
                        }
                    }
                    *target = pose;
                }
            }
        });
        parts.iter().map(|part| part.moving.count_ones() as usize).sum()
    }
}

/// The bit of a row in the sets of its part.
#[inline]
fn bit(row: usize) -> u64 {
    1 << (row % WORD)
}

/// The rows of a set, lowest first.
fn rows(part: usize, set: u64) -> impl Iterator<Item = usize> {
    ones(set).map(move |at| part * WORD + at)
}

/// The wish of a row, as far as it can go in a step. One that is not a number is no wish at all; the heading of a disc
/// is left alone.
#[inline]
pub(crate) fn within_reach(row: usize, bodies: &Bodies<'_>, wish: Pose) -> Pose {
    let (from, to, reach) = (bodies.place(row), wish.place(), bodies.reach[row]);
    let motion = to - from;
    let place = if motion.length_squared() <= reach * reach {
        from + motion
    } else if to.is_finite() {
        from + motion.clamp_length_max(reach)
    } else {
        from
    };
    let turns = !bodies.is_disc(row) && wish.heading.is_finite();
    let heading = if turns { wish.heading } else { bodies.headings[row] };
    Pose { heading, ..wish }.with_place(place)
}

/// Whether a target is off the wish by more than a hundredth of the way, or of a thousandth of the body.
#[inline]
fn differs(row: usize, bodies: &Bodies<'_>, wish: Pose, target: Pose) -> bool {
    let turned = !bodies.is_disc(row) && wish.heading != target.heading;
    // most are where they wished to be
    turned || wish.place() != target.place() && is_off(row, bodies, wish.place(), target.place())
}

#[cold]
fn is_off(row: usize, bodies: &Bodies<'_>, wish: Vec3, target: Vec3) -> bool {
    let tolerance = wish.distance(bodies.place(row)).max(1e-3 * bodies.radii[row]) * 1e-2;
    !wish.is_finite() || wish.distance(target) > tolerance
}

//! The guard: certification in rounds.
//!
//! Relaxation and clamping change few targets. The result for a row depends only on the row's own target and on the
//! targets of the rows that it could touch. So a pass evaluates a row only if one of these targets changed since the
//! row's last evaluation. Evaluating any other row would give the same result again.

use super::cores::Cores;
use super::safe::is_safe;
use super::solid::GuardedObjects;
use super::spread::{Clamping, Nowhere, Spreading};
use super::{BodyPose, Contacts, GuardedBodies, cell, relax};
use crate::avoid::{HalfPlane, HalfSpace};
use crate::parallel::{self, WORD, Words};
use crate::simd::ones;
use crate::space::Walls;
use glam::Vec3;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// At most this many waiting rows are listed, so that a pass does not look for them among all rows.
const FEW: usize = 256;

/// Statistics of one certification.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Number of agents with a displacement that the guard changed by more than 1 %.
    pub changed: usize,
    /// Number of agents clamped to their cells.
    pub clamped: usize,
    /// Number of certification rounds.
    pub rounds: usize,
}

/// The guard, with buffers that are reused from step to step.
#[derive(Clone, Debug, Default)]
pub struct Guard {
    parts: Vec<RowRange>,
    waiting: Vec<Waiting>,
    listed: Vec<u32>,
    scratch: Vec<CertifyScratch>,
    cores: Cores,
}

/// The state of 64 consecutive rows. A set of rows is a word with one bit per row.
#[derive(Clone, Debug, Default)]
pub(super) struct RowRange {
    /// Rows that get a new target in this pass.
    moving: u64,
    /// Rows evaluated in any pass of this step.
    seen: u64,
    /// Rows with a target that changed in any pass of this step.
    moved: u64,
    pub(super) clamped: u64,
    /// Rows with a target that differs from the desired pose.
    changed: u64,
}

/// Buffers of one thread.
#[derive(Clone, Debug, Default)]
pub(super) struct CertifyScratch {
    /// New targets of this pass, in the order of rows.
    targets: Vec<BodyPose>,
    /// Rows of these targets, in a pass over listed rows.
    rows: Vec<u32>,
    /// Buffers for the cell of one agent.
    pub lines: Vec<HalfPlane>,
    pub planes: Vec<HalfSpace>,
    pub sides: Vec<cell::CellSide>,
}

/// The rows among 64 that the next pass evaluates. Any thread may add rows.
#[derive(Debug, Default)]
struct Waiting(AtomicU64);

impl Waiting {
    fn add(&self, rows: u64) {
        // most rows are in the set already
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
    /// Computes safe `targets`: the poses of `desired`, changed as little as possible. `contacts` must hold every pair
    /// and every wall that can meet within the reach of the bodies.
    ///
    /// Clamping spreads only where it must. A round clamps the free rows that are not safe with the targets of the round
    /// before. No limit on the rounds is necessary:
    /// - Every round but the last clamps a row, and no row twice. So there are at most as many rounds as rows.
    /// - No row is clamped in the last round, so every free row was safe with the final targets when it was last
    ///   evaluated. A row waits again whenever a target that it depends on changes. So it is safe in the end.
    /// - Clamped rows are in their cells, and two rows that are both in their cells are safe.
    ///
    /// The rows clamped in a round depend on the targets of the round before only, so they are the same for any number
    /// of threads. Clamping leaves a row that stands where it stands, so it spreads through moving rows only.
    ///
    /// Together the rounds evaluate no row more often than once for each target that changes among its contacts and its
    /// own. A round with few waiting rows takes time for these rows only.
    pub fn certify(
        &mut self,
        bodies: &GuardedBodies<'_>,
        contacts: &Contacts,
        walls: &Walls,
        desired: impl Fn(usize) -> BodyPose + Sync,
        targets: &mut Vec<BodyPose>,
    ) -> Report {
        self.certify_own(bodies, contacts, walls, desired, targets, (bodies.positions.len(), &mut Nowhere))
    }

    /// As [`certify`](Self::certify), where only the first `own` rows count for the report. The other rows belong to other
    /// worlds: clamping may spread there from bodies that have no row here.
    ///
    /// A row depends on the rows of its contacts, so what is unknown comes nearer by one contact in a round. After a batch
    /// of rounds all worlds tell whether the last round of the batch clamped one of their rows. If none did, clamping has
    /// ended everywhere. Otherwise the rows of other worlds are renewed, and the next batch begins.
    pub(crate) fn certify_own(
        &mut self,
        bodies: &GuardedBodies<'_>,
        contacts: &Contacts,
        walls: &Walls,
        desired: impl Fn(usize) -> BodyPose + Sync,
        targets: &mut Vec<BodyPose>,
        (own, elsewhere): (usize, &mut dyn Spreading),
    ) -> Report {
        let count = bodies.positions.len();
        let Self { parts, waiting, listed, scratch, cores } = self;
        cores.rebuild(bodies);
        let solid = GuardedObjects { bodies, contacts, walls, cores };
        let touching = |part: usize| contacts.touching(part) | bodies.solids.near(part);
        targets.resize(count, BodyPose::default());
        parts.resize_with(count.div_ceil(WORD), RowRange::default);
        waiting.clear();
        waiting.resize_with(parts.len(), Waiting::default);
        parallel::ranges((Words(parts), &mut targets[..]), |rows, (Words(parts), targets)| {
            for ((first, part), targets) in rows.step_by(WORD).zip(parts).zip(targets.chunks_mut(WORD)) {
                *part = RowRange::default();
                if bodies.rest(first / WORD) {
                    continue;
                }
                for (row, target) in (first..).zip(targets) {
                    let pose = desired(row);
                    *target = within_reach(row, bodies, pose);
                    part.changed |= u64::from(differs(row, bodies, pose, *target)) * bit(row);
                }
            }
        });
        let mut passes = Passes { contacts, parts, waiting, listed, is_listed: false, scratch, targets };
        passes.look_at(|at, _, targets| {
            let touching = rows(at, if bodies.rest(at) { 0 } else { touching(at) });
            touching.filter(|&row| !relax::is_clear(row, solid, targets)).fold(0, |some, row| some | bit(row))
        });
        for _ in 0..relax::ITERATIONS {
            passes.run(|_, _, row, targets| Some(relax::relaxed(row, solid, targets)));
        }
        passes.look_at(|_, part, _| part.seen);
        let mut report = Report::default();
        let clamps = |part: &mut RowRange, scratch: &mut CertifyScratch, row: usize, targets: &[BodyPose]| {
            let free = part.clamped & bit(row) == 0;
            (free && !is_safe(row, solid, targets)).then(|| {
                part.clamped |= bit(row);
                cell::clamp(row, solid, targets[row], scratch)
            })
        };
        let clamped = |passes: &Passes<'_>| -> u32 {
            (0..).zip(&*passes.parts).map(|(at, part)| (part.clamped & first(own, at)).count_ones()).sum()
        };
        let mut left = elsewhere.rounds();
        loop {
            let before = if left == 1 { clamped(&passes) } else { 0 };
            let goes_on = passes.run(clamps) > 0;
            report.rounds += usize::from(goes_on);
            left -= 1;
            if left > 0 && goes_on {
                continue;
            }
            let spreads = left == 0 && clamped(&passes) > before;
            let mut clamping = Clamping { parts: passes.parts, targets: passes.targets };
            if !elsewhere.go_on(spreads, &mut clamping) {
                break;
            }
            // evaluating a row again changes nothing
            passes.look_at(|at, _, _| if bodies.rest(at) { 0 } else { first(count, at) });
            left = elsewhere.rounds();
        }
        let moved = parts.iter().map(|part| part.moved.count_ones() as usize).sum();
        let note = |part_rows: Range<usize>, parts: &mut [RowRange]| {
            for (first, part) in part_rows.step_by(WORD).zip(parts) {
                for row in rows(first / WORD, part.moved) {
                    part.changed &= !bit(row);
                    part.changed |= u64::from(differs(row, bodies, desired(row), targets[row])) * bit(row);
                }
            }
        };
        parallel::ranges_if_busy(Words(parts), moved, scratch, |_, rows, Words(parts)| note(rows, parts));
        for (at, part) in (0..).zip(parts) {
            report.changed += (part.changed & first(own, at)).count_ones() as usize;
            report.clamped += (part.clamped & first(own, at)).count_ones() as usize;
        }
        report
    }

    /// Returns the rows with targets that a pass changed in the last step.
    pub(crate) fn moved_rows(&self) -> impl Iterator<Item = usize> {
        (0..).zip(&self.parts).flat_map(|(part, of)| rows(part, of.moved))
    }

    /// Returns the rows among 64 with targets that a pass changed in the last step, one bit per row.
    pub(crate) fn moved(&self, part: usize) -> u64 {
        self.parts[part].moved
    }
}

/// Computes `targets` without the guard: the desired poses, limited to each row's reach and kept out of solids. Agents
/// may overlap each other and walls.
pub(crate) fn unguarded(
    bodies: &GuardedBodies<'_>,
    desired: impl Fn(usize) -> BodyPose + Sync,
    targets: &mut Vec<BodyPose>,
) {
    targets.resize(bodies.positions.len(), BodyPose::default());
    parallel::ranges(&mut targets[..], |rows, targets| {
        for (row, target) in rows.zip(targets) {
            *target = bodies.solids.lead(row, bodies, within_reach(row, bodies, desired(row)));
        }
    });
}

/// Computes the targets as [`unguarded`] does, but only of rows near a solid. Other targets stay unchanged.
pub(crate) fn led(bodies: &GuardedBodies<'_>, desired: impl Fn(usize) -> BodyPose + Sync, targets: &mut Vec<BodyPose>) {
    targets.resize(bodies.positions.len(), BodyPose::default());
    parallel::ranges(&mut targets[..], |all, targets| {
        for row in all.clone().step_by(WORD).flat_map(|first| rows(first / WORD, bodies.solids.near(first / WORD))) {
            targets[row - all.start] = bodies.solids.lead(row, bodies, within_reach(row, bodies, desired(row)));
        }
    });
}

/// The state of all rows, and their targets.
struct Passes<'a> {
    contacts: &'a Contacts,
    parts: &'a mut [RowRange],
    waiting: &'a mut [Waiting],
    /// The waiting rows in no particular order, if `is_listed`.
    listed: &'a mut Vec<u32>,
    is_listed: bool,
    scratch: &'a mut Vec<CertifyScratch>,
    targets: &'a mut [BodyPose],
}

impl Passes<'_> {
    /// Adds to the next pass the rows that `select` returns for each part.
    fn look_at(&mut self, select: impl Fn(usize, &RowRange, &[BodyPose]) -> u64 + Sync) {
        self.is_listed = false;
        let targets = &*self.targets;
        parallel::ranges((Words(self.parts), Words(self.waiting)), |rows, (Words(parts), Words(waiting))| {
            for ((first, part), waiting) in rows.step_by(WORD).zip(parts).zip(waiting) {
                *waiting.0.get_mut() |= select(first / WORD, part, targets);
            }
        });
    }

    /// Evaluates all waiting rows and applies the new poses that `target` returns. If the target of a row changed, the
    /// row and the rows that it could touch wait for the next pass. Returns the number of rows with a new pose,
    /// including poses equal to the old ones.
    fn run(
        &mut self,
        target: impl Fn(&mut RowRange, &mut CertifyScratch, usize, &[BodyPose]) -> Option<BodyPose> + Sync,
    ) -> usize {
        if self.list() {
            return self.run_listed(target);
        }
        let Self { contacts, parts, waiting, scratch, targets, .. } = self;
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
        // the work is divided as before, so each range finds its buffers
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

    /// Lists the waiting rows if they are few. Returns whether they are.
    fn list(&mut self) -> bool {
        if !self.is_listed {
            self.listed.clear();
            for (part, waiting) in (0..).zip(&mut *self.waiting) {
                self.listed.extend(rows(part, *waiting.0.get_mut()).map(|row| row as u32));
                if self.listed.len() > FEW {
                    break;
                }
            }
        }
        self.is_listed = self.listed.len() <= FEW;
        self.is_listed
    }

    /// As [`run`](Self::run), on this thread. It visits listed rows only.
    fn run_listed(
        &mut self,
        target: impl Fn(&mut RowRange, &mut CertifyScratch, usize, &[BodyPose]) -> Option<BodyPose>,
    ) -> usize {
        let Self { contacts, parts, waiting, listed, scratch, targets, .. } = self;
        if scratch.is_empty() {
            scratch.push(CertifyScratch::default());
        }
        let scratch = &mut scratch[0];
        scratch.targets.clear();
        scratch.rows.clear();
        for row in listed.drain(..) {
            let at = row as usize;
            *waiting[at / WORD].0.get_mut() &= !bit(at);
            let part = &mut parts[at / WORD];
            part.seen |= bit(at);
            if let Some(pose) = target(part, scratch, at, targets) {
                scratch.rows.push(row);
                scratch.targets.push(pose);
            }
        }
        for (&row, &pose) in scratch.rows.iter().zip(&scratch.targets) {
            let at = row as usize;
            if targets[at] != pose {
                parts[at / WORD].moved |= bit(at);
                for &row in [row].iter().chain(contacts.of(at)) {
                    let (at, waiting) = (row as usize, waiting[row as usize / WORD].0.get_mut());
                    if *waiting & bit(at) == 0 {
                        *waiting |= bit(at);
                        listed.push(row);
                    }
                }
            }
            targets[at] = pose;
        }
        scratch.rows.len()
    }
}

/// Returns the bit of a row in the sets of its part.
#[inline]
fn bit(row: usize) -> u64 {
    1 << (row % WORD)
}

/// Returns those of the rows of a part that are among the first `count` of all rows.
#[inline]
fn first(count: usize, part: usize) -> u64 {
    match count.saturating_sub(part * WORD) {
        0 => 0,
        rows => u64::MAX >> (WORD - rows.min(WORD)),
    }
}

/// Returns the rows of a set in ascending order.
fn rows(part: usize, set: u64) -> impl Iterator<Item = usize> {
    ones(set).map(move |at| part * WORD + at)
}

/// Returns the desired pose of a row, limited to the row's reach in a step. A position that is not finite leaves the
/// body at its place. The heading of a disc stays unchanged.
#[inline]
pub(crate) fn within_reach(row: usize, bodies: &GuardedBodies<'_>, desired: BodyPose) -> BodyPose {
    let (from, to, reach) = (bodies.place(row), desired.place(), bodies.reach[row]);
    let motion = to - from;
    let place = if motion.length_squared() <= reach * reach {
        from + motion
    } else if to.is_finite() {
        from + motion.clamp_length_max(reach)
    } else {
        from
    };
    let turns = !bodies.is_disc(row) && desired.heading.is_finite();
    let heading = if turns { desired.heading } else { bodies.headings[row] };
    BodyPose { heading, ..desired }.with_place(place)
}

/// Whether a target is off the desired pose by more than 1 % of the displacement, or of a thousandth of the radius.
#[inline]
fn differs(row: usize, bodies: &GuardedBodies<'_>, desired: BodyPose, target: BodyPose) -> bool {
    let turned = !bodies.is_disc(row) && desired.heading != target.heading;
    // most targets equal the desired poses
    turned || desired.place() != target.place() && is_off(row, bodies, desired.place(), target.place())
}

#[cold]
fn is_off(row: usize, bodies: &GuardedBodies<'_>, desired: Vec3, target: Vec3) -> bool {
    let tolerance = desired.distance(bodies.place(row)).max(1e-3 * bodies.radii[row]) * 1e-2;
    !desired.is_finite() || desired.distance(target) > tolerance
}

//! Solids: surfaces in space that nobody of a group gets into.
//!
//! A body counts as the ball about its centre that holds it at any heading. What is needed of a surface is how much
//! [room](Barrier::room) it leaves at a point and what a ball [touches](Surface::sweep) on its way; `guard/mod.rs`, 5, says
//! why that is enough.

use super::relax::{SKIN, clearance};
use super::{Bodies, Pose};
use crate::agent::{Column, GroupId};
use crate::parallel::{self, WORD, Words};
use crate::space::surface::{Barrier, Room, Surface, Sweep, rounding};
use glam::Vec3;
use std::ops::Range;
use std::sync::Arc;

/// A surface and its free side.
type Side = Barrier<Arc<dyn Surface>>;

/// What nobody of a group gets into, by group, and who is near it in this step.
///
/// ```
/// use glam::Vec3;
/// use throng::guard::Solids;
/// use throng::space::surface::{SeenFrom, Sphere};
/// use throng::steer::Barriers;
///
/// let mut solids = Solids::default();
/// solids.add(Barriers::default().with(Sphere::new(Vec3::ZERO, 1.0)?, SeenFrom::Outside).0);
/// assert!(!solids.is_near(0), "nobody was looked for");
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Solids {
    groups: Vec<Vec<Side>>,
    /// Of every row.
    known: Vec<Known>,
    /// Who can touch a solid in this step, a bit each; nothing where no group has one.
    near: Vec<u64>,
}

/// The room that a group's solids leave at a place. It stays true whoever is in the row: who is not far from there needs no
/// other look.
#[derive(Clone, Copy, Debug, Default)]
struct Known {
    place: Vec3,
    room: f32,
    /// Group, counted from 1; 0: nothing is known.
    group: u32,
}

/// How often a motion that is blocked is turned along what blocks it.
const SLIDES: usize = 4;
/// Parts of the way to what blocks a motion that are tried.
const SHORT: [f32; 3] = [0.999, 0.9, 0.5];
/// A slope up which nobody on the ground is pushed: the least part of a normal along the ground.
const STEEP: f32 = 0.25;

impl Solids {
    /// Adds the solids of the next group, each with the side where its agents may be; none leave all of space to them.
    pub fn add(&mut self, sides: Vec<Side>) {
        self.groups.push(sides);
    }

    /// Gives a group that was added other solids.
    pub fn set(&mut self, group: usize, sides: Vec<Side>) {
        self.groups[group] = sides;
        // what room they left is known of the former ones
        self.known.clear();
    }

    /// Finds out who can touch a solid in the step that begins. `group` tells whose solids count for a row.
    pub fn find(&mut self, bodies: &Bodies<'_>, group: &Column<GroupId>) {
        self.near.clear();
        let Self { groups, known, near } = self;
        if groups.iter().all(Vec::is_empty) {
            return;
        }
        let count = bodies.positions.len();
        known.resize(count, Known::default());
        near.resize(count.div_ceil(WORD), 0);
        let groups = &groups[..];
        parallel::ranges((Words(near), &mut known[..]), |rows, (Words(near), known)| {
            for ((first, near), known) in rows.step_by(WORD).zip(near).zip(known.chunks_mut(WORD)) {
                for (at, known) in known.iter_mut().enumerate() {
                    let (row, index) = (first + at, group[first + at].index());
                    let Some(sides) = groups.get(index).filter(|sides| !sides.is_empty()) else { continue };
                    let matters = bodies.bound(row) * (1.0 + SKIN as f32) + bodies.reach[row];
                    *near |= u64::from(known.room(bodies.place(row), index, sides, matters) < matters) << at;
                }
            }
        });
    }

    /// Whether a row can touch a solid in this step.
    #[inline]
    pub fn is_near(&self, row: usize) -> bool {
        self.near(row / WORD) >> (row % WORD) & 1 == 1
    }

    /// Whether any group has one, so that somebody may be near it.
    pub(crate) fn are_near(&self) -> bool {
        !self.near.is_empty()
    }

    /// Those of 64 rows that can touch a solid, a bit each.
    #[inline]
    pub(crate) fn near(&self, part: usize) -> u64 {
        self.near.get(part).copied().unwrap_or(0)
    }

    /// Those of a vector of rows that can touch a solid, a bit each.
    #[inline]
    pub(crate) fn near_of(&self, rows: Range<usize>) -> u64 {
        // rows of a vector are in one word
        let from_first = self.near(rows.start / WORD) >> (rows.start % WORD);
        from_first & (u64::MAX >> (WORD - rows.len().clamp(1, WORD)))
    }

    /// The solids that a row can touch.
    #[inline]
    fn sides(&self, row: usize) -> &[Side] {
        if self.is_near(row) { &self.groups[self.known[row].group as usize - 1] } else { &[] }
    }

    /// The room that its solids leave at a place to a row that can touch one.
    pub(crate) fn room(&self, row: usize, place: Vec3) -> f32 {
        least_room(self.sides(row), place)
    }

    /// Whether the motion of a row to a target is safe with all solids.
    pub(super) fn is_safe(&self, row: usize, bodies: &Bodies<'_>, target: Pose) -> bool {
        let sides = self.sides(row);
        sides.is_empty() || Way::of(row, bodies, target).block(sides, target.place()).is_none()
    }

    /// The target, or where that leads without getting into a solid: along it, or up to it, or away from one that it is in.
    #[inline]
    pub(super) fn lead(&self, row: usize, bodies: &Bodies<'_>, target: Pose) -> Pose {
        let sides = self.sides(row);
        if sides.is_empty() {
            return target;
        }
        target.with_place(Way::of(row, bodies, target).lead(sides, target.place()))
    }
}

impl Known {
    /// The room at a place, or less of which no more than what `matters` is sure.
    fn room(&mut self, place: Vec3, group: usize, sides: &[Side], matters: f32) -> f32 {
        let group = group as u32 + 1;
        let surely = self.room - self.place.distance(place) - 2.0 * rounding(place).max(rounding(self.place));
        if self.group == group && surely >= matters {
            return surely;
        }
        *self = Self { place, room: least_room(sides, place), group };
        self.room - rounding(place)
    }
}

fn least_room(sides: &[Side], place: Vec3) -> f32 {
    sides.iter().map(|side| side.room(place).distance).fold(f32::INFINITY, f32::min)
}

/// The motion of a ball in a step.
#[derive(Clone, Copy)]
struct Way {
    from: Vec3,
    radius: f32,
    /// How far it goes at most.
    reach: f32,
    /// Whether it stays on the ground.
    is_flat: bool,
}

/// What blocks a motion: where the ball is then, and which way is out.
#[derive(Clone, Copy)]
struct Block {
    distance: f32,
    out: Vec3,
}

impl Way {
    fn of(row: usize, bodies: &Bodies<'_>, target: Pose) -> Self {
        let is_flat = bodies.altitudes[row] == 0.0 && target.altitude == 0.0;
        Self { from: bodies.place(row), radius: bodies.bound(row), reach: bodies.reach[row], is_flat }
    }

    /// A place where the ball may go straight to, near to a goal.
    fn lead(&self, sides: &[Side], goal: Vec3) -> Vec3 {
        let mut goal = goal;
        let mut first = None;
        for _ in 0..SLIDES {
            goal = self.pushed(sides, goal);
            let Some(block) = self.block(sides, goal) else { return goal };
            first.get_or_insert((goal, block.distance));
            let touching = self.from + (goal - self.from).normalize_or_zero() * block.distance;
            let (rest, out) = (goal - touching, self.out(block.out));
            goal = self.on_ground(touching + (rest - out * rest.dot(out).min(0.0)));
        }
        let Some((goal, distance)) = first else { return self.from };
        let direction = (goal - self.from).normalize_or_zero();
        let short = SHORT.map(|part| self.on_ground(self.from + direction * (distance * part)));
        let mut places = short.into_iter().chain([self.pushed(sides, self.from)]);
        places.find(|&place| place != self.from && self.block(sides, place).is_none()).unwrap_or(self.from)
    }

    /// A goal, pushed out of what the ball would overlap there.
    fn pushed(&self, sides: &[Side], goal: Vec3) -> Vec3 {
        let mut pushed = goal;
        for side in sides {
            let Room { distance, out } = side.room(pushed);
            let most = self.radius * (1.0 + SKIN as f32);
            if distance < most {
                let here = side.room(self.from).distance;
                let clearance = clearance(here.into(), self.radius.into(), self.reach.into()) as f32;
                let along = self.out(out);
                // up a slope it takes more
                let rise = along.dot(out).max(STEEP);
                pushed += along * ((clearance - distance).max(0.0) / rise);
            }
        }
        if pushed == goal {
            goal
        } else {
            self.on_ground(self.from + (pushed - self.from).clamp_length_max(self.reach))
        }
    }

    /// The way out for it, as a unit vector; none where it cannot go that way.
    fn out(&self, out: Vec3) -> Vec3 {
        if self.is_flat { out.with_z(0.0).normalize_or_zero() } else { out }
    }

    /// A place, or the one on the ground if that is below it, or if the ball stays there.
    fn on_ground(&self, place: Vec3) -> Vec3 {
        place.with_z(if self.is_flat { self.from.z } else { place.z.max(0.0) })
    }

    /// What the ball touches first on its way to a place, or would be in there; none if the way is safe.
    fn block(&self, sides: &[Side], to: Vec3) -> Option<Block> {
        let length = self.from.distance(to);
        if to == self.from {
            return None;
        }
        let blocks = sides.iter().filter_map(|side| self.block_of(side, to, length));
        blocks.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    fn block_of(&self, side: &Side, to: Vec3, length: f32) -> Option<Block> {
        let here = side.room(self.from);
        let needed = self.radius.min(here.distance);
        let slack = rounding(self.from).max(rounding(to));
        let spare = here.distance - needed;
        if spare >= length + slack {
            return None;
        }
        let there = side.room(to);
        let ends_well = there.distance >= needed;
        // whose centre is where it must not be is held to where it ends
        if ends_well && (needed <= 0.0 || spare + (there.distance - needed) >= length + slack) {
            return None;
        }
        if needed <= 0.0 {
            return Some(Block { distance: 0.0, out: here.out });
        }
        let direction = (to - self.from) / length;
        let hit = side.surface.sweep(&Sweep { origin: self.from, direction, radius: needed, reach: length });
        match hit {
            Some(hit) => {
                // away from what it touches, whatever side that has
                let away = self.from + direction * hit.distance - hit.point;
                Some(Block { distance: hit.distance, out: away.normalize_or(here.out) })
            }
            None => (!ends_well).then_some(Block { distance: length, out: there.out }),
        }
    }
}

//! Solids: surfaces in space that the agents of a group cannot enter.
//!
//! A body counts as the ball about its centre that holds it at any heading. A surface must provide the
//! [clearance](Barrier::room) at a point and what a ball [touches](Surface::sweep) along a line. Section 5 of
//! `guard/mod.rs` shows why that is enough.

use super::relax::{SKIN, clearance};
use super::{BodyPose, GuardedBodies};
use crate::agent::{Column, GroupId};
use crate::parallel::{self, WORD, Words};
use crate::space::surface::{Barrier, BarrierClearance, Surface, Sweep, rounding};
use glam::Vec3;
use std::ops::Range;
use std::sync::Arc;

/// A surface and its free side.
type SurfaceSide = Barrier<Arc<dyn Surface>>;

/// The solids of each group, and the rows that are near a solid in this step.
///
/// ```
/// use glam::Vec3;
/// use throng::guard::Solids;
/// use throng::space::surface::{SeenFrom, Sphere};
/// use throng::steer::Barriers;
///
/// let mut solids = Solids::default();
/// solids.add(Barriers::default().with(Sphere::new(Vec3::ZERO, 1.0)?, SeenFrom::Outside).0);
/// assert!(!solids.is_near(0), "`find` was not called yet");
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Solids {
    groups: Vec<Vec<SurfaceSide>>,
    /// The known clearance of every row.
    known: Vec<KnownClearance>,
    /// Rows that can touch a solid in this step, one bit per row; empty if no group has a solid.
    near: Vec<u64>,
}

/// The clearance that a group's solids leave at a place. The value does not depend on which agent is in the row. A row
/// near that place needs no new query.
#[derive(Clone, Copy, Debug, Default)]
struct KnownClearance {
    place: Vec3,
    room: f32,
    /// Index of the group plus 1; 0 if nothing is known.
    group: u32,
}

/// How often a blocked motion is redirected along the surface that blocks it.
const SLIDES: usize = 4;
/// Fractions of the distance to the blocking surface that are tried.
const SHORT: [f32; 3] = [0.999, 0.9, 0.5];
/// Least horizontal component of a normal that is used to push a body on the ground out of a slope.
const STEEP: f32 = 0.25;

impl Solids {
    /// Adds the solids of the next group, each with the side on which the group's agents may be. An empty list leaves
    /// all of space free.
    pub fn add(&mut self, sides: Vec<SurfaceSide>) {
        self.groups.push(sides);
    }

    /// Replaces the solids of a group.
    pub fn set(&mut self, group: usize, sides: Vec<SurfaceSide>) {
        self.groups[group] = sides;
        // the known clearances belong to the former solids
        self.known.clear();
    }

    /// Finds the rows that can touch a solid in the step that begins. `group` is the group of each row.
    pub fn find(&mut self, bodies: &GuardedBodies<'_>, group: &Column<GroupId>) {
        self.near.clear();
        let Self { groups, known, near } = self;
        if groups.iter().all(Vec::is_empty) {
            return;
        }
        let count = bodies.positions.len();
        known.resize(count, KnownClearance::default());
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

    /// Whether any group has a solid, so that a row may be near one.
    pub(crate) fn are_near(&self) -> bool {
        !self.near.is_empty()
    }

    /// Returns the rows among 64 that can touch a solid, one bit per row.
    #[inline]
    pub(crate) fn near(&self, part: usize) -> u64 {
        self.near.get(part).copied().unwrap_or(0)
    }

    /// Returns the rows of a SIMD vector that can touch a solid, one bit per row.
    #[inline]
    pub(crate) fn near_of(&self, rows: Range<usize>) -> u64 {
        // all rows of a vector are in one word
        let from_first = self.near(rows.start / WORD) >> (rows.start % WORD);
        from_first & (u64::MAX >> (WORD - rows.len().clamp(1, WORD)))
    }

    /// Returns the solids that a row can touch.
    #[inline]
    fn sides(&self, row: usize) -> &[SurfaceSide] {
        if self.is_near(row) { &self.groups[self.known[row].group as usize - 1] } else { &[] }
    }

    /// Returns the clearance that the solids which `row` can touch leave at a place, metres.
    pub(crate) fn room(&self, row: usize, place: Vec3) -> f32 {
        least_room(self.sides(row), place)
    }

    /// Whether the solids of a group leave room for a ball at a place.
    pub(crate) fn leave_room(&self, group: GroupId, place: Vec3, radius: f32) -> bool {
        least_room(&self.groups[group.index()], place) >= radius + rounding(place)
    }

    /// Whether the motion of a row to a target is safe with all solids.
    pub(super) fn is_safe(&self, row: usize, bodies: &GuardedBodies<'_>, target: BodyPose) -> bool {
        let sides = self.sides(row);
        sides.is_empty() || BallMotion::of(row, bodies, target).block(sides, target.place()).is_none()
    }

    /// Returns the target if it is safe. Otherwise returns a pose along the surface, in front of it, or farther out of
    /// a surface that the body is in.
    #[inline]
    pub(super) fn lead(&self, row: usize, bodies: &GuardedBodies<'_>, target: BodyPose) -> BodyPose {
        let sides = self.sides(row);
        if sides.is_empty() {
            return target;
        }
        target.with_place(BallMotion::of(row, bodies, target).lead(sides, target.place()))
    }
}

impl KnownClearance {
    /// Returns the clearance at a place. A clearance of at least `matters` may be underestimated, but not below
    /// `matters`.
    fn room(&mut self, place: Vec3, group: usize, sides: &[SurfaceSide], matters: f32) -> f32 {
        let group = group as u32 + 1;
        let surely = self.room - self.place.distance(place) - 2.0 * rounding(place).max(rounding(self.place));
        if self.group == group && surely >= matters {
            return surely;
        }
        *self = Self { place, room: least_room(sides, place), group };
        self.room - rounding(place)
    }
}

fn least_room(sides: &[SurfaceSide], place: Vec3) -> f32 {
    sides.iter().map(|side| side.room(place).distance).fold(f32::INFINITY, f32::min)
}

/// The motion of a ball in a step.
#[derive(Clone, Copy)]
struct BallMotion {
    from: Vec3,
    radius: f32,
    /// Greatest length of the motion.
    reach: f32,
    /// Whether the ball stays on the ground.
    is_flat: bool,
}

/// The first contact of a motion: the distance until then, and the direction out of the surface.
#[derive(Clone, Copy)]
struct Blocking {
    distance: f32,
    out: Vec3,
}

impl BallMotion {
    fn of(row: usize, bodies: &GuardedBodies<'_>, target: BodyPose) -> Self {
        let is_flat = bodies.altitudes[row] == 0.0 && target.altitude == 0.0;
        Self { from: bodies.place(row), radius: bodies.bound(row), reach: bodies.reach[row], is_flat }
    }

    /// Returns a place near `goal` that the ball may move to in a straight line.
    fn lead(&self, sides: &[SurfaceSide], goal: Vec3) -> Vec3 {
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

    /// Returns the goal, pushed out of the surfaces that the ball would overlap there.
    fn pushed(&self, sides: &[SurfaceSide], goal: Vec3) -> Vec3 {
        let mut pushed = goal;
        for side in sides {
            let BarrierClearance { distance, out } = side.room(pushed);
            let most = self.radius * (1.0 + SKIN as f32);
            if distance < most {
                let here = side.room(self.from).distance;
                let clearance = clearance(here.into(), self.radius.into(), self.reach.into()) as f32;
                let along = self.out(out);
                // on a slope the horizontal push must be longer
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

    /// Returns the direction out as a unit vector, in the plane for a ball on the ground; zero if that has no component
    /// in the plane.
    fn out(&self, out: Vec3) -> Vec3 {
        if self.is_flat { out.with_z(0.0).normalize_or_zero() } else { out }
    }

    /// Returns the place, at least on the ground. A ball that stays on the ground keeps its height.
    fn on_ground(&self, place: Vec3) -> Vec3 {
        place.with_z(if self.is_flat { self.from.z } else { place.z.max(0.0) })
    }

    /// Returns what the ball touches first on its straight way to a place, or overlaps there; `None` if the way is
    /// safe.
    fn block(&self, sides: &[SurfaceSide], to: Vec3) -> Option<Blocking> {
        let length = self.from.distance(to);
        if to == self.from {
            return None;
        }
        let blocks = sides.iter().filter_map(|side| self.block_of(side, to, length));
        blocks.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    fn block_of(&self, side: &SurfaceSide, to: Vec3, length: f32) -> Option<Blocking> {
        let here = side.room(self.from);
        let needed = self.radius.min(here.distance);
        let slack = rounding(self.from).max(rounding(to));
        let spare = here.distance - needed;
        if spare >= length + slack {
            return None;
        }
        let there = side.room(to);
        let ends_well = there.distance >= needed;
        // a ball with its centre on the wrong side is judged by its end only
        if ends_well && (needed <= 0.0 || spare + (there.distance - needed) >= length + slack) {
            return None;
        }
        if needed <= 0.0 {
            return Some(Blocking { distance: 0.0, out: here.out });
        }
        let direction = (to - self.from) / length;
        let hit = side.surface.sweep(&Sweep { origin: self.from, direction, radius: needed, reach: length });
        match hit {
            Some(hit) => {
                // away from the touched point, whichever side the surface has there
                let away = self.from + direction * hit.distance - hit.point;
                Some(Blocking { distance: hit.distance, out: away.normalize_or(here.out) })
            }
            None => (!ends_well).then_some(Blocking { distance: length, out: there.out }),
        }
    }
}

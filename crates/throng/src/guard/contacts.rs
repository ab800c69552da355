//! Contacts: for each body a complete list of the bodies and walls that it could touch in this step.

use super::GuardedBodies;
use super::lists::{ContactLists, Reports};
use super::sizes::{BodySizes, CommonBody};
use crate::parallel::WORD;
use crate::perceive::{CellLattice, Grid, Near};
use crate::simd::ones;
use crate::space::{NearWalls, Walls};
use glam::Vec3;

/// The bodies and walls within the reach of each body. Two bodies that are both in a pile are not in each other's
/// lists, so the cost of a step is linear in the number of bodies even if all of them start at one point.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    others: ContactLists<Vec<Near>>,
    /// Per row: nothing, or the number of edges, then the edges, then the discs.
    walls: ContactLists<NearWalls>,
    /// Contacts that a body does not search for itself.
    reports: Reports,
    sizes: BodySizes,
}

/// The result of an earlier neighbour search of a row, among the bodies that it collides with.
#[derive(Clone, Copy, Debug)]
pub struct RowContacts<'a> {
    /// The nearest bodies by the distance of cores, nearest first.
    pub nearest: &'a [u32],
    /// The range of the search, metres.
    pub range: f32,
    /// Whether the list holds all bodies within the range.
    pub all: bool,
}

/// Ranges are slightly larger than the sums, because squares are rounded.
pub(super) const PAD: f32 = 1.0001;

/// At most six discs of equal size can touch a disc. A body that overlaps more than six others, by more than touching,
/// is in a *pile*.
const PILE: usize = 6;
/// A body counts as overlapping another if the distance of the centres is less than its radius plus this fraction of
/// the least radius.
const DEEP: f32 = 0.8;

/// The centres of the bodies, sorted by place.
#[derive(Clone, Copy)]
pub(super) struct Centers<'a> {
    pub grid: &'a Grid,
    /// The centres in space, if all bodies are discs: a search in space has fewer candidates.
    pub space: Option<&'a CellLattice>,
}

/// The search for contacts. A body searches as far as is needed for all bodies that are not larger than the usual size
/// or than itself. The few larger bodies report their contacts to the smaller ones. `ALIKE`: all rows have the common
/// body.
#[derive(Clone, Copy)]
struct ContactSearch<'a, const ALIKE: bool> {
    bodies: &'a GuardedBodies<'a>,
    numbers: &'a [u32],
    centers: Centers<'a>,
    sizes: &'a BodySizes,
    common: CommonBody,
}

impl<const ALIKE: bool> ContactSearch<'_, ALIKE> {
    /// Whether a row has the common body.
    #[inline]
    fn is_common(&self, row: usize) -> bool {
        ALIKE || self.sizes.blocks[row / WORD].common >> (row % WORD) & 1 == 1
    }

    /// Returns how far from its centre a body can touch something in the step.
    #[inline]
    fn size(&self, row: usize) -> f32 {
        if self.is_common(row) { self.common.size } else { self.bodies.bound(row) + self.bodies.reach[row] }
    }

    /// Returns the greatest distance of the centres at which two bodies can touch. The first must not be the smaller
    /// one.
    #[inline]
    fn range(&self, a: usize, b: usize) -> f32 {
        let bodies = self.bodies;
        (bodies.bound(a) + bodies.bound(b) + bodies.reach[a] + bodies.reach[b]) * PAD
    }

    /// Calls `found` for the bodies that can touch `row` and are not larger than `limit`.
    #[inline]
    fn look(&self, row: usize, limit: f32, mut found: impl FnMut(usize)) {
        let range = (self.size(row) + limit) * (PAD * PAD);
        let mut look = |other: usize, distance_squared: f32| {
            if other != row && self.size(other) <= limit && self.touch(row, other, distance_squared) {
                found(other);
            }
        };
        let Centers { grid, space } = self.centers;
        match space {
            None => {
                grid.within(self.bodies.positions[row], range, |near| look(near.row as usize, near.distance_squared))
            }
            Some(space) => space.within(self.center(row), range, |place, offset| {
                look(space.order()[place] as usize, offset.truncate().length_squared());
            }),
        }
    }

    /// Returns the centre of a body.
    fn center(&self, row: usize) -> Vec3 {
        self.bodies.positions[row].extend(self.bodies.altitudes[row])
    }

    /// Adds the contacts of a larger body to `found`, for the smaller bodies.
    fn report_larger(&self, row: u32, meets: &impl Fn(usize, usize) -> bool, found: &mut Vec<(u32, u32)>) {
        let size = self.size(row as usize);
        self.look(row as usize, size, |other| {
            if self.size(other) < size && meets(row as usize, other) {
                found.push((other as u32, row));
            }
        });
    }

    /// Whether a body is a disc.
    #[inline]
    fn is_disc(&self, row: usize) -> bool {
        if self.is_common(row) { self.common.is_disc } else { self.bodies.is_disc(row) }
    }

    /// Adds to `found` the bodies not larger than `limit` that can touch a disc of this size, among those of an earlier
    /// search. Returns whether the search found all of them.
    ///
    /// The distance of cores is at most that of centres. So if the list of a disc holds another disc beyond a range, it
    /// holds all bodies with centres within that range.
    #[inline]
    fn take(&self, (row, size): (usize, f32), limit: f32, seen: RowContacts<'_>, found: &mut Vec<u32>) -> bool {
        let at = self.bodies.positions[row];
        let reach = (size + limit) * (PAD * PAD);
        for &other in seen.nearest {
            let distance_squared = at.distance_squared(self.bodies.positions[other as usize]);
            if distance_squared > reach * reach {
                if self.is_disc(other as usize) {
                    return true;
                }
            } else if self.touch(row, other as usize, distance_squared)
                && (ALIKE || self.sizes.largest <= limit || self.size(other as usize) <= limit)
            {
                found.push(other);
            }
        }
        seen.all && seen.range > reach
    }

    /// Whether two bodies can touch, given the squared distance of their centres in the plan.
    #[inline]
    fn touch(&self, a: usize, b: usize, distance_squared: f32) -> bool {
        if self.is_common(a) && self.is_common(b) {
            return distance_squared <= self.common.range * self.common.range;
        }
        let Self { bodies, numbers, .. } = self;
        // the order of the operands does not depend on the caller, so both rows get the same rounding
        let rank = |row: usize| (bodies.bound(row), numbers[row]);
        let range = if rank(a) < rank(b) { self.range(b, a) } else { self.range(a, b) };
        let above = if self.is_disc(a) && self.is_disc(b) { bodies.altitudes[b] - bodies.altitudes[a] } else { 0.0 };
        distance_squared + above * above <= range * range
    }

    /// Whether `row` is in a pile. `meets` is as for [`Contacts::collect`]. Only for a disc can there be an earlier
    /// search.
    #[inline]
    fn is_piled(
        &self,
        row: usize,
        meets: &impl Fn(usize, usize) -> bool,
        seen: Option<RowContacts<'_>>,
        found: &mut Vec<Near>,
    ) -> bool {
        let GuardedBodies { positions, altitudes, radii, .. } = self.bodies;
        let reach = radii[row] + DEEP * self.sizes.least_radius;
        // the earlier search decides most cases
        if let Some(RowContacts { nearest, range, all }) = seen {
            let mut deep = 0;
            for &other in nearest {
                if positions[row].distance_squared(positions[other as usize]) < reach * reach {
                    deep += 1;
                } else if deep <= PILE && self.is_disc(other as usize) {
                    return false;
                }
            }
            if deep > PILE && altitudes.uniform().is_some() {
                return true;
            }
            if deep <= PILE && all && range > reach {
                return false;
            }
        }
        let Centers { grid, space } = self.centers;
        if let Some(space) = space {
            let mut deep = 0;
            space.within(self.center(row), reach, |place, offset| {
                let other = space.order()[place] as usize;
                deep += usize::from(other != row && offset.length_squared() < reach * reach && meets(row, other));
            });
            return deep > PILE;
        }
        let overlaps = |near: &mut Near| {
            let other = near.row as usize;
            near.distance_squared += (altitudes[row] - altitudes[other]).powi(2);
            other != row && near.distance_squared < reach * reach && meets(row, other)
        };
        grid.nearest(positions[row], PILE + 1, reach, overlaps, found);
        found.len() > PILE
    }

    /// Fills the lists of all bodies that are not in a pile.
    fn fill<'s>(
        &self,
        others: &mut ContactLists<Vec<Near>>,
        reports: &Reports,
        meets: &(impl Fn(usize, usize) -> bool + Sync),
        seen: &(impl Fn(usize) -> Option<RowContacts<'s>> + Sync),
    ) {
        others.fill(
            self.bodies.positions.len(),
            |part| self.bodies.rest(part),
            |near, row, others| {
                let start = others.len();
                let seen = if self.is_disc(row) { seen(row) } else { None };
                if self.is_piled(row, meets, seen, near) {
                    return true;
                }
                let size = self.size(row);
                let limit = size.max(self.sizes.usual);
                let all = seen.is_some_and(|seen| self.take((row, size), limit, seen, others));
                if !all {
                    others.truncate(start);
                    self.look(row, limit, |other| {
                        if meets(row, other) {
                            others.push(other as u32);
                        }
                    });
                }
                others.extend(reports.to(row).iter().map(|&(_, by)| by));
                if others.len() > start + 1 {
                    others[start..].sort_unstable_by_key(|&other| self.numbers[other as usize]);
                }
                false
            },
        );
    }
}

impl Contacts {
    /// Collects all pairs that could touch, and all walls. `grid` holds the positions of the bodies. `meets` says
    /// whether two rows collide with each other; it must be symmetric. `seen` may return the nearest bodies that a row
    /// collides with, from an earlier search. It is called for discs only.
    pub fn collect<'a>(
        &mut self,
        bodies: &GuardedBodies<'_>,
        numbers: &[u32],
        grid: &Grid,
        walls: &Walls,
        meets: impl Fn(usize, usize) -> bool + Sync,
        seen: impl Fn(usize) -> Option<RowContacts<'a>> + Sync,
    ) {
        let centers = Centers { grid, space: None };
        self.collect_from((bodies, f32::INFINITY), numbers, centers, walls, meets, seen);
    }

    /// As [`collect`](Self::collect), with the centres perhaps sorted in space too, and the least radius of bodies that
    /// are not among these.
    pub(super) fn collect_from<'a>(
        &mut self,
        (bodies, least_radius): (&GuardedBodies<'_>, f32),
        numbers: &[u32],
        centers: Centers<'_>,
        walls: &Walls,
        meets: impl Fn(usize, usize) -> bool + Sync,
        seen: impl Fn(usize) -> Option<RowContacts<'a>> + Sync,
    ) {
        self.sizes.measure(bodies);
        self.sizes.least_radius = self.sizes.least_radius.min(least_radius);
        let Self { others, reports, sizes, .. } = self;
        let (sizes, common) = (&*sizes, sizes.common);
        if sizes.all_alike() {
            reports.clear();
            ContactSearch::<true> { bodies, numbers, centers, sizes, common }.fill(others, reports, &meets, &seen);
        } else {
            let search = ContactSearch::<false> { bodies, numbers, centers, sizes, common };
            reports.collect(sizes.larger.len(), |first, found| {
                sizes.larger[first..].iter().take(WORD).for_each(|&row| search.report_larger(row, &meets, found));
            });
            search.fill(others, reports, &meets, &seen);
        }
        self.report_to_piles(numbers);
        self.collect_walls(bodies, walls);
    }

    /// Adds to the lists of piled bodies the contacts found by bodies that are not in a pile.
    fn report_to_piles(&mut self, numbers: &[u32]) {
        let others = &self.others;
        if !others.any_marked() {
            return;
        }
        self.reports.collect(numbers.len(), |first, found| {
            for row in ones(others.some(first / WORD)).map(|at| first + at) {
                let piled = others.of(row).iter().filter(|&&other| others.is_marked(other as usize));
                found.extend(piled.map(|&other| (other, row as u32)));
            }
        });
        self.others.add(self.reports.all(), |other| numbers[other as usize]);
    }

    /// Collects the walls only and leaves the lists of bodies empty.
    pub fn collect_walls_only(&mut self, bodies: &GuardedBodies<'_>, walls: &Walls) {
        self.others.clear();
        self.collect_walls(bodies, walls);
    }

    fn collect_walls(&mut self, bodies: &GuardedBodies<'_>, walls: &Walls) {
        if walls.is_empty() {
            self.walls.clear();
            return;
        }
        self.walls.fill(
            bodies.positions.len(),
            |part| bodies.rest(part),
            |near, row, found| {
                let range = f64::from(bodies.bound(row) + bodies.reach[row]) * 1.0001;
                walls.near(bodies.positions[row].as_dvec2(), range, near);
                if !near.edges.is_empty() || !near.discs.is_empty() {
                    found.push(near.edges.len() as u32);
                    found.extend(near.edges.iter().chain(&near.discs).map(|&(_, index)| index));
                }
                false
            },
        );
    }

    /// Returns the rows of the bodies that `row` could touch, in the order of their numbers.
    #[inline]
    pub fn of(&self, row: usize) -> &[u32] {
        self.others.of(row)
    }

    /// Returns the wall edges that `row` could touch, nearest first.
    pub fn edges_of(&self, row: usize) -> &[u32] {
        self.walls_of(row).0
    }

    /// Returns the solid discs that `row` could touch, nearest first.
    pub fn discs_of(&self, row: usize) -> &[u32] {
        self.walls_of(row).1
    }

    fn walls_of(&self, row: usize) -> (&[u32], &[u32]) {
        match self.walls.of(row) {
            [edges, all @ ..] => all.split_at(*edges as usize),
            [] => (&[], &[]),
        }
    }

    /// Whether `row` can touch no wall.
    pub fn is_off_walls(&self, row: usize) -> bool {
        self.walls.of(row).is_empty()
    }

    /// Returns the rows among 64 that can touch a body or a wall, one bit per row.
    pub(crate) fn touching(&self, part: usize) -> u64 {
        self.others.some(part) | self.walls.some(part)
    }
}

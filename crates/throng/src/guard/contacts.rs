//! Contacts: for each body a complete list of the bodies and walls that it could touch in this step.

use super::GuardedBodies;
use super::lists::ContactLists;
use crate::perceive::{Grid, Near};
use crate::space::{NearWalls, Walls};
use std::sync::atomic::{AtomicBool, Ordering};

/// The bodies and walls within the reach of each body. Two bodies that are both in a pile are not in each other's
/// lists, so the cost of a step is linear in the number of bodies even if all of them start at one point.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    others: ContactLists<Vec<Near>>,
    /// Per row: nothing, or the number of edges, then the edges, then the discs.
    walls: ContactLists<NearWalls>,
    /// Pairs (body, body that found it): contacts that the first body does not search for itself.
    reported: Vec<(u32, u32)>,
}

/// The result of an earlier neighbour search of a row, among the bodies that it collides with.
#[derive(Clone, Copy, Debug)]
pub struct RowContacts<'a> {
    /// The nearest bodies, nearest first.
    pub nearest: &'a [u32],
    /// The range of the search, metres.
    pub range: f32,
    /// Whether the list holds all bodies within the range.
    pub all: bool,
}

/// Ranges are slightly larger than the sums, because squares are rounded.
const PAD: f32 = 1.0001;

/// At most six discs of equal size can touch a disc. A body that overlaps more than six others, by more than touching,
/// is in a *pile*.
const PILE: usize = 6;
/// A body counts as overlapping another if the distance of the centres is less than its radius plus this fraction of
/// the least radius.
const DEEP: f32 = 0.8;

/// The search for contacts. A body searches as far as is needed for all bodies that are not larger than the usual size
/// or than itself. The few larger bodies report their contacts to the smaller ones.
#[derive(Clone, Copy)]
struct ContactSearch<'a> {
    bodies: &'a GuardedBodies<'a>,
    numbers: &'a [u32],
    grid: &'a Grid,
    /// The size of all bodies and the range within which two touch, if all bodies are alike.
    alike: Option<(f32, f32)>,
    /// The least radius.
    least: f32,
}

impl<'a> ContactSearch<'a> {
    fn new(bodies: &'a GuardedBodies<'a>, numbers: &'a [u32], grid: &'a Grid) -> Self {
        let least = bodies.radii.values().iter().copied().fold(f32::INFINITY, f32::min);
        let mut search = Self { bodies, numbers, grid, alike: None, least };
        let GuardedBodies { altitudes, cores, radii, reach, positions, .. } = bodies;
        let uniform = cores.uniform().and(radii.uniform()).and(reach.uniform()).and(altitudes.uniform());
        if uniform.is_some() && !positions.is_empty() {
            search.alike = Some((search.size(0), search.range(0, 0)));
        }
        search
    }

    /// Returns how far from its centre a body can touch something in the step.
    #[inline]
    fn size(&self, row: usize) -> f32 {
        match self.alike {
            Some((size, _)) => size,
            None => self.bodies.bound(row) + self.bodies.reach[row],
        }
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
        self.grid.within(self.bodies.positions[row], range, |near| {
            let other = near.row as usize;
            if other != row && self.size(other) <= limit && self.touch(row, other, near.distance_squared) {
                found(other);
            }
        });
    }

    /// Adds to `found` the bodies that can touch `row` among those of an earlier search. Returns whether they are
    /// complete, given that every body that can touch the row is within `reach`.
    #[inline]
    fn take(&self, row: usize, reach: f32, seen: RowContacts<'_>, found: &mut Vec<u32>) -> bool {
        let at = self.bodies.positions[row];
        for &other in seen.nearest {
            let distance_squared = at.distance_squared(self.bodies.positions[other as usize]);
            if distance_squared > reach * reach {
                return true;
            }
            if self.touch(row, other as usize, distance_squared) {
                found.push(other);
            }
        }
        seen.all && seen.range > reach
    }

    /// Whether two bodies can touch, given the squared distance of their centres in the plan.
    #[inline]
    fn touch(&self, a: usize, b: usize, distance_squared: f32) -> bool {
        if let Some((_, range)) = self.alike {
            return distance_squared <= range * range;
        }
        let Self { bodies, numbers, .. } = self;
        // the order of the operands does not depend on the caller, so both rows get the same rounding
        let rank = |row: usize| (bodies.bound(row), numbers[row]);
        let range = if rank(a) < rank(b) { self.range(b, a) } else { self.range(a, b) };
        let discs = bodies.is_disc(a) && bodies.is_disc(b);
        let above = if discs { bodies.altitudes[b] - bodies.altitudes[a] } else { 0.0 };
        distance_squared + above * above <= range * range
    }

    /// Whether `row` is in a pile. `meets` is as for [`Contacts::collect`].
    fn is_piled(
        &self,
        row: usize,
        meets: &impl Fn(usize, usize) -> bool,
        seen: Option<RowContacts<'_>>,
        found: &mut Vec<Near>,
    ) -> bool {
        let GuardedBodies { positions, altitudes, radii, .. } = self.bodies;
        let reach = radii[row] + DEEP * self.least;
        // the earlier search decides most cases
        if let Some(RowContacts { nearest, range, all }) = seen {
            let is_deep = |&&other: &&u32| positions[row].distance_squared(positions[other as usize]) < reach * reach;
            let deep = nearest.iter().take(PILE + 1).take_while(is_deep).count();
            if deep > PILE && altitudes.uniform().is_some() {
                return true;
            }
            if deep < nearest.len().min(PILE + 1) || deep <= PILE && all && range > reach {
                return false;
            }
        }
        let overlaps = |near: &mut Near| {
            let other = near.row as usize;
            near.distance_squared += (altitudes[row] - altitudes[other]).powi(2);
            other != row && near.distance_squared < reach * reach && meets(row, other)
        };
        self.grid.nearest(positions[row], PILE + 1, reach, overlaps, found);
        found.len() > PILE
    }
}

impl Contacts {
    /// Collects all pairs that could touch, and all walls. `grid` holds the positions of the bodies. `meets` says
    /// whether two rows collide with each other; it must be symmetric. `seen` may return the nearest bodies that a row
    /// collides with, from an earlier search.
    pub fn collect<'a>(
        &mut self,
        bodies: &GuardedBodies<'_>,
        numbers: &[u32],
        grid: &Grid,
        walls: &Walls,
        meets: impl Fn(usize, usize) -> bool + Sync,
        seen: impl Fn(usize) -> Option<RowContacts<'a>> + Sync,
    ) {
        let search = ContactSearch::new(bodies, numbers, grid);
        let (usual, largest) = self.tell(search, &meets);
        let reported = &self.reported;
        let piles = AtomicBool::new(false);
        self.others.fill(
            bodies.positions.len(),
            |part| bodies.rest(part),
            |near, row, others| {
                let (start, seen) = (others.len(), seen(row));
                if search.is_piled(row, &meets, seen, near) {
                    piles.store(true, Ordering::Relaxed);
                    return;
                }
                let size = search.size(row);
                let reach = (size + largest) * (PAD * PAD);
                let all = seen.is_some_and(|seen| search.take(row, reach, seen, others));
                if !all {
                    others.truncate(start);
                    search.look(row, size.max(usual), |other| {
                        if meets(row, other) {
                            others.push(other as u32);
                        }
                    });
                    if !reported.is_empty() {
                        let first = reported.partition_point(|&(of, _)| of < row as u32);
                        others.extend(
                            reported[first..].iter().take_while(|&&(of, _)| of == row as u32).map(|&(_, by)| by),
                        );
                    }
                }
                if others.len() > start + 1 {
                    others[start..].sort_unstable_by_key(|&other| numbers[other as usize]);
                }
            },
        );
        if piles.into_inner() {
            self.answer(numbers);
        }
        self.collect_walls(bodies, walls);
    }

    /// Adds to the lists of piled bodies the contacts found by bodies that are not in a pile.
    fn answer(&mut self, numbers: &[u32]) {
        self.reported.clear();
        for row in 0..numbers.len() {
            let unknown = |&&other: &&u32| !self.others.of(other as usize).contains(&(row as u32));
            self.reported.extend(self.others.of(row).iter().filter(unknown).map(|&other| (other, row as u32)));
        }
        self.reported.sort_unstable();
        self.others.add(&self.reported, |other| numbers[other as usize]);
    }

    /// Collects the contacts of bodies larger than usual for the bodies that they can touch. Returns the usual size and
    /// the largest size.
    fn tell(&mut self, search: ContactSearch<'_>, meets: impl Fn(usize, usize) -> bool) -> (f32, f32) {
        self.reported.clear();
        if let Some((size, _)) = search.alike {
            return (size, size);
        }
        let rows = search.bodies.positions.len();
        let sizes = || (0..rows).map(|row| search.size(row));
        let largest = sizes().fold(0.0, f32::max);
        let twice_the_mean = (2.0 * sizes().map(f64::from).sum::<f64>() / rows as f64) as f32;
        if largest <= twice_the_mean {
            return (largest, largest);
        }
        let usual = sizes().filter(|&size| size <= twice_the_mean).fold(0.0, f32::max);
        for row in (0..rows).filter(|&row| search.size(row) > usual) {
            let size = search.size(row);
            search.look(row, size, |other| {
                if search.size(other) < size && meets(row, other) {
                    self.reported.push((other as u32, row as u32));
                }
            });
        }
        self.reported.sort_unstable();
        (usual, largest)
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

//! Who and what each body could touch in this step: a complete list.

use super::Bodies;
use super::lists::Lists;
use crate::perceive::{Grid, Near};
use crate::space::{NearWalls, Walls};
use std::sync::atomic::{AtomicBool, Ordering};

/// For each body, the others and the walls within its reach and theirs; but two who are both in a pile do not count: so a
/// step costs no more than there are bodies, however many begin in one spot.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    others: Lists<Vec<Near>>,
    /// Nothing, or the number of edges, the edges, the discs.
    walls: Lists<NearWalls>,
    /// Bodies and those that tell them of contacts they do not look for.
    told: Vec<(u32, u32)>,
}

/// What a row has seen of those whom it meets.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The nearest, nearest first.
    pub nearest: &'a [u32],
    /// Within which distance it looked.
    pub range: f32,
    /// Whether these are all that are within the range.
    pub all: bool,
}

/// Ranges are a little wider than the sums, for the rounding of squares.
const PAD: f32 = 1.0001;

/// As many discs of its size can touch a disc: who overlaps more others than this, by more than touching, is in a *pile*.
const PILE: usize = 6;
/// Part of the least radius within which, beyond its own, a centre is that tells of a pile: who is there overlaps.
const DEEP: f32 = 0.8;

/// How bodies find each other: everybody looks as far as is needed for all who are not larger than usual or than they
/// are; the few who are larger tell.
#[derive(Clone, Copy)]
struct Search<'a> {
    bodies: &'a Bodies<'a>,
    numbers: &'a [u32],
    grid: &'a Grid,
    /// Size of everybody and range within which two touch, if all are alike.
    alike: Option<(f32, f32)>,
    /// The least radius.
    least: f32,
}

impl<'a> Search<'a> {
    fn new(bodies: &'a Bodies<'a>, numbers: &'a [u32], grid: &'a Grid) -> Self {
        let least = bodies.radii.values().iter().copied().fold(f32::INFINITY, f32::min);
        let mut search = Self { bodies, numbers, grid, alike: None, least };
        let Bodies { altitudes, cores, radii, reach, positions, .. } = bodies;
        let uniform = cores.uniform().and(radii.uniform()).and(reach.uniform()).and(altitudes.uniform());
        if uniform.is_some() && !positions.is_empty() {
            search.alike = Some((search.size(0), search.range(0, 0)));
        }
        search
    }

    /// How far from its centre a body can touch something in the step.
    #[inline]
    fn size(&self, row: usize) -> f32 {
        match self.alike {
            Some((size, _)) => size,
            None => self.bodies.bound(row) + self.bodies.reach[row],
        }
    }

    /// How far the centres of two can be apart that touch, of which the first is not smaller.
    #[inline]
    fn range(&self, a: usize, b: usize) -> f32 {
        let bodies = self.bodies;
        (bodies.bound(a) + bodies.bound(b) + bodies.reach[a] + bodies.reach[b]) * PAD
    }

    /// Calls `found` for those who can touch `row` and are not larger than `limit`.
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

    /// Adds to `found` those who can touch `row` of those it has seen. Whether they are all there are, if who can touch
    /// it is within `reach`.
    #[inline]
    fn take(&self, row: usize, reach: f32, seen: Seen<'_>, found: &mut Vec<u32>) -> bool {
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

    /// Whether two can touch whose centres are this far apart in the plan.
    #[inline]
    fn touch(&self, a: usize, b: usize, distance_squared: f32) -> bool {
        if let Some((_, range)) = self.alike {
            return distance_squared <= range * range;
        }
        let Self { bodies, numbers, .. } = self;
        // rounded in the same way whoever asks
        let rank = |row: usize| (bodies.bound(row), numbers[row]);
        let range = if rank(a) < rank(b) { self.range(b, a) } else { self.range(a, b) };
        let discs = bodies.is_disc(a) && bodies.is_disc(b);
        let above = if discs { bodies.altitudes[b] - bodies.altitudes[a] } else { 0.0 };
        distance_squared + above * above <= range * range
    }

    /// Whether `row` is in a pile.
    fn is_piled(
        &self,
        row: usize,
        meets: &impl Fn(usize, usize) -> bool,
        seen: Option<Seen<'_>>,
        found: &mut Vec<Near>,
    ) -> bool {
        let Bodies { positions, altitudes, radii, .. } = self.bodies;
        let reach = radii[row] + DEEP * self.least;
        // most have seen enough to tell
        if let Some(Seen { nearest, range, all }) = seen {
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
    /// Collects all pairs that could touch, by a grid over the bodies' positions, and all walls. `meets` tells
    /// whether two rows are solid to each other, the same whichever comes first. `seen` may know the nearest of all
    /// whom a row meets.
    pub fn collect<'a>(
        &mut self,
        bodies: &Bodies<'_>,
        numbers: &[u32],
        grid: &Grid,
        walls: &Walls,
        meets: impl Fn(usize, usize) -> bool + Sync,
        seen: impl Fn(usize) -> Option<Seen<'a>> + Sync,
    ) {
        let search = Search::new(bodies, numbers, grid);
        let (usual, largest) = self.tell(search, &meets);
        let told = &self.told;
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
                    if !told.is_empty() {
                        let first = told.partition_point(|&(of, _)| of < row as u32);
                        others.extend(told[first..].iter().take_while(|&&(of, _)| of == row as u32).map(|&(_, by)| by));
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

    /// Has everybody in a pile know those who know them: who are not in a pile.
    fn answer(&mut self, numbers: &[u32]) {
        self.told.clear();
        for row in 0..numbers.len() {
            let unknown = |&&other: &&u32| !self.others.of(other as usize).contains(&(row as u32));
            self.told.extend(self.others.of(row).iter().filter(unknown).map(|&other| (other, row as u32)));
        }
        self.told.sort_unstable();
        self.others.add(&self.told, |other| numbers[other as usize]);
    }

    /// Has those who are larger than usual tell those whom they can touch; gives the usual size, and the largest.
    fn tell(&mut self, search: Search<'_>, meets: impl Fn(usize, usize) -> bool) -> (f32, f32) {
        self.told.clear();
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
                    self.told.push((other as u32, row as u32));
                }
            });
        }
        self.told.sort_unstable();
        (usual, largest)
    }

    /// Collects the walls only: nobody is known to touch another.
    pub fn collect_walls_only(&mut self, bodies: &Bodies<'_>, walls: &Walls) {
        self.others.clear();
        self.collect_walls(bodies, walls);
    }

    fn collect_walls(&mut self, bodies: &Bodies<'_>, walls: &Walls) {
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

    /// Rows of the bodies that `row` could touch, in the order of their numbers.
    #[inline]
    pub fn of(&self, row: usize) -> &[u32] {
        self.others.of(row)
    }

    /// Wall edges that `row` could touch, nearest first.
    pub fn edges_of(&self, row: usize) -> &[u32] {
        self.walls_of(row).0
    }

    /// Solid discs that `row` could touch, nearest first.
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

    /// Those of 64 rows that can touch anybody or any wall, a bit each.
    pub(crate) fn touching(&self, part: usize) -> u64 {
        self.others.some(part) | self.walls.some(part)
    }
}

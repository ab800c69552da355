//! Division of the ground by straight cuts.

use glam::Vec2;
use std::collections::BTreeMap;

/// A division of the ground among worlds by straight cuts along the axes: recursive bisection. A [`Halo`](super::Halo)
/// answers [`owner`](super::Halo::owner) and [`near`](super::Halo::near) with it.
///
/// ```
/// use throng::halo::Cuts;
/// // the ground below x = 3 m is the first world's, the rest is cut at y = 1 m
/// let cuts = Cuts::cut(0, 3.0, Cuts::default(), Cuts::cut(1, 1.0, Cuts::default(), Cuts::default()));
/// assert_eq!(cuts.worlds(), 3);
/// assert_eq!([[0.0, 9.0], [3.0, 0.0], [3.0, 1.0]].map(|place| cuts.owner(place.into())), [0, 1, 2]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cuts(Ground);

/// A part of the ground.
#[derive(Clone, Debug, PartialEq)]
enum Ground {
    World(usize),
    Cut { axis: usize, at: f32, below: Box<Self>, above: Box<Self> },
}

impl Default for Cuts {
    /// One world owns all ground.
    fn default() -> Self {
        Self(Ground::World(0))
    }
}

impl Cuts {
    /// Returns two divisions joined by a cut across an axis, 0 for x and 1 for y. The worlds of `below` come first.
    ///
    /// # Panics
    /// If there is no such axis.
    pub fn cut(axis: usize, at: f32, below: Self, above: Self) -> Self {
        assert!(axis < 2, "there is no axis {axis} on the ground");
        let first = below.worlds();
        Self(Ground::Cut { axis, at, below: Box::new(below.0), above: Box::new(above.0.shifted(first)) })
    }

    /// Returns cuts that give each of the worlds about the same load.
    ///
    /// # Panics
    /// If there are no worlds.
    pub fn balanced(worlds: usize, load: &Load) -> Self {
        assert!(worlds > 0, "a division has at least one world");
        let cells: Vec<Cell> = load.cells.iter().map(|(&cell, &load)| ([cell % ACROSS, cell / ACROSS], load)).collect();
        bisect(worlds, cells, &|axis, cell| load.low[axis] + load.side * cell as f32)
    }

    /// Returns the number of worlds.
    pub fn worlds(&self) -> usize {
        self.0.worlds()
    }

    /// Returns the index of the world that owns a place.
    pub fn owner(&self, place: Vec2) -> usize {
        self.0.owner(place)
    }

    /// Calls `found` once for each world that owns ground within a square about a place, and so within its inscribed disc.
    /// Half of its side is `distance`.
    pub fn near(&self, place: Vec2, distance: f32, found: &mut dyn FnMut(usize)) {
        self.0.near(place, distance, found);
    }
}

impl Ground {
    fn shifted(self, by: usize) -> Self {
        match self {
            Self::World(index) => Self::World(index + by),
            Self::Cut { axis, at, below, above } => {
                Self::Cut { axis, at, below: Box::new(below.shifted(by)), above: Box::new(above.shifted(by)) }
            }
        }
    }

    fn worlds(&self) -> usize {
        match self {
            Self::World(_) => 1,
            Self::Cut { below, above, .. } => below.worlds() + above.worlds(),
        }
    }

    fn owner(&self, place: Vec2) -> usize {
        match self {
            Self::World(index) => *index,
            Self::Cut { axis, at, below, above } => if place[*axis] < *at { below } else { above }.owner(place),
        }
    }

    fn near(&self, place: Vec2, distance: f32, found: &mut dyn FnMut(usize)) {
        match self {
            Self::World(index) => found(*index),
            Self::Cut { axis, at, below, above } => {
                if place[*axis] - distance < *at {
                    below.near(place, distance, found);
                }
                if place[*axis] + distance >= *at {
                    above.near(place, distance, found);
                }
            }
        }
    }
}

/// Cells along each axis of a [`Load`].
const ACROSS: u32 = 1024;

/// A cell, by its column and row, and its load.
type Cell = ([u32; 2], u64);

/// How much there is to compute where: a load for each cell of a grid over the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    low: Vec2,
    /// Side of the cells, metres.
    side: f32,
    cells: BTreeMap<u32, u64>,
}

impl Load {
    /// Returns no load, over the box between two corners.
    pub fn within(low: Vec2, high: Vec2) -> Self {
        let size = (high - low).max_element();
        // a little more, so that the upper corner lies within
        let side = if size.is_finite() && size > 0.0 { 1.0001 * size / ACROSS as f32 } else { 1.0 };
        Self { low, side, cells: BTreeMap::new() }
    }

    /// Adds the load of an agent at a place. Places outside of the box count at its edge.
    pub fn add(&mut self, place: Vec2, load: u64) {
        let cell = ((place - self.low) / self.side).clamp(Vec2::ZERO, Vec2::splat((ACROSS - 1) as f32));
        *self.cells.entry(cell.y as u32 * ACROSS + cell.x as u32).or_default() += load;
    }

    /// Returns the loads, by cell.
    pub(super) fn cells(self) -> BTreeMap<u32, u64> {
        self.cells
    }

    /// Returns the same grid with other loads.
    pub(super) fn with(self, cells: BTreeMap<u32, u64>) -> Self {
        Self { cells, ..self }
    }
}

/// Cuts cells across their longer extent, in proportion to the numbers of worlds on both sides.
fn bisect(worlds: usize, mut cells: Vec<Cell>, border: &dyn Fn(usize, u32) -> f32) -> Cuts {
    if worlds == 1 {
        return Cuts::default();
    }
    let extent = |axis: usize| {
        let along = || cells.iter().map(|(cell, _)| cell[axis]);
        along().max().unwrap_or(0) - along().min().unwrap_or(0)
    };
    let axis = usize::from(extent(1) > extent(0));
    cells.sort_by_key(|(cell, _)| cell[axis]);
    let lower = worlds / 2;
    let all: u64 = cells.iter().map(|&(_, load)| load).sum();
    let share = (u128::from(all) * lower as u128 / worlds as u128) as u64;
    // the cut between two columns of cells that comes nearest to the share
    let (mut at, mut below, mut least) = (0, 0, share);
    let mut sum = 0;
    for (k, &(cell, load)) in cells.iter().enumerate() {
        sum += load;
        let ends = cells.get(k + 1).is_none_or(|(next, _)| next[axis] != cell[axis]);
        if ends && sum.abs_diff(share) < least {
            (at, below, least) = (cell[axis] + 1, k + 1, sum.abs_diff(share));
        }
    }
    let above = cells.split_off(below);
    let cut = border(axis, at);
    Cuts::cut(axis, cut, bisect(lower, cells, border), bisect(worlds - lower, above, border))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Compares the loads that the worlds own with equal shares.
        #[test]
        fn balanced_worlds_own_equal_loads(
            worlds in 1usize..20,
            places in proptest::collection::vec((-50.0f32..50.0, -20.0f32..20.0, 1u64..10), 2000),
        ) {
            let mut load = Load::within(Vec2::new(-50.0, -20.0), Vec2::new(50.0, 20.0));
            places.iter().for_each(|&(x, y, weight)| load.add(Vec2::new(x, y), weight));
            let cuts = Cuts::balanced(worlds, &load);
            prop_assert_eq!(cuts.worlds(), worlds);
            let mut owned = vec![0; worlds];
            places.iter().for_each(|&(x, y, weight)| owned[cuts.owner(Vec2::new(x, y))] += weight);
            let all: u64 = owned.iter().sum();
            for own in owned {
                let share = own as f64 * worlds as f64 / all as f64;
                prop_assert!((0.75..1.33).contains(&share), "{share}");
            }
        }

        /// A world with ground within a distance, found by sampling a circle, is found.
        #[test]
        fn near_finds_the_owners_around(
            xs in proptest::collection::vec(-9.0f32..9.0, 4), at in (-10.0f32..10.0, -10.0f32..10.0), distance in 0.0f32..5.0,
        ) {
            let one = Cuts::default;
            let cuts = Cuts::cut(
                0, xs[0], Cuts::cut(1, xs[1], one(), one()), Cuts::cut(1, xs[2], one(), Cuts::cut(0, xs[3], one(), one())),
            );
            let at = Vec2::from(at);
            let mut found = Vec::new();
            cuts.near(at, distance, &mut |world| found.push(world));
            for k in 0..64 {
                let place = at + 0.999 * distance * Vec2::from_angle(k as f32 * 0.0982);
                prop_assert!(found.contains(&cuts.owner(place)));
            }
            let count = found.len();
            found.dedup();
            prop_assert_eq!(found.len(), count);
        }
    }

    #[test]
    fn all_agents_at_one_place_belong_to_one_world() {
        let mut load = Load::within(Vec2::ZERO, Vec2::ZERO);
        load.add(Vec2::ZERO, 7);
        let cuts = Cuts::balanced(4, &load);
        assert_eq!(cuts.worlds(), 4);
        assert_eq!(Cuts::balanced(3, &Load::within(Vec2::INFINITY, Vec2::NEG_INFINITY)).worlds(), 3);
    }
}

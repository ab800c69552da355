//! A building of rooms along corridors, which all people leave.

use crate::{Crowd, Dice, Person};
use glam::DVec2;
use throng::{Obstacle, Walkable};

/// Size of a room, metres.
const ROOM: DVec2 = DVec2::new(8.0, 6.0);
/// People in a room: 0.5 per m2, in four rows of six.
const PEOPLE: usize = 24;
/// Width of the doors, metres.
const DOOR: f64 = 1.2;
/// Width of the corridors, metres.
const CORRIDOR: f64 = 4.0;
/// Rooms in a row between two corridors that cross the rows. The first has half as many on its left, so that a corridor
/// connects all rows of a floor with more than one pair.
const BETWEEN: usize = 4;
/// Side of the exits, metres.
const EXIT: f64 = 2.0;

/// A floor about as wide as high. A pair of rows of rooms has a corridor between them, along x. Each room has a door to
/// that corridor.
struct Floor {
    /// Rooms in a row.
    columns: usize,
    /// Pairs of rows.
    pairs: usize,
}

/// Returns people in all rooms of a building with corridors in both directions. Every end of a corridor has an exit.
/// Each person goes to the nearest exit in a straight line.
pub fn evacuation(count: usize) -> Crowd {
    let floor = Floor::of(count);
    let goals = floor.exits();
    let nearest = |p: DVec2| {
        let distance = |k: &usize| goals[*k].distance_squared(p);
        (0..goals.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let mut rng = Dice::new(15);
    let people = (0..count).map(|k| {
        let (room, place) = (k / PEOPLE, k % PEOPLE);
        let within = DVec2::new(1.0 + 1.2 * (place % 6) as f64, 1.2 + 1.2 * (place / 6) as f64);
        let position = floor.room(room) + within + rng.in_disc(0.3);
        Person { position, preferred_speed: rng.between(1.3, 1.5), way: nearest(position) }
    });
    let people = people.collect();
    let outer = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|p| DVec2::from(p) * floor.size()).to_vec();
    Crowd {
        people,
        radius: 0.2,
        ways: (0..goals.len()).map(|goal| vec![goal]).collect(),
        goals,
        exit: Some(EXIT),
        walkable: vec![Walkable { outer, holes: vec![] }],
        obstacles: floor.walls(),
        step: 0.05,
    }
}

impl Floor {
    /// Height of two rows with their corridor, metres.
    const PAIR: f64 = 2.0 * ROOM.y + CORRIDOR;

    /// Returns the floor for a number of people.
    fn of(count: usize) -> Self {
        let rooms = count.div_ceil(PEOPLE).max(1);
        let columns = (0.5 * rooms as f64 * Self::PAIR / ROOM.x).sqrt().ceil() as usize;
        Self { columns, pairs: rooms.div_ceil(2 * columns) }
    }

    /// Returns the number of corridors across the rows on the left of a column.
    fn crossings(column: usize) -> usize {
        (column + BETWEEN / 2) / BETWEEN
    }

    /// Whether a corridor is directly on the left of a column.
    fn is_beside_crossing(column: usize) -> bool {
        column > 0 && Self::crossings(column) > Self::crossings(column - 1)
    }

    /// Returns the size of the floor, metres.
    fn size(&self) -> DVec2 {
        DVec2::new(Self::left(self.columns - 1) + ROOM.x, self.pairs as f64 * Self::PAIR)
    }

    /// Returns the left end of a column.
    fn left(column: usize) -> f64 {
        column as f64 * ROOM.x + Self::crossings(column) as f64 * CORRIDOR
    }

    /// Returns the lower left corner of a room. Rooms are counted along the rows, pair by pair.
    fn room(&self, k: usize) -> DVec2 {
        let (row, column) = (k / self.columns, k % self.columns);
        let above = if row % 2 == 1 { ROOM.y + CORRIDOR } else { 0.0 };
        DVec2::new(Self::left(column), (row / 2) as f64 * Self::PAIR + above)
    }

    /// Returns the middles of the exits.
    fn exits(&self) -> Vec<DVec2> {
        let size = self.size();
        let along = (0..self.pairs).flat_map(|pair| {
            let y = (pair as f64 + 0.5) * Self::PAIR;
            [0.5 * EXIT, size.x - 0.5 * EXIT].map(|x| DVec2::new(x, y))
        });
        let across = (1..self.columns).filter(|&column| Self::is_beside_crossing(column)).flat_map(|column| {
            let x = Self::left(column) - 0.5 * CORRIDOR;
            [0.5 * EXIT, size.y - 0.5 * EXIT].map(|y| DVec2::new(x, y))
        });
        along.chain(across).collect()
    }

    /// Returns the walls between rooms and corridors.
    fn walls(&self) -> Vec<Obstacle> {
        let mut walls = Vec::new();
        let mut wall = |from: (f64, f64), to: (f64, f64)| {
            walls.push(Obstacle::Wall { points: vec![from.into(), to.into()] });
        };
        let size = self.size();
        for k in 0..2 * self.pairs * self.columns {
            let (low, row, column) = (self.room(k), k / self.columns, k % self.columns);
            let (high, middle) = (low + ROOM, low.x + 0.5 * ROOM.x);
            // the wall with the door, and the wall to the next pair of rows
            let (door, back) = if row % 2 == 0 { (high.y, low.y) } else { (low.y, high.y) };
            wall((low.x, door), (middle - 0.5 * DOOR, door));
            wall((middle + 0.5 * DOOR, door), (high.x, door));
            if row % 2 == 1 && back < size.y {
                wall((low.x, back), (high.x, back));
            }
            if Self::is_beside_crossing(column) {
                wall((low.x, low.y), (low.x, high.y));
            }
            if column + 1 < self.columns {
                wall((high.x, low.y), (high.x, high.y));
            }
        }
        walls
    }
}

//! A floor of rooms, and the same crowd in a hall without them.

use crate::{Crowd, Dice, Person};
use glam::DVec2;
use throng::{Obstacle, Walkable};

/// Size of a room, metres.
const ROOM: DVec2 = DVec2::new(5.0, 4.0);
/// Initial positions in a room: five, along its lower side.
const PLACES: usize = 5;
/// Width of a door, metres.
const DOOR: f64 = 1.2;

/// Returns a floor with a room per five pedestrians. Rooms have the same size and form a square; each has a door to
/// every adjacent room, a desk and a pillar. Every pedestrian walks to and fro between two rooms.
pub fn rooms(count: usize) -> Crowd {
    let side = side(count);
    let mut obstacles = Vec::new();
    let size = side as f64;
    // a wall with a door in the middle
    let mut wall = |from: DVec2, to: DVec2| {
        let (middle, along) = (from.midpoint(to), (to - from).normalize() * (0.5 * DOOR));
        obstacles.push(Obstacle::Wall { points: vec![from, middle - along] });
        obstacles.push(Obstacle::Wall { points: vec![middle + along, to] });
    };
    for k in 0..side * side {
        let corner = |dx: f64, dy: f64| room(k, side) + DVec2::new(dx, dy) * ROOM;
        if (k % side) as f64 + 1.0 < size {
            wall(corner(1.0, 0.0), corner(1.0, 1.0));
        }
        if (k / side) as f64 + 1.0 < size {
            wall(corner(0.0, 1.0), corner(1.0, 1.0));
        }
    }
    for k in 0..side * side {
        obstacles.push(Obstacle::rectangle(room(k, side) + DVec2::new(1.3, 3.2), DVec2::new(1.6, 0.6), 0.0));
        obstacles.push(Obstacle::Circle { center: room(k, side) + DVec2::new(4.3, 3.2), radius: 0.25 });
    }
    Crowd { obstacles, ..hall(count) }
}

/// Returns the crowd of [`rooms`], with its ways, on the same ground without walls, desks and pillars.
pub fn hall(count: usize) -> Crowd {
    let (mut rng, side) = (Dice::new(11), side(count));
    let stand = |k: usize, rng: &mut Dice| {
        let along = DVec2::new(0.7 + 0.9 * (k % PLACES) as f64, 1.2);
        room(k / PLACES % (side * side), side) + along + rng.in_disc(0.2)
    };
    let mut people = Vec::with_capacity(count);
    let mut ways = Vec::with_capacity(count);
    for k in 0..count {
        let position = stand(k, &mut rng);
        ways.push(vec![rng.below(side * side), rng.below(side * side)]);
        people.push(Person { position, preferred_speed: rng.between(1.3, 1.5), way: Some(k) });
    }
    let size = ROOM * side as f64;
    let outer = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|p| DVec2::from(p) * size).to_vec();
    Crowd {
        people,
        radius: 0.2,
        goals: (0..side * side).map(|k| room(k, side) + DVec2::new(2.5, 1.8)).collect(),
        exit: None,
        ways,
        walkable: vec![Walkable { outer, holes: vec![] }],
        obstacles: vec![],
        step: 0.05,
    }
}

/// Returns the number of rooms along a side.
fn side(count: usize) -> usize {
    (count as f64 / PLACES as f64).sqrt().ceil().max(1.0) as usize
}

/// Returns the lower left corner of a room.
fn room(k: usize, side: usize) -> DVec2 {
    DVec2::new((k % side) as f64, (k / side) as f64) * ROOM
}

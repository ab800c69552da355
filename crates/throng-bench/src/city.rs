//! The streets of a city.

use crate::crowd::square;
use crate::place::uniform_where;
use crate::{Crowd, Dice, Person};
use glam::DVec2;
use std::ops::Range;
use throng::{Obstacle, Walkable};

/// Side of the blocks of buildings, metres.
const BLOCK: f64 = 60.0;
/// Width of the streets, metres.
const STREET: f64 = 12.0;
/// Greatest density in the streets, people per square metre.
const DENSITY: f64 = 0.25;
/// Least distance from a person to its goal along x or y, blocks; half of a small city.
const NEAREST: usize = 2;
/// Greatest distance from a person to its goal along x and y, blocks.
const FARTHEST: usize = 4;
/// Radius of all people, metres.
const RADIUS: f64 = 0.25;

/// Returns people in the streets between square blocks of buildings. The blocks form the smallest square with room for
/// them, at least two by two. Each person has a goal of its own in a street, two to four blocks away.
pub fn city(count: usize) -> Crowd {
    let across = (2..).find(|&across| streets(across) * DENSITY >= count as f64).unwrap_or(2);
    let side = side(across);
    let mut rng = Dice::new(17);
    let places = uniform_where(count, side, 2.0 * RADIUS, &mut rng, |p| is_in_street(p, side));
    let [nearest, farthest] = [NEAREST.min(across / 2), FARTHEST].map(|blocks| blocks as f64 * (BLOCK + STREET));
    let mut goals = Vec::with_capacity(count);
    let mut people = Vec::with_capacity(count);
    for (k, position) in places.into_iter().enumerate() {
        goals.push(goal(position, side, nearest..farthest, &mut rng));
        people.push(Person { position, preferred_speed: rng.between(1.3, 1.5), way: Some(k) });
    }
    let block = |k: usize| {
        let corner = DVec2::new((k % across) as f64, (k / across) as f64) * (BLOCK + STREET) + STREET;
        Obstacle::Polygon { corners: square(corner + 0.5 * BLOCK, BLOCK).to_vec() }
    };
    Crowd {
        obstacles: (0..across * across).map(block).collect(),
        walkable: vec![Walkable { outer: square(DVec2::splat(0.5 * side), side).to_vec(), holes: vec![] }],
        ..Crowd::open(people, RADIUS, goals)
    }
}

/// Returns the side of a city with this number of blocks along a side, metres. Streets surround it.
fn side(across: usize) -> f64 {
    across as f64 * (BLOCK + STREET) + STREET
}

/// Returns the area of the streets, m2.
fn streets(across: usize) -> f64 {
    side(across).powi(2) - (across as f64 * BLOCK).powi(2)
}

/// Whether a person can stand at a point: it is in a street, not too near to a wall.
fn is_in_street(p: DVec2, side: f64) -> bool {
    const MARGIN: f64 = RADIUS + 0.1;
    let within = |x: f64| (x.rem_euclid(BLOCK + STREET) - 0.5 * STREET).abs() < 0.5 * STREET - MARGIN;
    let inside = |x: f64| (MARGIN..side - MARGIN).contains(&x);
    inside(p.x) && inside(p.y) && (within(p.x) || within(p.y))
}

/// Returns a random goal of a person, in this range of distances along the axis with the greater distance.
fn goal(from: DVec2, side: f64, far: Range<f64>, rng: &mut Dice) -> DVec2 {
    let [x, y] = from.to_array().map(|x| ((x - far.end).max(0.0), (x + far.end).min(side)));
    loop {
        let p = DVec2::new(rng.between(x.0, x.1), rng.between(y.0, y.1));
        if is_in_street(p, side) && far.contains(&(p - from).abs().max_element()) {
            return p;
        }
    }
}

//! Divisions of the ground.

use crate::draw::Draw;
use glam::Vec2;
use throng::halo::Cuts;

/// Cuts a box at random into this number of worlds.
pub fn random_cuts(draw: &mut Draw, worlds: usize, low: Vec2, high: Vec2) -> Cuts {
    if worlds == 1 {
        return Cuts::default();
    }
    let axis = draw.index(2);
    let at = draw.between(low[axis].into(), high[axis].into()) as f32;
    let lower = 1 + draw.index(worlds - 1);
    let (mut middle_high, mut middle_low) = (high, low);
    (middle_high[axis], middle_low[axis]) = (at, at);
    let below = random_cuts(draw, lower, low, middle_high);
    Cuts::cut(axis, at, below, random_cuts(draw, worlds - lower, middle_low, high))
}

/// Cuts across the x axis at these places.
pub fn across(places: &[f32]) -> Cuts {
    let Some((last, below)) = places.split_last() else { return Cuts::default() };
    Cuts::cut(0, *last, across(below), Cuts::default())
}

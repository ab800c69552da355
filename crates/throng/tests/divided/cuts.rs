//! Divisions of the ground.

use crate::draw::Draw;
use crate::threads::Cuts;
use glam::Vec2;

impl Cuts {
    /// Cuts a box at random into this number of worlds.
    pub fn random(draw: &mut Draw, worlds: usize, low: Vec2, high: Vec2) -> Self {
        Self::cut(draw, 0, worlds, low, high)
    }

    fn cut(draw: &mut Draw, first: usize, worlds: usize, low: Vec2, high: Vec2) -> Self {
        if worlds == 1 {
            return Self::World(first);
        }
        let axis = draw.index(2);
        let at = draw.between(low[axis].into(), high[axis].into()) as f32;
        let lower = 1 + draw.index(worlds - 1);
        let (mut middle_high, mut middle_low) = (high, low);
        (middle_high[axis], middle_low[axis]) = (at, at);
        let below = Self::cut(draw, first, lower, low, middle_high);
        let above = Self::cut(draw, first + lower, worlds - lower, middle_low, high);
        Self::Cut { axis, at, below: Box::new(below), above: Box::new(above) }
    }
}

/// Cuts across the x axis at these places.
pub fn across(places: &[f32]) -> Cuts {
    match places {
        [] => Cuts::World(0),
        [below @ .., last] => {
            Cuts::Cut { axis: 0, at: *last, below: Box::new(across(below)), above: Box::new(Cuts::World(places.len())) }
        }
    }
}

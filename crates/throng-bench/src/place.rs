//! Where people stand at the start.

use crate::Dice;
use glam::DVec2;

/// Uniformly at random in a square round the origin, so many to the square metre, no two nearer than `apart` metres:
/// places are drawn one by one, and drawn again where somebody is too near. In the order drawn, which has nothing to do with
/// where they are.
///
/// Ends only where there is room: discs of diameter `apart` may cover up to 0.4 of the ground.
pub fn uniform(count: usize, density: f64, apart: f64, dice: &mut Dice) -> Vec<DVec2> {
    let side = (count as f64 / density).sqrt();
    // cells with about one person each, at least as wide as nobody else may be
    let cell = density.sqrt().recip().max(apart);
    let across = (side / cell).ceil().max(1.0) as usize;
    const NOBODY: u32 = u32::MAX;
    // who came last into each cell, and who came before them
    let (mut last, mut before) = (vec![NOBODY; across * across], Vec::with_capacity(count));
    let mut places: Vec<DVec2> = Vec::with_capacity(count);
    while places.len() < count {
        let p = DVec2::new(dice.between(0.0, side), dice.between(0.0, side));
        let [x, y] = (p / cell).to_array().map(|x| (x as usize).min(across - 1));
        let (xs, ys) = (x.saturating_sub(1)..=(x + 1).min(across - 1), y.saturating_sub(1)..=(y + 1).min(across - 1));
        let near = |cell: usize| {
            let mut at = last[cell];
            while at != NOBODY {
                if places[at as usize].distance_squared(p) < apart * apart {
                    return true;
                }
                at = before[at as usize];
            }
            false
        };
        if ys.into_iter().any(|y| xs.clone().any(|x| near(y * across + x))) {
            continue;
        }
        before.push(last[y * across + x]);
        last[y * across + x] = places.len() as u32;
        places.push(p);
    }
    places.iter().map(|p| *p - 0.5 * side).collect()
}

/// In rows like bricks, so many to the square metre, each moved aside at random as far as keeps all `apart` metres from
/// each other. Row by row, round the origin.
pub fn bricks(count: usize, density: f64, apart: f64, dice: &mut Dice) -> Vec<DVec2> {
    let spacing = (2.0 / (3.0_f64.sqrt() * density)).sqrt();
    let free = 0.5 * (spacing - apart);
    let height = 0.75_f64.sqrt();
    // as many rows as make a square
    let across = (count as f64 * height).sqrt().ceil() as usize;
    let middle = 0.5 * DVec2::new(across as f64, (count as f64 / across as f64) * height);
    let place = |k: usize| {
        let (x, y) = (k % across, k / across);
        DVec2::new(x as f64 + 0.5 * (y % 2) as f64, y as f64 * height) - middle
    };
    (0..count).map(|k| place(k) * spacing + dice.in_disc(free)).collect()
}

/// Puts places into spatial order: by squares of 5 m, row by row.
pub fn sort(places: &mut [DVec2]) {
    places.sort_by_key(|p| {
        let square = (*p / 5.0).floor();
        (square.y as i64, square.x as i64)
    });
}

//! The initial positions of pedestrians.

use crate::Dice;
use glam::DVec2;

/// Returns uniformly random points in a square around the origin, with `density` points per square metre and at least
/// `apart` metres between them. A point that is too near to another is drawn again. The order is that of drawing,
/// independent of the positions.
///
/// Terminates only if there is room: discs of diameter `apart` may cover up to 0.4 of the ground.
pub fn uniform(count: usize, density: f64, apart: f64, rng: &mut Dice) -> Vec<DVec2> {
    let side = (count as f64 / density).sqrt();
    uniform_where(count, side, apart, rng, |_| true).iter().map(|p| *p - 0.5 * side).collect()
}

/// Returns uniformly random points where `free` returns `true`, in a square of this side from the origin on, with at
/// least `apart` metres between them. Otherwise as [`uniform`].
pub fn uniform_where(count: usize, side: f64, apart: f64, rng: &mut Dice, free: impl Fn(DVec2) -> bool) -> Vec<DVec2> {
    // cells with about one point each, at least `apart` wide
    let cell = (side / (count as f64).sqrt()).max(apart);
    let across = (side / cell).ceil().max(1.0) as usize;
    const NONE: u32 = u32::MAX;
    // the last point of each cell, and for each point the one before it in its cell
    let (mut last, mut before) = (vec![NONE; across * across], Vec::with_capacity(count));
    let mut places: Vec<DVec2> = Vec::with_capacity(count);
    while places.len() < count {
        let p = DVec2::new(rng.between(0.0, side), rng.between(0.0, side));
        let [x, y] = (p / cell).to_array().map(|x| (x as usize).min(across - 1));
        let (xs, ys) = (x.saturating_sub(1)..=(x + 1).min(across - 1), y.saturating_sub(1)..=(y + 1).min(across - 1));
        let near = |cell: usize| {
            let mut at = last[cell];
            while at != NONE {
                if places[at as usize].distance_squared(p) < apart * apart {
                    return true;
                }
                at = before[at as usize];
            }
            false
        };
        if !free(p) || ys.into_iter().any(|y| xs.clone().any(|x| near(y * across + x))) {
            continue;
        }
        before.push(last[y * across + x]);
        last[y * across + x] = places.len() as u32;
        places.push(p);
    }
    places
}

/// Returns points in rows like bricks, with `density` points per square metre, each shifted at random as far as the
/// distance `apart` allows. The order is row by row, around the origin.
pub fn bricks(count: usize, density: f64, apart: f64, rng: &mut Dice) -> Vec<DVec2> {
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
    (0..count).map(|k| place(k) * spacing + rng.in_disc(free)).collect()
}

/// Sorts points spatially: by squares of 5 m, row by row.
pub fn sort(places: &mut [DVec2]) {
    places.sort_by_key(|p| {
        let square = (*p / 5.0).floor();
        (square.y as i64, square.x as i64)
    });
}

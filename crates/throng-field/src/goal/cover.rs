//! The cells that obstacles cover.

use super::super::eikonal::NodeLattice;
use glam::DVec2;
use throng::space::{Obstacle, Place};

/// Returns, row by row, whether the centre of each cell is outside the free ground of a place. `first` is the centre of
/// the first cell. The result agrees with [`Place::blocked`] except at thin walls.
pub(super) fn solid(place: &Place, first: DVec2, lattice: &NodeLattice<2>) -> Vec<bool> {
    let mut solid = vec![!place.areas.is_empty(); lattice.len()];
    let mut ground = vec![false; lattice.len()];
    for area in &place.areas {
        ground.fill(false);
        fill(&area.outer, (first, lattice), |cell| ground[cell] = true);
        for hole in &area.holes {
            fill(hole, (first, lattice), |cell| ground[cell] = false);
        }
        solid.iter_mut().zip(&ground).for_each(|(solid, ground)| *solid &= !ground);
    }
    for obstacle in place.obstacles() {
        match obstacle {
            Obstacle::Polygon { corners } => fill(corners, (first, lattice), |cell| solid[cell] = true),
            Obstacle::Circle { center, radius } => {
                disc((*center, *radius), (first, lattice), |cell| solid[cell] = true)
            }
            // a wall has no width
            Obstacle::Wall { .. } => {}
        }
    }
    solid
}

/// Calls `inside` with every cell that has its centre in a disc.
pub(super) fn disc((center, radius): (DVec2, f64), ground: (DVec2, &NodeLattice<2>), mut inside: impl FnMut(usize)) {
    for row in rows(ground, center.y - radius, center.y + radius) {
        let away = ground.0.y + row as f64 * ground.1.cell - center.y;
        let half = (radius * radius - away * away).max(0.0).sqrt();
        span(ground, row, (center.x - half, center.x + half), &mut inside);
    }
}

/// Calls `inside` with every cell that has its centre in a polygon, by the even-odd rule: row by row, between the edges
/// that cross the row.
pub(super) fn fill(corners: &[DVec2], ground: (DVec2, &NodeLattice<2>), mut inside: impl FnMut(usize)) {
    let least = corners.iter().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
    let greatest = corners.iter().map(|corner| corner.y).fold(f64::NEG_INFINITY, f64::max);
    let rows = rows(ground, least, greatest);
    let mut crossings: Vec<(usize, f64)> = Vec::new();
    for (index, corner) in corners.iter().enumerate() {
        let before = corners[(index + corners.len() - 1) % corners.len()];
        let within = self::rows(ground, corner.y.min(before.y), corner.y.max(before.y));
        for row in within {
            let y = ground.0.y + row as f64 * ground.1.cell;
            if (corner.y > y) != (before.y > y) {
                crossings.push((row, (before.x - corner.x) * (y - corner.y) / (before.y - corner.y) + corner.x));
            }
        }
    }
    crossings.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    debug_assert!(crossings.iter().all(|crossing| rows.contains(&crossing.0)));
    for pair in crossings.chunks_exact(2) {
        span(ground, pair[0].0, (pair[0].1, pair[1].1), &mut inside);
    }
}

/// Returns the rows of cells with centres between two heights, and possibly one more.
fn rows((first, lattice): (DVec2, &NodeLattice<2>), from: f64, to: f64) -> std::ops::Range<usize> {
    let row = |y: f64| (y - first.y) / lattice.cell;
    // `as` saturates
    row(from).floor().max(0.0) as usize..((row(to).ceil() + 1.0).max(0.0) as usize).min(lattice.counts[1])
}

/// Calls `inside` with the cells of a row that have their centres between two places along x.
fn span(
    (first, lattice): (DVec2, &NodeLattice<2>),
    row: usize,
    (from, to): (f64, f64),
    inside: &mut impl FnMut(usize),
) {
    let column = |x: f64| ((x - first.x) / lattice.cell).ceil().max(0.0) as usize;
    for column in column(from)..column(to).min(lattice.counts[0]) {
        inside(row * lattice.counts[0] + column);
    }
}

/// Returns the sides between solid and free cells as walls. Sides in a straight line make one wall.
pub(super) fn outlines(low: DVec2, lattice: &NodeLattice<2>, solid: &[bool]) -> Vec<Obstacle> {
    let [columns, rows] = lattice.counts;
    let corner = |column: usize, row: usize| low + DVec2::new(column as f64, row as f64) * lattice.cell;
    let mut walls = Vec::new();
    // first the sides between rows, then the sides between columns
    let mut straight =
        |lines: usize, length: usize, ends: &dyn Fn(usize, usize) -> DVec2, parts: &dyn Fn(usize, usize) -> bool| {
            for line in 1..lines {
                let mut start = None;
                for at in 0..=length {
                    let parted = at < length && parts(line, at);
                    match start {
                        None if parted => start = Some(at),
                        Some(from) if !parted => {
                            walls.push(Obstacle::Wall { points: vec![ends(line, from), ends(line, at)] });
                            start = None;
                        }
                        _ => {}
                    }
                }
            }
        };
    straight(rows, columns, &|row, column| corner(column, row), &|row, column| {
        solid[row * columns + column] != solid[(row - 1) * columns + column]
    });
    straight(columns, rows, &|column, row| corner(column, row), &|column, row| {
        solid[row * columns + column] != solid[row * columns + column - 1]
    });
    walls
}

/// Calls `inside` with every cell that has its centre in a box.
pub(super) fn within((low, high): (DVec2, DVec2), ground: (DVec2, &NodeLattice<2>), mut inside: impl FnMut(usize)) {
    for row in rows(ground, low.y, high.y) {
        span(ground, row, (low.x, high.x), &mut inside);
    }
}

//! Finds bodies that are too near each other.

use glam::DVec3;
use std::collections::HashMap;

/// Centre, radius, number.
type PlacedDisc = (DVec3, f64, u32);

/// Bodies in square cells of the horizontal plane.
#[derive(Debug)]
pub(crate) struct Spacing {
    cell: f64,
    cells: HashMap<(i64, i64), Vec<PlacedDisc>>,
}

impl Spacing {
    /// Makes an empty index for bodies; the radii and the gap of each pair add up to at most `reach`.
    pub fn new(reach: f64) -> Self {
        Self { cell: reach.max(1e-6), cells: HashMap::new() }
    }

    fn cell_of(&self, p: DVec3) -> (i64, i64) {
        ((p.x / self.cell).floor() as i64, (p.y / self.cell).floor() as i64)
    }

    /// Returns a body nearer than `gap` (between surfaces), if any: its number and the distance between the centres.
    pub fn too_near(&self, p: DVec3, radius: f64, gap: f64) -> Option<(u32, f64)> {
        let (x, y) = self.cell_of(p);
        (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y))).find_map(|cell| {
            self.cells.get(&cell)?.iter().find_map(|(q, r, number)| {
                // Bodies within a billionth of contact touch: rounding must not make that an overlap.
                let least = (radius + r) * (1.0 - 1e-9) + gap;
                (p.distance_squared(*q) < least * least).then(|| (*number, p.distance(*q)))
            })
        })
    }

    /// Adds a body.
    pub fn add(&mut self, p: DVec3, radius: f64, number: u32) {
        let cell = self.cell_of(p);
        self.cells.entry(cell).or_default().push((p, radius, number));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_that_touch_are_not_too_near() {
        let mut spacing = Spacing::new(0.5);
        spacing.add(DVec3::ZERO, 0.2, 7);
        assert_eq!(spacing.too_near(DVec3::new(0.4, 0.0, 0.0), 0.2, 0.0), None);
        assert_eq!(spacing.too_near(DVec3::new(0.0, 0.3, 0.3), 0.2, 0.0), None);
        assert_eq!(spacing.too_near(DVec3::new(0.4, 0.0, 0.0), 0.2, 0.1).map(|found| found.0), Some(7));
        assert_eq!(spacing.too_near(DVec3::new(0.25, 0.0, 0.0), 0.2, 0.0), Some((7, 0.25)));
    }
}

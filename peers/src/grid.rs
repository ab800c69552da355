//! A plain grid, for simulators without a neighbour search: a counting sort into square cells, and a sorted list of the
//! nearest.

use dodgy_2d::Vec2;

/// Agents in square cells; the agents of a cell are contiguous.
#[derive(Clone, Default)]
pub struct Grid {
    cell: f32,
    low: Vec2,
    size: (usize, usize),
    /// Index in `order` of the first agent of each cell; one more at the end.
    starts: Vec<u32>,
    /// Indices and positions, cell by cell.
    order: Vec<(u32, Vec2)>,
}

impl Grid {
    /// Sorts agents into cells of this width.
    pub fn rebuild(&mut self, places: impl Iterator<Item = Vec2> + Clone, cell: f32) {
        let low = places.clone().fold(Vec2::MAX, Vec2::min);
        let high = places.clone().fold(Vec2::MIN, Vec2::max);
        let place = |p: Vec2| {
            let cell = ((p - low) / cell).as_uvec2();
            (cell.x as usize, cell.y as usize)
        };
        let (across, up) = place(high);
        let size = (across + 1, up + 1);
        (self.cell, self.low, self.size) = (cell, low, size);
        let at = |p: Vec2| place(p).1 * size.0 + place(p).0;
        self.starts.clear();
        self.starts.resize(size.0 * size.1 + 1, 0);
        let mut count = 0;
        for p in places.clone() {
            self.starts[at(p)] += 1;
            count += 1;
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        self.order.resize(count, (0, Vec2::ZERO));
        for (k, p) in places.enumerate() {
            let start = &mut self.starts[at(p)];
            *start -= 1;
            self.order[*start as usize] = (k as u32, p);
        }
    }

    /// Finds the `most` nearest other agents within a cell width of `p`, nearest first.
    pub fn nearest(&self, own: usize, p: Vec2, most: usize, found: &mut Vec<(f32, u32)>) {
        found.clear();
        let mut range = self.cell * self.cell;
        let cell = ((p - self.low) / self.cell).as_uvec2();
        let (x, y) = (cell.x as usize, cell.y as usize);
        let (left, right) = (x.saturating_sub(1), (x + 1).min(self.size.0 - 1));
        for y in y.saturating_sub(1)..=(y + 1).min(self.size.1 - 1) {
            let row = y * self.size.0;
            let (from, to) = (self.starts[row + left], self.starts[row + right + 1]);
            for &(other, at) in &self.order[from as usize..to as usize] {
                let distance = at.distance_squared(p);
                if distance >= range || other as usize == own {
                    continue;
                }
                if found.len() == most {
                    found.pop();
                }
                let place = found.iter().rposition(|near| near.0 <= distance).map_or(0, |place| place + 1);
                found.insert(place, (distance, other));
                if found.len() == most {
                    range = found[most - 1].0;
                }
            }
        }
    }
}

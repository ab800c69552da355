//! Reduces a picture to at most 255 colours by median cut (Heckbert 1982, "Color image quantization for frame buffer
//! display"). The commonest colour of each box represents the box, so that flat areas keep their exact colour and do
//! not flicker from picture to picture.

/// The number of bits per channel of the cells.
const BITS: u32 = 5;
const CELLS: usize = 1 << (3 * BITS);

/// Counts of colours by cell.
#[derive(Clone, Debug)]
pub(super) struct Counter {
    /// The number of pixels in each cell, and their commonest colour (majority vote, Boyer and Moore).
    cells: Vec<Cell>,
    /// The cells that are not empty.
    used: Vec<u16>,
    /// The palette index of each cell.
    index: Vec<u8>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    count: u32,
    color: [u8; 3],
    lead: u32,
}

fn cell(color: [u8; 3]) -> usize {
    let part = |c: u8| usize::from(c >> (8 - BITS));
    part(color[0]) << (2 * BITS) | part(color[1]) << BITS | part(color[2])
}

impl Counter {
    pub(super) fn new() -> Self {
        Self { cells: vec![Cell::default(); CELLS], used: Vec::new(), index: vec![0; CELLS] }
    }

    /// Counts a pixel.
    pub(super) fn add(&mut self, color: [u8; 3]) {
        let at = cell(color);
        let cell = &mut self.cells[at];
        if cell.count == 0 {
            self.used.push(at as u16);
        }
        cell.count += 1;
        if cell.color == color {
            cell.lead += 1;
        } else if cell.lead == 0 {
            (cell.color, cell.lead) = (color, 1);
        } else {
            cell.lead -= 1;
        }
    }

    /// Returns the palette of at most `most` colours for the counted pixels, and resets the counts.
    pub(super) fn palette(&mut self, most: usize) -> Vec<u8> {
        self.used.sort_unstable();
        let mut boxes = vec![std::mem::take(&mut self.used)];
        if boxes[0].is_empty() {
            return Vec::new();
        }
        while boxes.len() < most {
            // Cuts the box with the largest error: its longest side, weighted by its pixels.
            let worst = (0..boxes.len()).max_by_key(|&k| (self.badness(&boxes[k]), usize::MAX - k));
            let Some(worst) = worst.filter(|&k| boxes[k].len() > 1) else { break };
            let (low, high) = self.cut(std::mem::take(&mut boxes[worst]));
            boxes[worst] = low;
            boxes.push(high);
        }
        let mut palette = Vec::with_capacity(boxes.len() * 3);
        for (k, cells) in boxes.iter().enumerate() {
            let best = cells.iter().max_by_key(|&&c| self.cells[usize::from(c)].count).expect("no box is empty");
            palette.extend_from_slice(&self.cells[usize::from(*best)].color);
            cells.iter().for_each(|&c| self.index[usize::from(c)] = k as u8);
        }
        for cells in boxes {
            cells.iter().for_each(|&c| self.cells[usize::from(c)] = Cell::default());
        }
        palette
    }

    /// Returns the index in the last palette of a colour that was counted for it.
    pub(super) fn index(&self, color: [u8; 3]) -> u8 {
        self.index[cell(color)]
    }

    fn channel(&self, cell: u16, channel: usize) -> u8 {
        self.cells[usize::from(cell)].color[channel]
    }

    /// Returns the longest side of a box and its length.
    fn longest(&self, cells: &[u16]) -> (usize, u8) {
        (0..3)
            .map(|channel| {
                let values = || cells.iter().map(|&c| self.channel(c, channel));
                (channel, values().max().unwrap_or(0) - values().min().unwrap_or(0))
            })
            .max_by_key(|&(channel, length)| (length, 3 - channel))
            .expect("there are three channels")
    }

    fn badness(&self, cells: &[u16]) -> u64 {
        if cells.len() < 2 {
            return 0;
        }
        let count: u64 = cells.iter().map(|&c| u64::from(self.cells[usize::from(c)].count)).sum();
        let side = u64::from(self.longest(cells).1);
        side * side * count.isqrt()
    }

    /// Cuts a box across its longest side, so that both parts have half of the weight.
    fn cut(&self, mut cells: Vec<u16>) -> (Vec<u16>, Vec<u16>) {
        let (channel, _) = self.longest(&cells);
        cells.sort_by_key(|&c| (self.channel(c, channel), c));
        // Square roots of the counts keep a large flat area from dominating the cut.
        let weight = |c: u16| u64::from(self.cells[usize::from(c)].count).isqrt().max(1);
        let total: u64 = cells.iter().map(|&c| weight(c)).sum();
        let (mut sum, mut at) = (0, 0);
        while at < cells.len() - 1 && 2 * sum < total {
            sum += weight(cells[at]);
            at += 1;
        }
        let high = cells.split_off(at.max(1));
        (cells, high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_exactly() {
        let colors = [[246, 245, 241], [56, 102, 182], [227, 140, 46], [0, 0, 0]];
        let mut counter = Counter::new();
        colors.iter().enumerate().for_each(|(k, &c)| (0..=k * 100).for_each(|_| counter.add(c)));
        let palette = counter.palette(255);
        assert_eq!(palette.len(), 12);
        for color in colors {
            let k = usize::from(counter.index(color)) * 3;
            assert_eq!(palette[k..k + 3], color);
        }
    }

    #[test]
    fn many_colours_are_brought_down_and_flat_areas_stay() {
        let flat = [201, 77, 33];
        let mut counter = Counter::new();
        (0..100_000).for_each(|_| counter.add(flat));
        let all = || (0..40u8).flat_map(|r| (0..40u8).map(move |g| [r * 6, g * 6, 90]));
        all().for_each(|c| counter.add(c));
        let palette = counter.palette(255);
        assert_eq!(palette.len(), 255 * 3);
        let see = |c: [u8; 3]| {
            let k = usize::from(counter.index(c)) * 3;
            [palette[k], palette[k + 1], palette[k + 2]]
        };
        assert_eq!(see(flat), flat);
        for color in all() {
            let near = see(color);
            for (a, b) in color.into_iter().zip(near) {
                assert!(a.abs_diff(b) <= 24, "{color:?} became {near:?}");
            }
        }
    }
}

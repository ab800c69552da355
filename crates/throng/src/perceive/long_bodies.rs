//! Bodies that are not discs, in the neighbour search.

use super::{Grid, Near};
use crate::agent::Columns;
use glam::Vec2;

/// Bodies that are not discs: they may be near although their centres are far.
#[derive(Clone, Debug, Default)]
pub(crate) struct LongBodies {
    rows: Vec<usize>,
    points: Vec<Vec2>,
    numbers: Vec<u32>,
    grid: Grid,
    /// Greatest distance of a point of a core from its centre.
    reach: f32,
}

impl LongBodies {
    /// Whether all bodies are discs.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    pub(super) fn rebuild(&mut self, agents: &Columns, cell: f32) {
        self.rows.clear();
        if !agents.all_discs() {
            self.rows.extend((0..agents.len()).filter(|&row| !agents.is_disc(row)));
        }
        let Self { rows, points, numbers, .. } = self;
        self.reach = rows.iter().map(|&row| agents.core[row].length()).fold(0.0, f32::max);
        points.clear();
        points.extend(rows.iter().map(|&row| agents.position[row]));
        numbers.clear();
        numbers.extend(rows.iter().map(|&row| agents.number[row]));
        self.grid.rebuild(points, numbers, cell);
    }

    /// Whether a long body may belong to the `k` nearest bodies of a row within `range`, given the bodies with the nearest
    /// centres.
    pub(super) fn may_reach(&self, agents: &Columns, row: usize, nearest: &[u32], (k, range): (usize, f32)) -> bool {
        if self.is_empty() {
            return false;
        }
        if !agents.is_disc(row) || nearest.iter().any(|&other| !agents.is_disc(other as usize)) {
            return true;
        }
        let at = agents.position[row];
        let farthest = match nearest.last() {
            Some(&last) if nearest.len() >= k => at.distance(agents.position[last as usize]) * 1.0001,
            _ => range,
        };
        let mut any = false;
        self.grid.within(at, farthest + self.reach, |_| any = true);
        any
    }

    /// Merges long bodies into `found`, which holds the nearest discs to `row` by their centres. `found` then holds the
    /// `k` nearest bodies within `range` by the distance of cores.
    pub(super) fn add(
        &self,
        agents: &Columns,
        grid: &Grid,
        row: usize,
        (k, range): (usize, f32),
        accept: impl Fn(&mut Near) -> bool,
        found: &mut Vec<Near>,
    ) {
        if k == 0 {
            return found.clear();
        }
        let at = agents.position[row];
        if agents.is_disc(row) {
            found.retain(|near| agents.is_disc(near.row as usize));
            self.grid.within(at, range + self.reach, |near| {
                found.push(Near { row: self.rows[near.row as usize] as u32, ..near });
            });
        } else {
            found.clear();
            grid.within(at, range + self.reach + agents.core[row].length(), |near| found.push(near));
        }
        found.retain_mut(accept);
        // cores are at least this far apart: a body beyond the limit by this measure needs no exact test
        let reach = |row: usize| agents.core[row].length();
        let least = |near: &Near| {
            let cores = reach(row) + reach(near.row as usize);
            (at.distance(agents.position[near.row as usize]) - cores) * 0.9999
        };
        found.sort_unstable_by(|a, b| least(a).total_cmp(&least(b)).then(a.number.cmp(&b.number)));
        let mut kept = 0;
        for next in 0..found.len() {
            let mut near = found[next];
            let worst = if kept < k { range } else { found[k - 1].distance_squared.sqrt() };
            if least(&near) > worst {
                break;
            }
            near.distance_squared = agents.offset_in_space(row, near.row as usize).length_squared();
            if near.distance_squared > range * range {
                continue;
            }
            let place = found[..kept]
                .partition_point(|other| (other.distance_squared, other.number) < (near.distance_squared, near.number));
            if place < k {
                // kept neighbours are in front, sorted by distance
                kept = (kept + 1).min(k);
                found[place..=next].rotate_right(1);
                found[place] = near;
            }
        }
        found.truncate(kept);
    }
}

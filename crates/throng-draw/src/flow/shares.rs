//! The shares of several fields in a picture: each field is drawn near the agents of its groups and fades out beyond
//! them, so that the fields do not cover each other.

use super::Canvas;
use crate::Image;
use glam::Vec2;
use throng_record::{Flow, Frame};

/// The width of the cells of the shares, in units of the layout.
const CELL: f32 = 6.0;
/// The distances from the nearest agent up to which a field is drawn in full, and from which on it is not drawn, in
/// units of the layout.
const FULL: f32 = 24.0;
const NONE: f32 = 110.0;

/// The shares of all fields, on a grid that covers the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Shares {
    cell: f32,
    columns: usize,
    rows: usize,
    /// The shares of each field by cell, 0 to 1; their sum is at most 1.
    of: Vec<Vec<f32>>,
}

impl Shares {
    /// Returns the shares at a moment. A field without agents in the frame has no share, unless no field has any: then
    /// all have the same.
    pub fn new<'a>(flows: impl Iterator<Item = &'a Flow>, canvas: &Canvas, frame: &Frame) -> Self {
        let cell = CELL * canvas.unit;
        let [columns, rows] = (canvas.size / cell).ceil().to_array().map(|count| count as usize + 1);
        let near = |flow: &Flow| {
            let bodies = frame.bodies.iter().filter(|body| flow.groups.contains(&body.group));
            nearness((columns, rows), bodies.map(|body| canvas.camera.pixel(body.position) / cell))
        };
        let mut of: Vec<Vec<f32>> = flows.map(near).collect();
        let count = of.len() as f32;
        let is_empty = of.iter().flatten().all(|&share| share == 0.0);
        for index in 0..columns * rows {
            // The nearer field takes more than its part.
            let sum: f32 = of.iter().map(|near| near[index].powi(2)).sum();
            let share = |near: f32| if is_empty { count.recip() } else { near.powi(3) / sum.max(1e-9) };
            of.iter_mut().for_each(|near| near[index] = share(near[index]));
        }
        Self { cell, columns, rows, of }
    }

    /// Returns the share of a field at a pixel by bilinear interpolation.
    pub fn at(&self, field: usize, pixel: Vec2) -> f32 {
        let at = (pixel / self.cell).clamp(Vec2::ZERO, Vec2::new(self.columns as f32, self.rows as f32) - 1.001);
        let (part, first) = (at.fract(), at.y as usize * self.columns + at.x as usize);
        let share = &self.of[field];
        let along = |first: usize| share[first] + (share[first + 1] - share[first]) * part.x;
        along(first) + (along(first + self.columns) - along(first)) * part.y
    }

    /// Returns the mean of pictures of the fields, weighted by their shares; the rest is `bare`.
    pub fn mix(&self, bare: &Image, pictures: &[Image]) -> Image {
        let mut mixed = bare.clone();
        let width = bare.width() as usize;
        for (k, pixel) in mixed.data_mut().chunks_exact_mut(4).enumerate() {
            let at = Vec2::new((k % width) as f32, (k / width) as f32) + 0.5;
            let mut sum = [0.0; 3];
            for (field, picture) in pictures.iter().enumerate() {
                let share = self.at(field, at);
                if share > 0.0 {
                    let from = &picture.data()[4 * k..4 * k + 3];
                    sum.iter_mut().zip(from).zip(&*pixel).for_each(|((sum, &to), &bare)| {
                        *sum += share * (f32::from(to) - f32::from(bare));
                    });
                }
            }
            pixel.iter_mut().zip(sum).for_each(|(channel, sum)| *channel = (f32::from(*channel) + sum + 0.5) as u8);
        }
        mixed
    }
}

/// Returns for each cell how near the nearest agent is, 1 to 0. Positions are in cells.
fn nearness((columns, rows): (usize, usize), agents: impl Iterator<Item = Vec2>) -> Vec<f32> {
    let mut distances = vec![f32::INFINITY; columns * rows];
    for at in agents.filter(|at| at.is_finite()) {
        let [x, y] = at.round().to_array();
        if x >= 0.0 && y >= 0.0 && (x as usize) < columns && (y as usize) < rows {
            distances[y as usize * columns + x as usize] = 0.0;
        }
    }
    // The chamfer distance: two passes over the cells with the neighbours that have their distances.
    const STRAIGHT: f32 = 1.0;
    const ACROSS: f32 = std::f32::consts::SQRT_2;
    let mut pass = |index: usize, sense: isize| {
        let (column, row) = ((index % columns) as isize, (index / columns) as isize);
        let before = [(-1, 0, STRAIGHT), (-1, -1, ACROSS), (0, -1, STRAIGHT), (1, -1, ACROSS)];
        for (dx, dy, length) in before {
            let (x, y) = (column + dx * sense, row + dy * sense);
            if (0..columns as isize).contains(&x) && (0..rows as isize).contains(&y) {
                let other = distances[y as usize * columns + x as usize] + length;
                distances[index] = distances[index].min(other);
            }
        }
    };
    (0..columns * rows).for_each(|index| pass(index, 1));
    (0..columns * rows).rev().for_each(|index| pass(index, -1));
    let near = |distance: f32| {
        let t = ((NONE - distance * CELL) / (NONE - FULL)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    distances.into_iter().map(near).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearness_falls_with_the_distance_on_all_sides() {
        let near = nearness((60, 40), [Vec2::new(30.0, 20.0)].into_iter());
        let at = |x: usize, y: usize| near[y * 60 + x];
        assert_eq!((at(30, 20), at(33, 20), at(55, 20), at(5, 20)), (1.0, 1.0, 0.0, 0.0));
        for (x, y) in [(40, 20), (20, 20), (30, 30), (30, 10)] {
            assert!((at(x, y) - at(40, 20)).abs() < 1e-5 && (0.3..0.9).contains(&at(x, y)), "{}", at(x, y));
        }
        assert!(nearness((8, 8), std::iter::empty()).iter().all(|&near| near == 0.0));
    }
}

//! Painting on a grid with a brush.

use super::Sampled;
use super::grid::{Interpolate, ValueGrid};
use glam::DVec2;
use throng::Error;

/// Dabs per radius of the brush: close enough that single dabs are not visible.
const DABS: f64 = 8.0;
/// Maximum number of dabs of a stroke.
const MOST: f64 = 1e6;

/// A round brush.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Radius, metres. Limit: > 0.
    pub radius: f64,
    /// Opacity where the brush has full strength: 1 replaces the old value. Limit: 0 to 1.
    pub strength: f64,
    /// Part of the radius within which the brush has full strength; from there it fades to the rim. Limit: 0 to 1.
    pub hardness: f64,
}

impl Default for Brush {
    /// A radius of 2 m, with full strength within half of it.
    fn default() -> Self {
        Self { radius: 2.0, strength: 1.0, hardness: 0.5 }
    }
}

impl Brush {
    fn check(&self) -> Result<(), Error> {
        let Self { radius, strength, hardness } = *self;
        Error::unless(radius > 0.0 && radius.is_finite(), "radius of a brush", radius, "greater than 0 and finite")?;
        Error::unless((0.0..=1.0).contains(&strength), "strength of a brush", strength, "0 to 1")?;
        Error::unless((0.0..=1.0).contains(&hardness), "hardness of a brush", hardness, "0 to 1")
    }

    /// Returns the coverage at a distance.
    fn cover(&self, distance: f64) -> f64 {
        let full = self.radius * self.hardness;
        let part = ((distance - full) / (self.radius - full)).clamp(0.0, 1.0);
        // hardness 1 has no soft rim: coverage is 0 or 1
        if part.is_nan() { 1.0 } else { 1.0 - part * part * (3.0 - 2.0 * part) }
    }

    /// Strokes along a line. Each corner gets the mean, weighted by coverage, of what the dabs that reach it leave.
    /// `leaves` returns what a dab leaves for a direction of the stroke (zero: a dab without a stroke).
    pub(super) fn stroke<T: Interpolate>(
        &self,
        grid: &mut ValueGrid<T>,
        points: &[DVec2],
        leaves: impl Fn(DVec2) -> T,
    ) -> Result<(), Error> {
        self.check()?;
        let dabs = self.dabs(points)?;
        let (Some(first), reach) = (dabs.first(), DVec2::splat(self.radius)) else { return Ok(()) };
        let (low, high) = dabs.iter().fold((first.0, first.0), |(low, high), dab| (low.min(dab.0), high.max(dab.0)));
        // for each corner in reach: the weighted sum of what the dabs leave, the sum of the coverages, and their
        // maximum
        let (across, up) = grid.within(low - reach, high + reach);
        let mut left = vec![(T::NOTHING, 0.0f64, 0.0f64); across.len() * up.len()];
        for (at, direction) in dabs {
            let leaves = leaves(direction);
            let (columns, rows) = grid.within(at - reach, at + reach);
            for row in rows {
                let first = (row - up.start) * across.len();
                for column in columns.clone() {
                    let distance = at.distance(grid.place(column, row));
                    if distance <= self.radius {
                        let cover = self.cover(distance);
                        let (sum, weight, most) = &mut left[first + column - across.start];
                        *sum = *sum + leaves * cover as f32;
                        *weight += cover;
                        *most = most.max(cover);
                    }
                }
            }
        }
        let corners = up.flat_map(|row| across.clone().map(move |column| (row, column)));
        for ((row, column), (sum, weight, most)) in corners.zip(left).filter(|(_, (_, weight, _))| *weight > 0.0) {
            let value = &mut grid.values[row * grid.columns + column];
            let left = sum * (1.0 / weight) as f32;
            *value = *value + (left - *value) * (self.strength * most) as f32;
        }
        Ok(())
    }

    /// Returns the positions of the dabs of a stroke, with the direction of the stroke there.
    fn dabs(&self, points: &[DVec2]) -> Result<Vec<(DVec2, DVec2)>, Error> {
        for point in points {
            Error::unless_finite("point of a stroke", point.element_sum())?;
        }
        let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let apart = self.radius / DABS;
        Error::unless(length / apart < MOST, "length of a stroke", length, "at most 125000 times the brush's radius")?;
        if length == 0.0 {
            return Ok(points.first().map(|&point| (point, DVec2::ZERO)).into_iter().collect());
        }
        let mut dabs = Vec::with_capacity((length / apart) as usize + points.len() + 1);
        for pair in points.windows(2).filter(|pair| pair[0] != pair[1]) {
            let (along, parts) = (pair[1] - pair[0], (pair[0].distance(pair[1]) / apart).ceil().max(1.0));
            let direction = along.normalize();
            dabs.extend((0..=parts as usize).map(|part| (pair[0] + along * (part as f64 / parts), direction)));
        }
        Ok(dabs)
    }
}

impl Sampled {
    /// Paints with a brush: leaves velocities along the line at a speed, m/s (below zero: against it). Around corners
    /// the direction turns gradually.
    ///
    /// ```
    /// use glam::{DVec2, Vec3};
    /// use throng::field::Field;
    /// use throng_field::{Brush, Sampled};
    /// let mut field = Sampled::over(DVec2::splat(-10.0), DVec2::splat(10.0), 0.25)?;
    /// let street = [DVec2::new(-8.0, 0.0), DVec2::ZERO, DVec2::new(0.0, 8.0)];
    /// field.paint(&Brush::default(), &street, 1.3)?;
    /// assert!(field.velocity(Vec3::new(-5.0, 0.3, 0.0), 0.0).distance(Vec3::X * 1.3) < 1e-6);
    /// let corner = field.velocity(Vec3::ZERO, 0.0);
    /// assert!((corner.x - corner.y).abs() < 0.05 && corner.x > 0.5);
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// Values out of the limits of the brush; places and speeds that are not finite; strokes of more than a million
    /// dabs.
    pub fn paint(&mut self, brush: &Brush, points: &[DVec2], speed: f64) -> Result<(), Error> {
        Error::unless_finite("speed of a stroke", speed)?;
        brush.stroke(&mut self.grid, points, |direction| (direction * speed).as_vec2())
    }

    /// Erases along a line: where the brush has full strength, the field becomes zero.
    ///
    /// # Errors
    /// As [`paint`](Self::paint).
    pub fn rub_out(&mut self, brush: &Brush, points: &[DVec2]) -> Result<(), Error> {
        brush.stroke(&mut self.grid, points, |_| Interpolate::NOTHING)
    }
}

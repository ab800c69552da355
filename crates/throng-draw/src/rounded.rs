//! Agents: antialiased discs and rounded rectangles with a notch, drawn directly on the picture.
//!
//! The coverage of a pixel is the clamped distance of its centre to the edge; the total is the disc's area to a
//! fraction of a percent. Thousands of discs are cheaper this way than by filled paths.

use crate::Color;
use crate::image::{Image, blend};
use glam::Vec2;

/// A body, in pixels: all points within a radius of a rectangle. A rectangle of size zero gives a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounded {
    pub center: Vec2,
    /// The half extents of the rectangle, along and across `along`; zero for a disc.
    pub core: Vec2,
    /// The unit vector along the body's length.
    pub along: Vec2,
    pub radius: f32,
    pub fill: Color,
    /// The colour of the edge.
    pub rim: Color,
    /// The width of the edge, which lies inside.
    pub rim_width: f32,
    /// The colour of the notch, which marks the front end.
    pub notch: Option<Color>,
}

/// The start of the notch, in radii.
pub(crate) const NOTCH_FROM: f32 = 0.36;
/// The end of the notch, in radii.
pub(crate) const NOTCH_TO: f32 = 0.82;
/// Half the width of the notch, in radii.
pub(crate) const NOTCH_HALF_WIDTH: f32 = 0.14;
/// The least radius of discs with a notch, pixels.
pub(crate) const NOTCH_LEAST_RADIUS: f32 = 3.5;

impl Rounded {
    /// Creates a disc in one colour.
    pub fn spot(center: Vec2, radius: f32, fill: Color) -> Self {
        Self { center, core: Vec2::ZERO, along: Vec2::X, radius, fill, rim: fill, rim_width: 0.0, notch: None }
    }

    /// Returns half the narrower side.
    pub fn clearance_radius(&self) -> f32 {
        self.radius + self.core.min_element()
    }

    /// Returns the centre of the disc that fills the front end.
    pub fn front(&self) -> Vec2 {
        self.center + self.along * (self.core.x - self.core.min_element())
    }

    /// Draws the body on a picture.
    pub(crate) fn draw(&self, image: &mut Image) {
        // The linear ramp at the edge adds pi / 12 to the area of the disc; a slightly smaller disc compensates.
        let is_disc = self.core == Vec2::ZERO;
        let r = if is_disc { (self.radius * self.radius - 1.0 / 12.0).max(0.01).sqrt() } else { self.radius };
        let reach = r + self.core.length() + 0.5;
        let (width, height) = (image.width() as i32, image.height() as i32);
        let c = self.center;
        if !(c.is_finite() && reach.is_finite()) {
            return;
        }
        let low = ((c.y - reach - 0.5).ceil().max(0.0)) as i32;
        let high = ((c.y + reach - 0.5).floor().min((height - 1) as f32)) as i32;
        for y in low..=high {
            let dy = y as f32 + 0.5 - c.y;
            let half = (reach * reach - dy * dy).max(0.0).sqrt();
            let left = ((c.x - half - 0.5).ceil().max(0.0)) as i32;
            let right = ((c.x + half - 0.5).floor().min((width - 1) as f32)) as i32;
            if left > right {
                continue;
            }
            let first = (y as usize * width as usize + left as usize) * 4;
            let row = &mut image.data_mut()[first..first + (right - left + 1) as usize * 4];
            for (k, pixel) in row.chunks_exact_mut(4).enumerate() {
                let offset = Vec2::new((left + k as i32) as f32 + 0.5 - c.x, dy);
                self.pixel(pixel, offset, r);
            }
        }
    }

    /// Returns the distance of a pixel from the rectangle, negative inside.
    fn beyond(&self, offset: Vec2) -> f32 {
        let local = Vec2::new(offset.dot(self.along), self.along.perp_dot(offset));
        let beyond = local.abs() - self.core;
        beyond.max(Vec2::ZERO).length() + beyond.max_element().min(0.0)
    }

    fn pixel(&self, pixel: &mut [u8], offset: Vec2, r: f32) {
        let distance = if self.core == Vec2::ZERO { offset.length() } else { self.beyond(offset) };
        let cover = (r + 0.5 - distance).clamp(0.0, 1.0);
        let mut color = self.fill;
        let rim = (distance - (r - self.rim_width) + 0.5).clamp(0.0, 1.0);
        if rim > 0.0 {
            color = color.mix(self.rim, rim);
        }
        if let Some(notch) = self.notch {
            let (r, offset) = (r + self.core.min_element(), offset + self.center - self.front());
            let along = offset.dot(self.along).clamp(NOTCH_FROM * r, NOTCH_TO * r);
            let half = (NOTCH_HALF_WIDTH * r).max(0.6);
            let over = (half + 0.5 - offset.distance(self.along * along)).clamp(0.0, 1.0);
            if over > 0.0 {
                color = color.mix(notch, over * f32::from(notch.a) / 255.0);
            }
        }
        let cover = (cover * 256.0 * f32::from(self.fill.a) / 255.0 + 0.5) as u32;
        blend(pixel, [color.r, color.g, color.b], cover);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: Color = Color::rgb(0);
    const WHITE: Color = Color::rgb(0xffffff);

    fn white(center: Vec2, radius: f32) -> Rounded {
        let (core, along) = (Vec2::ZERO, Vec2::Y);
        Rounded { center, core, along, radius, fill: WHITE, rim: WHITE, rim_width: 0.0, notch: None }
    }

    fn area(image: &Image) -> f64 {
        image.data().chunks_exact(4).map(|p| f64::from(p[0]) / 255.0).sum()
    }

    #[test]
    fn the_covered_pixels_sum_to_the_area_wherever_the_disc_lies() {
        for radius in [1.5f32, 2.2, 3.7, 8.0, 25.3] {
            for k in 0..16 {
                let center = Vec2::new(32.0 + k as f32 * 0.0625, 32.0 + (k * 5 % 16) as f32 * 0.0625);
                let mut image = Image::new(64, 64, BLACK);
                white(center, radius).draw(&mut image);
                let want = std::f64::consts::PI * f64::from(radius * radius);
                let error = (area(&image) - want) / want;
                assert!(error.abs() < 0.01, "radius {radius} at {center}: {:.2} %", error * 100.0);
            }
        }
    }

    #[test]
    fn the_covered_pixels_of_a_rounded_rectangle_sum_to_its_area() {
        for (core, radius) in [(Vec2::new(12.0, 0.0), 4.0), (Vec2::new(10.0, 6.0), 2.5), (Vec2::new(0.0, 9.0), 3.0)] {
            for k in 0..16 {
                let mut image = Image::new(64, 64, BLACK);
                let along = Vec2::from_angle(k as f32 * 0.4);
                let center = Vec2::new(32.0 + k as f32 * 0.0625, 32.0);
                Rounded { core, along, ..white(center, radius) }.draw(&mut image);
                let sides = 4.0 * core.x * core.y + 4.0 * radius * (core.x + core.y);
                let want = f64::from(sides + std::f32::consts::PI * radius * radius);
                let error = (area(&image) - want) / want;
                assert!(error.abs() < 0.01, "{core} at {along}: {:.2} %", error * 100.0);
            }
        }
    }

    #[test]
    fn a_disc_across_the_corner_is_cut_off() {
        let mut image = Image::new(20, 20, BLACK);
        white(Vec2::ZERO, 10.0).draw(&mut image);
        let want = std::f64::consts::PI * 25.0;
        assert!((area(&image) / want - 1.0).abs() < 0.02);
        white(Vec2::new(-50.0, 5.0), 10.0).draw(&mut image);
        white(Vec2::new(f32::NAN, 5.0), 10.0).draw(&mut image);
        assert!((area(&image) / want - 1.0).abs() < 0.02);
    }

    #[test]
    fn the_notch_points_where_the_agent_does() {
        let mut image = Image::new(40, 40, BLACK);
        let grey = Color::rgb(0x808080);
        Rounded { fill: grey, rim: grey, notch: Some(WHITE), ..white(Vec2::splat(20.0), 12.0) }.draw(&mut image);
        assert_eq!(image.pixel(20, 27), WHITE);
        for (x, y) in [(20, 20), (20, 12), (12, 20), (27, 20)] {
            assert_eq!(image.pixel(x, y), grey, "at ({x}, {y})");
        }
    }
}

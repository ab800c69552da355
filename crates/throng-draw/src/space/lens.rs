//! The perspective projection from points in space to pixels.

use glam::{DMat4, DVec3, Vec2};
use throng_render::View;

/// The distance of the near plane, relative to the distance of the target.
const NEAR: f64 = 0.02;
/// The share of its colour that the farthest point loses to haze.
const HAZE: f64 = 0.6;

/// A perspective view at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// The viewpoint, metres.
    pub eye: DVec3,
    /// The axes of the picture, of length 1.
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// The pixel of the target.
    anchor: Vec2,
    /// The focal length, pixels: an object as wide as it is distant has this width in the picture.
    focal: f64,
    /// The distance of the near plane, metres.
    near: f64,
    /// The depths at which haze begins and at which it is strongest, metres.
    clear: [f64; 2],
}

impl Lens {
    /// Creates a view from `eye` to `target`, with the vertical axis up. The scene lies within `reach` of the target.
    pub fn new(eye: DVec3, target: DVec3, focal: f64, anchor: Vec2, reach: f64) -> Self {
        let ahead = target - eye;
        let forward = ahead.normalize_or(DVec3::Y);
        // For a view straight down, the top of the picture is north.
        let right = forward.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        let distance = ahead.length();
        let clear = [(distance - reach).max(0.0), distance + reach];
        Self { eye, right, up: right.cross(forward), forward, anchor, focal, near: NEAR * distance, clear }
    }

    /// Returns the focal length, pixels.
    pub fn focal(&self) -> f64 {
        self.focal
    }

    /// Returns the distance of the near plane, metres.
    pub fn near(&self) -> f64 {
        self.near
    }

    /// Returns the depth of a point along the view direction, metres.
    pub fn depth(&self, point: DVec3) -> f64 {
        (point - self.eye).dot(self.forward)
    }

    /// Returns the directions to the right and to the top of the picture, of length 1.
    pub(crate) fn axes(&self) -> [DVec3; 2] {
        [self.right, self.up]
    }

    /// Returns the view of the renderer.
    pub(crate) fn view(&self) -> View {
        View {
            eye: self.eye,
            right: self.right.as_vec3(),
            up: self.up.as_vec3(),
            forward: self.forward.as_vec3(),
            centre: self.anchor,
            focal: self.focal as f32,
            near: self.near as f32,
        }
    }

    /// Returns the pixel of a point; `None` if it is behind the near plane.
    pub fn pixel(&self, point: DVec3) -> Option<Vec2> {
        (self.depth(point) >= self.near).then(|| self.project(point))
    }

    fn project(&self, point: DVec3) -> Vec2 {
        let (offset, scale) = (point - self.eye, self.focal / self.depth(point));
        self.anchor + Vec2::new((offset.dot(self.right) * scale) as f32, (-offset.dot(self.up) * scale) as f32)
    }

    /// Returns pixels per metre at a point, across the line of sight.
    pub fn scale(&self, point: DVec3) -> f64 {
        self.focal / self.depth(point).max(self.near)
    }

    /// Returns the view direction of a pixel, of length 1.
    pub fn sight(&self, pixel: Vec2) -> DVec3 {
        let offset = (pixel - self.anchor).as_dvec2() / self.focal;
        (self.forward + self.right * offset.x - self.up * offset.y).normalize()
    }

    /// Returns the matrix from points relative to `origin` to clip coordinates of OpenGL, for a picture of `size`
    /// pixels. Infinite distance has the depth 1.
    pub fn clip(&self, origin: DVec3, size: Vec2) -> DMat4 {
        let size = size.as_dvec2();
        let (aside, above) = (self.right * (2.0 * self.focal / size.x), self.up * (2.0 * self.focal / size.y));
        let middle = 2.0 * self.anchor.as_dvec2() / size - 1.0;
        let rows = [aside + self.forward * middle.x, above - self.forward * middle.y, self.forward, self.forward];
        let from = self.eye - origin;
        let row = |row: DVec3, shift: f64| row.extend(shift - row.dot(from));
        DMat4::from_cols(row(rows[0], 0.0), row(rows[1], 0.0), row(rows[2], -2.0 * self.near), row(rows[3], 0.0))
            .transpose()
    }

    /// Returns the part of a line in front of the near plane, in pixels.
    pub(crate) fn line(&self, from: DVec3, to: DVec3) -> Option<[Vec2; 2]> {
        let [a, b] = [from, to].map(|point| self.depth(point) - self.near);
        if a < 0.0 && b < 0.0 {
            return None;
        }
        let ahead = |point: DVec3, depth: f64| if depth < 0.0 { from.lerp(to, a / (a - b)) } else { point };
        Some([(from, a), (to, b)].map(|(point, depth)| self.project(ahead(point, depth))))
    }

    /// Returns the share of its colour that a point loses to haze, 0 to 1.
    pub(crate) fn haze(&self, point: DVec3) -> f32 {
        let [from, to] = self.clear;
        (HAZE * ((self.depth(point) - from) / (to - from)).clamp(0.0, 1.0).powi(2)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lens() -> Lens {
        Lens::new(DVec3::new(0.0, -10.0, 0.0), DVec3::ZERO, 100.0, Vec2::new(50.0, 40.0), 5.0)
    }

    #[test]
    fn twice_the_distance_is_half_the_size() {
        let lens = lens();
        assert_eq!(lens.pixel(DVec3::ZERO), Some(Vec2::new(50.0, 40.0)));
        assert_eq!(lens.pixel(DVec3::new(1.0, 0.0, 2.0)), Some(Vec2::new(60.0, 20.0)), "up is up");
        assert_eq!(lens.pixel(DVec3::new(1.0, 10.0, 2.0)), Some(Vec2::new(55.0, 30.0)));
        assert_eq!((lens.scale(DVec3::ZERO), lens.scale(DVec3::Y * 10.0)), (10.0, 5.0));
        assert_eq!((lens.haze(DVec3::Y * -6.0), lens.haze(DVec3::Y * 9.0)), (0.0, HAZE as f32));
    }

    #[test]
    fn points_behind_the_eye_are_cut_off() {
        let lens = lens();
        let behind = DVec3::new(1.0, -11.0, 0.0);
        assert_eq!(lens.pixel(behind), None);
        assert_eq!(lens.line(behind, behind - DVec3::Y), None);
        let [from, to] = lens.line(behind, DVec3::X).unwrap();
        assert!(from.x > 500.0 && to == lens.pixel(DVec3::X).unwrap(), "{from} {to}");
    }

    #[test]
    fn clip_coordinates_are_those_of_the_pixels() {
        let (lens, size) = (lens(), Vec2::new(100.0, 80.0));
        let (origin, point) = (DVec3::new(30.0, 2.0, 1.0), DVec3::new(1.0, 4.0, -2.0));
        let clip = lens.clip(origin, size) * (point - origin).extend(1.0);
        let pixel = lens.pixel(point).unwrap();
        let found = Vec2::new(clip.x as f32, -clip.y as f32) / clip.w as f32 * 0.5 + 0.5;
        assert!((found * size).distance(pixel) < 1e-3, "{found} {pixel}");
        assert!((lens.sight(pixel).cross(point - lens.eye)).length() < 1e-5);
    }

    #[test]
    fn straight_down_north_is_up() {
        let lens = Lens::new(DVec3::Z * 10.0, DVec3::ZERO, 100.0, Vec2::ZERO, 5.0);
        assert_eq!(lens.pixel(DVec3::new(1.0, 2.0, 0.0)), Some(Vec2::new(10.0, -20.0)));
    }
}

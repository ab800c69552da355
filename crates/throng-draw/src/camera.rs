//! The projection from metres to pixels in plan view.

use glam::{DMat4, DVec2, DVec3, Vec2};
use throng::Obstacle;
use throng_record::{Frame, Setting};

/// The distance that people stray from their starts and goals, in radii, on unbounded ground.
const GIVING_WAY: f64 = 3.0;

/// Greater heights and depths are outside the clip coordinates, metres.
const HEIGHT: f64 = 1e5;

/// A rectangle of the world, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldBox {
    /// The corner with the least coordinates.
    pub min: DVec2,
    /// The corner with the greatest coordinates.
    pub max: DVec2,
}

impl WorldBox {
    /// The empty box, which can [grow](Self::add).
    pub(crate) const NOTHING: Self = Self { min: DVec2::INFINITY, max: DVec2::NEG_INFINITY };

    /// Returns the smallest box that holds the place and all bodies in `frame`; `None` if there is nothing. On
    /// unbounded ground it has a margin, because people give way to each other.
    pub fn of(setting: &Setting, frame: &Frame) -> Option<Self> {
        let mut all = Self::NOTHING;
        setting.walkable.iter().flat_map(|w| &w.outer).for_each(|&p| all.add(p, 0.0));
        for obstacle in &setting.obstacles {
            match obstacle {
                Obstacle::Circle { center, radius } => all.add(*center, *radius),
                Obstacle::Polygon { corners: points } | Obstacle::Wall { points } => {
                    points.iter().for_each(|&p| all.add(p, 0.0));
                }
            }
        }
        let corners = setting.shells.iter().flat_map(|shell| shell.facets.iter().flatten());
        corners.for_each(|corner| all.add(corner.truncate().as_dvec2() + setting.origin, 0.0));
        for segment in setting.paths.iter().flat_map(|path| path.segments()) {
            for end in [segment.start, segment.end] {
                all.add(end.truncate().as_dvec2() + setting.origin, segment.radius.into());
            }
        }
        for goal in &setting.goals {
            match goal.tolerance() {
                Some(tolerance) => all.add(goal.middle(), f64::from(tolerance).min(1.0)),
                None => goal.corners().into_iter().flatten().for_each(|&p| all.add(p, 0.0)),
            }
        }
        frame.bodies.iter().for_each(|b| all.add(b.position, f64::from(b.shape().bounding_radius())));
        if setting.walkable.is_empty() {
            let radii = frame.bodies.iter().map(|b| f64::from(b.shape().bounding_radius())).filter(|r| r.is_finite());
            let room = GIVING_WAY * radii.fold(0.0, f64::max);
            (all.min, all.max) = (all.min - room, all.max + room);
        }
        (all.min.cmple(all.max).all()).then_some(all)
    }

    /// Returns this box, enlarged around its middle to sides of at least `side` metres.
    pub(crate) fn at_least(self, side: f64) -> Self {
        let half = (self.max - self.min).max(DVec2::splat(side)) * 0.5;
        let center = (self.min + self.max) * 0.5;
        Self { min: center - half, max: center + half }
    }

    /// Grows the box to hold a disc. Ignores discs that are not finite.
    pub(crate) fn add(&mut self, point: DVec2, radius: f64) {
        if point.is_finite() && radius.is_finite() {
            self.min = self.min.min(point - radius);
            self.max = self.max.max(point + radius);
        }
    }
}

/// A camera in plan view: a point of the world, its pixel, and the scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The point of the world shown at `anchor`.
    pub center: DVec2,
    /// The pixel that shows `center`.
    pub anchor: Vec2,
    /// Pixels per metre.
    pub scale: f64,
}

impl Camera {
    /// Returns the camera that shows all of `view` inside the pixels from `low` to `high`, as large as possible, with
    /// the same aspect ratio.
    pub fn fit(view: WorldBox, low: Vec2, high: Vec2) -> Self {
        let extent = (view.max - view.min).abs().max(DVec2::splat(1e-3));
        let room = (high - low).max(Vec2::ONE).as_dvec2();
        let scale = (room / extent).min_element();
        Self { center: (view.min + view.max) * 0.5, anchor: (low + high) * 0.5, scale }
    }

    /// Returns the pixel of a point of the world: x to the right, y down, whole numbers at the corners of pixels.
    pub fn pixel(&self, point: DVec2) -> Vec2 {
        let offset = (point - self.center) * self.scale;
        self.anchor + Vec2::new(offset.x as f32, -offset.y as f32)
    }

    /// Returns the point of the world at a pixel.
    pub fn point(&self, pixel: Vec2) -> DVec2 {
        let offset = (pixel - self.anchor).as_dvec2() / self.scale;
        self.center + DVec2::new(offset.x, -offset.y)
    }

    /// Returns the matrix from points relative to `origin` to clip coordinates of OpenGL, for a picture of `size`
    /// pixels. Higher points are nearer.
    pub fn clip(&self, origin: DVec3, size: Vec2) -> DMat4 {
        let scale = DVec2::splat(2.0 * self.scale) / size.as_dvec2();
        let middle = (2.0 * self.anchor / size - 1.0).as_dvec2() * DVec2::new(1.0, -1.0);
        let shift = middle + (origin.truncate() - self.center) * scale;
        DMat4::from_translation(shift.extend(0.0)) * DMat4::from_scale(scale.extend(-HEIGHT.recip()))
    }

    /// Converts a length to pixels.
    pub fn length(&self, metres: f64) -> f32 {
        (metres * self.scale) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_fits_and_keeps_its_aspect() {
        let view = WorldBox { min: DVec2::new(-1800.0, 10.0), max: DVec2::new(-1780.0, 20.0) };
        let camera = Camera::fit(view, Vec2::new(10.0, 30.0), Vec2::new(410.0, 430.0));
        assert_eq!(camera.scale, 20.0);
        assert_eq!(camera.pixel(view.min), Vec2::new(10.0, 330.0), "y points up in the world, down in the picture");
        assert_eq!(camera.pixel(view.max), Vec2::new(410.0, 130.0));
        assert_eq!(camera.point(Vec2::new(410.0, 130.0)), view.max);
    }

    #[test]
    fn clip_coordinates_are_those_of_the_pixels() {
        let (center, size) = (DVec2::new(-1800.0, 9.0), Vec2::new(400.0, 300.0));
        let camera = Camera { center, anchor: Vec2::new(150.0, 200.0), scale: 20.0 };
        let (origin, point) = (DVec3::new(-1790.0, 10.0, 0.0), DVec3::new(-1802.0, 13.0, 2.0));
        let clip = camera.clip(origin, size).transform_point3(point - origin).as_vec3();
        let pixel = (Vec2::new(clip.x, -clip.y) * 0.5 + 0.5) * size;
        assert!(pixel.distance(camera.pixel(point.truncate())) < 1e-3, "{pixel}");
    }

    #[test]
    fn the_box_of_nothing_is_none_and_broken_numbers_are_left_out() {
        assert_eq!(WorldBox::of(&Setting::default(), &Frame::default()), None);
        let setting = Setting {
            obstacles: vec![
                Obstacle::Circle { center: DVec2::new(1.0, 2.0), radius: 0.5 },
                Obstacle::Wall { points: vec![DVec2::NAN, DVec2::ZERO] },
            ],
            ..Setting::default()
        };
        let all = WorldBox::of(&setting, &Frame::default()).unwrap();
        assert_eq!((all.min, all.max), (DVec2::ZERO, DVec2::new(1.5, 2.5)));
    }
}

//! The projection from the world to the picture.

use crate::Camera;
use crate::space::Lens;
use glam::{DMat4, DVec3, Vec2};

/// A projection from the world to pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projector {
    /// Plan view: an orthographic projection from above.
    Plan(Camera),
    /// A perspective view.
    Perspective(Lens),
}

impl Projector {
    /// Returns the pixel of a point; `None` behind the viewpoint.
    pub fn pixel(&self, point: DVec3) -> Option<Vec2> {
        match self {
            Self::Plan(camera) => Some(camera.pixel(point.truncate())),
            Self::Perspective(lens) => lens.pixel(point),
        }
    }

    /// Returns the matrix from points relative to `origin` to clip coordinates of OpenGL, for a picture of `size`
    /// pixels.
    pub fn clip(&self, origin: DVec3, size: Vec2) -> DMat4 {
        match self {
            Self::Plan(camera) => camera.clip(origin, size),
            Self::Perspective(lens) => lens.clip(origin, size),
        }
    }

    /// Returns the pixels of a line; `None` if all of it is behind the viewpoint.
    pub(crate) fn line(&self, from: DVec3, to: DVec3) -> Option<[Vec2; 2]> {
        match self {
            Self::Plan(camera) => Some([from, to].map(|point| camera.pixel(point.truncate()))),
            Self::Perspective(lens) => lens.line(from, to),
        }
    }

    /// Returns pixels per metre at a point.
    pub fn scale(&self, point: DVec3) -> f64 {
        match self {
            Self::Plan(camera) => camera.scale,
            Self::Perspective(lens) => lens.scale(point),
        }
    }

    /// Returns the direction from a point to the viewpoint.
    pub(crate) fn sight(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Plan(_) => DVec3::Z,
            Self::Perspective(lens) => (lens.eye - point).normalize_or(DVec3::Z),
        }
    }

    /// Returns the share of its colour that a point loses to haze, 0 to 1.
    pub(crate) fn haze(&self, point: DVec3) -> f32 {
        match self {
            Self::Plan(_) => 0.0,
            Self::Perspective(lens) => lens.haze(point),
        }
    }
}

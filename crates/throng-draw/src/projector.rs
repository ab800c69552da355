//! From the world to the picture, whichever way it is projected.

use crate::Camera;
use crate::space::Lens;
use glam::{DMat4, DVec3, Vec2};

/// How points of the world become pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projector {
    /// Seen from straight above, from infinitely far.
    Plan(Camera),
    /// Seen by an eye.
    Perspective(Lens),
}

impl Projector {
    /// The pixel that shows a point; `None` behind the eye.
    pub fn pixel(&self, point: DVec3) -> Option<Vec2> {
        match self {
            Self::Plan(camera) => Some(camera.pixel(point.truncate())),
            Self::Perspective(lens) => lens.pixel(point),
        }
    }

    /// The matrix that takes points, relative to `origin`, to clip coordinates of OpenGL on a picture of this size, pixels.
    pub fn clip(&self, origin: DVec3, size: Vec2) -> DMat4 {
        match self {
            Self::Plan(camera) => camera.clip(origin, size),
            Self::Perspective(lens) => lens.clip(origin, size),
        }
    }

    /// The pixels that show a line; `None` if all of it is behind the eye.
    pub(crate) fn line(&self, from: DVec3, to: DVec3) -> Option<[Vec2; 2]> {
        match self {
            Self::Plan(camera) => Some([from, to].map(|point| camera.pixel(point.truncate()))),
            Self::Perspective(lens) => lens.line(from, to),
        }
    }

    /// Pixels a metre at a point.
    pub fn scale(&self, point: DVec3) -> f64 {
        match self {
            Self::Plan(camera) => camera.scale,
            Self::Perspective(lens) => lens.scale(point),
        }
    }

    /// The direction from a point to the eye.
    pub(crate) fn sight(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Plan(_) => DVec3::Z,
            Self::Perspective(lens) => (lens.eye - point).normalize_or(DVec3::Z),
        }
    }

    /// How far from the eye a point is along the ground.
    pub(crate) fn away(&self, point: DVec3) -> f64 {
        match self {
            Self::Plan(_) => 0.0,
            Self::Perspective(lens) => lens.away(point),
        }
    }

    /// How much of its colour a point loses to the air before it: 0 to 1.
    pub(crate) fn haze(&self, point: DVec3) -> f32 {
        match self {
            Self::Plan(_) => 0.0,
            Self::Perspective(lens) => lens.haze(point),
        }
    }
}

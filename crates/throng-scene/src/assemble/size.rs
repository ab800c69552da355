//! The size of a body: what its placement and its paths need.

use crate::random::Purpose;
use crate::scene::{Body, Number, Sides};

/// The size of a body, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    pub body: throng::Body,
    /// Bounding radius: that of the disc that contains the body at any heading.
    pub bound: f64,
    /// Clearance radius: half of the body's shorter side.
    pub clearance_radius: f64,
}

impl Size {
    /// Returns the size of a body; `draw` returns its numbers.
    pub fn of(body: &Body, draw: impl Fn(Purpose, &Number) -> f64) -> Self {
        let sides = |sides: &Sides| (draw(Purpose::Length, &sides.length), draw(Purpose::Width, &sides.width));
        let long = |body: throng::Body| Self {
            body,
            bound: body.bounding_radius().into(),
            clearance_radius: body.clearance_radius().into(),
        };
        match body {
            Body::Radius(radius) => {
                let radius = draw(Purpose::Radius, radius);
                Self { body: throng::Body::disc(radius as f32), bound: radius, clearance_radius: radius }
            }
            Body::Capsule(capsule) => {
                let (length, width) = sides(capsule);
                long(throng::Body::capsule(length as f32, width as f32))
            }
            Body::Rectangle(rectangle) => {
                let (length, width) = sides(rectangle);
                long(throng::Body::rectangle(length as f32, width as f32))
            }
        }
    }
}

//! How large a body is: what has to be known of it to place it and to find its way.

use crate::random::Purpose;
use crate::scene::{Body, Number, Sides};

/// How large a body is, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    pub body: throng::Body,
    /// Radius of the disc that holds it at any heading.
    pub bound: f64,
    /// Half of its narrower side.
    pub girth: f64,
}

impl Size {
    /// The size of one body of a kind; `draw` gives its numbers.
    pub fn of(body: &Body, draw: impl Fn(Purpose, &Number) -> f64) -> Self {
        let sides = |sides: &Sides| (draw(Purpose::Length, &sides.length), draw(Purpose::Width, &sides.width));
        let long = |body: throng::Body| Self { body, bound: body.bound().into(), girth: body.girth().into() };
        match body {
            Body::Radius(radius) => {
                let radius = draw(Purpose::Radius, radius);
                Self { body: throng::Body::disc(radius as f32), bound: radius, girth: radius }
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

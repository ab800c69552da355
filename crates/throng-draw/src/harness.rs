//! What unit tests share.

use glam::{DVec2, Vec2};
use throng_record::Body;

/// Returns a disc that walks at the origin, 1 m/s along +x.
pub fn body() -> Body {
    Body {
        number: 0,
        group: 0,
        goal: None,
        position: DVec2::ZERO,
        altitude: 0.0,
        velocity: Vec2::X,
        vertical_velocity: 0.0,
        heading: 0.0,
        basis: None,
        radius: 0.2,
        core: Vec2::ZERO,
        preferred_speed: 1.3,
        status: throng::Status::Walking,
    }
}

//! What agents that look ahead found.

use glam::Vec2;
use serde::{Deserialize, Serialize};

/// What an agent found when it last looked ahead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ahead {
    /// Cosine and sine of the angle by which it turns from its way to the right.
    pub turn: Vec2,
    /// Speed that the gap ahead allows, m/s; infinite if there is no agent ahead.
    pub speed: f32,
}

impl Ahead {
    /// Straight on, as fast as it likes.
    pub const FREE: Self = Self { turn: Vec2::X, speed: f32::INFINITY };

    /// As fast as it likes, turned to the right by an angle, radians.
    pub(crate) fn turned_by(angle: f32) -> Self {
        let (sin, cos) = libm::sincosf(angle);
        Self { turn: Vec2::new(cos, sin), ..Self::FREE }
    }

    /// A direction after the turn.
    pub fn turned(&self, direction: Vec2) -> Vec2 {
        let Vec2 { x: cos, y: sin } = self.turn;
        Vec2::new(cos * direction.x + sin * direction.y, cos * direction.y - sin * direction.x)
    }
}

//! What rounding takes from positions far from the origin.

use glam::Vec2;
use serde::{Deserialize, Serialize};

/// The greatest coordinate, metres, up to which positions are fine enough: their steps are at most 0.25 mm.
const FINE: f32 = 4096.0;

/// What rounding has taken from the position of an agent, metres: at most a step of the position. It is added to the next
/// motion, so that agents keep their speed where steps of positions are not small against their motion in a sub-step.
/// 20 km from the origin a step is 2 mm; at 0.05 m/s and 75 sub-steps a second, agents would not move at all.
///
/// It is -0 where positions are fine: adding that changes nothing, not even the sign of zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rounding(pub(crate) Vec2);

impl Rounding {
    /// Nothing.
    pub const NONE: Self = Self(Vec2::splat(-0.0));

    /// Returns the rounding of a motion to `to` that should have covered `way` and covered `motion`.
    #[inline]
    pub(crate) fn of(to: Vec2, way: Vec2, motion: Vec2) -> Self {
        if Self::is_far(to.abs().max_element()) { Self(way - motion) } else { Self::NONE }
    }

    /// Returns how much farther than its speed allows an agent at `from` may move by rounding, metres.
    #[inline]
    pub(crate) fn farther(from: Vec2) -> f32 {
        let largest = from.abs().max_element();
        if Self::is_far(largest) { largest * f32::EPSILON } else { 0.0 }
    }

    /// Returns what is added to the next motion, metres.
    pub fn rest(&self) -> Vec2 {
        self.0
    }

    /// Whether positions with this greatest coordinate are rounded too much: their steps are at least 0.5 mm.
    pub(crate) fn is_far(coordinate: f32) -> bool {
        coordinate >= FINE
    }
}

impl Default for Rounding {
    fn default() -> Self {
        Self::NONE
    }
}

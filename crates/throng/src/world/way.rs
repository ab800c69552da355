//! Ways: what others see of where somebody wants to go.

use crate::agent::GoalId;
use glam::Vec2;

/// What others see of somebody: one look into memory, 32 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(32))]
pub(super) struct Shown {
    /// Position and velocity.
    pub motion: [f32; 4],
    pub way: Way,
}

impl Shown {
    pub fn new(position: Vec2, velocity: Vec2, way: Way) -> Self {
        Self { motion: [position.x, position.y, velocity.x, velocity.y], way }
    }

    pub fn position(&self) -> Vec2 {
        Vec2::new(self.motion[0], self.motion[1])
    }

    pub fn velocity(&self) -> Vec2 {
        Vec2::new(self.motion[2], self.motion[3])
    }
}

/// What others see of where somebody wants to go: 16 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Way {
    /// Unit vector towards what it heads for, detours left aside; zero for who isn't walking.
    pub direction: Vec2,
    /// Metres still ahead, in space.
    pub remaining: f32,
    /// Index of the goal, and 1; 0 for none. The highest bits: flags.
    key: u32,
}

/// What the [key](Way::key) of who is on its way has.
pub(super) const WALKS: u32 = 1 << 31;
const STOPS: u32 = 1 << 30;
pub(super) const MAY_CHANGE: u32 = 1 << 29;
const PLAIN: u32 = 1 << 28;
/// What the keys of those with the same goal, or none both, have in common.
pub(super) const GOAL: u32 = PLAIN - 1;

/// Cosine of the angle within which two agents go the same way; beyond its negative they go opposite ways.
pub(super) const SAME_WAY: f32 = 0.3;

impl Way {
    /// The way of who does not walk.
    pub fn at_rest(goal: Option<GoalId>, remaining: f32) -> Self {
        Self { direction: Vec2::ZERO, remaining, key: goal.map_or(0, |goal| goal.0 + 1) }
    }

    /// A way with this key.
    pub fn with_key(key: u32, direction: Vec2, remaining: f32) -> Self {
        Self { direction, remaining, key }
    }

    /// The way of who walks.
    pub fn walking(goal: Option<GoalId>, direction: Vec2, remaining: f32) -> Self {
        let way = Self::at_rest(goal, remaining);
        Self { direction, key: way.key | WALKS, ..way }
    }

    /// To come to rest at the end.
    pub fn stopping(self, stops: bool) -> Self {
        Self { key: if stops { self.key | STOPS } else { self.key }, ..self }
    }

    /// With a status that may change in this sub-step.
    pub fn changing(self, may_change: bool) -> Self {
        Self { key: if may_change { self.key | MAY_CHANGE } else { self.key }, ..self }
    }

    /// Straight to the point of the stop, on the ground.
    pub fn plain(self, is_plain: bool) -> Self {
        Self { key: if is_plain { self.key | PLAIN } else { self.key }, ..self }
    }

    /// Whether it leads straight to the point of the stop, on the ground, and nothing was in the way of who looked.
    pub fn is_plain(&self) -> bool {
        self.key & PLAIN != 0
    }

    /// Goal and flags.
    pub fn key(&self) -> u32 {
        self.key
    }

    /// Whether it is on its way.
    pub fn walks(&self) -> bool {
        self.key & WALKS != 0
    }

    /// Whether it has a goal.
    pub fn has_goal(&self) -> bool {
        self.key & GOAL != 0
    }

    /// Whether it is to come to rest at the end.
    pub fn stops(&self) -> bool {
        self.key & STOPS != 0
    }

    /// Whether its status may change in this sub-step.
    pub fn may_change(&self) -> bool {
        self.key & MAY_CHANGE != 0
    }

    /// Whether two agents come the other way to each other.
    pub fn is_opposite(&self, other: &Self) -> bool {
        self.direction.dot(other.direction) < -SAME_WAY
    }

    /// Whether two have the same goal, or none both.
    pub fn same_goal(&self, other: &Self) -> bool {
        (self.key ^ other.key) & GOAL == 0
    }
}

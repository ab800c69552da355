//! Ways: what others see of where somebody wants to go.

use crate::agent::{GoalId, Status};
use glam::Vec2;

/// What others see of where somebody wants to go: 16 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way {
    /// Unit vector towards what it heads for, detours left aside; zero for who isn't walking.
    pub direction: Vec2,
    /// Metres still ahead, in space.
    pub remaining: f32,
    /// Index of the goal, and 1; 0 for none. The highest bit: it walks.
    key: u32,
}

const WALKS: u32 = 1 << 31;

impl Way {
    pub fn new(status: Status, goal: Option<GoalId>, direction: Vec2, remaining: f32) -> Self {
        let walks = if status == Status::Walking { WALKS } else { 0 };
        Self { direction, remaining, key: walks | goal.map_or(0, |goal| goal.0 + 1) }
    }

    /// Whether it is on its way.
    pub fn walks(&self) -> bool {
        self.key & WALKS != 0
    }

    /// Whether two have the same goal, or none both.
    pub fn same_goal(&self, other: &Self) -> bool {
        (self.key ^ other.key) & !WALKS == 0
    }

    /// Whether both walk, to different goals: neither has the right of way.
    pub fn are_equals(&self, other: &Self) -> bool {
        self.key & other.key & WALKS != 0 && self.key != other.key
    }
}

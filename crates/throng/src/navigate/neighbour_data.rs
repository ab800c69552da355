//! Neighbour data: what an agent's neighbours know of it and of its path.

use crate::agent::GoalId;
use crate::perceive::Neighbours;
use crate::world::State;
use glam::Vec2;

/// What an agent's neighbours read of it: 32 bytes, one memory access.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(32))]
pub(crate) struct NeighbourData {
    /// Position and velocity.
    pub motion: [f32; 4],
    pub way: NavFlags,
}

impl NeighbourData {
    pub fn new(position: Vec2, velocity: Vec2, way: NavFlags) -> Self {
        Self { motion: [position.x, position.y, velocity.x, velocity.y], way }
    }

    pub fn position(&self) -> Vec2 {
        Vec2::new(self.motion[0], self.motion[1])
    }

    pub fn velocity(&self) -> Vec2 {
        Vec2::new(self.motion[2], self.motion[3])
    }
}

/// What an agent's neighbours know of its path: 16 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct NavFlags {
    /// Unit vector towards the point it heads for, without detours; zero for an agent that does not walk.
    pub direction: Vec2,
    /// Remaining distance, metres, in space.
    pub remaining: f32,
    /// Index of the goal plus 1; 0 for none. The highest bits are flags.
    key: u32,
}

/// Flag in the [key](Way::key) of an agent that walks.
pub(crate) const WALKS: u32 = 1 << 31;
const STOPS: u32 = 1 << 30;
pub(crate) const MAY_CHANGE: u32 = 1 << 29;
const PLAIN: u32 = 1 << 28;
/// Bits of the key that are equal for agents with the same goal, or without a goal.
pub(crate) const GOAL: u32 = PLAIN - 1;

/// Cosine of the angle within which two agents go the same way; beyond its negative they go opposite ways.
pub(crate) const SAME_WAY: f32 = 0.3;

impl NavFlags {
    /// Returns the data of an agent that does not walk.
    pub fn at_rest(goal: Option<GoalId>, remaining: f32) -> Self {
        Self { direction: Vec2::ZERO, remaining, key: goal.map_or(0, |goal| goal.0 + 1) }
    }

    /// Returns data with a given key.
    pub fn with_key(key: u32, direction: Vec2, remaining: f32) -> Self {
        Self { direction, remaining, key }
    }

    /// Returns the data of an agent that walks.
    pub fn walking(goal: Option<GoalId>, direction: Vec2, remaining: f32) -> Self {
        let way = Self::at_rest(goal, remaining);
        Self { direction, key: way.key | WALKS, ..way }
    }

    /// Sets whether the agent stops at the end of its path.
    pub fn stopping(self, stops: bool) -> Self {
        Self { key: if stops { self.key | STOPS } else { self.key }, ..self }
    }

    /// Sets whether the status of the agent may change in this sub-step.
    pub fn changing(self, may_change: bool) -> Self {
        Self { key: if may_change { self.key | MAY_CHANGE } else { self.key }, ..self }
    }

    /// Sets whether the path leads straight to the point of the stop, on the ground.
    pub fn plain(self, is_plain: bool) -> Self {
        Self { key: if is_plain { self.key | PLAIN } else { self.key }, ..self }
    }

    /// Whether the path leads straight to the point of the stop, on the ground, and nothing blocked it when the agent
    /// planned.
    pub fn is_plain(&self) -> bool {
        self.key & PLAIN != 0
    }

    /// Returns the data as words.
    pub fn words(&self) -> [u32; 4] {
        [self.direction.x.to_bits(), self.direction.y.to_bits(), self.remaining.to_bits(), self.key]
    }

    /// Returns the data of words.
    pub fn of_words([x, y, remaining, key]: [u32; 4]) -> Self {
        Self { direction: Vec2::new(f32::from_bits(x), f32::from_bits(y)), remaining: f32::from_bits(remaining), key }
    }

    /// Returns the goal and the flags.
    pub fn key(&self) -> u32 {
        self.key
    }

    /// Whether the agent walks.
    pub fn walks(&self) -> bool {
        self.key & WALKS != 0
    }

    /// Whether the agent has a goal.
    pub fn has_goal(&self) -> bool {
        self.key & GOAL != 0
    }

    /// Whether the agent stops at the end of its path.
    pub fn stops(&self) -> bool {
        self.key & STOPS != 0
    }

    /// Whether the status of the agent may change in this sub-step.
    pub fn may_change(&self) -> bool {
        self.key & MAY_CHANGE != 0
    }

    /// Whether two agents go opposite ways.
    pub fn is_opposite(&self, other: &Self) -> bool {
        self.direction.dot(other.direction) < -SAME_WAY
    }

    /// Whether two agents have the same goal, or both have none.
    pub fn same_goal(&self, other: &Self) -> bool {
        (self.key ^ other.key) & GOAL == 0
    }
}

/// The state, with the neighbours of each agent and what agents know of each other's paths.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub state: &'a State,
    pub near: &'a Neighbours,
    /// What its neighbours know of each agent, by row.
    pub shown: &'a [NeighbourData],
}

impl<'a> Surroundings<'a> {
    /// Returns the rows of the neighbours of an agent, nearest first.
    #[inline]
    pub fn neighbours(&self, row: usize) -> &'a [u32] {
        self.near.of(row)
    }

    /// Returns what the neighbours of an agent know of its path.
    #[inline]
    pub fn way(&self, row: usize) -> &'a NavFlags {
        &self.shown[row].way
    }
}

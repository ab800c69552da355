//! Explanations of chosen velocities, as data that a viewer can draw.

use super::{Forbidden, HalfPlane};
use glam::Vec2;

/// The origin of a constraint: an index into a list of the [`AvoidanceInput`](super::AvoidanceInput).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// One of the [neighbours](super::AvoidanceInput::neighbours).
    Neighbour(usize),
    /// One of the [edges](super::AvoidanceInput::edges).
    Edge(usize),
    /// One of the [discs](super::AvoidanceInput::discs).
    Disc(usize),
    /// The limits of the body itself.
    Body,
}

/// One of the facts that led to the velocity that a model chose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AvoidanceReason {
    /// A half-plane of permitted velocities: on the line or left of it.
    Permits(Cause, HalfPlane),
    /// A region of forbidden velocities.
    Forbids(Cause, Forbidden),
    /// What a neighbour or a wall adds in models of repulsion: to the acceleration, m/s^2, or to the direction,
    /// relative to the preferred direction of length 1.
    Push(Cause, Vec2),
    /// A velocity that was evaluated.
    Candidate {
        /// The velocity.
        velocity: Vec2,
        /// Its cost, lower is better; infinite if the velocity is forbidden.
        cost: f32,
    },
}

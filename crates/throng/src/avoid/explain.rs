//! Why a model chose a velocity, as data that a viewer can draw.

use super::{Forbidden, Line};
use glam::Vec2;

/// What a constraint comes from: an index into a list of the [`View`](super::View).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// One of the [neighbours](super::View::neighbours).
    Neighbour(usize),
    /// One of the [edges](super::View::edges).
    Edge(usize),
    /// One of the [discs](super::View::discs).
    Disc(usize),
    /// What the body itself can do.
    Body,
}

/// One of the things that led to the velocity that a model chose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// A half-plane of permitted velocities: on the line or left of it.
    Permits(Cause, Line),
    /// A region of forbidden velocities.
    Forbids(Cause, Forbidden),
    /// What a neighbour or a wall adds in models of repulsion: to the acceleration, m/s^2, or to the direction, the
    /// preferred direction being 1.
    Push(Cause, Vec2),
    /// A velocity that was tried.
    Candidate {
        /// The velocity.
        velocity: Vec2,
        /// What it costs, the less the better; infinite for one that is forbidden.
        cost: f32,
    },
}

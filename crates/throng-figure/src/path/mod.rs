//! The motion of the body over the ground.

mod recorded;
mod tracker;

pub(crate) use recorded::{CELL, Column, Recorded, gauss};
pub(crate) use tracker::{Extrapolated, Tracker};

use glam::DVec2;

/// Where an agent is at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time, s.
    pub time: f64,
    /// Position on the ground, m.
    pub position: DVec2,
    /// Direction in which the agent faces, rad, counterclockwise from the x axis.
    pub heading: f64,
}

/// The smoothed motion of a body at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Position on the ground, m.
    pub position: DVec2,
    /// Velocity, m/s.
    pub velocity: DVec2,
    /// Direction in which the body faces, rad. It does not jump by whole turns.
    pub heading: f64,
    /// Angular speed, rad/s, counterclockwise.
    pub turning: f64,
}

/// The motion of a body in the past and the near future: recorded, or extrapolated.
pub trait Ahead {
    /// Returns the motion at a time, s.
    fn at(&self, time: f64) -> Motion;
}

//! Footfalls: where and when feet are on the ground, and how they move there.

mod foot;
mod planner;

pub(crate) use foot::{FootPose, STRETCH, Swing, allowed_roll, foot_at, stance};
pub(crate) use planner::{Planner, along};

use crate::person::Side;
use glam::DVec2;

/// A foot on the ground, from the strike until it is lifted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plant {
    /// Position of the ankle above the ground, with the foot flat, m.
    pub ankle: DVec2,
    /// Direction of the foot, rad.
    pub yaw: f64,
    /// Time at which the foot touches the ground, s.
    pub strike: f64,
    /// Time at which the foot leaves the ground, s; infinite while it is not planned.
    pub lift: f64,
    /// Angle of the foot when it touches the ground, rad: positive on the heel, negative on the ball.
    pub pitch: f64,
    /// Time until the foot is flat, s.
    pub landing: f64,
    /// Angle by which the heel is raised when the foot leaves the ground, rad, at least: the leg may need more.
    pub roll: f64,
    /// Time during which the heel rises, s.
    pub rolling: f64,
    /// Velocity of the ankle when it touches the ground, m/s.
    pub arrival: DVec2,
}

impl Plant {
    /// Returns a flat foot that stands until its step is planned.
    pub fn standing(ankle: DVec2, yaw: f64, since: f64) -> Plant {
        Plant {
            ankle,
            yaw,
            strike: since,
            lift: f64::INFINITY,
            pitch: 0.0,
            landing: 0.1,
            roll: 0.0,
            rolling: 0.2,
            arrival: DVec2::ZERO,
        }
    }
}

/// A step: a foot is lifted and put down elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    pub side: Side,
    /// Time at which the foot is lifted, s.
    pub lift: f64,
    /// The rise of the heel before, rad, and its duration, s.
    pub roll: f64,
    pub rolling: f64,
    /// Where the foot is put down.
    pub plant: Plant,
    /// Phase at the lift, and at the strike.
    pub phases: [f64; 2],
}

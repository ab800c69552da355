//! Formations: places in the frame of a leader, by a pattern (gdx-ai's formations).

use crate::single::keep;
use glam::Vec3;
use std::f32::consts::{PI, TAU};
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};

/// The arrangement of the places of a formation. The leader is at the origin and faces x; y points to its left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Abreast: left, right, left, ever farther out.
    Line,
    /// One place behind the other.
    Column,
    /// A wedge: left, right, left, each pair farther out and back.
    Wedge,
    /// Round the leader, from ahead to the left.
    Circle,
    /// A square behind the leader, row by row from its left.
    Grid,
}

impl Pattern {
    /// Returns the `index`-th of `count` places, metres; neighbouring places are `spacing` apart.
    ///
    /// ```
    /// use glam::Vec3;
    /// use throng_steer::Pattern;
    /// assert_eq!(Pattern::Wedge.place(1, 4, 2.0), Vec3::new(-2.0, -2.0, 0.0));
    /// ```
    pub fn place(self, index: usize, count: usize, spacing: f32) -> Vec3 {
        let pair = (index / 2 + 1) as f32;
        let side = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        let place = match self {
            Self::Line => Vec3::new(0.0, side * pair, 0.0),
            Self::Column => Vec3::new(-(index as f32 + 1.0), 0.0, 0.0),
            Self::Wedge => Vec3::new(-pair, side * pair, 0.0),
            Self::Circle => {
                let half = PI / count.max(2) as f32;
                let (sin, cos) = libm::sincosf(TAU * index as f32 / count.max(1) as f32);
                Vec3::new(cos, sin, 0.0) * (0.5 / libm::sinf(half))
            }
            Self::Grid => {
                let wide = (1..).find(|wide| wide * wide >= count).unwrap_or(1);
                let (row, column) = (index / wide, index % wide);
                Vec3::new(-(row as f32 + 1.0), 0.5 * (wide as f32 - 1.0) - column as f32, 0.0)
            }
        };
        place * spacing
    }
}

/// Keeps the agent's [slot](SteeringInput::slot) in a formation that moves with a leader. [`assign`](super::assign) assigns
/// agents to slots.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{KeepFormation, Pattern};
/// let geese = KeepFormation {
///     leader: Target::Agent(0), pattern: Pattern::Wedge, count: 8, spacing: 1.5, slowing_distance: 3.0,
/// };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeepFormation {
    /// The leader.
    pub leader: Target,
    /// The arrangement of the places.
    pub pattern: Pattern,
    /// Number of places. Limit: >= 1.
    pub count: usize,
    /// Distance between neighbouring places, metres. Limit: > 0.
    pub spacing: f32,
    /// Distance from its place at which the agent begins to slow down, metres. Limit: >= 0.
    pub slowing_distance: f32,
}

impl Behaviour for KeepFormation {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let leader = self.leader.find(view)?;
        let place = self.pattern.place(view.slot, self.count, self.spacing);
        Some(keep(view, &leader, place, self.slowing_distance, why))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.count > 0, "number of places", self.count as f64, "1 or more")?;
        Error::unless_positive("spacing", self.spacing)?;
        Error::unless(self.slowing_distance >= 0.0, "slowing distance", self.slowing_distance, "0 or more")
    }
}

//! Formations: places in the frame of a leader, by a pattern (gdx-ai's formations).

use crate::single::{SLOWING_DISTANCE, keep};
use crate::{ForGroup, GroupFacts};
use glam::Vec3;
use std::f32::consts::{PI, TAU};
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, Target, TraceRecorder};

/// The arrangement of the places of a formation.
///
/// The leader is at the origin and faces x; y points to its left.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Abreast, alternating left and right, farther and farther out.
    Line,
    /// In single file.
    Column,
    /// A wedge, alternating left and right, each pair farther out and back.
    Wedge,
    /// Around the leader, from ahead to the left.
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

/// Keeps its place in a formation that moves with a leader: the k-th agent of the group has the k-th place.
///
/// The place of an agent is its [slot](SteeringInput::slot). [`assign`](super::assign) assigns agents to slots.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{KeepFormation, Pattern};
/// let geese = KeepFormation { count: Some(8), ..KeepFormation::new(Target::Agent(0), Pattern::Wedge, 1.5_f32) };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeepFormation {
    /// The leader.
    #[parameter(required)]
    pub leader: Target,
    /// The arrangement of the places.
    #[parameter(required)]
    pub pattern: Pattern,
    /// The number of places. Without it, as many as the group has agents; in code it must be given.
    #[parameter(least = 1)]
    pub count: Option<usize>,
    /// Distance between neighbouring places, metres.
    #[parameter(required, unit = "m", above = 0)]
    pub spacing: f32,
    /// Distance from its place at which it starts to slow down, metres.
    #[parameter(default = SLOWING_DISTANCE, unit = "m", least = 0)]
    pub slowing_distance: f32,
}

impl ForGroup for KeepFormation {
    fn for_group(self, group: &GroupFacts) -> Result<BoxedBehaviour, Error> {
        Ok(Self { count: self.count.or(Some(group.agents)), ..self }.into())
    }
}

impl Behaviour for KeepFormation {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let leader = self.leader.find(view)?;
        let place = self.pattern.place(view.slot(), self.count?, self.spacing);
        Some(keep(view, &leader, place, self.slowing_distance, why))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.count.is_some(), "count", 0.0, "1 or more")?;
        self.check_limits()
    }
}

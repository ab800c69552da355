//! The columns of tables of trajectories.

use crate::Body;
use std::fmt;
use std::str::FromStr;

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// The agent's own number.
    Number,
    /// The name of its group; its index where it has no name.
    Group,
    /// Time since the start, seconds.
    Time,
    /// Centre, world coordinates, metres.
    X,
    /// Centre, world coordinates, metres.
    Y,
    /// Height of the centre above the ground, metres.
    Z,
    /// Velocity along x, m/s.
    Vx,
    /// Velocity along y, m/s.
    Vy,
    /// Velocity upwards, m/s.
    Vz,
    /// Direction of the body, radians counter-clockwise from +x.
    Heading,
    /// Radius of the body, metres; of one that is no disc, half of its narrower side.
    Radius,
    /// What it is doing: `walking`, `waiting`, `arrived` or `stranded`.
    Status,
}

impl Column {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Number,
        Self::Group,
        Self::Time,
        Self::X,
        Self::Y,
        Self::Z,
        Self::Vx,
        Self::Vy,
        Self::Vz,
        Self::Heading,
        Self::Radius,
        Self::Status,
    ];

    /// What tables call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Number => "number",
            Self::Group => "group",
            Self::Time => "time",
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::Vx => "vx",
            Self::Vy => "vy",
            Self::Vz => "vz",
            Self::Heading => "heading",
            Self::Radius => "radius",
            Self::Status => "status",
        }
    }

    /// Its value, where that is a number of single precision.
    pub(super) fn single(self) -> Option<fn(&Body) -> f32> {
        Some(match self {
            Self::Z => |body| body.altitude,
            Self::Vx => |body| body.velocity.x,
            Self::Vy => |body| body.velocity.y,
            Self::Vz => |body| body.climb,
            Self::Heading => |body| body.heading,
            Self::Radius => |body| body.shape().girth(),
            _ => return None,
        })
    }
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Column {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|column| column.name() == text);
        found.ok_or_else(|| format!("there is: {}", Self::ALL.map(Self::name).join(", ")))
    }
}

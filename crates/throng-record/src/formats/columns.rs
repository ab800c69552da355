//! The columns of tables of trajectories.

use crate::Body;
use std::fmt;
use std::str::FromStr;

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// The agent number.
    Number,
    /// The name of the group; its index if the group has no name.
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
    /// Radius of the body, metres; for bodies other than discs, half of the narrower side.
    Radius,
    /// The agent's status: `walking`, `waiting`, `arrived` or `stranded`.
    Status,
}

impl Column {
    /// All columns.
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

    /// Returns the name of the column in tables.
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

    /// Returns the function of the column's value, if the value is an `f32`.
    pub(super) fn single(self) -> Option<fn(&Body) -> f32> {
        Some(match self {
            Self::Z => |body| body.altitude,
            Self::Vx => |body| body.velocity.x,
            Self::Vy => |body| body.velocity.y,
            Self::Vz => |body| body.vertical_velocity,
            Self::Heading => |body| body.heading,
            Self::Radius => |body| body.shape().clearance_radius(),
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
        found.ok_or_else(|| format!("the columns are: {}", Self::ALL.map(Self::name).join(", ")))
    }
}

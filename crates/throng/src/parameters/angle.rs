//! Angles: radians in code, degrees in files.

use serde::{Deserialize, Serialize};

/// An angle: radians in code, degrees in files.
///
/// ```
/// use throng::parameters::Angle;
/// assert_eq!(Angle::degrees(180.0).radians(), std::f32::consts::PI);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd, Serialize, Deserialize)]
pub struct Angle(f32);

impl Angle {
    /// Returns an angle of this many degrees.
    pub const fn degrees(degrees: f64) -> Self {
        Self(degrees.to_radians() as f32)
    }

    /// Returns an angle of this many radians.
    pub const fn from_radians(radians: f32) -> Self {
        Self(radians)
    }

    /// Returns the radians.
    pub const fn radians(self) -> f32 {
        self.0
    }

    /// Returns the degrees with the fewest decimals that are this angle.
    pub fn to_degrees(self) -> f64 {
        let degrees = f64::from(self.0).to_degrees();
        let rounded = (0..10).filter_map(|decimals| format!("{degrees:.decimals$}").parse().ok());
        rounded.into_iter().find(|rounded| Self::degrees(*rounded) == self).unwrap_or(degrees)
    }
}

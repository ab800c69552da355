//! The state of motion of a vehicle, which a step changes.

use super::Basis;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// The position of a vehicle and its motion. Metres, seconds.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Motion;
/// let motion = Motion { velocity: Vec3::X * 2.0, ..Motion::default() };
/// assert_eq!(motion.position_in(3.0), Vec3::X * 6.0);
/// // half way round a circle of one metre radius
/// let turning = Motion { curvature: Vec3::Y, ..motion };
/// assert!(turning.curved_position_in(std::f32::consts::FRAC_PI_2).distance(Vec3::Y * 2.0) < 1e-5);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Position of the centre.
    pub position: Vec3,
    /// Velocity. It is along forward for a vehicle that faces its direction of motion.
    pub velocity: Vec3,
    /// Orientation.
    pub basis: Basis,
    /// The last acceleration, smoothed ([`Vehicle::smoothing`](super::Vehicle::smoothing)).
    pub acceleration: Vec3,
    /// The curvature of the path, smoothed: a vector towards the centre of the circle, with the inverse radius as its
    /// length.
    pub curvature: Vec3,
}

/// The part of a vehicle's [`Motion`] besides position and velocity, which are stored elsewhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Attitude {
    /// Orientation.
    pub basis: Basis,
    /// As [`Motion::acceleration`].
    pub acceleration: Vec3,
    /// As [`Motion::curvature`].
    pub curvature: Vec3,
}

impl Attitude {
    /// Returns the attitude of a vehicle at rest, upright, with a heading, radians counter-clockwise from +x.
    pub fn heading(heading: f32) -> Self {
        let (sin, cos) = libm::sincosf(heading);
        Self { basis: Basis::facing(Vec3::new(cos, sin, 0.0)), ..Self::default() }
    }

    /// Returns the components: forward, side, up, acceleration, curvature, and a zero.
    #[inline]
    pub(crate) fn record(self) -> [f32; 16] {
        let Self { basis: Basis { forward: f, side: s, up: u }, acceleration: a, curvature: c } = self;
        [f.x, f.y, f.z, s.x, s.y, s.z, u.x, u.y, u.z, a.x, a.y, a.z, c.x, c.y, c.z, 0.0]
    }

    /// Returns the attitude of a [`record`](Self::record).
    #[inline]
    pub(crate) fn of_record(record: &[f32; 16]) -> Self {
        let v = |at: usize| Vec3::new(record[at], record[at + 1], record[at + 2]);
        Self { basis: Basis { forward: v(0), side: v(3), up: v(6) }, acceleration: v(9), curvature: v(12) }
    }

    /// Returns the motion with this attitude at a position with a velocity.
    pub fn motion(self, position: Vec3, velocity: Vec3) -> Motion {
        let Self { basis, acceleration, curvature } = self;
        Motion { position, velocity, basis, acceleration, curvature }
    }
}

impl From<Motion> for Attitude {
    fn from(motion: Motion) -> Self {
        let Motion { basis, acceleration, curvature, .. } = motion;
        Self { basis, acceleration, curvature }
    }
}

impl Motion {
    /// Returns a motion that stands at a position, upright, facing a direction.
    pub fn at_rest(position: Vec3, facing: Vec3) -> Self {
        Self { position, basis: Basis::facing(facing), ..Self::default() }
    }

    /// Returns a motion at a position with a velocity, upright, facing the direction of motion.
    pub fn moving(position: Vec3, velocity: Vec3) -> Self {
        Self { position, velocity, basis: Basis::facing(velocity), ..Self::default() }
    }

    /// Returns the speed, m/s.
    pub fn speed(&self) -> f32 {
        self.velocity.length()
    }

    /// Returns the position after `seconds` at constant velocity.
    pub fn position_in(&self, seconds: f32) -> Vec3 {
        self.position + self.velocity * seconds
    }

    /// Returns the position after `seconds` at constant speed and curvature.
    pub fn curved_position_in(&self, seconds: f32) -> Vec3 {
        let (speed, bend) = (self.speed(), self.curvature.length());
        let angle = bend * speed * seconds;
        if angle.abs() < 1e-3 {
            return self.position_in(seconds);
        }
        let (sin, cos) = libm::sincosf(angle);
        self.position + self.velocity * (sin / (bend * speed)) + self.curvature * ((1.0 - cos) / (bend * bend))
    }
}

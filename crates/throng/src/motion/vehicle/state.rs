//! How a vehicle moves: the state that a step changes.

use super::Basis;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Where a vehicle is and how it moves. Metres, seconds.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Motion;
/// let motion = Motion { velocity: Vec3::X * 2.0, ..Motion::default() };
/// assert_eq!(motion.position_in(3.0), Vec3::X * 6.0);
/// // on a circle of one metre, half way round
/// let turning = Motion { curvature: Vec3::Y, ..motion };
/// assert!(turning.curved_position_in(std::f32::consts::FRAC_PI_2).distance(Vec3::Y * 2.0) < 1e-5);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Where its centre is.
    pub position: Vec3,
    /// Its velocity; along forward for those who look where they go.
    pub velocity: Vec3,
    /// Which way it faces.
    pub basis: Basis,
    /// The acceleration it last had, smoothed ([`Vehicle::smoothing`](super::Vehicle::smoothing)).
    pub acceleration: Vec3,
    /// How its path bends, smoothed: towards the centre of the circle, one over its radius long.
    pub curvature: Vec3,
}

/// How a vehicle holds itself, wherever it is and however fast: what of its [`Motion`] others do not keep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Attitude {
    /// Which way it faces.
    pub basis: Basis,
    /// As [`Motion::acceleration`].
    pub acceleration: Vec3,
    /// As [`Motion::curvature`].
    pub curvature: Vec3,
}

impl Attitude {
    /// At a place, with a velocity.
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
    /// At rest at a place, facing a direction upright.
    pub fn at_rest(position: Vec3, facing: Vec3) -> Self {
        Self { position, basis: Basis::facing(facing), ..Self::default() }
    }

    /// At a place with a velocity, looking where it goes, upright.
    pub fn moving(position: Vec3, velocity: Vec3) -> Self {
        Self { position, velocity, basis: Basis::facing(velocity), ..Self::default() }
    }

    /// How fast it moves, m/s.
    pub fn speed(&self) -> f32 {
        self.velocity.length()
    }

    /// Where it will be in so many seconds if it keeps its velocity.
    pub fn position_in(&self, seconds: f32) -> Vec3 {
        self.position + self.velocity * seconds
    }

    /// Where it will be in so many seconds if it keeps its speed and the curvature of its path.
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

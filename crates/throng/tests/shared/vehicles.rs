//! Vehicles of tests.

use glam::Vec3;
use proptest::prelude::*;
use throng::motion::{Locomotion, Vehicle};

/// Time steps at which the documented properties of behaviours hold, seconds.
pub const RATES: [f32; 3] = [1.0 / 15.0, 1.0 / 60.0, 1.0 / 240.0];

pub fn vector(range: f32) -> impl Strategy<Value = Vec3> {
    (-range..range, -range..range, -range..range).prop_map(Vec3::from)
}

pub fn angle(a: Vec3, b: Vec3) -> f32 {
    a.cross(b).length().atan2(a.dot(b))
}

pub fn flier() -> Vehicle {
    Vehicle { locomotion: Locomotion::Level, ..Vehicle::default() }
}

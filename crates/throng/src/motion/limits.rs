//! Limits of acceleration, speed and turning.

use super::angle::angle;
use glam::{Vec2, Vec3};

/// The limits of a body's motion in one step.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Top speed, m/s.
    pub speed: f32,
    /// Greatest change of velocity in the step, m/s.
    pub change: f32,
    /// Greatest angle between the horizontal direction of motion and the heading in the step, radians.
    pub turn: f32,
}

/// Returns the velocity nearest to the chosen velocity that a body with this velocity and heading can have after a
/// step.
pub fn limit(chosen: Vec3, velocity: Vec3, heading: f32, limits: Limits) -> Vec3 {
    let turns = limits.turn < std::f32::consts::PI;
    let chosen = if turns { turned(chosen.truncate(), heading, limits.turn).extend(chosen.z) } else { chosen };
    let change = (chosen - velocity).clamp_length_max(limits.change);
    (velocity + change).clamp_length_max(limits.speed)
}

/// Returns the part of the chosen velocity that lies within `most` radians of `heading`.
fn turned(chosen: Vec2, heading: f32, most: f32) -> Vec2 {
    let forward = Vec2::new(libm::cosf(heading), libm::sinf(heading));
    let aside = angle(Vec2::new(forward.dot(chosen), forward.perp_dot(chosen)));
    if aside.abs() <= most {
        return chosen;
    }
    let angle = heading + aside.clamp(-most, most);
    let along = Vec2::new(libm::cosf(angle), libm::sinf(angle));
    along * chosen.dot(along).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acceleration_is_limited() {
        let limits = Limits { speed: 2.0, change: 0.1, turn: f32::INFINITY };
        let v = limit(Vec3::new(2.0, 0.0, 1.0), Vec3::ZERO, 0.0, limits);
        assert!((v.length() - 0.1).abs() < 1e-6);
    }

    #[test]
    fn a_body_that_turns_slowly_goes_round() {
        let limits = Limits { speed: 2.0, change: 9.0, turn: 0.2 };
        let v = limit(Vec3::Y, Vec3::X, 0.0, limits);
        assert!((libm::atan2f(v.y, v.x) - 0.2).abs() < 1e-6, "{v}");
        assert_eq!(limit(-Vec3::X, Vec3::X, 0.0, limits), Vec3::ZERO, "it stops rather than skid backwards");
    }
}

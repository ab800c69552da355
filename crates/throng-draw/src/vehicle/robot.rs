//! Robots on two wheels: a round body with a visor that shows the heading, and an antenna.

use super::loft::{Loft, rounded};
use super::motion::Drive;
use super::{Chassis, light, paint};
use crate::Color;
use glam::{Vec2, Vec3};
use throng_record::Body;

/// The radius of the body, that of a wheel, half the width of a wheel, and the distance of wheels from the middle, in radii
/// of the agent.
const BODY: f32 = 0.72;
const WHEEL: Vec2 = Vec2::new(0.4, 0.085);
const TRACK: f32 = 0.82;
/// The angle of the visor to both sides, radians, and its heights, in radii.
const VISOR: f32 = 0.85;
const VISOR_HEIGHTS: [f32; 2] = [0.86, 1.12];
/// Levels of the body and of the antenna: height and radius, in radii.
const SHELL: [[f32; 2]; 12] = [
    [0.16, 0.60],
    [0.22, 0.69],
    [0.36, BODY],
    [0.78, BODY],
    [0.86, 0.715],
    [0.95, 0.71],
    [1.04, 0.70],
    [1.12, 0.68],
    [1.22, 0.60],
    [1.30, 0.46],
    [1.34, 0.28],
    [1.35, 0.12],
];
const ANTENNA: [[f32; 2]; 6] = [[1.2, 0.025], [1.85, 0.02], [1.86, 0.06], [1.91, 0.08], [1.96, 0.06], [1.975, 0.02]];
const BACK: f32 = -0.36;
const DARK: u32 = 0x22_262c;
const EYE: u32 = 0xd8_f1ff;
const RUBBER: u32 = 0x2a_2b2e;
const RIM: u32 = 0xb9_bdc2;
const GAP: u32 = 0x44_474c;

/// Returns the sizes of a robot.
pub(super) fn chassis(body: &Body) -> Chassis {
    let radius = body.shape().clearance_radius();
    Chassis { half: Vec2::splat(radius), axle: 0.0, track: TRACK * radius, wheel: WHEEL * radius }
}

/// Returns the body, which is a little glossy, and the wheels, with how much each mirrors.
pub(super) fn parts(chassis: &Chassis, drive: &Drive, coat: Color, fine: bool) -> Vec<(Loft, f32)> {
    let (radius, coat) = (chassis.half.x, paint(coat));
    let corners = if fine { 9 } else { 5 };
    let ring = |middle: f32, height: f32, size: f32| {
        let ends = [middle - size, middle + size].map(|x| x * radius);
        rounded(ends, size * radius, height * radius, 1.0, [corners, 1])
    };
    let mut shell = Loft::default();
    let rings: Vec<Vec<Vec3>> = SHELL.iter().map(|&[height, size]| ring(0.0, height, size)).collect();
    shell.add(&rings, |_, middle| {
        let (angle, height) = (libm::atan2f(middle.y, middle.x), middle.z / radius);
        let visor = angle.abs() < VISOR && height > VISOR_HEIGHTS[0] && height < VISOR_HEIGHTS[1];
        if visor || height < 0.3 { light(DARK) } else { coat }
    });
    let rings: Vec<Vec<Vec3>> = ANTENNA.iter().map(|&[height, size]| ring(BACK, height, size)).collect();
    shell.add(&rings, |_, middle| if middle.z > 1.855 * radius { coat } else { light(DARK) });
    for side in [1.0, -1.0] {
        eye(&mut shell, radius, side * 0.34);
    }
    let mut wheels = Loft::default();
    let tones = [RUBBER, RIM, GAP].map(light);
    for (k, y) in [chassis.track, -chassis.track].into_iter().enumerate() {
        let centre = Vec3::new(0.0, y, chassis.wheel.x);
        wheels.wheel((centre, chassis.wheel), (drive.rolled[1][k], 0.0), if fine { 20 } else { 10 }, tones);
    }
    vec![(shell, 0.25), (wheels, 0.0)]
}

/// Adds an eye on the visor at an angle to the heading, radians.
fn eye(shell: &mut Loft, radius: f32, angle: f32) {
    const AROUND: usize = 10;
    let (sin, cos) = libm::sincosf(angle);
    let (out, aside) = (Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0));
    let centre = out * (0.725 * radius) + Vec3::Z * (0.99 * radius);
    let corner = |k: usize| {
        let (sin, cos) = libm::sincosf(std::f32::consts::TAU * k as f32 / AROUND as f32);
        centre + (aside * cos + Vec3::Z * sin) * (0.07 * radius)
    };
    shell.flat(&(0..AROUND).map(corner).collect::<Vec<_>>(), light(EYE));
}

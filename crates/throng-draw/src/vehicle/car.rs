//! Cars as architects' models have them: a shell with round edges, a cabin of glass, wheels.

use super::loft::{HUB, Loft, rounded};
use super::motion::Drive;
use super::{Chassis, light, paint};
use crate::Color;
use crate::shape::CAR;
use glam::{Vec2, Vec3};
use throng_record::Body;

/// The width of a car that is a disc, in lengths.
const SLIM: f32 = 0.45;
/// The distance of the axles from the middle, in half lengths.
const AXLE: f32 = 0.62;
/// The radius of a wheel, in half lengths, at most in half widths; half its width, in half widths.
const WHEEL: [f32; 2] = [0.165, 0.4];
const TYRE: f32 = 0.12;
/// How much the bonnet falls towards the front, and where it begins to, in half widths and half lengths.
const FALL: f32 = 0.13;
const BONNET: f32 = 0.35;
/// Half the width of a pillar, in half lengths.
const PILLAR: f32 = 0.045;
const GLASS: u32 = 0x2b_3640;
const RUBBER: u32 = 0x26_2729;
const RIM: u32 = 0xb4_b8bc;
const GAP: u32 = 0x3c_3e42;
const TRIM: u32 = 0x30_3236;
const LAMP: u32 = 0xf2_f0e6;
const TAIL: u32 = 0xb0_2a24;

/// Levels of the shell and of the cabin: height in half widths, back and front in half lengths, half width.
type Level = (f32, [f32; 2], f32);
const SHELL: [Level; 8] = [
    (0.20, [-0.93, 0.93], 0.84),
    (0.26, [-0.975, 0.97], 0.94),
    (0.38, [-0.995, 0.995], 0.975),
    (0.50, [-1.0, 1.0], 0.985),
    (0.66, [-0.995, 0.985], 0.98),
    (0.80, [-0.985, 0.955], 0.965),
    (0.87, [-0.965, 0.915], 0.93),
    (0.90, [-0.93, 0.86], 0.87),
];
const CABIN: [Level; 6] = [
    (0.84, [-0.86, 0.42], 0.86),
    (0.93, [-0.83, 0.38], 0.855),
    (1.35, [-0.62, 0.08], 0.73),
    (1.45, [-0.57, 0.02], 0.69),
    (1.53, [-0.50, -0.04], 0.62),
    (1.56, [-0.40, -0.12], 0.48),
];

/// Returns the sizes of a car: those of a body with a core, or of a car in a disc.
pub(super) fn chassis(body: &Body) -> Chassis {
    let half = if body.core == Vec2::ZERO { Vec2::new(CAR, CAR * SLIM) * body.radius } else { body.core + body.radius };
    let radius = (WHEEL[0] * half.x).min(WHEEL[1] * half.y);
    let wheel = Vec2::new(radius, TYRE * half.y);
    Chassis { half, axle: AXLE * half.x, track: half.y - HUB * wheel.y, wheel }
}

/// Returns the shell, which is glossy, and the wheels, with how much each mirrors.
pub(super) fn parts(chassis: &Chassis, drive: &Drive, coat: Color, fine: bool) -> Vec<(Loft, f32)> {
    let (half, coat) = (chassis.half, paint(coat));
    let [corners, along] = if fine { [6, 13] } else { [3, 7] };
    let ring = |(height, [back, front], side): &Level| -> Vec<Vec3> {
        let ring = rounded([back * half.x, front * half.x], side * half.y, height * half.y, 0.34, [corners, along]);
        let fall = |at: Vec3| FALL * half.y * ((at.x / half.x - BONNET) / (1.0 - BONNET)).clamp(0.0, 1.0).powi(2);
        // the whole height falls in proportion
        ring.into_iter().map(|at| at.with_z(at.z - fall(at) * (at.z / (0.9 * half.y)).powi(2))).collect()
    };
    let mut shell = Loft::default();
    let rings: Vec<Vec<Vec3>> = SHELL.iter().map(ring).collect();
    shell.add(&rings, |level, middle| {
        let (ahead, aside) = (middle.x / half.x, middle.y.abs() / half.y);
        match level {
            0 | 1 => light(TRIM),
            2 if ahead > 0.9 && aside < 0.6 => light(TRIM),
            3 if ahead > 0.9 && aside > 0.55 => light(LAMP),
            3 if ahead < -0.92 && aside > 0.55 => light(TAIL),
            _ => coat,
        }
    });
    let rings: Vec<Vec<Vec3>> = CABIN.iter().map(ring).collect();
    shell.add(&rings, |level, middle| {
        // the cabin between the second and the third ring is glass, with a pillar behind the doors
        let side = middle.y.abs() > 0.7 * half.y;
        let pillar = side && (middle.x / half.x + 0.25).abs() < PILLAR;
        if level == 1 && !pillar { light(GLASS) } else { coat }
    });
    let mut wheels = Loft::default();
    let around = if fine { 20 } else { 10 };
    let tones = [RUBBER, RIM, GAP].map(light);
    for (axle, x) in [chassis.axle, -chassis.axle].into_iter().enumerate() {
        for (k, y) in [chassis.track, -chassis.track].into_iter().enumerate() {
            let steered = if axle == 0 { drive.steered[k] } else { 0.0 };
            let centre = Vec3::new(x, y, chassis.wheel.x);
            wheels.wheel((centre, chassis.wheel), (drive.rolled[axle][k], steered), around, tones);
            arch(&mut wheels, chassis, x, y.signum(), around);
        }
    }
    vec![(shell, 0.45), (wheels, 0.0)]
}

/// Adds the dark arch of a wheel on the side of the shell.
fn arch(loft: &mut Loft, chassis: &Chassis, x: f32, side: f32, around: usize) {
    let out = 1.2 * chassis.wheel.x;
    let y = side * 0.988 * chassis.half.y;
    let at = |k: usize| {
        let (sin, cos) = libm::sincosf(std::f32::consts::PI * k as f32 / around as f32);
        Vec3::new(x - side * cos * out, y, chassis.wheel.x + sin * out)
    };
    let low = [at(0), at(around)].map(|end| end.with_z(0.2 * chassis.half.y));
    let corners: Vec<Vec3> = [low[1]].into_iter().chain([low[0]]).chain((0..=around).map(at)).collect();
    loft.flat(&corners, light(TRIM));
}

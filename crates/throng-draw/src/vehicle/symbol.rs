//! Vehicles from above: polygons in the axes of the vehicle, x ahead and y to the left, metres; the first are below.

use super::Chassis;
use super::loft::rounded;
use super::motion::Drive;
use crate::Color;
use glam::Vec2;

const RUBBER: Color = Color::rgb(0x26_2729);
const GLASS: Color = Color::rgb(0x36_424d);
const LAMP: Color = Color::rgb(0xf7_f3e2);
const TAIL: Color = Color::rgb(0xb0_2a24);
/// The width of the edge, in half widths.
const EDGE: f32 = 0.08;

/// Returns a car: wheels, edge, body, glass and lights.
pub(super) fn car(chassis: &Chassis, drive: &Drive, fill: Color, rim: Color) -> Vec<(Vec<Vec2>, Color)> {
    let half = chassis.half;
    let at = |x: f32, y: f32| Vec2::new(x * half.x, y * half.y);
    let mut areas = Vec::new();
    for (axle, x) in [chassis.axle, -chassis.axle].into_iter().enumerate() {
        for (k, y) in [chassis.track, -chassis.track].into_iter().enumerate() {
            let steered = if axle == 0 { drive.steered[k] } else { 0.0 };
            areas.push((wheel(chassis, Vec2::new(x, y), steered), RUBBER));
        }
    }
    let body = |edge: f32| outline([edge - half.x, half.x - edge], half.y - edge, 0.4);
    areas.extend([(body(0.0), rim), (body(EDGE * half.y), fill)]);
    // windscreen, rear window, and the windows of both sides
    areas.push((vec![at(0.38, 0.74), at(0.38, -0.74), at(0.08, -0.6), at(0.08, 0.6)], GLASS));
    areas.push((vec![at(-0.82, -0.7), at(-0.82, 0.7), at(-0.6, 0.58), at(-0.6, -0.58)], GLASS));
    for side in [1.0, -1.0] {
        areas.push((
            vec![at(0.3, 0.8 * side), at(0.06, 0.68 * side), at(-0.58, 0.66 * side), at(-0.74, 0.78 * side)],
            GLASS,
        ));
        for (x, color) in [(0.93, LAMP), (-0.95, TAIL)] {
            let corner = |dx: f32, dy: f32| at(x + dx, side * (0.66 + dy));
            areas
                .push((vec![corner(0.03, -0.16), corner(0.03, 0.1), corner(-0.03, 0.16), corner(-0.03, -0.16)], color));
        }
    }
    areas
}

/// Returns a robot: wheels, edge, body and visor.
pub(super) fn robot(chassis: &Chassis, fill: Color, rim: Color) -> Vec<(Vec<Vec2>, Color)> {
    let radius = chassis.half.x;
    let disc = |share: f32| outline([-share * radius, share * radius], share * radius, 1.0);
    let wheels = [chassis.track, -chassis.track].map(|y| (wheel(chassis, Vec2::new(0.0, y), 0.0), RUBBER));
    let arc = |share: f32| (0..=8).map(move |k| Vec2::from_angle(0.2 * (k as f32 - 4.0)) * (share * radius));
    let visor: Vec<Vec2> = arc(0.72).chain(arc(0.46).collect::<Vec<_>>().into_iter().rev()).collect();
    wheels.into_iter().chain([(disc(0.76), rim), (disc(0.7), fill), (visor, GLASS)]).collect()
}

/// Returns a wheel at a place, steered to the left, radians.
fn wheel(chassis: &Chassis, place: Vec2, steered: f32) -> Vec<Vec2> {
    let (half, turn) = (chassis.wheel, Vec2::from_angle(steered));
    let corners = [Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0), Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0)];
    corners.map(|corner| place + turn.rotate(corner * half)).to_vec()
}

fn outline(ends: [f32; 2], half: f32, round: f32) -> Vec<Vec2> {
    rounded(ends, half, 0.0, round, [6, 1]).into_iter().map(|corner| corner.truncate()).collect()
}

//! How wheels roll and steer.

use super::Chassis;
use glam::DVec2;
use std::f32::consts::{PI, TAU};
use throng_record::Body;

/// The largest angle of a front wheel, radians.
const MOST: f32 = 0.6;
/// The distance over which the curvature of the path is measured, in wheelbases.
const OVER: f32 = 0.35;
/// The time in which wheels turn to another angle at least, seconds.
const SLOW: f32 = 0.12;
/// A vehicle that is faster, m/s, has been moved, and its wheels do not roll.
const FASTEST: f64 = 80.0;

/// The state of the wheels of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Drive {
    position: DVec2,
    heading: f32,
    /// The way ahead and the turn to the left since the curvature was measured, metres and radians.
    since: [f32; 2],
    /// The curvature of the path, to the left, 1/m; and what the wheels show of it.
    measured: f32,
    curvature: f32,
    /// The angles by which the wheels have rolled, radians: left and right, those ahead first.
    pub rolled: [[f32; 2]; 2],
    /// The angles of the front wheels to the left, radians: left and right.
    pub steered: [f32; 2],
}

impl Drive {
    /// Returns the state of a vehicle that appears.
    pub fn new(body: &Body) -> Self {
        let (position, heading) = (body.position, body.heading);
        Self {
            position,
            heading,
            since: [0.0; 2],
            measured: 0.0,
            curvature: 0.0,
            rolled: [[0.0; 2]; 2],
            steered: [0.0; 2],
        }
    }

    /// Returns the state after `step` seconds, greater than 0.
    pub fn next(&self, body: &Body, chassis: Chassis, step: f32) -> Self {
        let moved = body.position - self.position;
        let turned = around(body.heading - self.heading);
        if moved.length() > FASTEST * f64::from(step) {
            return Self { position: body.position, heading: body.heading, ..*self };
        }
        // along the heading in the middle of the step
        let ahead = DVec2::from_angle(f64::from(self.heading + 0.5 * turned));
        let way = moved.dot(ahead) as f32;
        let mut next = Self { position: body.position, heading: body.heading, ..*self };
        let base = 2.0 * chassis.axle;
        if base > 0.0 {
            next.measure(way, turned, base, step);
        }
        let offsets = [chassis.track, -chassis.track];
        for (k, side) in offsets.into_iter().enumerate() {
            // a wheel to the left drives less in a turn to the left
            let along = way - side * turned;
            let front = along.hypot(base * turned).copysign(along);
            for (axle, rolled) in [front, along].into_iter().enumerate() {
                next.rolled[axle][k] = (self.rolled[axle][k] + rolled / chassis.wheel.x) % TAU;
            }
            // the wheels point across the lines to the centre of the turn (Ackermann)
            let lean = libm::atan2f(base * next.curvature, 1.0 - side * next.curvature);
            next.steered[k] = lean.clamp(-MOST, MOST);
        }
        next
    }

    /// Measures the curvature of the path, and turns the wheels towards it.
    fn measure(&mut self, way: f32, turned: f32, base: f32, step: f32) {
        self.since = [self.since[0] + way, self.since[1] + turned];
        let [along, turn] = self.since;
        let most = libm::tanf(MOST) / base;
        if along.abs() > OVER * base || turn.abs() > most * OVER * base {
            let curvature = if along.abs() > 1e-6 { turn / along } else { most.copysign(turn) };
            self.measured = curvature.clamp(-most, most);
            self.since = [0.0; 2];
        }
        self.curvature += (self.measured - self.curvature) * (step / SLOW).min(1.0);
    }
}

/// Returns an angle from -π to π.
fn around(angle: f32) -> f32 {
    let turned = angle % TAU;
    if turned > PI {
        turned - TAU
    } else if turned < -PI {
        turned + TAU
    } else {
        turned
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    const CHASSIS: Chassis = Chassis { half: Vec2::new(2.1, 0.9), axle: 1.3, track: 0.75, wheel: Vec2::new(0.33, 0.1) };

    fn body(position: DVec2, heading: f32) -> Body {
        Body { position, heading, ..crate::vehicle::tests::body() }
    }

    /// Drives a course of places and headings at 25 moments a second.
    fn driven(course: impl Iterator<Item = (DVec2, f32)>, chassis: Chassis) -> Drive {
        let mut bodies = course.map(|(position, heading)| body(position, heading));
        let first = Drive::new(&bodies.next().unwrap());
        bodies.fold(first, |drive, body| drive.next(&body, chassis, 0.04))
    }

    fn near(a: f32, b: f32, most: f32) {
        assert!(around(a - b).abs() < most, "{a} and {b}");
    }

    #[test]
    fn wheels_roll_by_the_distance_over_the_radius() {
        let way = |k: i32| DVec2::from_angle(0.7) * 0.11 * f64::from(k);
        let ahead = driven((0..=50).map(|k| (way(k), 0.7)), CHASSIS);
        ahead.rolled.as_flattened().iter().for_each(|rolled| near(*rolled, 5.5 / 0.33, 1e-3));
        let back = driven((0..=50).map(|k| (way(-k), 0.7)), CHASSIS);
        back.rolled.as_flattened().iter().for_each(|rolled| near(*rolled, -5.5 / 0.33, 1e-3));
        assert_eq!(ahead.steered, [0.0; 2]);
    }

    #[test]
    fn front_wheels_steer_across_the_lines_to_the_centre_of_a_circle() {
        for (radius, sign) in [(8.0, 1.0), (8.0, -1.0), (20.0, 1.0)] {
            // along x at first, 0.1 m a moment
            let centre = DVec2::new(0.0, sign * radius);
            let course = (0..200).map(|k| {
                let angle = sign * f64::from(k) * 0.1 / radius;
                (centre + DVec2::from_angle(angle).rotate(-centre), angle as f32)
            });
            let drive = driven(course, CHASSIS);
            let (radius, sign) = (radius as f32, sign as f32);
            let inner = (2.6 / (radius - 0.75)).atan();
            let outer = (2.6 / (radius + 0.75)).atan();
            let expected = if sign > 0.0 { [inner, outer] } else { [-outer, -inner] };
            for (steered, expected) in drive.steered.into_iter().zip(expected) {
                near(steered, expected, 0.01);
            }
            // the wheel on the inside rolls less
            let way = 19.9f32;
            let [left, right] = [0.75f32, -0.75].map(|side| way * (1.0 - sign * side / radius) / 0.33);
            near(drive.rolled[1][0], left, 0.02);
            near(drive.rolled[1][1], right, 0.02);
        }
    }

    #[test]
    fn a_robot_that_turns_on_the_spot_rolls_its_wheels_against_each_other() {
        let chassis = Chassis { axle: 0.0, track: 0.16, wheel: Vec2::new(0.08, 0.02), ..CHASSIS };
        let drive = driven((0..=25).map(|k| (DVec2::ZERO, 0.04 * k as f32)), chassis);
        near(drive.rolled[1][0], -0.16 / 0.08, 1e-3);
        near(drive.rolled[1][1], 0.16 / 0.08, 1e-3);
        assert_eq!(drive.steered, [0.0; 2]);
    }

    #[test]
    fn steering_is_limited_and_turns_gradually() {
        let turn = |k: i32| (DVec2::ZERO, 0.1 * k as f32);
        let drive = driven((0..100).map(turn), CHASSIS);
        assert!(drive.steered.iter().all(|angle| *angle <= MOST && *angle > 0.4), "{:?}", drive.steered);
        // a corner between straight lines
        let mut drive = Drive::new(&body(DVec2::ZERO, 0.0));
        let mut before = drive.steered;
        for k in 1..100 {
            let heading = if k < 50 { 0.0 } else { (0.04 * (k - 50) as f32).min(1.0) };
            let position = drive.position + DVec2::from_angle(f64::from(heading)) * 0.2;
            drive = drive.next(&body(position, heading), CHASSIS, 0.04);
            for (now, before) in drive.steered.iter().zip(before) {
                assert!((now - before).abs() < 0.2, "at {k}: {before} to {now}");
            }
            before = drive.steered;
        }
        assert!(before.iter().all(|angle| angle.abs() < 0.01), "straight again: {before:?}");
    }

    #[test]
    fn a_vehicle_that_was_moved_does_not_roll() {
        let drive = driven([(DVec2::ZERO, 0.0), (DVec2::X * 1000.0, 0.0)].into_iter(), CHASSIS);
        assert_eq!(drive.rolled, [[0.0; 2]; 2]);
    }
}

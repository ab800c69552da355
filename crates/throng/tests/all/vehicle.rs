//! The vehicle, compared with the papers' own steps in f64 and with closed forms of its motion, and its limits.

use crate::vehicles::{RATES, angle, flier, vector};
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use std::f32::consts::{FRAC_PI_2, PI};
use throng::motion::{Basis, Forces, Integrator, Locomotion, Motion, Steering, Vehicle};
use throng::parameters::Angle;

proptest! {
    /// "Steering behaviors for autonomous characters", a simple vehicle model, with a time step.
    #[test]
    fn a_step_is_that_of_the_paper(
        velocity in vector(2.0), force in vector(30.0), mass in 0.2f32..9.0, seconds in 0.001f32..0.3, euler: bool,
    ) {
        let integrator = if euler { Integrator::Euler } else { Integrator::SemiImplicit };
        let vehicle = Vehicle { mass, max_speed: 4.0, integrator, ..flier() };
        let mut motion = Motion::moving(Vec3::ONE, velocity);
        vehicle.step(&mut motion, force, seconds);
        let truncate = |v: DVec3, most: f64| v * (most / v.length()).min(1.0);
        let (dt, before) = (f64::from(seconds), velocity.as_dvec3());
        let acceleration = truncate(force.as_dvec3(), 5.0) / f64::from(mass);
        let after = truncate(before + acceleration * dt, 4.0);
        let place = DVec3::ONE + if euler { before } else { after } * dt;
        prop_assert!(motion.velocity.as_dvec3().distance(after) < 1e-5);
        prop_assert!(motion.position.as_dvec3().distance(place) < 1e-5);
        prop_assert!(angle(motion.basis.forward, motion.velocity) < 1e-3);
    }

    /// The approach to a chosen velocity is exponential at any time step.
    #[test]
    fn the_step_does_not_show_on_the_way_to_a_velocity(start in vector(1.0), wanted in vector(1.0), response in 0.1f32..1.0) {
        let vehicle = Vehicle { response, max_force: 1e3, max_speed: 9.0, ..flier() };
        let expected = wanted + (start - wanted) * (-1.0 / response).exp();
        for rate in [15, 60, 240] {
            let (mut motion, seconds) = (Motion::moving(Vec3::ZERO, start), 1.0 / rate as f32);
            for _ in 0..rate {
                let force = vehicle.force_towards(&motion, wanted, seconds);
                prop_assert!(vehicle.velocity_of(&motion, force, seconds).distance(wanted) < 1e-4);
                vehicle.step(&mut motion, force, seconds);
            }
            prop_assert!(motion.velocity.distance(expected) < 1e-4, "{rate}: {} {expected}", motion.velocity);
        }
    }

    /// The same holds with smoothing.
    #[test]
    fn smoothing_is_the_same_at_any_rate(force in vector(3.0), smoothing in 0.05f32..0.5) {
        let vehicle = Vehicle { smoothing, ..flier() };
        for rate in [15, 60, 240] {
            let mut motion = Motion::default();
            (0..rate).for_each(|_| vehicle.step(&mut motion, force, 1.0 / rate as f32));
            let expected = force.clamp_length_max(5.0) * (1.0 - (-1.0 / smoothing).exp());
            prop_assert!(motion.acceleration.distance(expected) < 1e-3);
        }
        let mut motion = Motion::moving(Vec3::ZERO, force * 0.3);
        for _ in 0..40 {
            let brake = flier().brake(&motion, 2.0, 0.025);
            flier().step(&mut motion, brake, 0.025);
        }
        prop_assert!(motion.velocity.distance(force * (0.3 * (-2.0f32).exp())) < 1e-3, "{}", motion.velocity);
    }

    #[test]
    fn limits_are_kept(
        pushes in prop::collection::vec(vector(20.0), 1..40), rate in 0.2f32..6.0, seconds in 0.01f32..0.1, low in 0.0f32..0.5,
        kind in 0usize..3,
    ) {
        let locomotion = [Locomotion::Ground, Locomotion::Level, Locomotion::Banking][kind];
        let vehicle = Vehicle { max_turn_rate: Angle::from_radians(rate), min_speed: 0.3, low_speed: low, locomotion, ..Vehicle::default() };
        let mut motion = Motion::at_rest(Vec3::Z, Vec3::X);
        for push in pushes {
            let before = motion;
            vehicle.step(&mut motion, push, seconds);
            prop_assert!((0.2999..1.8001).contains(&motion.speed()), "{}", motion.speed());
            let turned = angle(before.basis.forward, motion.basis.forward);
            prop_assert!(turned <= rate * seconds + 1e-3, "{turned}");
            prop_assert!(angle(motion.basis.forward, motion.velocity) < 1e-3, "it does not skid");
            let Basis { forward, side, up } = motion.basis;
            prop_assert!(forward.cross(side).distance(up) < 1e-4 && (up.length() - 1.0).abs() < 1e-4);
            if locomotion == Locomotion::Ground {
                prop_assert!(motion.position.z == 1.0 && up == Vec3::Z);
            }
        }
    }

    /// Only up is a special direction.
    #[test]
    fn turned_vehicles_do_the_same_turned(
        pushes in prop::collection::vec(vector(9.0), 1..20), turn in 0.0f32..6.0, kind in 0usize..3,
    ) {
        let locomotion = [Locomotion::Ground, Locomotion::Level, Locomotion::Banking][kind];
        let vehicle = Vehicle { low_speed: 0.2, smoothing: 0.1, max_turn_rate: Angle::from_radians(2.0), locomotion, ..Vehicle::default() };
        let by = glam::Quat::from_rotation_z(turn);
        let (mut plain, mut turned) = (Motion::default(), Motion::at_rest(Vec3::ZERO, by * Vec3::X));
        for push in pushes {
            vehicle.step(&mut plain, push, 0.05);
            vehicle.step(&mut turned, by * push, 0.05);
            prop_assert!((by * plain.position).distance(turned.position) < 1e-3);
            prop_assert!((by * plain.basis.up).distance(turned.basis.up) < 1e-2);
        }
    }

    #[test]
    fn each_axis_has_its_limit(force in vector(9.0), facing in vector(1.0)) {
        prop_assume!(facing.length() > 0.1);
        let forces = Forces { thrust: 2.0, brake: 1.0, side: 0.5, up: 0.25 };
        let vehicle = Vehicle { forces, max_force: 100.0, max_speed: 100.0, ..flier() };
        let mut motion = Motion::at_rest(Vec3::ZERO, facing);
        let (basis, local) = (motion.basis, motion.basis.to_local(force));
        vehicle.step(&mut motion, force, 1.0);
        let expected = Vec3::new(local.x.clamp(-1.0, 2.0), local.y.clamp(-0.5, 0.5), local.z.clamp(-0.25, 0.25));
        prop_assert!(basis.to_local(motion.velocity).distance(expected) < 1e-4);
    }

    /// An agent that faces a target moves in any direction.
    #[test]
    fn an_agent_with_a_facing_may_walk_backwards(facing in vector(1.0), force in vector(2.0)) {
        prop_assume!(facing.truncate().length() > 0.1);
        let vehicle = Vehicle { max_turn_rate: Angle::from_radians(3.0), ..Vehicle::default() };
        let mut motion = Motion::default();
        for _ in 0..60 {
            vehicle.step(&mut motion, Steering { force, facing: Some(facing) }, 0.02);
        }
        prop_assert!(angle(motion.basis.forward, facing.with_z(0.0)) < 1e-3);
        prop_assert!(motion.velocity.distance((force.with_z(0.0) * 1.2).clamp_length_max(1.8)) < 1e-3);
    }

    /// A constant lateral force leads round a circle: its curvature is measured, and the position on it predicted.
    #[test]
    fn the_curve_ahead_is_foreseen(speed in 0.5f32..1.7, aside in 0.2f32..2.0, ahead in 0.1f32..1.5) {
        prop_assume!(aside * ahead / speed < PI);
        let (vehicle, seconds) = (Vehicle::default(), 0.002);
        let mut motion = Motion::moving(Vec3::ZERO, Vec3::X * speed);
        let mut turn = |time: f32| {
            for _ in 0..(time / seconds) as usize {
                let inwards = motion.basis.side * aside;
                vehicle.step(&mut motion, inwards, seconds);
            }
            motion
        };
        let now = turn(2.0);
        prop_assert!((now.curvature.length() * now.speed() * now.speed() / aside - 1.0).abs() < 0.02);
        let foreseen = now.curved_position_in((ahead / seconds).floor() * seconds);
        prop_assert!(turn(ahead).position.distance(foreseen) < 0.02 * speed, "{foreseen}");
    }

    /// At low speed the vehicle turns slowly, and still reaches any direction; it brakes to a stop whatever it faces.
    #[test]
    fn at_low_speed_it_goes_round(angle in -PI..PI) {
        let vehicle = Vehicle { low_speed: 0.2, ..Vehicle::default() };
        let (wanted, mut motion) = (Vec3::new(angle.cos(), angle.sin(), 0.0), Motion::default());
        let mut run = |wanted: Vec3| {
            for _ in 0..250 {
                let force = vehicle.force_towards(&motion, wanted, 0.02);
                vehicle.step(&mut motion, force, 0.02);
            }
            motion
        };
        prop_assert!(run(wanted).velocity.distance(wanted) < 1e-3);
        let rest = run(Vec3::ZERO);
        prop_assert!(rest.speed() < 1e-3 && rest.basis.forward.distance(wanted) < 0.05);
    }
}

#[test]
fn at_rest_only_straight_ahead() {
    let vehicle = Vehicle { low_speed: 0.2, ..Vehicle::default() };
    let mut motion = Motion::default();
    vehicle.step(&mut motion, Vec3::Y, 0.1);
    assert!(motion.velocity.distance(Vec3::X * 0.1) < 1e-6, "{}", motion.velocity);
}

/// In a steady turn a weight that hangs from the bird points straight down in the bird's frame.
#[test]
fn up_leans_into_the_turn() {
    let vehicle = Vehicle { max_speed: 9.0, max_force: 27.0, locomotion: Locomotion::Banking, ..Vehicle::default() };
    let mut motion = Motion::moving(Vec3::ZERO, Vec3::X * 9.0);
    for _ in 0..500 {
        let inwards = Vec3::Z.cross(motion.basis.forward);
        vehicle.step(&mut motion, inwards * 6.0, 0.01);
    }
    let bank = angle(motion.basis.up, Vec3::Z);
    assert!((bank - (6.0f32 / 9.81).atan()).abs() < 0.05, "{bank}");
    assert!(motion.basis.up.dot(Vec3::Z.cross(motion.basis.forward)) > 0.3, "to the inside");
    let level = Vehicle { locomotion: Locomotion::Level, ..vehicle };
    (0..300).for_each(|_| level.step(&mut motion, Vec3::ZERO, 0.01));
    assert!(motion.basis.up.distance(Vec3::Z) < 1e-2, "it rights itself");
}

#[test]
fn mistakes_are_named() {
    let told = |vehicle: Vehicle| vehicle.check().expect_err("it is wrong").to_string();
    assert!(Vehicle::default().check().is_ok());
    assert!(told(Vehicle { mass: 0.0, ..Vehicle::default() }).contains("mass is 0"));
    assert!(
        told(Vehicle { min_speed: 3.0, ..Vehicle::default() })
            .contains("min_speed is 3, but must be from 0 to max_speed")
    );
    assert!(told(Vehicle { response: f32::NAN, ..Vehicle::default() }).contains("response"));
}

/// A force straight to the side, within rounding, does not move a standing agent that cannot turn on the spot.
#[test]
fn at_rest_it_goes_ahead_first() {
    let vehicle = Vehicle { low_speed: 0.5, ..Vehicle::default() };
    for heading in [FRAC_PI_2, -FRAC_PI_2] {
        let forward = Vec3::new(heading.cos(), heading.sin(), 0.0);
        let mut motion = Motion::at_rest(Vec3::ZERO, forward);
        vehicle.step(&mut motion, Vec3::X * 5.0, 0.02);
        assert!(angle(motion.velocity, forward) < 1e-3 && motion.speed() > 0.05, "{heading}: {}", motion.velocity);
    }
}

/// A vehicle that cannot stop comes round to a target behind it, even exactly behind, and then circles it as tightly as
/// it can turn.
#[test]
fn vehicles_that_cannot_stop_come_back() {
    for (speed, rate) in [(0.5, f32::INFINITY), (1.5, f32::INFINITY), (1.5, 1.0)] {
        let radius = f32::max(speed / rate, speed * speed / 5.0);
        for seconds in RATES {
            let vehicle = Vehicle { min_speed: speed, max_turn_rate: Angle::from_radians(rate), ..Vehicle::default() };
            let mut motion = Motion::moving(Vec3::ZERO, Vec3::X * 1.8);
            let (mut nearest, mut farthest) = (f32::INFINITY, 0.0f32);
            for step in 0..(60.0 / seconds) as usize {
                let to = Vec3::X * -6.0 - motion.position;
                let force = vehicle.force_towards(&motion, to.normalize_or_zero() * 1.8, seconds);
                vehicle.step(&mut motion, force, seconds);
                nearest = nearest.min(to.length());
                if step as f32 * seconds > 30.0 {
                    farthest = farthest.max(to.length());
                }
            }
            assert!(nearest < 0.1 && farthest < 2.0 * radius, "{speed} {rate} {seconds}: {nearest} {farthest}");
        }
    }
}

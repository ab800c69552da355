//! The cures: holding, irregular motion, waiting, amortised decisions.

use crate::combine::{Clock, Says};
use crate::harness::{Actor, RADIUS, Stage, angle, ask, on_ground, rate, vector};
use glam::Vec3;
use proptest::prelude::*;
use throng::motion::{Motion, Vehicle};
use throng::parameters::Angle;
use throng::steer::{Behaviour, Rng, SteeringInput, SteeringNeighbour, Target, TraceRecorder};
use throng_steer::{Amortised, Hold, Irregular, MoveForward, Noise, Seek, StopAndWait, TargetSpeed};

proptest! {
    /// A held force lasts as long as set, and fades linearly.
    #[test]
    fn what_is_held_fades(until in 0.1f64..1.0, hold in 0.1f32..1.0) {
        let behaviour = Hold { seconds: hold, of: Clock(until).into() };
        let mut memory = vec![0.0; behaviour.memory()];
        let mut last = (0.0f64, 0.0f32);
        for step in 0..200 {
            let time = f64::from(step) * 0.01;
            let view = SteeringInput { time, seconds: 0.01, ..SteeringInput::default() };
            let said = behaviour.steer(&view, &mut memory, &mut TraceRecorder::default()).map(|said| said.force.x);
            if time < until {
                prop_assert_eq!(said, Some(1.0 + time as f32));
                last = (time, 1.0 + time as f32);
            } else {
                let expected = last.1 * (1.0 - (time - last.0) as f32 / hold).max(0.0);
                prop_assert!((said.unwrap_or(0.0) - expected).abs() < 1e-3, "{said:?} {expected}");
            }
        }
    }

    /// A kept force is dropped exactly where it would cause a collision: by a search in small steps.
    #[test]
    fn what_is_held_causes_no_hit(velocity in on_ground(1.5), push in on_ground(5.0), place in on_ground(2.5), theirs in on_ground(1.0)) {
        let other = SteeringNeighbour { offset: place, velocity: theirs, forward: Vec3::X, radius: 0.2, number: 1, group: 0 };
        let hold = Hold { seconds: 1.0, of: Clock(0.0).into() };
        let mut memory = vec![0.0; hold.memory()];
        memory[..4].copy_from_slice(&[1.0, push.x, push.y, 0.0]);
        let view = SteeringInput { neighbours: &[other], motion: Motion::moving(Vec3::ZERO, velocity), seconds: 0.1, ..SteeringInput::default() };
        let nearest = |own: Vec3| {
            (0..900).map(|k| (place + (theirs - own) * (k as f32 * 1e-3)).length()).fold(f32::INFINITY, f32::min)
        };
        let distances = [nearest(view.chosen(Some((push * 0.9).into()))), nearest(velocity)];
        prop_assume!(place.length() > 0.41 && distances.iter().all(|distance| (distance - 0.4).abs() > 0.01));
        let said = hold.steer(&view, &mut memory, &mut TraceRecorder::default());
        prop_assert_eq!(said.is_none(), distances[0] < 0.4 && distances[1] > 0.4, "{:?}", distances);
    }

    /// The changes stay within the angle and the part of the speed, and vary.
    #[test]
    fn irregular_motion_wavers_within_bounds(velocity in vector(0.9), most in 0.05f32..0.5, speed in 0.0f32..0.1) {
        prop_assume!(velocity.truncate().length() > 0.3);
        let steady = velocity.with_z(0.0);
        let reach = SteeringInput::default().reach(steady).force;
        let behaviour = Irregular { angle: Angle::from_radians(most), speed, noise: Noise::default(), of: Says(Some(reach)).into() };
        let chosen_velocities: Vec<Vec3> = (0..300).map(|i| {
            let view = SteeringInput { time: f64::from(i) * 0.3, ..SteeringInput::default() };
            view.chosen(ask(&behaviour, &view))
        }).collect();
        let aside = |chosen: &Vec3| angle(*chosen, steady) * steady.cross(*chosen).z.signum();
        prop_assert!(chosen_velocities.iter().all(|chosen| aside(chosen).abs() <= most + 1e-3));
        prop_assert!(chosen_velocities.iter().all(|chosen| (chosen.length() / steady.length() - 1.0).abs() <= speed + 1e-3));
        let mean = chosen_velocities.iter().map(aside).sum::<f32>() / 300.0;
        prop_assert!(mean.abs() < 0.25 * most && chosen_velocities.iter().any(|chosen| aside(chosen).abs() > 0.2 * most), "{mean}");
    }

    /// Before contact with any approaching agent it has stopped, if it can: then the other agent runs into it.
    #[test]
    fn stopped_agents_run_into_no_agent(
        speed in 0.2f32..1.8, far in 1.5f32..4.0, beside in -0.6f32..0.6, theirs in 0.0f32..1.5, seconds in rate(),
    ) {
        let stop = StopAndWait { within: 0.6, ..StopAndWait::new(Seek { target: Target::Point(Vec3::X * 50.0) }) };
        let walker = Actor::new(Motion::moving(Vec3::ZERO, Vec3::X * speed), Vehicle::default(), stop);
        let from = Vec3::new(far, beside, 0.0);
        let other = Actor::new(Motion::moving(from, Vec3::NEG_X * theirs), Vehicle::default(), MoveForward { part: 0.0 });
        let mut stage = Stage::new(seconds, vec![walker, other]);
        let mut worst = 0.0f32;
        stage.run(6.0, |stage| {
            let offset = stage.actors[1].motion.position - stage.actors[0].motion.position;
            if offset.length() < 2.0 * RADIUS {
                worst = worst.max(stage.actors[0].motion.velocity.dot(offset.normalize()));
            }
        });
        prop_assert!(worst < 0.2, "it goes at {worst} m/s into the other");
    }
}

#[test]
fn waiting_agents_neither_collide_nor_wait_for_ever() {
    let walker = StopAndWait::new(Seek { target: Target::Point(Vec3::X * 50.0) });
    let porter = Actor::new(Motion::at_rest(Vec3::X * 4.0, Vec3::Y), Vehicle::default(), MoveForward { part: 0.0 });
    let walker = Actor::new(Motion::default(), Vehicle::default(), walker);
    let mut stage = Stage::new(0.02, vec![walker, porter]);
    let mut nearest = f32::INFINITY;
    let apart = |stage: &Stage| stage.actors[0].motion.position.distance(stage.actors[1].motion.position);
    stage.run(6.0, |stage| nearest = nearest.min(apart(stage)));
    assert!(nearest > 0.4 && stage.actors[0].motion.speed() < 0.5, "{nearest}");
    stage.actors[1].behaviour = TargetSpeed { speed: 1.0 }.into();
    stage.run(6.0, |stage| nearest = nearest.min(apart(stage)));
    assert!(nearest > 0.4 && stage.actors[0].motion.position.x > 6.0, "{nearest}");
}

#[test]
fn amortised_behaviours_run_seldom_and_not_in_the_same_steps() {
    let behaviour = Amortised { every: 0.1, of: Clock(100.0).into() };
    let mut thinks = [0; 10];
    for number in 0..40 {
        let mut memory = vec![0.0; behaviour.memory()];
        let mut thoughts = Vec::new();
        for step in 0..500 {
            let time = step as f64 * 0.01;
            let view = SteeringInput {
                time,
                seconds: 0.01,
                rng: Rng { number, step, ..Rng::default() },
                ..SteeringInput::default()
            };
            let said = behaviour.steer(&view, &mut memory, &mut TraceRecorder::default()).expect("the clock runs");
            let thought = f64::from(said.force.x) - 1.0;
            assert!(thought <= time + 1e-6 && time - thought < 0.1, "{thought} {time}");
            if (thought - time).abs() < 1e-6 {
                thoughts.push(step);
            }
        }
        assert!((50..=52).contains(&thoughts.len()), "{}", thoughts.len());
        assert!(thoughts[1..].windows(2).all(|pair| pair[1] - pair[0] == 10));
        thinks[(thoughts[2] % 10) as usize] += 1;
    }
    assert!(thinks.iter().all(|&count| count < 12), "{thinks:?}");
}

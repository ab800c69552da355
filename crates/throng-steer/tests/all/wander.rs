//! Wandering, exploring, foraging.

use crate::harness::{Actor, RATES, Stage, angle, ask, flier, on_ground, rate, told};
use crate::single::view;
use glam::Vec3;
use proptest::prelude::*;
use throng::motion::{Motion, Vehicle};
use throng::parameters::Angle;
use throng::steer::{GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, Target};
use throng_steer::{Explore, Forage, FractalWander, Noise, TargetSpeed, Wander};

proptest! {
    /// The aim is aside by the noise of the time, no farther than the angle.
    #[test]
    fn fractal_wandering_turns_by_noise(velocity in on_ground(1.0), time in 0.0f64..90.0, most in 0.0f32..1.5, turbulent: bool) {
        prop_assume!(velocity.length() > 0.1);
        let noise = Noise { turbulent, ..Noise::default() };
        let view = SteeringInput { time, vehicle: Vehicle::default(), ..view(velocity) };
        let (_, reasons) = told(&FractalWander { angle: Angle::from_radians(most), noise }, &view);
        let SteeringReason::Aim(aim) = reasons[0].reason else { panic!("{reasons:?}") };
        let turned = angle(velocity, aim - Vec3::ONE) * velocity.cross(aim - Vec3::ONE).z.signum();
        prop_assert!((turned - most * noise.at(time, 0, view.rng)).abs() < 2e-3 && turned.abs() <= most + 1e-3);
    }

    /// The nearest food in range; until then the other behaviour.
    #[test]
    fn foragers_go_to_what_they_see(places in prop::collection::vec(on_ground(6.0), 0..5), range in 0.5f32..6.0) {
        let mut places = places;
        places.sort_by(|a, b| a.length().total_cmp(&b.length()));
        let food = |(number, &offset): (usize, &Vec3)| SteeringNeighbour {
            offset, velocity: Vec3::ZERO, forward: Vec3::X, radius: 0.1, number: number as u32 + 9, group: 3 + number % 2,
        };
        let foods: Vec<SteeringNeighbour> = places.iter().enumerate().map(food).collect();
        let view = SteeringInput { neighbours: &foods, vehicle: Vehicle::default(), ..view(Vec3::ZERO) };
        let forage = Forage { food: Target::Nearest(GroupFilter::Group(3)), range, of: TargetSpeed { speed: 0.3 }.into() };
        let seen = foods.iter().find(|food| food.group == 3).map(|food| food.offset).filter(|offset| offset.length() <= range);
        let expected = seen.map_or(Vec3::X * 0.3, |offset| offset.normalize() * 1.8);
        prop_assert!(view.chosen(ask(&forage, &view)).distance(expected) < 1e-3);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// From any start, every cell is visited within the time that visiting the cells one after another takes.
    #[test]
    fn explorers_see_everything(start in on_ground(12.0), size in (3.0f32..10.0, 3.0f32..10.0), x in 1usize..6, y in 1usize..6, seconds in rate()) {
        let max = Vec3::new(size.0, size.1, 0.0);
        let explore = Explore { min: Vec3::ZERO, max, columns: x, rows: y, levels: 1 };
        let mut stage = Stage::new(seconds, vec![Actor::new(Motion::at_rest(start, Vec3::X), Vehicle::default(), explore)]);
        stage.run(15.0 + (x * y) as f32 * max.length() / 1.8, |_| ());
        let visits = &stage.actors[0].memory[2..];
        prop_assert!(visits.iter().all(|&seconds| seconds > 0.0), "{visits:?}");
    }
}

/// Mean cosine of the angle that a wandering agent has turned after a while.
fn memory_of_direction(rate: u32, flies: bool) -> f64 {
    let vehicle = if flies { flier() } else { Vehicle::default() };
    let actor = Actor::new(
        Motion::moving(Vec3::ZERO, Vec3::X),
        vehicle,
        Wander { strength: 1.0, rate: Angle::from_radians(1.5) },
    );
    let mut stages: Vec<Stage> =
        (0..1500).map(|seed| Stage { seed, ..Stage::new(1.0 / rate as f32, vec![actor.clone()]) }).collect();
    stages.iter_mut().for_each(|stage| stage.run(0.6, |_| ()));
    stages.iter().map(|stage| f64::from(stage.actors[0].motion.basis.forward.x)).sum::<f64>() / 1500.0
}

#[test]
fn wandering_is_the_same_at_any_rate() {
    for flies in [false, true] {
        let [slow, medium, fast] = [15, 60, 240].map(|rate| memory_of_direction(rate, flies));
        // the standard deviation of these means is 0.015
        assert!((slow - fast).abs() < 0.06 && (medium - fast).abs() < 0.06, "{slow} {medium} {fast}");
        assert!((0.05..0.9).contains(&fast), "it turns: {fast}");
    }
}

/// The point on the circle is a Brownian motion: its angle spreads with the square root of time.
#[test]
fn the_wandering_point_spreads_as_it_should() {
    let wander = Wander { strength: 1.0, rate: Angle::from_radians(0.8) };
    for rate in [15, 60, 240] {
        let cosines = (0..2000).map(|number| {
            let mut memory = [1.0, 0.0, 0.0];
            for step in 0..rate {
                let rng = throng::steer::Rng { number, step, ..Default::default() };
                let view = SteeringInput { rng, seconds: 1.0 / rate as f32, ..SteeringInput::default() };
                throng::steer::Behaviour::steer(&wander, &view, &mut memory, &mut Default::default());
            }
            f64::from(memory[0])
        });
        let mean = cosines.sum::<f64>() / 2000.0;
        assert!((mean - (-0.5 * 0.64f64).exp()).abs() < 0.03, "{rate}: {mean}");
    }
}

#[test]
fn fractal_wandering_does_not_depend_on_the_rate_at_all() {
    let [slow, medium, fast] = RATES.map(|seconds| {
        let actor = Actor::new(Motion::moving(Vec3::ZERO, Vec3::X), flier(), FractalWander::default());
        let mut stage = Stage::new(seconds, vec![actor]);
        stage.run(3.0, |_| ());
        stage.actors[0].motion.position
    });
    assert!(slow.distance(fast) < 0.6 && medium.distance(fast) < 0.15, "{slow} {medium} {fast}");
    assert!(fast.distance(Vec3::X * 5.4) > 0.1);
}

/// A place that cannot be reached, for example behind a wall: the agent tries another after a while.
#[test]
fn explorers_give_up_on_what_they_cannot_reach() {
    let explore = Explore { min: Vec3::ZERO, max: Vec3::new(4.0, 2.0, 0.0), columns: 2, rows: 1, levels: 1 };
    let stuck = Vehicle { max_speed: 1e-3, ..Vehicle::default() };
    let mut stage = Stage::new(1.0, vec![Actor::new(Motion::default(), stuck, explore)]);
    let mut aims = std::collections::BTreeSet::new();
    stage.run(60_000.0, |stage| {
        aims.insert(stage.actors[0].memory[0] as u32);
    });
    assert!(aims.contains(&2));
}

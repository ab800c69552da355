//! Each guide alone, compared with its documentation: its output in a view.

use glam::{Quat, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::motion::{Basis, Motion};
use throng::space::Pathway;
use throng::space::surface::{Cuboid, Sphere};
use throng::steer::{AgentQuery, GroupFilter, Kinematics, Rng, SteeringInput, SteeringNeighbour, Target};
use throng_field::FadeOut;
use throng_steer::swarm::{
    Aggregate, Align, Attack, Escape, Flow, Guide, GuideOutput, HeightBand, Migrate, Phototaxis, Sedation, Zones, midge,
};

/// Returns the output of a guide with this memory.
fn ask(guide: &dyn Guide, view: &SteeringInput<'_>, memory: &mut [f32]) -> GuideOutput {
    let mut chosen = GuideOutput::default();
    guide.guide(view, memory, &mut chosen);
    chosen
}

fn fresh(guide: &dyn Guide, view: &SteeringInput<'_>) -> GuideOutput {
    ask(guide, view, &mut vec![0.0; guide.memory()])
}

fn at(position: Vec3) -> SteeringInput<'static> {
    SteeringInput {
        motion: Motion { position, ..Motion::default() },
        vehicle: midge(),
        radius: 0.005,
        ..SteeringInput::default()
    }
}

fn neighbour(offset: Vec3, velocity: Vec3, number: u32) -> SteeringNeighbour {
    SteeringNeighbour { offset, velocity, forward: Vec3::X, radius: 0.005, number, group: 0 }
}

/// A moving prey with the number 9.
#[derive(Debug)]
struct Prey(Kinematics);

impl AgentQuery for Prey {
    fn find(&self, number: u32) -> Option<Kinematics> {
        (number == 9).then_some(self.0)
    }
}

fn close(a: Vec3, b: Vec3) -> bool {
    a.distance(b) <= 1e-5 * (1.0 + b.length())
}

#[test]
fn a_flow_is_the_velocity_of_the_field_there_and_then() {
    let flow = Flow { weight: 0.5, ..Flow::of(|place: Vec3, time: f64| place * time as f32) };
    let view = SteeringInput { time: 3.0, ..at(Vec3::new(1.0, 2.0, 4.0)) };
    assert_eq!(fresh(&flow, &view).velocity, Vec3::new(1.5, 3.0, 6.0));
}

#[test]
fn a_marker_draws_from_beyond_its_radius_on() {
    let marker = Aggregate { rate: 2.0, beyond: 1.5, ..Aggregate::new(Target::Point(Vec3::Z)) };
    assert_eq!(fresh(&marker, &at(Vec3::Z * 2.4)), GuideOutput::default());
    assert!(close(fresh(&marker, &at(Vec3::new(0.0, 4.0, 1.0))).velocity, Vec3::NEG_Y * 5.0));
    // a guide without a target adds nothing
    assert_eq!(fresh(&Aggregate { beyond: 0.0, ..marker }, &at(Vec3::Z)), GuideOutput::default());
    assert_eq!(fresh(&Aggregate::new(Target::Agent(3)), &at(Vec3::Z)), GuideOutput::default());
}

#[test]
fn light_draws_by_its_intensity_and_is_circled_both_ways() {
    let lamp = Vec3::new(0.0, 0.0, 3.0);
    let light = Target::Point(lamp);
    let light = Phototaxis { power: 2.0, threshold: 0.5, speed: 1.2, orbit: 0.5, spread: 0.0, noise: 3.0, light };
    // I = 2 / 4, equal to the threshold: half of the speed
    let far = fresh(&light, &at(lamp + Vec3::X * 2.0));
    assert!(close(far.velocity, Vec3::NEG_X * 0.6) && far.noise == 1.0);
    let mut axes = Vec3::ZERO;
    let mut squares = Vec3::ZERO;
    for number in 0..2000 {
        let rng = Rng { seed: 5, number, step: 77 };
        let offset = Vec3::new(0.2, 0.1, -0.3);
        let near = fresh(&light, &SteeringInput { rng, ..at(lamp + offset) });
        // at right angles to the direction of the light, at the speed of its intensity
        let intensity = 2.0 / offset.length_squared();
        let part = intensity / (intensity + 0.5);
        assert!(near.velocity.dot(offset).abs() < 1e-5 && (near.velocity.length() - 1.2 * part).abs() < 1e-4);
        assert!((near.noise - (1.0 + 2.0 * part)).abs() < 1e-5);
        let again = fresh(&light, &SteeringInput { rng: rng.at(78), ..at(lamp + offset) });
        assert_eq!(again, near, "they keep their axes");
        let way = near.velocity.normalize();
        (axes, squares) = (axes + way / 2000.0, squares + way * way / 2000.0);
    }
    assert!(axes.length() < 0.06, "every way round is as likely: {axes}");
    assert!(squares.min_element() > 0.1, "{squares}");
    // continuous at the orbit, and at its end
    for distance in [0.5, 0.75] {
        let [inside, outside] = [1e-4, -1e-4].map(|off| fresh(&light, &at(lamp + Vec3::X * (distance - off))).velocity);
        assert!(inside.distance(outside) < 5e-3, "{distance}: {inside} {outside}");
    }
    // no velocity without light, nor at the centre of the light
    assert_eq!(fresh(&Phototaxis { power: 0.0, ..light }, &at(Vec3::ZERO)), GuideOutput::default());
    assert_eq!(fresh(&light, &at(lamp)), GuideOutput::default());
}

#[test]
fn orbits_differ_by_their_spread() {
    let light = Phototaxis { orbit: 1.0, spread: 0.5, ..Phototaxis::new(Target::Point(Vec3::ZERO)) };
    // from half of the orbit to one and a half times of it: how many insects fly round, without any velocity inwards?
    let round = |distance: f32| {
        let inwards = |number: u32| {
            let rng = Rng { seed: 5, number, step: 7 };
            fresh(&light, &SteeringInput { rng, ..at(Vec3::X * distance) }).velocity.x < -1e-5
        };
        (0..1000).filter(|&number| !inwards(number)).count()
    };
    assert_eq!([round(0.49), round(1.51)], [1000, 0]);
    assert!((round(0.75) as i32 - 750).abs() < 50 && (round(1.25) as i32 - 250).abs() < 50);
}

#[test]
fn smoke_calms_exponentially_and_it_wears_off() {
    let smoke = FadeOut::new(Sphere::new(Vec3::Z * 5.0, 1.0).unwrap(), 1.0).unwrap();
    let sedation = Sedation { uptake: 0.5, recovery: 0.25, sink: 0.8, ..Sedation::new(smoke) };
    let mut memory = vec![0.0; sedation.memory()];
    let view = |z: f32| SteeringInput { seconds: 0.01, ..at(Vec3::Z * z) };
    for _ in 0..300 {
        ask(&sedation, &view(5.2), &mut memory);
    }
    let chosen = ask(&sedation, &view(5.2), &mut memory);
    let vigour = (-0.5 * 3.01_f32).exp();
    assert!((chosen.vigour - vigour).abs() < 1e-4 && (chosen.noise - vigour).abs() < 1e-4);
    assert!(close(chosen.drift, Vec3::NEG_Z * 0.8 * (1.0 - vigour)) && !chosen.rests);
    // on the ground the insect rests; then, for 9 s, the dose wears off
    assert!(ask(&sedation, &view(0.01), &mut memory).rests);
    for _ in 0..400 {
        ask(&sedation, &view(0.01), &mut memory);
    }
    let chosen = ask(&sedation, &view(0.01), &mut memory);
    let dose = 0.5 * 3.01 * (-0.25 * 4.02_f32).exp();
    assert!((chosen.vigour - (-dose).exp()).abs() < 1e-3, "{} {dose}", chosen.vigour);
    assert!(!chosen.rests, "it is awake again");
    // floors act as the ground does
    let floor = Cuboid::new(Vec3::new(9.0, 9.0, 8.0)).unwrap();
    let on_floor = Sedation { floors: vec![Arc::new(floor)], ..sedation };
    assert!(ask(&on_floor, &view(4.01), &mut [3.0, 0.0]).rests);
    assert!(!ask(&on_floor, &view(4.2), &mut [3.0, 0.0]).rests);
    assert!(!ask(&on_floor, &view(4.01), &mut [0.1, 0.0]).rests, "it is too lively");
}

#[test]
fn prey_is_chased_where_it_will_be() {
    let prey = Prey(Kinematics { position: Vec3::new(4.0, 0.0, 0.0), velocity: Vec3::Y, ..Kinematics::default() });
    let attack = Attack { speed: 1.5, near: 8.0, calm: 0.2, ..Attack::new(Target::Agent(9)) };
    let view = SteeringInput { others: &prey, ..at(Vec3::ZERO) };
    let chosen = fresh(&attack, &view);
    // at 2 m/s the insect is there in 2 s
    assert!(close(chosen.velocity, Vec3::new(4.0, 2.0, 0.0).normalize() * 1.5));
    assert!((chosen.noise - 0.6).abs() < 1e-6);
    assert_eq!(fresh(&Attack { within: 3.9, ..attack }, &view), GuideOutput::default());
    let above = fresh(&Attack { height: 1.0, ..attack }, &view).velocity;
    assert!(above.z > 0.3 && (above.length() - 1.5).abs() < 1e-5, "{above}");
    // a third of the insects lead, the same in every step
    let third = Attack { leaders: 0.333, follow: 2.0, ..attack };
    let leads = |number: u32, step: u64| {
        let rng = Rng { seed: 1, number, step };
        fresh(&third, &SteeringInput { rng, ..view }).velocity != Vec3::ZERO
    };
    let leaders: Vec<u32> = (10..3010).filter(|&number| leads(number, 0)).collect();
    assert!((900..1100).contains(&leaders.len()), "{}", leaders.len());
    assert!(leaders.iter().all(|&number| leads(number, 99)));
    // followers fly to the leaders that they perceive, or along with their neighbours if there is no leader
    let follower = (10..).find(|number| !leaders.contains(number)).unwrap();
    let another = (follower + 1..).find(|number| !leaders.contains(number)).unwrap();
    let rng = Rng { seed: 1, number: follower, step: 0 };
    let near = [neighbour(Vec3::Z, Vec3::X, leaders[0]), neighbour(Vec3::Y, Vec3::NEG_Z, another)];
    let to = |neighbours| fresh(&third, &SteeringInput { rng, neighbours, ..view }).velocity;
    assert!(close(to(&near), Vec3::Z * 1.5) && close(to(&near[1..]), Vec3::NEG_Z * 1.5));
    assert_eq!(to(&[neighbour(Vec3::Z * 2.1, Vec3::X, leaders[0])]), Vec3::ZERO, "too far");
}

#[test]
fn migration_follows_its_path_together_and_keeps_its_height() {
    let path = Pathway::new(&[Vec3::ZERO, Vec3::X * 10.0], 0.5, false).unwrap();
    let migrate = Migrate { speed: 1.2, rate: 2.0, ..Migrate::new(path) };
    assert!(close(fresh(&migrate, &at(Vec3::new(4.0, 0.0, 0.4))).velocity, Vec3::X * 1.2));
    // 1 m outside of the path
    assert!(close(fresh(&migrate, &at(Vec3::new(4.0, 1.5, 0.0))).velocity, Vec3::new(1.2, -2.0, 0.0)));
    assert!(close(fresh(&migrate, &at(Vec3::new(12.5, 0.0, 0.0))).velocity, Vec3::NEG_X * 4.0), "at its end they stay");
    let align = Align { distance: 1.0, weight: 0.5 };
    let near = [
        neighbour(Vec3::X * 0.5, Vec3::Y, 1),
        neighbour(Vec3::Y, Vec3::new(2.0, 1.0, 0.0), 2),
        neighbour(Vec3::Y * 1.1, Vec3::Z * 99.0, 3),
        SteeringNeighbour { group: 1, ..neighbour(Vec3::Y * 0.1, Vec3::Z * 99.0, 4) },
    ];
    let mut view = SteeringInput { neighbours: &near, ..at(Vec3::ZERO) };
    view.motion.velocity = Vec3::X * 0.2;
    assert!(close(fresh(&align, &view).velocity, Vec3::new(0.8, 1.0, 0.0) * 0.5));
    let band = HeightBand { low: 1.0, high: 2.0, rate: 3.0 };
    let asked = |z: f32| fresh(&band, &at(Vec3::Z * z)).velocity;
    assert_eq!((asked(0.5), asked(1.7), asked(2.5)), (Vec3::Z * 1.5, Vec3::ZERO, Vec3::NEG_Z * 1.5));
}

#[test]
fn an_escape_continues_for_a_moment() {
    let escape = Escape { within: 1.0, speed: 2.0, memory: 0.5, ..Escape::new(Target::Agent(9)) };
    let mut memory = vec![0.0; escape.memory()];
    let predator = |x: f32| Prey(Kinematics { position: Vec3::X * x, ..Kinematics::default() });
    let mut asked = |x: f32| {
        let mut chosen = GuideOutput { velocity: Vec3::Y, ..GuideOutput::default() };
        escape.guide(&SteeringInput { others: &predator(x), seconds: 0.1, ..at(Vec3::ZERO) }, &mut memory, &mut chosen);
        chosen.velocity
    };
    assert_eq!(asked(1.1), Vec3::Y, "not yet");
    assert_eq!(asked(0.9), Vec3::NEG_X * 2.0);
    let after: Vec<Vec3> = (0..7).map(|_| asked(3.0)).collect();
    for (k, &velocity) in after.iter().enumerate() {
        let left = (1.0 - 0.2 * (k + 1) as f32).max(0.0);
        assert!(close(velocity, Vec3::NEG_X * (2.0 * left) + Vec3::Y * (1.0 - left)), "{k}: {velocity}");
    }
    // a missing predator has no effect; a predator at exactly the same place has
    let same = SteeringInput { others: &predator(0.0), ..at(Vec3::ZERO) };
    assert!((fresh(&escape, &same).velocity.length() - 2.0).abs() < 1e-5);
}

#[test]
fn zones_repel_align_and_attract() {
    let zones = Zones { reach: [0.1, 0.3, 0.9], repulsion: 1.0, alignment: 0.5, attraction: 0.4 };
    let asked =
        |neighbours: &[SteeringNeighbour]| fresh(&zones, &SteeringInput { neighbours, ..at(Vec3::ZERO) }).velocity;
    let one = |distance: f32| asked(&[neighbour(Vec3::X * distance, Vec3::Y, 1)]);
    assert!(close(one(0.05), Vec3::NEG_X * 0.5));
    assert!(close(one(0.2), Vec3::Y * 0.5));
    assert!(close(one(0.6), Vec3::X * 0.4));
    for edge in [0.1, 0.3, 0.9, 1.0] {
        assert!(one(edge).length() < 1e-5, "{edge}");
    }
    // the mean of many neighbours
    let crowd: Vec<SteeringNeighbour> = (0..10).map(|number| neighbour(Vec3::Y * 0.6, Vec3::ZERO, number)).collect();
    assert!(close(asked(&crowd), Vec3::Y * 0.4));
}

proptest! {
    /// Rotated scenes give rotated outputs, for guides without axes or heights of their own.
    #[test]
    fn guides_turn_with_the_scene(
        axis in (-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0), angle in 0.1f32..6.0,
        position in (-3.0f32..3.0, -3.0f32..3.0, 0.5f32..3.0), others in prop::collection::vec(
            ((-0.8f32..0.8, -0.8f32..0.8, -0.8f32..0.8), (-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0)), 0..6),
    ) {
        let axis = Vec3::from(axis);
        prop_assume!(axis.length() > 0.1);
        let turn = Quat::from_axis_angle(axis.normalize(), angle);
        let scene = |by: Quat, aside: Vec3| {
            let prey = Prey(Kinematics { position: by * Vec3::new(1.0, 2.0, 3.0), velocity: by * Vec3::X, ..Kinematics::default() });
            let neighbours: Vec<SteeringNeighbour> = others.iter().zip(0..).map(|(&(offset, velocity), number)| {
                neighbour(by * (Vec3::from(offset) - aside), by * Vec3::from(velocity), number)
            }).collect();
            let forward = by * Vec3::Y;
            let motion = Motion {
                position: by * (Vec3::from(position) + aside),
                velocity: by * Vec3::new(0.3, 0.5, -0.2),
                basis: Basis { forward, side: by * Vec3::NEG_X, up: by * Vec3::Z },
                ..Motion::default()
            };
            let view = SteeringInput { motion, others: &prey, neighbours: &neighbours, ..at(Vec3::ZERO) };
            let path = Pathway::new(&[by * Vec3::NEG_X, by * Vec3::X, by * Vec3::new(3.0, 3.0, 1.0)], 0.3, false).unwrap();
            let point = Target::Point(by * Vec3::new(0.5, 0.2, 9.0));
            let all: [Box<dyn Guide>; 9] = [
                Box::new(Flow::of(move |place: Vec3, _: f64| (by * Vec3::Z).cross(place))),
                Box::new(Aggregate::new(point)),
                Box::new(Phototaxis::new(point)),
                Box::new(Attack::new(Target::Agent(9))),
                Box::new(Attack { leaders: 0.5, follow: 1.0, ..Attack::new(Target::Agent(9)) }),
                Box::new(Migrate::new(path)),
                Box::new(Align { distance: 1.0, weight: 1.0 }),
                Box::new(Escape { within: 5.0, ..Escape::new(Target::Nearest(GroupFilter::All)) }),
                Box::new(Zones::default()),
            ];
            all.map(|guide| fresh(&*guide, &view))
        };
        let here = scene(Quat::IDENTITY, Vec3::ZERO);
        // a guide may jump at the edge of a zone or half way between two paths: there rounding chooses the side
        let near = [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
        let near: Vec<_> = near.map(|axis| scene(Quat::IDENTITY, axis * 2e-5)).collect();
        for (index, (chosen, turned)) in here.into_iter().zip(scene(turn, Vec3::ZERO)).enumerate() {
            let changes = near.iter().map(|all| (all[index].velocity - chosen.velocity).length());
            let velocity = 1e-4 + changes.fold(0.0, f32::max);
            let changes = near.iter().map(|all| (all[index].noise - chosen.noise).abs());
            let noise = 1e-5 + changes.fold(0.0, f32::max);
            prop_assert!((turn * chosen.velocity).distance(turned.velocity) < velocity, "{index}: {chosen:?} {turned:?}");
            prop_assert!((chosen.noise - turned.noise).abs() < noise, "{index}: {chosen:?} {turned:?}");
        }
    }
}

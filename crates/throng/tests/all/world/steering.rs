//! Steered agents: motion by their vehicles alone, flocks, and pedestrians with avoidance.

use crate::world::oracle::assert_free;
use glam::{DVec2, Vec3};
use std::sync::Arc;
use throng::avoid::Orca;
use throng::motion::{Locomotion, Motion, Vehicle};
use throng::parameters::Angle;
use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
use throng::{Agent, AgentId, Goal, Group, Journey, Settings, Stop, SubSteps, TraceRequest, World};
use throng_steer::{Arrive, Flocking, Pursue, Seek, Wander, WeightedSum};

const STEP: f64 = 1.0 / 30.0;

fn world() -> World {
    let settings = Settings { step: STEP, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    World::new(settings).unwrap()
}

fn agent(at: (f64, f64, f32), group: throng::GroupId, vehicle: &Vehicle) -> Agent {
    Agent {
        position: DVec2::new(at.0, at.1).extend(f64::from(at.2)),
        group,
        preferred_speed: vehicle.max_speed,
        motor: (*vehicle).into(),
        heading: Some(0.0),
        ..Agent::default()
    }
}

fn place(world: &World, id: AgentId) -> Vec3 {
    let row = world.row(id).unwrap();
    world.relative_columns().position[row].extend(world.relative_columns().altitude[row])
}

#[test]
fn alone_it_moves_as_its_vehicle() {
    for locomotion in [Locomotion::Ground, Locomotion::Banking] {
        let vehicle =
            Vehicle { locomotion, max_turn_rate: Angle::from_radians(2.0), smoothing: 0.2, ..Vehicle::default() };
        let target = Vec3::new(-4.0, 7.0, if locomotion == Locomotion::Ground { 0.0 } else { 9.0 });
        let arrive = || Arrive::new(Target::Point(target));
        let mut world = world();
        let group = world.add_group(Group::steered(arrive())).unwrap();
        let height = if locomotion == Locomotion::Ground { 0.0 } else { 5.0 };
        let id = world.add_agent(agent((3.0, 1.0, height), group, &vehicle)).unwrap();
        let mut motion = Motion::at_rest(Vec3::new(3.0, 1.0, height), Vec3::X);
        for step in 0..600 {
            world.step();
            let seconds = STEP as f32;
            let view =
                SteeringInput { motion, vehicle, seconds, time: f64::from(step) * STEP, ..SteeringInput::default() };
            let steering = arrive().steer(&view, &mut [], &mut TraceRecorder::default()).unwrap_or_default();
            vehicle.step(&mut motion, steering, seconds);
            assert!(place(&world, id).distance(motion.position) < 1e-4, "{locomotion:?}, step {step}");
            let row = world.row(id).unwrap();
            let turned = world.relative_columns().attitude[row].basis.forward.dot(motion.basis.forward);
            assert!(turned > 0.9999, "{locomotion:?}, step {step}: it faces another way");
        }
        assert!(place(&world, id).distance(target) < 0.05, "{locomotion:?}");
    }
}

#[test]
fn pursuers_find_their_quarry_by_its_number_wherever_it_is() {
    let mut world = world();
    let vehicle = Vehicle::default();
    let fast = Vehicle { max_speed: 3.0, ..vehicle };
    let quarry = world.add_group(Group::steered(Wander::default())).unwrap();
    let pursuers = world.add_group(Group::steered(Pursue::new(Target::Agent(7)))).unwrap();
    let quarry = world.add_agent(Agent { number: Some(7), ..agent((0.0, 0.0, 0.0), quarry, &vehicle) }).unwrap();
    let pursuer = world.add_agent(agent((60.0, -30.0, 0.0), pursuers, &fast)).unwrap();
    let caught = (0..3000).any(|_| {
        world.step();
        place(&world, quarry).distance(place(&world, pursuer)) < 0.5
    });
    assert!(caught);
}

/// A flock in the open that steers to its centre.
fn flock(count: u32) -> World {
    let mut world = world();
    let vehicle = Vehicle { locomotion: Locomotion::Banking, max_speed: 9.0, max_force: 27.0, ..Vehicle::default() };
    let home = Seek { target: Target::Point(Vec3::new(0.0, 0.0, 60.0)) };
    let steering =
        WeightedSum(vec![(1.0, Flocking::default().into()), (0.3, Wander::default().into()), (0.1, home.into())]);
    let group = Group { neighbour_distance: 9.0, neighbours: 20, ..Group::steered(steering) };
    let group = world.add_group(group).unwrap();
    for k in 0..count {
        let (x, y, z) = (f64::from(k % 7) * 2.0, f64::from(k / 7 % 5) * 2.0, 40.0 + (k / 35) as f32 * 2.0);
        world.add_agent(Agent { heading: Some(k as f32), ..agent((x, y, z), group, &vehicle) }).unwrap();
    }
    world
}

#[test]
fn a_flock_has_the_same_bits_for_any_number_of_threads_and_when_it_is_loaded() {
    let after = |threads: usize, saved: bool| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = flock(300);
            (0..60).for_each(|_| world.step());
            if saved {
                let bytes = world.save();
                world = flock(0);
                world.load(&bytes).unwrap();
            }
            (0..60).for_each(|_| world.step());
            world.state_hash()
        })
    };
    let one = after(1, false);
    assert_eq!([after(2, false), after(3, false), after(1, true)], [one; 3]);
}

#[test]
fn agents_that_seek_the_same_place_on_foot_do_not_overlap() {
    let mut world = world();
    let vehicle = Vehicle::default();
    let seek = Arrive::new(Target::Point(Vec3::ZERO));
    let group = Group { model: Arc::new(Orca::default()), guard: true, ..Group::steered(seek) };
    let group = world.add_group(group).unwrap();
    for k in 0..40 {
        let at = DVec2::from_angle(f64::from(k) * 0.4) * (2.0 + 0.15 * f64::from(k));
        world.add_agent(agent((at.x, at.y, 0.0), group, &vehicle)).unwrap();
    }
    for _ in 0..400 {
        world.step();
        assert_free(&world);
    }
    let near = (0..world.relative_columns().len())
        .filter(|&row| world.relative_columns().position[row].length() < 3.0)
        .count();
    assert!(near > 30, "{near} came near");
}

#[test]
fn why_it_steers_is_told_and_changes_nothing() {
    let mut world = flock(50);
    (0..10).for_each(|_| world.step());
    let id = world.id(3);
    let before = world.save();
    let why = world.explain(id).unwrap();
    assert!(why.steering.len() > 3, "{:?}", why.steering);
    assert_eq!(world.save(), before);
}

#[test]
fn traced_agents_record_what_explain_returns_and_move_unchanged() {
    let (mut asked, mut quiet) = (flock(50), flock(50));
    let id = asked.id(3);
    let number = asked.relative_columns().number[3];
    asked.request_traces(TraceRequest::Numbers(vec![number, 7]));
    for _ in 0..20 {
        let why = quiet.explain(id).unwrap();
        asked.step();
        quiet.step();
        let account = asked.relative_traces().iter().find(|account| account.number == number).unwrap();
        assert_eq!((&account.entries, account.preferred.truncate()), (&why.steering, why.preferred));
        assert_eq!((asked.relative_traces().len(), quiet.relative_traces()), (2, &[][..]));
    }
    assert_eq!(asked.state_hash(), quiet.state_hash());
    assert_eq!(asked.save(), quiet.save());
}

#[test]
fn arrived_agents_stay_at_their_goal() {
    let mut world = world();
    let vehicle = Vehicle::default();
    let group = world.add_group(Group::steered(Arrive::new(Target::Goal))).unwrap();
    let goal = world.add_goal(Goal::Point { at: DVec2::new(6.0, 2.0), tolerance: 0.5 }).unwrap();
    let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap();
    let id = world.add_agent(Agent { journey, ..agent((0.0, 0.0, 0.0), group, &vehicle) }).unwrap();
    (0..600).for_each(|_| world.step());
    assert_eq!(world.counts().arrived, 1);
    assert!(place(&world, id).distance(Vec3::new(6.0, 2.0, 0.0)) < 0.02, "{}", place(&world, id));
}

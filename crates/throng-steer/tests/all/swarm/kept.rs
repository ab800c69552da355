//! Hashes of the outputs of each guide of a swarm, and of the flights of swarms and flocks.

use crate::draw::Draw;
use crate::results::Results;
use crate::swarm::{add, bare, empty, places, scattered, velocities};
use glam::{DVec2, Vec3};
use std::f32::consts::PI;
use std::sync::Arc;
use throng::motion::{Integrator, Locomotion, Motion, Vehicle};
use throng::parameters::Angle;
use throng::perceive::SimdLevel;
use throng::space::Pathway;
use throng::space::surface::{Cuboid, Plane, SeenFrom, Sphere};
use throng::steer::{
    AgentQuery, Barriers, Behaviour, GroupFilter, Kinematics, Rng, SteeringInput, SteeringNeighbour, Target,
    TraceRecorder,
};
use throng::{Group, World};
use throng_field::{CurlNoise, FadeOut, Octave, Potential};
use throng_steer::swarm::{
    Aggregate, Align, Attack, Escape, Flow, GuideOutput, HeightBand, KeepOff, Migrate, Phototaxis, Sedation, Swarm,
    SwarmSpacing, Zones, locust, midge,
};
use throng_steer::{Flocking, Rule, Seek};

/// Centre of the start positions.
const MIDDLE: Vec3 = Vec3::new(0.3, -0.2, 2.0);
/// Origin of a grid about them.
const GRID: Vec3 = Vec3::new(0.25, -0.25, 2.0);
/// A place among them, on the grid.
const POINT: Target = Target::Point(Vec3::new(0.5, 0.0, 2.125));
const STRANGER: Target = Target::Nearest(GroupFilter::OtherGroups);

fn guided() -> Vec<(&'static str, Swarm)> {
    let swarm = Swarm::default;
    let wild = Octave::turbulence(0.7, 0.3, 0.4, 3).unwrap();
    let wild = CurlNoise::new(Potential::Space, &wild, 5).unwrap();
    let corners = [MIDDLE, MIDDLE + Vec3::new(0.4, 0.0, 0.1), MIDDLE + Vec3::new(0.4, 0.5, -0.1)];
    let path = |cyclic| Pathway::new(&corners, 0.1, cyclic).unwrap();
    let smoke = || FadeOut::new(Sphere::new(MIDDLE + Vec3::X * 0.4, 0.4).unwrap(), 0.5).unwrap();
    let burst = |place: Vec3, time: f64| (if time < 0.3 { place.z - 1.5 } else { 0.0 }, Vec3::ZERO);
    let floor = Arc::new(Plane::new(MIDDLE, Vec3::Z).unwrap());
    let faint =
        Sedation { uptake: 9.0, recovery: 3.0, sink: 1.5, landing: 0.1, floors: vec![floor], ..Sedation::new(burst) };
    let some = Attack {
        within: 0.5,
        speed: 1.0,
        near: 0.3,
        calm: 0.5,
        leaders: 0.3,
        follow: 0.25,
        ..Attack::new(Target::Agent(5))
    };
    let lamp = Phototaxis::new(POINT);
    let ball = || Sphere::new(MIDDLE, 0.3).unwrap();
    let keep = |surface: Sphere, seen_from, distance, speed| {
        let keep_off = KeepOff { barriers: Barriers::default().with(surface, seen_from), distance, speed };
        Swarm { keep_off, ..Swarm::default() }
    };
    let cuboid = Barriers::default().with(Cuboid::new(Vec3::new(0.9, 0.8, 4.2)).unwrap(), SeenFrom::Inside);
    vec![
        ("swarm", swarm()),
        ("bare", bare()),
        ("one noise", Swarm { own_noise: false, ..swarm() }),
        ("wild noise", swarm().with_noise(wild, true)),
        ("apart", Swarm { apart: SwarmSpacing { distance: 0.25, speed: 2.0 }, ..bare() }),
        ("kept off", keep(ball(), SeenFrom::Outside, 0.3, 1.0)),
        ("kept within", keep(ball(), SeenFrom::Inside, 0.1, 2.0)),
        ("kept on either side", keep(ball(), SeenFrom::Both, 0.2, 0.5)),
        ("kept in a room", Swarm { keep_off: KeepOff { barriers: cuboid, ..swarm().keep_off }, ..bare() }),
        ("aggregate", swarm().with(Aggregate::new(POINT))),
        ("aggregate, loosely", bare().with(Aggregate { rate: 3.0, beyond: 0.25, ..Aggregate::new(STRANGER) })),
        ("attack", swarm().with(Attack::new(STRANGER))),
        ("attack, some", swarm().with(some)),
        ("attack, a stranger", bare().with(Attack { prey: STRANGER, leaders: 0.6, within: 0.75, ..some })),
        ("escape", swarm().with(Aggregate::new(POINT)).with(Escape::new(STRANGER))),
        ("escape, briefly", bare().with(Escape { within: 0.375, speed: 1.2, memory: 0.2, ..Escape::new(POINT) })),
        ("flow", swarm().with(Flow::of(|place: Vec3, time: f64| place * (0.5 - time as f32)))),
        (
            "flow, of some weight",
            bare().with(Flow { weight: 0.3, ..Flow::of(|_: Vec3, _: f64| Vec3::new(1.0, 2.0, -0.5)) }),
        ),
        ("migrate", swarm().with(Migrate { speed: 1.0, rate: 2.0, ..Migrate::new(path(false)) })),
        ("migrate, round", bare().with(Migrate { speed: 0.6, rate: 3.0, ..Migrate::new(path(true)) })),
        ("align", swarm().with(Align { distance: 0.25, weight: 0.5 })),
        ("align, strongly", Swarm { own_noise: false, ..swarm() }.with(Align { distance: 0.15, weight: 2.0 })),
        ("heights", swarm().with(HeightBand { low: 1.875, high: 2.125, rate: 3.0 })),
        ("heights, low", bare().with(HeightBand { low: 0.5, high: 0.7, rate: 0.7 })),
        ("phototaxis", swarm().with(lamp)),
        (
            "phototaxis, dim",
            swarm().with(Phototaxis { power: 0.5, threshold: 2.0, speed: 1.5, orbit: 0.25, noise: 3.0, ..lamp }),
        ),
        ("sedation", swarm().with(Sedation::new(smoke()))),
        ("sedation, faint", swarm().with(faint)),
        ("zones", swarm().with(Zones::default())),
        (
            "zones, narrow",
            bare().with(Zones { reach: [0.125, 0.25, 0.375], repulsion: 2.0, alignment: 0.9, attraction: 1.2 }),
        ),
    ]
}

fn birds() -> Vec<(&'static str, Flocking, Vehicle)> {
    let bird = Vehicle { max_speed: 3.0, max_force: 9.0, locomotion: Locomotion::Banking, ..Vehicle::default() };
    let rule = |weight, distance, angle| Rule { weight, distance, angle: Angle::from_radians(angle) };
    let all = Flocking {
        separation: rule(0.5, 0.3, 2.0),
        alignment: rule(0.2, 0.6, PI),
        cohesion: rule(0.7, 0.8, 1.0),
        always: 20.0,
        groups: GroupFilter::All,
    };
    let level = Vehicle { locomotion: Locomotion::Level, smoothing: 0.2, integrator: Integrator::Euler, ..bird };
    let ground = Vehicle { locomotion: Locomotion::Ground, ..bird };
    vec![
        ("birds", Flocking::default(), Vehicle { min_speed: 0.8, ..bird }),
        ("birds, of all", all, level),
        ("birds, strangers", Flocking { groups: GroupFilter::OtherGroups, ..all }, bird),
        ("birds on the ground", Flocking { groups: GroupFilter::Group(0), ..all }, ground),
    ]
}

/// Adds the velocity of an insect with six neighbours: at a random place, or on a grid where many distances are equal.
fn ask(results: &mut Results, name: &str, swarm: &Swarm) {
    let mut draw = Draw::new(3);
    let mut memory = vec![0.0; swarm.memory()];
    for number in 0..200 {
        let on_grid = draw.index(2) == 0;
        let mut vector = |range: f64| {
            let v = draw
                .point(DVec2::splat(-range), DVec2::splat(range))
                .as_vec2()
                .extend(draw.between(-range, range) as f32);
            if on_grid { (v * 8.0).round() / 8.0 } else { v }
        };
        let motion = Motion::moving(GRID + vector(0.8), vector(0.5));
        let neighbour = |number| SteeringNeighbour {
            offset: vector(0.4),
            velocity: vector(1.0),
            forward: Vec3::X,
            radius: 0.005,
            number,
            group: number as usize % 3,
        };
        let mut neighbours: Vec<SteeringNeighbour> = (0..6).map(neighbour).collect();
        neighbours.sort_by(|a, b| a.offset.length().total_cmp(&b.offset.length()));
        let prey = Prey(Kinematics { position: GRID + vector(0.5), velocity: vector(1.0), ..Kinematics::default() });
        let view = SteeringInput {
            motion,
            vehicle: if draw.index(4) == 0 { Vehicle { locomotion: Locomotion::Ground, ..midge() } } else { midge() },
            radius: draw.one_of(&[0.005, 0.125]),
            neighbours: &neighbours,
            others: &prey,
            time: draw.between(0.0, 1.0),
            rng: Rng { seed: 5, number: number / 4, step: draw.bits() },
            ..SteeringInput::default()
        };
        if number % 8 == 0 {
            memory.fill(0.0);
        }
        let mut words = &mut memory.clone()[..];
        for guide in &swarm.guides {
            let (own, rest) = words.split_at_mut(guide.memory());
            let mut chosen = GuideOutput::default();
            guide.guide(&view, own, &mut chosen);
            results.add(name, &chosen);
            words = rest;
        }
        results.add(name, &(swarm.steer(&view, &mut memory, &mut TraceRecorder::default()), &memory));
    }
}

/// A moving agent with the number 5.
#[derive(Debug)]
struct Prey(Kinematics);

impl AgentQuery for Prey {
    fn find(&self, number: u32) -> Option<Kinematics> {
        (number == 5).then_some(self.0)
    }
}

/// Swarms, each with a parameter of this value.
fn with(x: f32) -> Vec<Swarm> {
    let attack = Attack::new(POINT);
    let (escape, lamp, zones) = (Escape::new(POINT), Phototaxis::new(POINT), Zones::default());
    let path = Migrate::new(Pathway::new(&[Vec3::ZERO, Vec3::X], 1.0, false).unwrap());
    let smoke = || Sedation::new(|_: Vec3, _: f64| (1.0, Vec3::ZERO));
    let near = |distance, speed| {
        let barriers = Barriers::default().with(Sphere::new(MIDDLE, 1.0).unwrap(), SeenFrom::Outside);
        Swarm { keep_off: KeepOff { barriers, distance, speed }, ..bare() }
    };
    vec![
        bare().with(Aggregate { rate: x, ..Aggregate::new(POINT) }),
        bare().with(Aggregate { beyond: x, ..Aggregate::new(POINT) }),
        bare().with(Attack { within: x, ..attack }),
        bare().with(Attack { speed: x, ..attack }),
        bare().with(Attack { near: x, ..attack }),
        bare().with(Attack { calm: x, ..attack }),
        bare().with(Attack { leaders: x, ..attack }),
        bare().with(Attack { follow: x, ..attack }),
        bare().with(Attack { prey: STRANGER, within: x, ..attack }),
        bare().with(Escape { within: x, ..escape }),
        bare().with(Escape { speed: x, ..escape }),
        bare().with(Escape { memory: x, ..escape }),
        bare().with(Escape { predator: STRANGER, within: x, ..escape }),
        bare().with(Flow { weight: x, ..Flow::of(|_: Vec3, _: f64| Vec3::X) }),
        bare().with(Migrate { speed: x, ..path.clone() }),
        bare().with(Migrate { rate: x, ..path }),
        bare().with(Align { distance: x, weight: 1.0 }),
        bare().with(Align { distance: 1.0, weight: x }),
        bare().with(HeightBand { low: x, high: 9.0, rate: 1.0 }),
        bare().with(HeightBand { low: 1.0, high: x, rate: 1.0 }),
        bare().with(HeightBand { low: 1.0, high: 1.0, rate: x }),
        bare().with(Phototaxis { power: x, ..lamp }),
        bare().with(Phototaxis { threshold: x, ..lamp }),
        bare().with(Phototaxis { speed: x, ..lamp }),
        bare().with(Phototaxis { orbit: x, ..lamp }),
        bare().with(Phototaxis { noise: x, ..lamp }),
        bare().with(Sedation { uptake: x, ..smoke() }),
        bare().with(Sedation { recovery: x, ..smoke() }),
        bare().with(Sedation { sink: x, ..smoke() }),
        bare().with(Sedation { landing: x, ..smoke() }),
        bare().with(Zones { reach: [x, 1.0, 2.0], ..zones }),
        bare().with(Zones { reach: [1.0, x, 2.0], ..zones }),
        bare().with(Zones { reach: [0.0, 1.0, x], ..zones }),
        bare().with(Zones { repulsion: x, ..zones }),
        bare().with(Zones { alignment: x, ..zones }),
        bare().with(Zones { attraction: x, ..zones }),
        Swarm { apart: SwarmSpacing { distance: x, speed: 1.0 }, ..bare() },
        Swarm { apart: SwarmSpacing { distance: 1.0, speed: x }, ..bare() },
        Swarm { keep_off: KeepOff { distance: x, ..bare().keep_off }, ..bare() },
        near(x, 1.0),
        near(1.0, x),
    ]
}

/// Adds the flight of a group, alone and with two agents that fly through it.
fn fly(results: &mut Results, name: &str, group: &Group, vehicle: Vehicle) {
    let start = scattered(30, MIDDLE, 0.5);
    let ground = vehicle.locomotion == Locomotion::Ground;
    let start: Vec<Vec3> = start.iter().map(|&place| if ground { place.with_z(0.0) } else { place }).collect();
    for instructions in [SimdLevel::Plain, SimdLevel::Best] {
        for company in [false, true] {
            let mut world = empty();
            world.set_simd_level(instructions);
            let number = world.add_group(group.clone()).unwrap();
            add(&mut world, number, vehicle, &start);
            if company {
                let bird = Vehicle { max_speed: 1.0, ..midge() };
                let strangers = world.add_group(Group { neighbours: 0, ..Group::steered(Seek { target: POINT }) });
                add(&mut world, strangers.unwrap(), bird, &[Vec3::new(-0.6, 0.1, 2.0), Vec3::new(0.2, 1.0, 2.2)]);
            }
            for _ in 0..5 {
                (0..8).for_each(|_| world.step());
                results.add(name, &told(&world));
            }
        }
    }
}

fn told(world: &World) -> (Vec<Vec3>, Vec<Vec3>) {
    (places(world), velocities(world))
}

#[test]
fn flights_are_as_kept() {
    let mut results = Results::default();
    let ground = Vehicle { locomotion: Locomotion::Ground, ..midge() };
    for (name, swarm) in guided() {
        ask(&mut results, name, &swarm);
        fly(&mut results, name, &swarm.group(), midge());
    }
    let lamp = Phototaxis::new(POINT);
    fly(&mut results, "locusts", &Swarm::default().with(Aggregate::new(POINT)).group(), locust());
    fly(&mut results, "on the ground", &Swarm::default().with(lamp).with(Zones::default()).group(), ground);
    for (name, flocking, vehicle) in birds() {
        fly(&mut results, name, &Group::steered(flocking), vehicle);
    }
    for x in [-1.0, 0.0, 0.5, 1.0, 1.5, 2.0, 9.0, f32::INFINITY, f32::NAN] {
        let all: Vec<_> = with(x).iter().map(|swarm| (swarm.check(), swarm.reach(), swarm.memory())).collect();
        results.add("refused", &all);
    }
    results.assert_kept("all/swarm/kept.txt");
}

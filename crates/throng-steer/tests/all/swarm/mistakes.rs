//! Errors of swarms and their messages.

use crate::swarm::{bare, empty, run, scattered, world};
use glam::Vec3;
use throng::motion::Vehicle;
use throng::space::Pathway;
use throng::space::surface::{SeenFrom, Sphere};
use throng::steer::{Barriers, Behaviour, Target};
use throng::{Group, World};
use throng_steer::swarm::{
    Aggregate, Align, Attack, Escape, Flow, Guide, HeightBand, KeepOff, Migrate, Phototaxis, Sedation, Swarm,
    SwarmSpacing, Zones, midge,
};

#[test]
fn parameters_out_of_their_limits_are_named() {
    let target = Target::Point(Vec3::ZERO);
    let path = Pathway::new(&[Vec3::ZERO, Vec3::X], 1.0, false).unwrap();
    for wrong in [-1.0, f32::NAN] {
        let sedation = || Sedation::new(|_: Vec3, _: f64| (1.0, Vec3::ZERO));
        let guides: Vec<Box<dyn Guide>> = vec![
            Box::new(Flow { weight: wrong, ..Flow::of(|_: Vec3, _: f64| Vec3::X) }),
            Box::new(Aggregate { rate: wrong, ..Aggregate::new(target) }),
            Box::new(Aggregate { beyond: wrong, ..Aggregate::new(target) }),
            Box::new(Phototaxis { power: wrong, ..Phototaxis::new(target) }),
            Box::new(Phototaxis { threshold: wrong, ..Phototaxis::new(target) }),
            Box::new(Phototaxis { speed: wrong, ..Phototaxis::new(target) }),
            Box::new(Phototaxis { orbit: wrong, ..Phototaxis::new(target) }),
            Box::new(Phototaxis { spread: wrong, ..Phototaxis::new(target) }),
            Box::new(Phototaxis { noise: wrong, ..Phototaxis::new(target) }),
            Box::new(Sedation { uptake: wrong, ..sedation() }),
            Box::new(Sedation { recovery: wrong, ..sedation() }),
            Box::new(Sedation { sink: wrong, ..sedation() }),
            Box::new(Sedation { landing: wrong, ..sedation() }),
            Box::new(Attack { within: wrong, ..Attack::new(target) }),
            Box::new(Attack { speed: wrong, ..Attack::new(target) }),
            Box::new(Attack { near: wrong, ..Attack::new(target) }),
            Box::new(Attack { calm: wrong, ..Attack::new(target) }),
            Box::new(Attack { leaders: wrong, ..Attack::new(target) }),
            Box::new(Attack { height: wrong, ..Attack::new(target) }),
            Box::new(Attack { follow: wrong, ..Attack::new(target) }),
            Box::new(Migrate { speed: wrong, ..Migrate::new(path.clone()) }),
            Box::new(Migrate { rate: wrong, ..Migrate::new(path.clone()) }),
            Box::new(Align { distance: wrong, weight: 1.0 }),
            Box::new(Align { distance: 1.0, weight: wrong }),
            Box::new(HeightBand { low: 0.0, high: wrong, rate: 1.0 }),
            Box::new(HeightBand { low: 0.0, high: 1.0, rate: wrong }),
            Box::new(Escape { within: wrong, ..Escape::new(target) }),
            Box::new(Escape { speed: wrong, ..Escape::new(target) }),
            Box::new(Escape { memory: wrong, ..Escape::new(target) }),
            Box::new(Zones { reach: [wrong, 1.0, 2.0], ..Zones::default() }),
            Box::new(Zones { reach: [0.1, wrong, 2.0], ..Zones::default() }),
            Box::new(Zones { reach: [0.1, 0.2, wrong], ..Zones::default() }),
            Box::new(Zones { repulsion: wrong, ..Zones::default() }),
            Box::new(Zones { alignment: wrong, ..Zones::default() }),
            Box::new(Zones { attraction: wrong, ..Zones::default() }),
        ];
        for guide in guides {
            assert!(guide.check().is_err(), "{guide:?}");
        }
        let barriers = Barriers::default().with(Sphere::new(Vec3::ZERO, 1.0).unwrap(), SeenFrom::Outside);
        for swarm in [
            Swarm { apart: SwarmSpacing { distance: wrong, speed: 1.0 }, ..Swarm::default() },
            Swarm { apart: SwarmSpacing { distance: 1.0, speed: wrong }, ..Swarm::default() },
            Swarm { keep_off: KeepOff { barriers: barriers.clone(), distance: wrong, speed: 1.0 }, ..Swarm::default() },
            Swarm { keep_off: KeepOff { barriers: barriers.clone(), distance: 1.0, speed: wrong }, ..Swarm::default() },
            Swarm::default().with(Aggregate { rate: wrong, ..Aggregate::new(target) }),
        ] {
            assert!(swarm.check().is_err(), "{swarm:?}");
            assert!(empty().add_group(Group::steered(swarm)).is_err());
        }
    }
    assert!(HeightBand { low: f32::NEG_INFINITY, high: 1.0, rate: 1.0 }.check().is_err());
}

#[test]
fn only_agents_without_avoidance_may_have_no_neighbours() {
    let error = empty().add_group(Group { neighbours: 0, ..Group::default() }).unwrap_err().to_string();
    assert_eq!(error, "neighbours is 0, but must be from 1 to 1000, or 0 or all for agents that avoid no other agent");
    assert!(empty().add_group(Group { neighbours: 1001, ..Group::steered(Swarm::default()) }).is_err());
}

/// The guard has its own neighbour search.
#[test]
fn guarded_insects_do_not_overlap_without_neighbours() {
    let middle = Vec3::Z * 2.0;
    let crush = bare().with(Aggregate { rate: 5.0, ..Aggregate::new(Target::Point(middle)) });
    let group = Group { guard: true, ..crush.group() };
    assert_eq!(group.neighbours, 0);
    let mut world = world(group, midge(), &scattered(60, middle, 0.3));
    run(&mut world, 1.0);
    assert_eq!(world.overlapping(), []);
    let nearest = crate::swarm::places(&world).iter().map(|place| place.distance(middle)).fold(f32::INFINITY, f32::min);
    assert!(nearest < 0.03, "{nearest}");
}

/// A guide that returns NaN leaves insects at their velocity, and a swarm without insects does no harm.
#[test]
fn what_is_not_a_number_does_no_harm() {
    let mad = bare().with(Flow::of(|_: Vec3, _: f64| Vec3::NAN));
    let mut world = world(mad.group(), midge(), &scattered(20, Vec3::Z, 0.5));
    run(&mut world, 0.5);
    assert!(crate::swarm::places(&world).iter().all(|place| place.is_finite()));
    let mut no_agents: World = crate::swarm::world(Swarm::default().group(), Vehicle::default(), &[]);
    run(&mut no_agents, 0.1);
}

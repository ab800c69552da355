//! The scalar and the SIMD path give the same bits, at any SIMD level and for any number of threads.

use crate::swarm::{bare, empty, run, scattered, world};
use glam::Vec3;
use throng::motion::{Locomotion, Vehicle};
use throng::perceive::SimdLevel;
use throng::space::surface::{SeenFrom, Sphere};
use throng::steer::{Barriers, GroupFilter, Target};
use throng::{Group, World};
use throng_field::FadeOut;
use throng_steer::swarm::{
    Aggregate, Align, Attack, Escape, KeepOff, Phototaxis, Sedation, Swarm, Zones, locust, midge,
};

/// A swarm with all guides.
fn busy() -> Swarm {
    let middle = Vec3::new(0.3, -0.2, 3.0);
    let smoke = FadeOut::new(Sphere::new(middle + Vec3::X, 0.5).unwrap(), 0.5).unwrap();
    let ball = Sphere::new(middle - Vec3::X, 0.4).unwrap();
    let keep_off = KeepOff { barriers: Barriers::default().with(ball, SeenFrom::Outside), distance: 0.3, speed: 1.0 };
    Swarm { keep_off, ..Swarm::default() }
        .with(Aggregate::new(Target::Point(middle)))
        .with(Sedation { recovery: 0.1, ..Sedation::new(smoke) })
        .with(Phototaxis::new(Target::Point(middle + Vec3::Y)))
        .with(Attack { leaders: 0.3, follow: 0.3, ..Attack::new(Target::Agent(5)) })
        .with(Escape { within: 0.2, ..Escape::new(Target::Nearest(GroupFilter::All)) })
        .with(Align { distance: 0.2, weight: 0.2 })
        .with(Zones { reach: [0.03, 0.1, 0.25], ..Zones::default() })
}

fn groups() -> Vec<(&'static str, Group, Vehicle)> {
    let alone = Swarm { apart: bare().apart, own_noise: false, ..Swarm::default() };
    let ground = Vehicle { locomotion: Locomotion::Ground, ..midge() };
    vec![
        ("busy", busy().group(), midge()),
        ("locusts", busy().group(), locust()),
        ("without neighbours", alone.clone().group(), midge()),
        ("the nearest few", Group { neighbours: 5, ..busy().group() }, midge()),
        ("without noise", bare().with(Aggregate::new(Target::Point(Vec3::Z))).group(), midge()),
        ("on the ground", alone.group(), ground),
    ]
}

fn saved(mut world: World, instructions: SimdLevel) -> Vec<u8> {
    world.set_simd_level(instructions);
    run(&mut world, 0.7);
    world.save()
}

#[test]
fn simd_and_scalar_flights_are_equal() {
    for (name, group, vehicle) in groups() {
        let start = scattered(330, Vec3::Z * 3.0, 1.0);
        let start: Vec<Vec3> = match vehicle.locomotion {
            Locomotion::Ground => start.into_iter().map(|place| place.with_z(0.0)).collect(),
            _ => start,
        };
        let plain = saved(world(group.clone(), vehicle, &start), SimdLevel::Plain);
        for instructions in SimdLevel::ALL {
            assert!(saved(world(group.clone(), vehicle, &start), instructions) == plain, "{name}, {instructions:?}");
        }
    }
}

#[test]
fn threads_do_not_matter() {
    // enough insects that rows are sorted
    let start = scattered(5000, Vec3::Z * 3.0, 2.0);
    for (name, group, vehicle) in groups().into_iter().take(3) {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| saved(world(group.clone(), vehicle, &start), SimdLevel::Best))
        };
        let one = with(1);
        assert!(with(2) == one && with(3) == one, "{name}");
    }
}

/// Other agents do not change a swarm without neighbours, although it is then steered by the scalar path.
#[test]
fn company_does_not_matter_to_swarms_without_neighbours() {
    let swarm = Swarm { apart: bare().apart, ..Swarm::default() };
    let start = scattered(50, Vec3::Z * 3.0, 1.0);
    let mut alone = world(swarm.clone().group(), midge(), &start);
    let mut both = empty();
    let group = both.add_group(swarm.group()).unwrap();
    crate::swarm::add(&mut both, group, midge(), &start);
    let others = both.add_group(Swarm::default().group()).unwrap();
    crate::swarm::add(&mut both, others, midge(), &start);
    run(&mut alone, 1.0);
    run(&mut both, 1.0);
    assert_eq!(crate::swarm::places(&alone)[..], crate::swarm::places(&both)[..50]);
}

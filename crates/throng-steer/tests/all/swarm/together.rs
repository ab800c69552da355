//! Whole swarms in worlds.

use crate::swarm::{add, bare, empty, places, run, scattered, velocities, world};
use glam::{DVec2, Vec3};
use std::sync::Arc;
use throng::motion::{Locomotion, Vehicle};
use throng::space::Pathway;
use throng::space::surface::{Cuboid, Moved, Pose, SeenFrom, Sphere, Surface};
use throng::steer::{Barriers, GroupFilter, Target};
use throng::{Group, Settings, SubSteps, World};
use throng_field::{CurlNoise, NoiseWall, Octave, Potential};
use throng_steer::Seek;
use throng_steer::swarm::{
    Aggregate, Align, Attack, Escape, Flow, HeightBand, KeepOff, Migrate, Phototaxis, Sedation, Swarm, SwarmSpacing,
    locust, midge,
};

fn least_distance(all: &[Vec3]) -> f32 {
    let from = |k: usize| all[..k].iter().map(move |p| p.distance(all[k]));
    (0..all.len()).flat_map(from).fold(f32::INFINITY, f32::min)
}

fn mean(all: impl Iterator<Item = f32>) -> f32 {
    let (sum, count) = all.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
    sum / count
}

/// Without noise, an insect that a marker attracts is a damped oscillator: `tau x'' + x' + k x = 0`.
#[test]
fn a_marker_and_the_response_make_an_oscillator() {
    let start = Vec3::new(0.6, -0.3, 2.4);
    let rate = 6.0;
    let swarm = bare().with(Aggregate { rate, ..Aggregate::new(Target::Point(Vec3::Z * 2.0)) });
    let vehicle = Vehicle { max_speed: 50.0, max_force: 1e4, response: 0.1, ..midge() };
    let mut world = world(swarm.group(), vehicle, &[start]);
    // independent integration in small steps
    let (mut x, mut v, seconds) = (start.as_dvec3() - 2.0 * glam::DVec3::Z, glam::DVec3::ZERO, 1e-5);
    let mut most = 0.0_f64;
    for _ in 0..60 {
        world.step();
        for _ in 0..1667 {
            v += (-f64::from(rate) * x - v) / 0.1 * seconds;
            x += v * seconds;
        }
        most = most.max((places(&world)[0].as_dvec3() - 2.0 * glam::DVec3::Z).distance(x));
    }
    assert!(most < 0.05 * f64::from(start.length()), "{most}");
}

#[test]
fn noise_of_ones_own_is_independent_and_shared_noise_is_not() {
    // pairs 1 mm apart, far from each other
    let pairs: Vec<Vec3> = (0..60)
        .flat_map(|k| {
            let place = Vec3::new(4.0 * (k % 8) as f32, 4.0 * (k / 8) as f32, 3.0);
            [place, place + Vec3::X * 0.001]
        })
        .collect();
    let alike = |own_noise: bool| {
        let swarm = Swarm { own_noise, apart: bare().apart, ..Swarm::default() };
        let mut world = world(swarm.group(), midge(), &pairs);
        let (mut together, mut squares) = (0.0, 0.0);
        for _ in 0..60 {
            world.step();
            for pair in velocities(&world).chunks(2) {
                together += pair[0].dot(pair[1]);
                squares += 0.5 * (pair[0].length_squared() + pair[1].length_squared());
            }
        }
        assert!(squares > 100.0, "they move");
        together / squares
    };
    let (own, shared) = (alike(true), alike(false));
    assert!(own.abs() < 0.3 && shared > 0.8, "{own} {shared}");
}

#[test]
fn separation_keeps_them_apart() {
    let middle = Vec3::Z * 2.0;
    let drawn = |distance: f32| {
        let swarm = Swarm { apart: SwarmSpacing { distance, speed: 1.0 }, own_noise: false, ..Swarm::default() };
        let mut world =
            world(swarm.with(Aggregate::new(Target::Point(middle))).group(), midge(), &scattered(150, middle, 0.4));
        let mut least = Vec::new();
        for _ in 0..20 {
            run(&mut world, 0.5);
            least.push(least_distance(&places(&world)));
        }
        mean(least.into_iter())
    };
    let (with, without) = (drawn(0.1), drawn(0.0));
    assert!(with > 0.03 && without < 0.02, "{with} {without}");
    // two insects at one place separate too
    let swarm = Swarm { noise: None, apart: SwarmSpacing { distance: 0.1, speed: 1.0 }, ..Swarm::default() };
    let mut world = world(swarm.group(), midge(), &[middle; 2]);
    run(&mut world, 5.0);
    assert!(least_distance(&places(&world)) > 0.09);
}

/// With any velocity towards a surface: a flow into a box, and noise that ignores the box; and in a cage.
#[test]
fn obstacles_are_kept_off() {
    let pose = Pose::at(Vec3::new(3.0, 0.0, 2.0)).unwrap();
    let solid: Arc<dyn Surface> = Arc::new(Moved::new(Cuboid::new(Vec3::new(1.0, 2.0, 2.0)).unwrap(), pose));
    let cage: Arc<dyn Surface> = Arc::new(Sphere::new(Vec3::new(2.0, 0.0, 5.0), 4.5).unwrap());
    let barriers = Barriers::default().with(solid.clone(), SeenFrom::Outside).with(cage.clone(), SeenFrom::Inside);
    let mut noise = CurlNoise::new(Potential::Space, &Octave::turbulence(0.4, 0.5, 0.6, 2).unwrap(), 3).unwrap();
    for wall in [&solid, &cage] {
        noise = noise.with_wall(NoiseWall::new(wall.clone(), 0.4).unwrap());
    }
    let swarm = Swarm { keep_off: KeepOff { barriers, distance: 0.3, speed: 1.0 }, ..Swarm::default() };
    let swarm = swarm.with_noise(noise, true).with(Flow::of(|_: Vec3, _: f64| Vec3::X));
    let start: Vec<Vec3> = scattered(100, Vec3::new(0.0, 0.0, 3.0), 0.8);
    let mut world = world(swarm.group(), midge(), &start);
    let (mut near, mut far) = (f32::INFINITY, f32::NEG_INFINITY);
    for _ in 0..900 {
        world.step();
        for place in places(&world) {
            near = near.min(solid.query(place).distance);
            far = far.max(cage.query(place).distance);
        }
    }
    assert!(near > 0.0 && far < 0.0, "{near} {far}");
    assert!(near < 0.3, "they have come near: {near}");
}

#[test]
fn moths_fly_to_the_lamp_and_round_it() {
    let lamp = Vec3::Z * 3.0;
    let light = Phototaxis { orbit: 0.5, speed: 1.5, ..Phototaxis::new(Target::Point(lamp)) };
    let start = scattered(60, lamp, 2.8);
    let swarm = Swarm { noise: None, ..Swarm::default() }.with(light);
    let mut calm = world(swarm.group(), midge(), &start);
    run(&mut calm, 6.0);
    let mut spins = Vec3::ZERO;
    for (place, velocity) in places(&calm).into_iter().zip(velocities(&calm)) {
        let distance = place.distance(lamp);
        assert!((0.2..1.1).contains(&distance), "{distance}");
        assert!(velocity.length() > 0.7, "{velocity}");
        let spin = (place - lamp).cross(velocity).normalize();
        spins += spin / 60.0;
    }
    assert!(spins.length() < 0.4, "each about an axis of its own: {spins}");
    // with noise the insects stay near the lamp
    let mut wild = world(Swarm::default().with(light).group(), midge(), &start);
    run(&mut wild, 8.0);
    let distance = mean(places(&wild).iter().map(|place| place.distance(lamp)));
    assert!((0.3..1.2).contains(&distance), "{distance}");
}

#[test]
fn smoke_brings_them_down_until_it_has_gone() {
    let smoke = |place: Vec3, time: f64| (if place.x > 0.0 && time < 12.0 { 1.0 } else { 0.0 }, Vec3::ZERO);
    let sedation = Sedation { uptake: 0.5, recovery: 0.5, ..Sedation::new(smoke) };
    let (left, right) = (Vec3::new(-6.0, 0.0, 2.0), Vec3::new(6.0, 0.0, 2.0));
    let all: Vec<Vec3> = [scattered(40, left, 0.5), scattered(40, right, 0.5)].concat();
    let mut world = world(Swarm::default().with(sedation).group(), midge(), &all);
    run(&mut world, 12.0);
    for (place, velocity) in places(&world).into_iter().zip(velocities(&world)) {
        if place.x > 0.0 {
            assert!(place.z < 0.03 && velocity.length() < 1e-3, "down and at rest: {place} {velocity}");
        } else {
            assert!(place.z > 0.5, "not calmed: {place}");
        }
    }
    run(&mut world, 12.0);
    let flying = velocities(&world)[40..].iter().filter(|velocity| velocity.length() > 0.1).count();
    assert!(flying > 35, "{flying} fly again");
}

/// Returns the insects and a prey that flies straight on at half of their speed.
fn hunted(attack: Attack, seconds: f64) -> (Vec<Vec3>, Vec3) {
    let mut world = empty();
    let prey = Vehicle { max_speed: 0.75, ..midge() };
    let away = Seek { target: Target::Point(Vec3::new(0.0, 900.0, 5.0)) };
    let runner = world.add_group(Group { neighbours: 0, ..Group::steered(away) }).unwrap();
    add(&mut world, runner, prey, &[Vec3::new(0.0, 0.0, 5.0)]);
    let hunters = world.add_group(Swarm::default().with(attack).group()).unwrap();
    add(&mut world, hunters, midge(), &scattered(40, Vec3::new(6.0, 0.0, 5.0), 0.5));
    run(&mut world, seconds);
    let all = places(&world);
    (all[1..].to_vec(), all[0])
}

#[test]
fn prey_is_caught_by_leaders_and_followers() {
    let attack = Attack { speed: 1.5, ..Attack::new(Target::Agent(0)) };
    let (all, prey) = hunted(attack, 9.0);
    let distance = mean(all.iter().map(|place| place.distance(prey)));
    assert!(distance < 0.5, "{distance}");
    let (all, prey) = hunted(Attack { leaders: 0.2, follow: 1.0, ..attack }, 9.0);
    let near = all.iter().filter(|place| place.distance(prey) < 1.0).count();
    assert!(near > 25, "{near}");
    // without followers, four fifths stay where they were
    let (all, prey) = hunted(Attack { leaders: 0.2, follow: 0.0, ..attack }, 9.0);
    let near = all.iter().filter(|place| place.distance(prey) < 1.0).count();
    assert!((2..=16).contains(&near), "{near}");
}

#[test]
fn locusts_migrate_together_along_their_path() {
    let corners = [Vec3::new(0.0, 0.0, 5.0), Vec3::new(30.0, 0.0, 5.0), Vec3::new(30.0, 30.0, 8.0)];
    let path = Arc::new(Pathway::new(&corners, 1.5, false).unwrap());
    let migrate = Migrate { path: path.clone(), speed: 2.5, rate: 1.0 };
    let band = HeightBand { low: 4.0, high: 9.0, rate: 2.0 };
    let start = scattered(80, Vec3::new(1.0, 0.0, 5.0), 1.2);
    let order = |weight: f32| {
        let swarm = Swarm { apart: SwarmSpacing { distance: 0.3, speed: 1.0 }, ..Swarm::default() };
        let swarm = swarm.with(migrate.clone()).with(band).with(Align { distance: 1.5, weight });
        let mut world = world(swarm.group(), locust(), &start);
        let mut order = 0.0;
        for _ in 0..8 {
            run(&mut world, 1.0);
            let sum: Vec3 = velocities(&world).iter().map(|velocity| velocity.normalize_or_zero()).sum();
            order += sum.length() / 80.0 / 8.0;
        }
        for place in places(&world) {
            let near = path.nearest(place);
            assert!(near.along > 14.0 && near.outside < 1.0, "{place}: {near:?}");
            assert!((3.8..9.2).contains(&place.z));
        }
        order
    };
    let (alone, aligned) = (order(0.0), order(1.0));
    assert!(aligned > alone && aligned > 0.95, "{alone} {aligned}");
}

#[test]
fn escaping_insects_are_not_caught() {
    let nearest = |escapes: bool| {
        let mut world = empty();
        let bird = Vehicle { max_speed: 1.5, ..midge() };
        let through = Seek { target: Target::Point(Vec3::new(50.0, 0.0, 4.0)) };
        let predator = world.add_group(Group { neighbours: 0, ..Group::steered(through) }).unwrap();
        add(&mut world, predator, bird, &[Vec3::new(-4.0, 0.0, 4.0)]);
        let escape = Escape {
            within: if escapes { 1.0 } else { 1e-6 },
            ..Escape::new(Target::Nearest(GroupFilter::OtherGroups))
        };
        let marker = Aggregate::new(Target::Point(Vec3::Z * 4.0));
        let group = Swarm::default().with(marker).with(escape).group();
        let group = world.add_group(group).unwrap();
        add(&mut world, group, midge(), &scattered(60, Vec3::Z * 4.0, 0.8));
        let mut all = Vec::new();
        for _ in 0..360 {
            world.step();
            let places = places(&world);
            all.push(places[1..].iter().map(|place| place.distance(places[0])).fold(f32::INFINITY, f32::min));
        }
        all.into_iter().fold(f32::INFINITY, f32::min)
    };
    let (escaped, caught) = (nearest(true), nearest(false));
    assert!(escaped > 0.2 && caught < 0.15, "{escaped} {caught}");
}

#[test]
fn speeds_stay_within_those_of_the_vehicle() {
    for (vehicle, least) in [(locust(), 1.0), (Vehicle { max_speed: 0.5, ..midge() }, 0.0)] {
        let marker = Aggregate::new(Target::Point(Vec3::Z * 9.0));
        let mut world = world(Swarm::default().with(marker).group(), vehicle, &scattered(80, Vec3::Z * 9.0, 3.0));
        for _ in 0..200 {
            world.step();
            for velocity in velocities(&world) {
                let speed = velocity.length();
                assert!(speed >= least * (1.0 - 1e-5) && speed <= vehicle.max_speed * (1.0 + 1e-5), "{speed}");
            }
        }
    }
}

/// Insects on the ground stay there.
#[test]
fn insects_on_the_ground_stay_there() {
    let vehicle = Vehicle { locomotion: Locomotion::Ground, ..midge() };
    let start: Vec<Vec3> = scattered(50, Vec3::ZERO, 1.0).into_iter().map(|place| place.with_z(0.0)).collect();
    let light = Phototaxis::new(Target::Point(Vec3::Z * 2.0));
    let mut world = world(Swarm::default().with(light).group(), vehicle, &start);
    run(&mut world, 4.0);
    assert!(places(&world).iter().all(|place| place.z == 0.0));
    assert!(velocities(&world).iter().any(|velocity| velocity.length() > 0.3));
}

/// The same swarm at another place, with all its guides: only rounding differs.
#[test]
fn it_does_not_matter_where_a_swarm_is() {
    let flown = |by: Vec3, origin: DVec2| {
        let marker = Target::Point(Vec3::Z * 3.0 + by);
        let swarm =
            Swarm { noise: None, ..Swarm::default() }.with(Aggregate::new(marker)).with(Phototaxis::new(marker));
        let mut world =
            World::new(Settings { step: 1.0 / 60.0, sub_steps: SubSteps::Fixed(1), origin, ..Settings::default() })
                .unwrap();
        let group = world.add_group(swarm.group()).unwrap();
        let start: Vec<Vec3> = scattered(30, Vec3::Z * 3.0, 2.0).iter().map(|place| place + by).collect();
        add(&mut world, group, midge(), &start);
        run(&mut world, 0.7);
        places(&world).into_iter().map(|place| place - by).collect::<Vec<Vec3>>()
    };
    let (here, there) = (flown(Vec3::ZERO, DVec2::ZERO), flown(Vec3::new(64.0, -32.0, 4.0), DVec2::ZERO));
    for (here, there) in here.iter().zip(&there) {
        assert!(here.distance(*there) < 2e-3, "{here} {there}");
    }
}

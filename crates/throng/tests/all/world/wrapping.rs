//! Agents that leave a ball on one side and enter on the other: nothing overlaps, and the bits do not depend on threads,
//! instructions, the order of insertion or loading. Checked from positions and obstacles alone.

use crate::polygons::apart;
use crate::world::common::{Draw, journey_to, with_settings};
use crate::world::determinism::with_threads;
use crate::world::oracle::distance_to;
use glam::{DVec2, DVec3, Vec3};
use std::collections::BTreeMap;
use std::sync::Arc;
use throng::avoid::{NoAvoidance, Orca, Orca3d};
use throng::motion::{Holonomic, Locomotion, Motor, Vehicle, WrapAround};
use throng::perceive::SimdLevel;
use throng::space::surface::{SeenFrom, Sphere};
use throng::steer::Barriers;
use throng::{Agent, Body, EventKind, Group, GroupId, Keyframe, Obstacle, Script, Status, SubSteps, World};
use throng_steer::{Flocking, Wander};

/// A sphere that is solid to some groups.
const SOLID: (DVec3, f64) = (DVec3::new(-1.0, 1.5, 0.0), 0.8);
/// Part of the smaller radius by which bodies may penetrate each other.
const TOLERANCE: f64 = 1e-4;

/// The agents of a random world.
#[derive(Clone, Copy, Debug)]
struct Family {
    case: u64,
    count: usize,
    /// Shuffles the order in which agents are added.
    order: u64,
}

/// A body at one time, in local coordinates.
#[derive(Clone, Copy)]
struct Placed {
    at: DVec3,
    corners: [DVec2; 4],
    is_disc: bool,
    radius: f64,
    guarded: bool,
    /// Whether `SOLID` is solid to it, at this height.
    solid: Option<f64>,
    layers: (u32, u32),
}

impl Placed {
    fn new(at: DVec3, heading: f64, body: Body, group: &Group, layers: (u32, u32), height: f64) -> Self {
        let (along, half) = (DVec2::from_angle(heading), body.core.as_dvec2());
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
            .map(|(x, y)| at.truncate() + along * (x * half.x) + along.perp() * (y * half.y));
        let is_disc = half == DVec2::ZERO;
        let solid = (!group.solid.0.is_empty()).then_some(height);
        Self { at, corners, is_disc, radius: body.radius.into(), guarded: group.guard, solid, layers }
    }

    /// How deep it is in another body, over the smaller radius; negative for bodies apart.
    fn depth_in(&self, other: &Self) -> f64 {
        let meet = self.layers.0 & other.layers.1 | self.layers.1 & other.layers.0;
        if meet == 0 || !(self.guarded || other.guarded) {
            return f64::NEG_INFINITY;
        }
        let distance = if self.is_disc && other.is_disc {
            self.at.distance(other.at)
        } else {
            apart(&self.corners, &other.corners)
        };
        (self.radius + other.radius - distance) / self.radius.min(other.radius)
    }

    /// How deep it is in walls and solids, over its radius.
    fn depth_in_place(&self, obstacles: &[Obstacle]) -> f64 {
        let distance = |obstacle: &Obstacle| match obstacle {
            _ if self.is_disc => distance_to(obstacle, self.at.truncate()),
            Obstacle::Circle { center, radius } => apart(&self.corners, &[*center]) - radius,
            Obstacle::Polygon { corners } => apart(&self.corners, corners),
            Obstacle::Wall { points } => {
                points.windows(2).map(|side| apart(&self.corners, side)).fold(f64::INFINITY, f64::min)
            }
        };
        let walls = obstacles.iter().filter(|_| self.guarded).map(distance);
        let far = self.corners.iter().map(|corner| corner.distance(self.at.truncate())).fold(0.0, f64::max);
        let solid = self.solid.map(|z| self.at.distance(SOLID.0 + DVec3::Z * z) - SOLID.1 - far);
        (self.radius - walls.chain(solid).fold(f64::INFINITY, f64::min)) / self.radius
    }
}

/// The balls of a family are round a point at this height.
fn height(Family { case, .. }: Family) -> f64 {
    if flies(case) { radius(case) + 1.0 } else { 0.0 }
}

fn flies(case: u64) -> bool {
    case % 2 == 1
}

fn radius(case: u64) -> f64 {
    4.0 + (case % 5) as f64 * 0.5
}

fn groups(family: Family, origin: DVec2) -> Vec<Group> {
    let Family { case, count, .. } = family;
    let (flies, z) = (flies(case), height(family));
    let large = if flies { (count as f64 / 40.0).cbrt() } else { (count as f64 / 40.0).sqrt() };
    let ball =
        |part: f64| Some(WrapAround { center: Vec3::Z * z as f32, radius: (radius(case) * large * part) as f32 });
    let near = |group: Group| Group { neighbours: 10, neighbour_distance: 3.0, ..group };
    let wander = || near(Group::steered(Wander::default()));
    let sphere = Sphere::new((SOLID.0 + DVec3::Z * z).as_vec3(), SOLID.1 as f32).unwrap();
    let solid = Barriers::default().with(sphere, SeenFrom::Outside);
    let model: Arc<dyn throng::avoid::LocalModel> =
        if flies { Arc::new(Orca3d::default()) } else { Arc::new(Orca::default()) };
    let all = [
        Group { wrap_around: ball(1.0), model, ..Group::default() },
        Group { wrap_around: ball(0.9), model: Arc::new(NoAvoidance), ..Group::default() },
        Group { wrap_around: ball(1.0), guard: true, ..wander() },
        Group { wrap_around: ball(1.0), solid: solid.clone(), ..wander() },
        Group { wrap_around: ball(0.8), guard: true, solid, model: Arc::new(NoAvoidance), ..Group::default() },
        Group { wrap_around: ball(1.0), guard: false, model: Arc::new(NoAvoidance), ..Group::default() },
        Group { wrap_around: ball(1.0), guard: true, ..near(Group::steered(Flocking::default())) },
        // agents that stay are in the way of the rest
        Group { name: "posts".into(), model: Arc::new(NoAvoidance), ..Group::default() },
    ];
    let named = |(index, group): (usize, Group)| Group { name: format!("{index}"), origin, ..group };
    all.into_iter().enumerate().map(named).collect()
}

/// The motor of the agents of a group.
fn motor(group: usize, flies: bool) -> Motor {
    let locomotion = match group {
        0 | 1 | 4 | 5 | 7 => return Holonomic { max_speed: 2.0, ..Holonomic::default() }.into(),
        _ if !flies => Locomotion::Ground,
        2 => Locomotion::Level,
        _ => Locomotion::Banking,
    };
    Vehicle { locomotion, max_speed: 2.0, max_force: 8.0, ..Vehicle::default() }.into()
}

/// The groups with agents: all, or one, for which the engine has SIMD kernels.
fn used(case: u64) -> &'static [usize] {
    match (case / 2) % 5 {
        0 | 1 => &[0, 1, 2, 3, 4, 5, 6, 7],
        2 => &[0],
        3 => &[3],
        _ => &[5],
    }
}

fn clutter(draw: &mut Draw, origin: DVec2, reach: f64) -> Vec<Obstacle> {
    let mut thing = |kind: usize| {
        let at = draw.point(DVec2::splat(-reach), DVec2::splat(reach)) + origin;
        let end = at + DVec2::from_angle(draw.between(0.0, 6.0)) * draw.between(0.5, 2.0);
        match kind {
            0 => Obstacle::Circle { center: at, radius: draw.between(0.2, 0.6) },
            1 => Obstacle::Wall { points: vec![at, end] },
            _ => Obstacle::Polygon { corners: vec![at, end, end + (end - at).perp() * 0.7] },
        }
    };
    (0..6).map(|index| thing(index % 3)).collect()
}

fn world(family: Family) -> World {
    let Family { case, count, order } = family;
    let mut draw = Draw::new(case * 7919 + 13);
    let step = draw.one_of(&[0.03, 0.1, 0.25]);
    let origin = draw.point(DVec2::splat(-3000.0), DVec2::splat(3000.0)).round();
    let mut world = with_settings(step, SubSteps::Fixed(1), origin);
    let (flies, z, groups) = (flies(case), height(family), groups(family, origin));
    let ids: Vec<GroupId> = groups.iter().map(|group| world.add_group(group.clone()).unwrap()).collect();
    let ball = groups[0].wrap_around.unwrap();
    let reach = f64::from(ball.radius);
    for obstacle in clutter(&mut draw, origin, 1.2 * reach) {
        world.add_obstacle(obstacle).unwrap();
    }
    let obstacles = local_obstacles(&world);
    let (mut taken, mut agents) = (Vec::<Placed>::new(), Vec::new());
    for number in 0..count as u32 {
        let index = draw.one_of(used(case));
        let width = draw.between(0.2, 0.6) as f32;
        let long = Body::capsule(width * 2.5, width);
        let block = Body::rectangle(width * 2.0, width);
        let disc = Body::disc(width * 0.5);
        let body = if flies { disc } else { draw.one_of(&[disc, disc, long, block]) };
        let heading = draw.between(-3.0, 3.0) as f32;
        let avoids = draw.one_of(&[1, 1, 1, 1, 3]);
        let layers = (draw.one_of(&[1, 1, 1, 1, 2]), avoids);
        let spot = (0..200).find_map(|_| {
            let at = draw.point(DVec2::splat(-reach), DVec2::splat(reach));
            let up = if flies { draw.between(-reach, reach) } else { 0.0 };
            let at = at.as_vec2().as_dvec2().extend(f64::from((z + up) as f32));
            let larger = Body { radius: body.radius * 1.05, ..body };
            let placed = Placed::new(at, heading.into(), larger, &groups[index], layers, z);
            let is_free = at.distance(DVec3::Z * z) < 0.8 * reach
                && placed.depth_in_place(&obstacles) < 0.0
                && taken.iter().all(|other| placed.depth_in(other) < 0.0);
            is_free.then_some((at, placed))
        });
        let Some((at, placed)) = spot else { continue };
        let speed = draw.between(0.8, 2.0) as f32;
        let agent = Agent {
            position: at + origin.extend(0.0),
            heading: Some(heading),
            group: ids[index],
            preferred_speed: speed,
            motor: motor(index, flies),
            number: Some(number),
            layers: layers.0,
            avoids: layers.1,
            ..Agent::default()
        };
        let towards =
            DVec2::from_angle(draw.between(0.0, 6.3)).extend(if flies { draw.between(-1.0, 1.0) } else { 0.0 });
        let walks = groups[index].guidance.is_journey() && index != 7;
        let velocity = walks.then_some(towards.normalize().as_vec3() * speed);
        agents.push((agent.with_body(body), velocity));
        taken.push(placed);
    }
    if order != 0 {
        Draw::new(order).shuffle(&mut agents);
    }
    for (agent, velocity) in agents {
        // a place in an obstacle is refused to a guarded agent; polygons of the oracle have no inside
        if let Ok(id) = world.add_agent(agent) {
            world.set_preferred_velocity(id, velocity).unwrap();
        }
    }
    world
}

fn local_obstacles(world: &World) -> Vec<Obstacle> {
    let origin = world.settings().origin;
    world.place().obstacles().map(|obstacle| obstacle.clone().moved(-origin)).collect()
}

/// The bodies by number.
fn bodies(world: &World, z: f64) -> BTreeMap<u32, (GroupId, Placed)> {
    let agents = world.relative_columns();
    let placed = |row: usize| {
        let at = agents.position[row].as_dvec2().extend(agents.altitude[row].into());
        let layers = (agents.layers[row], agents.avoids[row]);
        let group = agents.group[row];
        let body = Placed::new(at, agents.heading[row].into(), agents.body(row), world.group(group), layers, z);
        (agents.number[row], (group, body))
    };
    (0..agents.len()).map(placed).collect()
}

/// Panics if anything overlaps.
fn assert_apart(all: &BTreeMap<u32, (GroupId, Placed)>, obstacles: &[Obstacle], what: &str) {
    for (number, (_, one)) in all {
        let depth = one.depth_in_place(obstacles);
        assert!(depth < TOLERANCE, "{what}: agent {number} is {depth} radii in a wall or a solid");
        for (other, (_, two)) in all.range(..number) {
            let depth = one.depth_in(two);
            assert!(depth < TOLERANCE, "{what}: agents {number} and {other} overlap by {depth} radii");
        }
    }
}

#[test]
fn nothing_overlaps_where_agents_wrap_around() {
    let mut jumps = BTreeMap::<(bool, String), u32>::new();
    let mut late = 0;
    for case in 0..30 {
        let family = Family { case, count: 40, order: 0 };
        let mut world = world(family);
        let (obstacles, z, step) = (local_obstacles(&world), height(family), world.settings().step);
        let mut before = bodies(&world, z);
        assert_apart(&before, &obstacles, &format!("the start of case {case}"));
        for made in 1..=300 {
            world.step();
            let after = bodies(&world, z);
            assert_apart(&after, &obstacles, &format!("step {made} of case {case}"));
            for (number, &(group, Placed { at, .. })) in &after {
                let (from, reach) = (before[number].1.at, 2.0 * step * 1.001 + 1e-4);
                if at.distance(from) > reach {
                    // a jump through the centre by the diameter, from where it could walk to
                    let ball = world.group(group).wrap_around.expect("only agents that wrap around jump");
                    let (center, radius) = (ball.center.as_dvec3(), f64::from(ball.radius));
                    let out = (at - center).length();
                    let left = [out - 2.0 * radius, out + 2.0 * radius].map(|d| center + (at - center) * (d / out));
                    let left = left.into_iter().min_by(|a, b| a.distance(from).total_cmp(&b.distance(from))).unwrap();
                    assert!(left.distance(from) <= reach, "case {case}, step {made}: {from} to {at}");
                    assert!(left.distance(center) > radius * (1.0 - 1e-5), "case {case}: it was inside");
                    late += u32::from(from.distance(center) > radius + 1e-3);
                    *jumps.entry((flies(case), world.group(group).name.clone())).or_default() += 1;
                }
            }
            before = after;
        }
        let agents = world.relative_columns();
        let most = 2.0 * world.time() * 1.001;
        assert!(agents.walked.iter().all(|&walked| walked <= most), "case {case}: a jump counts as walked");
    }
    for flies in [false, true] {
        for group in 0..7 {
            let found = jumps.get(&(flies, group.to_string())).copied().unwrap_or(0);
            assert!(found >= 5, "group {group}, in the air {flies}: {jumps:?}");
        }
    }
    assert!(late > 20, "{late} of {jumps:?} waited for room");
}

/// Hashes of the state at intervals, and the bytes that are saved at the end.
fn history(mut world: World) -> (Vec<u64>, Vec<u8>) {
    let hashes = (0..4).map(|_| {
        (0..10).for_each(|_| world.step());
        world.state_hash()
    });
    (hashes.collect(), world.save())
}

#[test]
fn threads_instructions_and_order_do_not_change_the_bits() {
    for case in 0..10 {
        let family = Family { case, count: 300, order: 0 };
        let run = |instructions: SimdLevel, order: u64| {
            let mut world = world(Family { order, ..family });
            world.set_simd_level(instructions);
            history(world)
        };
        let plain = with_threads(1, || run(SimdLevel::Plain, 0));
        for instructions in SimdLevel::ALL {
            assert!(run(instructions, 0).0 == plain.0, "case {case}: {instructions:?}");
        }
        for threads in [1, 4] {
            assert!(with_threads(threads, || run(SimdLevel::Best, 0)).0 == plain.0, "case {case}: {threads} threads");
        }
        assert!(run(SimdLevel::Best, 5).0 == plain.0, "case {case}: another order of insertion");
    }
}

#[test]
fn a_loaded_world_goes_on_with_the_same_bits() {
    for case in 0..10 {
        let family = Family { case, count: 80, order: 0 };
        let mut original = world(family);
        for part in 0..4 {
            (0..37).for_each(|_| original.step());
            let mut loaded = world(family);
            loaded.load(&original.save()).unwrap();
            for _ in 0..20 {
                original.step();
                loaded.step();
                assert_eq!(original.state_hash(), loaded.state_hash(), "case {case}, part {part}");
            }
        }
    }
}

fn ball(radius: f32) -> Option<WrapAround> {
    Some(WrapAround { center: Vec3::ZERO, radius })
}

#[test]
fn an_agent_waits_outside_until_there_is_room() {
    for obstacle in [false, true] {
        let mut world = with_settings(0.1, SubSteps::Fixed(1), DVec2::ZERO);
        let group = world.add_group(Group { wrap_around: ball(3.0), ..Group::default() }).unwrap();
        let walks = world.add_agent(Agent { group, ..Agent::at([2.8, 0.0]) }).unwrap();
        world.set_preferred_velocity(walks, Vec3::X).unwrap();
        // as far as it gets while it waits
        let stands = (!obstacle).then(|| world.add_agent(Agent { radius: 0.9, ..Agent::at([-2.4, 0.0]) }).unwrap());
        let circle = Obstacle::Circle { center: DVec2::new(-2.4, 0.0), radius: 0.9 };
        let stays = obstacle.then(|| world.add_obstacle(circle).unwrap());
        let x = |world: &World| world.position(walks).unwrap().x;
        (0..10).for_each(|_| world.step());
        let before = x(&world);
        assert!((3.2..4.0).contains(&before), "it has left the ball: {before}");
        if let Some(id) = stands {
            world.remove_agent(id);
        }
        if let Some(id) = stays {
            world.remove_obstacle(id);
        }
        world.step();
        let there = x(&world);
        assert!((before - there - 6.0).abs() < 0.2, "from {before} to {there}");
    }
}

#[test]
fn only_what_may_not_overlap_is_in_the_way() {
    // whether the agent that wraps around and the agent in its way are guarded
    for (own, other) in [(false, false), (false, true), (true, false), (true, true)] {
        let mut world = with_settings(0.1, SubSteps::Fixed(1), DVec2::ZERO);
        let wraps = Group { wrap_around: ball(3.0), guard: own, model: Arc::new(NoAvoidance), ..Group::default() };
        let stays = Group { guard: other, wrap_around: None, ..wraps.clone() };
        let group = world.add_group(wraps).unwrap();
        let walks = world.add_agent(Agent { group, ..Agent::at([2.99, 0.0]) }).unwrap();
        world.set_preferred_velocity(walks, Vec3::X).unwrap();
        let group = world.add_group(stays).unwrap();
        world.add_agent(Agent { group, ..Agent::at([-2.9, 0.0]) }).unwrap();
        world.step();
        let jumped = world.position(walks).unwrap().x < 0.0;
        assert_eq!(jumped, !(own || other), "guarded: {own}, {other}");
    }
}

#[test]
fn of_two_agents_with_one_place_to_enter_the_lower_number_enters() {
    for order in [[0, 1], [1, 0]] {
        let mut world = with_settings(0.1, SubSteps::Fixed(1), DVec2::ZERO);
        let groups = [Vec3::ZERO, Vec3::new(-3.0, -3.0, 0.0)].map(|center| {
            let wrap_around = Some(WrapAround { center, radius: 3.0 });
            world.add_group(Group { wrap_around, model: Arc::new(NoAvoidance), ..Group::default() }).unwrap()
        });
        // both would enter at (-3, 0)
        let at = [DVec2::new(2.99, 0.0), DVec2::new(-3.0, -5.99)];
        for index in order {
            let (group, number) = (groups[index], Some(index as u32));
            let id = world.add_agent(Agent { group, number, ..Agent::at(at[index]) }).unwrap();
            world.set_preferred_velocity(id, [Vec3::X, Vec3::NEG_Y][index]).unwrap();
        }
        world.step();
        let place = |number: u32| {
            let agents = world.relative_columns();
            agents.position[agents.number.iter().position(|&one| one == number).unwrap()]
        };
        assert!(place(0).x < 0.0 && place(1).y < -5.9, "{order:?}: {} and {}", place(0), place(1));
    }
}

#[test]
fn a_walker_plans_its_way_anew_after_a_jump() {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    let group = world.add_group(Group { wrap_around: ball(6.0), ..Group::default() }).unwrap();
    let points = [(3.0, -3.0), (3.0, 3.0)].map(DVec2::from).to_vec();
    world.add_obstacle(Obstacle::Wall { points }).unwrap();
    // behind the wall, first by its end in the north
    let journey = journey_to(&mut world, DVec2::new(4.5, 0.0));
    let walker = world.add_agent(Agent { group, journey, ..Agent::at([0.0, 4.0]) }).unwrap();
    world.step();
    world.set_preferred_velocity(walker, Vec3::Y).unwrap();
    while world.position(walker).unwrap().y > 0.0 {
        assert!(world.time() < 9.0, "it does not wrap around");
        world.step();
    }
    // both ends are in sight, and the end in the south is nearer
    world.set_preferred_velocity(walker, None).unwrap();
    while !world.finished() {
        assert!(world.time() < 30.0, "it does not get there");
        world.step();
        let at = world.position(walker).unwrap();
        assert!(at.y < 0.2, "it goes the former way: {at}");
    }
}

#[test]
fn on_its_way_to_a_goal_outside_a_walker_plans_anew_after_every_jump() {
    let mut world = with_settings(0.1, SubSteps::Fixed(1), DVec2::ZERO);
    let group = world.add_group(Group { wrap_around: ball(3.0), ..Group::default() }).unwrap();
    let journey = journey_to(&mut world, DVec2::X * 9.0);
    let walker = world.add_agent(Agent { group, journey, ..Agent::at([0.0, 0.0]) }).unwrap();
    let (mut jumps, mut planned, mut before) = (0, 0, 0.0);
    for _ in 0..300 {
        world.step();
        planned += world.events().iter().filter(|event| event.kind == EventKind::Replanned).count();
        assert_eq!(planned, jumps, "in the step after");
        let x = world.position(walker).unwrap().x;
        assert!(x.abs() < 3.0 + 0.2, "{x}");
        jumps += usize::from(x < before - 5.0);
        before = x;
    }
    assert!(jumps > 3 && world.agent(walker).is_some_and(|agent| agent.status() == Status::Walking), "{jumps} jumps");
}

/// The ground is a floor of the ball too, and an agent on the ground stays there.
#[test]
fn the_ground_bounds_the_ball() {
    let center = Vec3::Z * 2.0;
    let group = Group { wrap_around: Some(WrapAround { center, radius: 3.0 }), ..Group::default() };
    let settled = |altitude: f64, velocity: Vec3| {
        let mut world = with_settings(0.1, SubSteps::Fixed(1), DVec2::ZERO);
        let group = world.add_group(group.clone()).unwrap();
        let id = world.add_agent(Agent { group, position: DVec3::Z * altitude, ..Agent::default() }).unwrap();
        world.set_preferred_velocity(id, velocity).unwrap();
        let mut places = Vec::new();
        for _ in 0..150 {
            world.step();
            let row = world.row(id).unwrap();
            let agents = world.relative_columns();
            places.push(agents.position[row].extend(agents.altitude[row]));
        }
        places
    };
    let rises = settled(2.0, Vec3::Z);
    assert!(rises.iter().all(|at| (0.0..5.2).contains(&at.z)));
    let entered = rises.windows(2).filter(|pair| pair[1].z < pair[0].z).map(|pair| pair[1].z);
    assert!(entered.clone().count() >= 2 && entered.into_iter().all(|z| z == 0.0), "{rises:?}");
    let walks = settled(0.0, Vec3::X);
    // the ball cuts the ground in a circle
    let radius = 5.0_f32.sqrt();
    assert!(walks.iter().all(|at| at.z == 0.0 && at.x.abs() < radius + 1e-4), "{walks:?}");
    assert!(walks.windows(2).filter(|pair| (pair[0].x - pair[1].x - 2.0 * radius).abs() < 0.2).count() >= 2);
}

#[test]
fn moving_obstacles_go_where_their_scripts_lead() {
    let mut world = with_settings(0.1, SubSteps::Fixed(1), DVec2::ZERO);
    let group = world.add_group(Group { wrap_around: ball(3.0), ..Group::default() }).unwrap();
    let keyframe = |time, x| Keyframe { time, at: DVec2::X * x, heading: 0.0 };
    let script = world.add_script(Script { keyframes: vec![keyframe(0.0, 0.0), keyframe(9.0, 9.0)], repeat: false });
    let agent = Agent { group, script: Some(script.unwrap()), motor: motor(0, false), ..Agent::default() };
    let id = world.add_agent(agent).unwrap();
    (0..90).for_each(|_| world.step());
    assert!((world.position(id).unwrap().x - 9.0).abs() < 1e-3);
}

//! Hashes of the steering of each behaviour in random situations, and of its trace.

use crate::draw::Draw;
use crate::harness::{Actor, Stage};
use crate::results::Results;
use glam::{DVec2, Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, PI};
use std::fmt::Debug;
use std::sync::Arc;
use throng::motion::{Basis, Forces, Integrator, Limits, Locomotion, Motion, Steering, Vehicle, WrapAround};
use throng::motion::{faces, limit, turn};
use throng::parameters::Angle;
use throng::space::surface::{Barrier, Cuboid, Cylinder, Moved, Plane, Pose, SeenFrom, Sphere};
use throng::space::{PathDirection, Pathway, Raster};
use throng::steer::{
    Barriers, Behaviour, BoxedBehaviour, GroupFilter, Rng, SteeringInput, Stimulus, Target, TraceEntry, TraceRecorder,
};
use throng_steer::{
    Alignment, Allocation, Amortised, Arrive, AvoidNeighbours, AvoidObstacles, Boids, CloseAvoidance, Cohesion,
    Condition, ConstantForce, Contain, ContextSteering, CrowdPath, Dithering, Dock, Docking, DriveByMap, Evade,
    EvadeAll, Explore, Face, Falloff, Fear, Flee, Flocking, FollowFlow, FollowLeader, FollowPath, FollowWall, Forage,
    FractalWander, HeadFor, Hide, Hold, Interpose, Irregular, KeepFormation, KeepStation, Limited, LookWhereYouGo,
    MatchOrientation, MatchVelocity, MoveForward, Neighbourhood, Noise, OffsetPursuit, Pattern, Prediction, Priority,
    Pursue, Queue, QueueAtDoor, Rule, RunningSum, Seek, Separation, Shadow, SlipThrough, State, StayOnPath,
    StopAndWait, Strengths, Switch, TargetSpeed, Tether, UnalignedAvoidance, Wander, WeightedSum, Whiskers, assign,
    takeoff,
};

type Named = (&'static str, BoxedBehaviour);

/// A place among the actors. Actors on the grid can be exactly there.
const PLACE: Vec3 = Vec3::new(2.0, -1.0, 0.0);
const POINT: Target = Target::Point(PLACE);
const AGENT: Target = Target::Agent(1);
const LEADER: Target = Target::Agent(0);
const NEAR: Target = Target::Nearest(GroupFilter::All);
const STRANGER: Target = Target::Nearest(GroupFilter::OtherGroups);

/// A neighbourhood with all of its limits.
const SOME: Neighbourhood =
    Neighbourhood { distance: 3.0, angle: radians(2.0), always: 2.0, most: 2, groups: GroupFilter::OtherGroups };
const FRIENDS: Neighbourhood =
    Neighbourhood { distance: 2.0, angle: radians(1.2), always: 3.0, most: 3, groups: GroupFilter::OwnGroup };

const fn radians(radians: f32) -> Angle {
    Angle::from_radians(radians)
}

fn single() -> Vec<Named> {
    let predicts = Prediction::Distance { per_metre: 0.3, most: 0.8 };
    let flow =
        |at: Vec3, time: f64| if at.x > 5.0 { Vec3::ZERO } else { Vec3::new(at.y, time as f32 * 0.2, at.x) * 0.4 };
    let offset = Vec3::new(-1.0, 0.7, 0.4);
    let dock = Docking { place: PLACE, direction: Vec3::new(1.0, 2.0, 0.0), speed: 0.0, time: None };
    let wavers = Noise { period: 0.7, octaves: 2, gain: 0.7, turbulent: true };
    let explore = Explore { min: Vec3::splat(-3.0), max: Vec3::new(3.0, 4.0, 2.0), columns: 3, rows: 2, levels: 2 };
    let follow = |prediction| FollowFlow { flow: Arc::new(flow), prediction };
    let slip = SlipThrough::new(POINT);
    let evade_all = EvadeAll { groups: GroupFilter::All, ahead: 0.9, near: 0.7, behind: 0.2 };
    vec![
        ("seek", Seek { target: POINT }.into()),
        ("seek, its goal", Seek { target: Target::Goal }.into()),
        ("seek, an agent", Seek { target: AGENT }.into()),
        ("seek, a group", Seek { target: Target::Nearest(GroupFilter::Group(1)) }.into()),
        ("flee", Flee::new(NEAR).into()),
        ("flee, near", Flee { target: POINT, panic_distance: 2.0 }.into()),
        ("pursue", Pursue::new(NEAR).into()),
        ("pursue, soon", Pursue { quarry: AGENT, prediction: Prediction::Cases { most: 0.6 } }.into()),
        ("pursue, by the distance", Pursue { quarry: AGENT, prediction: predicts }.into()),
        ("evade", Evade::new(STRANGER).into()),
        ("evade, near", Evade { menace: AGENT, prediction: predicts, panic_distance: 3.0 }.into()),
        ("evade, always", Evade { prediction: Prediction::Constant(0.4), ..Evade::new(NEAR) }.into()),
        ("evade all", EvadeAll::default().into()),
        ("evade all, weakly", evade_all.into()),
        ("pass", OffsetPursuit { quarry: AGENT, prediction: Prediction::default(), distance: 1.5 }.into()),
        ("pass, near", OffsetPursuit { quarry: POINT, prediction: predicts, distance: 0.5 }.into()),
        ("keep station", KeepStation { leader: LEADER, offset, slowing_distance: 2.0 }.into()),
        ("keep station, at once", KeepStation { leader: AGENT, offset: -offset, slowing_distance: 0.0 }.into()),
        ("arrive", Arrive::new(POINT).into()),
        ("arrive, about", Arrive { target: Target::Goal, slowing_distance: 3.0, tolerance: 1.0 }.into()),
        ("arrive, at once", Arrive { slowing_distance: 0.0, tolerance: 0.0, ..Arrive::new(AGENT) }.into()),
        ("interpose", Interpose::new(LEADER, AGENT).into()),
        ("interpose, nearer to", Interpose { from: NEAR, to: POINT, ratio: 0.2, slowing_distance: 3.0 }.into()),
        ("shadow", Shadow { quarry: AGENT, distance: 1.0, slowing_distance: 1.0 }.into()),
        ("shadow, close", Shadow { quarry: STRANGER, distance: 0.5, slowing_distance: 0.0 }.into()),
        ("dock", dock.into()),
        ("dock, at a speed", Docking { speed: 0.9, ..dock }.into()),
        ("dock, fast", Docking { speed: 1.7, ..dock }.into()),
        ("dock, at a time", Docking { time: Some(5.0), ..dock }.into()),
        ("dock, fast at a time", Docking { speed: 1.0, time: Some(4.0), ..dock }.into()),
        ("wander", Wander::default().into()),
        ("wander, wildly", Wander { strength: 0.6, rate: Angle::from_radians(3.0) }.into()),
        ("fractal wander", FractalWander::default().into()),
        ("fractal wander, turbulent", FractalWander { angle: Angle::from_radians(1.4), noise: wavers }.into()),
        ("forage", Forage { food: POINT, range: 2.0, of: Wander::default().into() }.into()),
        ("forage, for agents", Forage { food: STRANGER, range: 1.5, of: Wander::default().into() }.into()),
        ("tether", Tether { to: POINT, length: 1.0 }.into()),
        ("tether, to an agent", Tether { to: AGENT, length: 2.0 }.into()),
        ("target speed", TargetSpeed { speed: 1.0 }.into()),
        ("move forward", MoveForward { part: 0.3 }.into()),
        ("constant force", ConstantForce(Vec3::new(0.4, -0.7, 0.3)).into()),
        ("head for", HeadFor { heading: Angle::degrees(63.4), pitch: Angle::degrees(12.6), full: 0.5 }.into()),
        ("face", Face { target: POINT }.into()),
        ("look where you go", LookWhereYouGo.into()),
        ("match orientation", MatchOrientation { with: NEAR }.into()),
        ("follow a flow", follow(0.0).into()),
        ("follow a flow, ahead", follow(0.7).into()),
        ("fear", Fear { range: 9.0, fades: 3.0 }.into()),
        ("fear, briefly", Fear { range: 3.0, fades: 0.8 }.into()),
        ("slip through", slip.into()),
        (
            "slip through, turning",
            SlipThrough { evade: evade_all, ahead: 0.6, width: 4.0, turn: Angle::from_radians(2.0), ..slip }.into(),
        ),
        ("slip past", SlipThrough::new(Target::Goal).past(GroupFilter::Group(2)).into()),
        ("explore", explore.into()),
        ("explore, of one cell", Explore { columns: 1, rows: 1, levels: 1, ..explore }.into()),
        ("explore, held back", sum([(0.3, explore.into()), (1.0, ConstantForce(Vec3::new(2.0, 1.0, 0.0)).into())])),
    ]
}

fn group() -> Vec<Named> {
    let rule = |weight, distance, angle| Rule { weight, distance, angle: radians(angle) };
    let flocking = Flocking {
        separation: rule(0.5, 2.0, 2.0),
        alignment: rule(0.2, 3.0, 3.2),
        cohesion: rule(0.7, 4.0, 1.0),
        always: 2.0,
        groups: GroupFilter::All,
    };
    let strengths = Strengths { avoid: 0.7, matching: 1.0, center: 0.6, migrate: 0.9 };
    let boids = Boids { near: SOME, forward: 0.4, avoidance: 0.8, strengths, migration: Some(POINT) };
    let queue = Queue { distance: 4.0, width: 0.5, ..Queue::new(Seek { target: POINT }) };
    let slow = Queue { groups: GroupFilter::OwnGroup, distance: 2.0, gap: 0.5, headway: 1.5, ..queue.clone() };
    let file = FollowLeader { single_file: true, gap: 0.6, free: 1.0, width: 0.9, ..FollowLeader::new(LEADER) };
    let form = |pattern| KeepFormation { leader: LEADER, pattern, count: Some(5), spacing: 1.2, slowing_distance: 1.0 };
    vec![
        ("separation", Separation::default().into()),
        ("separation, square", Separation { near: SOME, falloff: Falloff::InverseSquare, full: 0.5 }.into()),
        ("cohesion", Cohesion::default().into()),
        ("cohesion, soft", Cohesion { near: SOME, full: 1.5 }.into()),
        ("alignment", Alignment::default().into()),
        ("alignment, soft", Alignment { near: FRIENDS, full: 0.8 }.into()),
        ("match velocity", MatchVelocity::default().into()),
        ("match velocity, of some", MatchVelocity { near: SOME }.into()),
        ("flocking", Flocking::default().into()),
        ("flocking, of all", flocking.into()),
        ("boids", Boids::default().into()),
        ("boids, migrating", boids.into()),
        ("unaligned avoidance", UnalignedAvoidance::default().into()),
        (
            "unaligned avoidance, wide",
            UnalignedAvoidance { groups: GroupFilter::OtherGroups, horizon: 6.0, gap: 0.6, destination: None }.into(),
        ),
        ("avoid neighbours", AvoidNeighbours::default().into()),
        ("avoid neighbours, going", avoids(AvoidNeighbours { groups: GroupFilter::OtherGroups, horizon: 6.0 })),
        ("close avoidance", CloseAvoidance::default().into()),
        ("close avoidance, wide", avoids(CloseAvoidance { groups: GroupFilter::OtherGroups, gap: 1.0 })),
        ("queue", queue.into()),
        ("queue, slow", slow.into()),
        (
            "queue, facing",
            Queue::new(sum([(1.0, Arrive::new(POINT).into()), (1.0, Face { target: NEAR }.into())])).into(),
        ),
        ("follow the leader", FollowLeader::new(LEADER).into()),
        ("follow the leader, in file", file.into()),
        ("follow the leader, apart", FollowLeader { spacing: 1.7, slowing_distance: 0.5, ..file }.into()),
        ("line", form(Pattern::Line).into()),
        ("column", form(Pattern::Column).into()),
        ("wedge", form(Pattern::Wedge).into()),
        ("circle", form(Pattern::Circle).into()),
        ("grid", form(Pattern::Grid).into()),
    ]
}

fn combined() -> Vec<Named> {
    let seek = || BoxedBehaviour::from(Seek { target: POINT });
    let wander = || BoxedBehaviour::from(Wander { rate: Angle::from_radians(2.0), ..Wander::default() });
    let shy = || BoxedBehaviour::from(Flee { target: NEAR, panic_distance: 1.2 });
    let apart = || BoxedBehaviour::from(Separation::default());
    let face = || BoxedBehaviour::from(Face { target: AGENT });
    let pulls = |x: f32, y: f32, z: f32| BoxedBehaviour::from(ConstantForce(Vec3::new(x, y, z)));
    let first = |epsilon, parts: Vec<BoxedBehaviour>| BoxedBehaviour::from(Priority { epsilon, parts });
    let crowded = Condition::Crowded { near: Neighbourhood { distance: 1.5, ..Neighbourhood::default() }, least: 2 };
    let lucky = Condition::Not(Box::new(Condition::Chance(3.0)));
    let chance = Condition::Any(vec![Condition::Chance(0.4), Condition::Figure { of: 0, at_least: 6.0, at_most: 9.0 }]);
    let bored = State { behaviour: wander(), exits: vec![(Condition::After(0.5), 1), (crowded, 2)] };
    let goes = State {
        behaviour: Arrive { tolerance: 0.5, ..Arrive::new(POINT) }.into(),
        exits: vec![
            (Condition::Done, 0),
            (Condition::Farther { target: POINT, than: 3.0 }, 2),
            (Condition::Nearer { target: AGENT, than: 1.0 }, 3),
        ],
    };
    let flees = State { behaviour: shy(), exits: vec![(Condition::All(vec![Condition::Done, lucky]), 3), (chance, 0)] };
    let stays = State { behaviour: Hold { seconds: 0.4, of: shy() }.into(), exits: vec![(Condition::Chance(2.0), 0)] };
    let stranger = Condition::Not(Box::new(Condition::Farther { target: STRANGER, than: 2.0 }));
    let figures = Condition::All(vec![Condition::Figure { of: 1, at_least: 2.0, at_most: 2.0 }, Condition::After(0.3)]);
    let again = vec![(Condition::Figure { of: 9, at_least: 0.0, at_most: 9.0 }, 0), (stranger, 1), (figures, 0)];
    let two = [(wander(), again.clone()), (seek(), again)];
    let two = two.map(|(behaviour, exits)| State { behaviour, exits });
    let waits = StopAndWait::new(seek());
    let hasty = StopAndWait {
        groups: GroupFilter::OtherGroups,
        within: 1.5,
        least_wait: 0.1,
        most_wait: 0.3,
        clear: 2.0,
        of: sum([(1.0, wander()), (1.0, face())]),
    };
    let wavers = Noise { period: 0.5, octaves: 4, gain: 0.3, turbulent: false };
    let weighs = ContextSteering::new(vec![(1.0, seek()), (0.6, wander()), (0.8, shy())]);
    let few = ContextSteering {
        directions: 7,
        horizon: 4.0,
        groups: GroupFilter::OtherGroups,
        barriers: solids(),
        ..ContextSteering::new(vec![(0.5, face()), (1.0, seek())])
    };
    let many: Vec<(f32, BoxedBehaviour)> =
        (0..18).map(|k| (1.0, if k < 15 { face() } else { pulls(k as f32 - 16.0, 0.7, 0.1) })).collect();
    vec![
        ("weighted sum", sum([(0.5, seek()), (1.5, wander()), (0.7, apart()), (2.0, face())])),
        ("priority", first(0.0, vec![shy(), Tether { to: POINT, length: 1.0 }.into(), wander()])),
        ("priority, of strong ones", first(1.5, vec![apart(), face(), seek()])),
        ("dithering", Dithering { every: 0.0, parts: vec![(0.3, shy()), (0.6, wander()), (0.9, seek())] }.into()),
        ("dithering, for a while", Dithering { every: 0.3, parts: vec![(0.5, wander()), (0.5, seek())] }.into()),
        ("allocation", Allocation { budget: 1.0, parts: vec![apart(), seek(), wander()] }.into()),
        ("allocation, scarce", Allocation { budget: 0.4, parts: vec![pulls(0.5, -0.6, 0.2), face(), wander()] }.into()),
        ("running sum", RunningSum(vec![(1.0, apart()), (0.4, seek()), (1.0, wander())]).into()),
        ("running sum, full", RunningSum(vec![(2.0, pulls(1.0, 1.0, 0.2)), (3.0, wander()), (1.0, seek())]).into()),
        ("amortised", Amortised { every: 0.25, of: sum([(1.0, seek()), (0.5, wander())]) }.into()),
        ("amortised, facing", Amortised { every: 0.5, of: first(0.0, vec![shy(), face()]) }.into()),
        ("hold", Hold { seconds: 0.5, of: AvoidNeighbours::default().into() }.into()),
        ("hold, and then", Hold { seconds: 1.5, of: first(0.0, vec![shy(), pulls(0.1, -0.1, 0.0)]) }.into()),
        ("hold, facing", Hold { seconds: 1.0, of: sum([(1.0, shy()), (1.0, face())]) }.into()),
        (
            "irregular",
            Irregular { angle: Angle::from_radians(0.3), speed: 0.2, noise: Noise::default(), of: seek() }.into(),
        ),
        (
            "irregular, at times",
            Irregular { angle: Angle::from_radians(1.0), speed: 0.7, noise: wavers, of: shy() }.into(),
        ),
        ("stop and wait", waits.into()),
        ("stop and wait, hastily", hasty.into()),
        (
            "stop and wait, as long",
            StopAndWait { least_wait: 0.125, most_wait: 0.125, within: 0.6, clear: 0.8, ..StopAndWait::new(wander()) }
                .into(),
        ),
        ("limited", Limited { max_speed: 0.7, max_force: 1.0, of: seek() }.into()),
        ("limited, hardly", Limited { max_speed: 3.0, max_force: 2.0, of: pulls(3.0, -1.0, 0.5) }.into()),
        ("context", weighs.into()),
        ("context, among walls", few.into()),
        ("context, of many", ContextSteering::new(many).into()),
        ("switch", Switch(vec![bored, goes, flees, stays]).into()),
        ("switch, of two", Switch(two.into()).into()),
    ]
}

/// A rotated block, a ball and a pillar.
fn solids() -> Barriers {
    let corners = [(-3.0, -2.0), (-1.5, -2.5), (-1.0, -1.0), (-2.5, -0.5)].map(|(x, y)| DVec2::new(x, y)).to_vec();
    let block = Barrier::of_obstacle(&throng::Obstacle::Polygon { corners }, DVec2::ZERO).unwrap();
    Barriers(vec![block])
        .with(Sphere::new(Vec3::new(2.0, 1.5, 0.3), 1.0).unwrap(), SeenFrom::Outside)
        .with(Cylinder::new(Vec3::new(-1.0, 2.5, -3.0), Vec3::new(-1.0, 2.5, 3.0), 0.5).unwrap(), SeenFrom::Outside)
}

fn room() -> Moved<Cuboid> {
    Moved::new(Cuboid::new(Vec3::new(9.0, 8.0, 6.0)).unwrap(), Pose::at(Vec3::new(0.5, 0.0, 0.5)).unwrap())
}

fn place() -> Vec<Named> {
    let walled = || solids().with(room(), SeenFrom::Inside);
    let ball = || Sphere::new(Vec3::new(1.0, 0.0, 0.0), 3.0).unwrap();
    let floor = || Plane::new(Vec3::new(0.0, 0.0, -1.0), Vec3::Z).unwrap();
    let hollow = || Barriers::default().with(ball(), SeenFrom::Both).with(floor(), SeenFrom::Outside);
    let avoid = || AvoidObstacles { towards: POINT, ..AvoidObstacles::from(walled()) };
    let careful = AvoidObstacles { horizon: 3.5, gap: 0.5, keeps: 0.3, towards: AGENT, obstacles: hollow() };
    let hide = Hide { obstacles: walled(), ..Hide::new(NEAR) };
    let far = Hide {
        obstacles: solids().with(floor(), SeenFrom::Both),
        gap: 0.6,
        range: 3.0,
        slowing_distance: 0.3,
        ..Hide::new(AGENT)
    };
    let corners = [(-5.0, -3.0, 0.0), (0.0, -2.0, 0.4), (2.0, 2.0, 0.0), (5.0, 3.0, -0.5), (5.0, 6.0, 0.0)];
    let corners = corners.map(|(x, y, z)| Vec3::new(x, y, z));
    let open = Arc::new(Pathway::with_radii(&corners, &[0.8, 0.5, 1.0, 0.6], false).unwrap());
    let ring = Arc::new(Pathway::new(&corners[..4], 0.7, true).unwrap());
    let along = |path: &Arc<Pathway>| FollowPath::new(path.clone());
    let quick = FollowPath {
        horizon: 1.5,
        slowing_distance: 3.0,
        inner: 0.4,
        direction: PathDirection::Backward,
        ..along(&open)
    };
    let rocks = [(4.0, 1.0, 1.5), (-4.0, 2.0, 1.2), (0.0, -6.0, 2.5), (3.0, -5.0, 0.6), (1.0, 6.5, 1.4)];
    let solid = |at: Vec2| rocks.iter().any(|&(x, y, radius)| at.distance(Vec2::new(x, y)) < radius);
    let map = Arc::new(Raster::of(Vec2::splat(-10.0), Vec2::splat(10.0), 0.4, solid).unwrap());
    let posts = |at: Vec2| (at - (at / 2.4).round() * 2.4).length() < 0.5;
    let posts = Arc::new(Raster::of(Vec2::splat(-10.0), Vec2::splat(10.0), 0.3, posts).unwrap());
    let drive = |of: BoxedBehaviour| DriveByMap::new(map.clone(), of);
    let speeds = || sum([(1.0, along(&ring).into()), (1.0, TargetSpeed { speed: 2.0 }.into())]);
    let straight = DriveByMap { horizon: 1.2, margin: 0.3, curved: false, ..drive(speeds()) };
    let contain = || Contain::inside(room());
    let wide = Contain { horizon: 2.5, angle: radians(1.2), gap: 0.4, ..Contain::on_side(ball(), SeenFrom::Both) };
    let follow = || FollowWall::from(solids());
    let close = FollowWall { offset: 0.5, horizon: 0.8, range: 1.5, ..FollowWall::from(hollow()) };
    vec![
        ("avoid obstacles", avoids(avoid())),
        ("avoid obstacles, going", goes(AvoidObstacles { towards: Target::Goal, ..avoid() }, Target::Goal)),
        ("avoid obstacles, carefully", goes(careful, AGENT)),
        ("contain", contain().into()),
        ("contain, a wanderer", goes(contain(), Target::Goal)),
        ("contain, on either side", avoids(wide)),
        ("contain, outside", goes(Contain::on_side(ball(), SeenFrom::Outside), POINT)),
        ("follow a wall", follow().into()),
        ("follow a wall, close", close.into()),
        ("follow a wall, inside", FollowWall { range: 9.0, ..FollowWall::from(walled()) }.into()),
        ("whisker", avoids(Whiskers::single(walled(), 2.0))),
        ("whiskers, parallel", avoids(Whiskers { clearance: 0.4, ..Whiskers::parallel(walled(), 3.0, 0.8) })),
        ("whiskers, fan", goes(Whiskers::fan(hollow(), 3.0, 1.5, radians(0.7)), AGENT)),
        ("hide", hide.into()),
        ("hide, from afar", far.into()),
        ("follow a path", along(&open).into()),
        ("follow a path, back", quick.into()),
        ("follow a path, held off", sum([(1.0, along(&open).into()), (0.7, Separation::default().into())])),
        ("follow a ring", along(&ring).into()),
        (
            "follow a ring, back",
            avoids(FollowPath { direction: PathDirection::Backward, horizon: 1.0, inner: 0.7, ..along(&ring) }),
        ),
        ("stay on a path", avoids(StayOnPath { path: open.clone(), horizon: 0.5 })),
        ("stay on a ring", avoids(StayOnPath { path: ring.clone(), horizon: 1.5 })),
        ("avoid a map", drive(Seek { target: Target::Goal }.into()).into()),
        ("avoid a map, wandering", drive(avoids(Wander::default())).into()),
        ("avoid a map, round", drive(speeds()).into()),
        ("avoid a map, straight", straight.into()),
        ("avoid a map, at times", drive(Flee { target: NEAR, panic_distance: 2.0 }.into()).into()),
        ("avoid a map, to the left", DriveByMap::new(posts.clone(), Circles(0.85)).into()),
        ("avoid a map, to the right", DriveByMap::new(posts, Circles(-0.95)).into()),
        ("a crowd on a path", CrowdPath::new(ring.clone()).into()),
        (
            "a crowd at a door",
            QueueAtDoor { goal: POINT, door: Target::Point(Vec3::new(0.0, -3.0, 0.0)), obstacles: solids() }.into(),
        ),
    ]
}

/// Turns to the left by a part of the force.
#[derive(Debug)]
struct Circles(f32);

impl Behaviour for Circles {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        Some((view.motion.basis.side * (self.0 * view.vehicle.max_force)).into())
    }
}

fn sum<const N: usize>(parts: [(f32, BoxedBehaviour); N]) -> BoxedBehaviour {
    WeightedSum(parts.into()).into()
}

/// A behaviour that moves forward while its first part returns `None`.
fn avoids(first: impl Into<BoxedBehaviour>) -> BoxedBehaviour {
    Priority { epsilon: 0.0, parts: vec![first.into(), MoveForward { part: 0.4 }.into()] }.into()
}

/// A behaviour that goes to a target while its first part returns `None`.
fn goes(first: impl Into<BoxedBehaviour>, to: Target) -> BoxedBehaviour {
    Priority { epsilon: 0.0, parts: vec![first.into(), Seek { target: to }.into(), Wander::default().into()] }.into()
}

fn number(draw: &mut Draw, low: f64, high: f64) -> f32 {
    draw.between(low, high) as f32
}

fn vector(draw: &mut Draw, range: f64) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|_| number(draw, -range, range)))
}

fn vehicle(draw: &mut Draw) -> Vehicle {
    let walks = Vehicle::default();
    let flies = Vehicle { locomotion: Locomotion::Level, ..walks };
    let forces = Forces { thrust: 3.0, brake: 4.0, side: 2.0, up: 1.0 };
    let car = Vehicle {
        mass: 2.0,
        forces,
        low_speed: 0.3,
        max_turn_rate: Angle::from_radians(1.5),
        max_speed: 4.0,
        response: 0.5,
        ..walks
    };
    let slow = Vehicle { max_speed: 0.7, max_force: 1.5, smoothing: 0.3, low_speed: 0.2, ..walks };
    let glider = Vehicle {
        min_speed: 0.8,
        max_force: 9.0,
        max_speed: 3.0,
        smoothing: 0.1,
        locomotion: Locomotion::Banking,
        ..walks
    };
    let drone = Vehicle {
        mass: 0.5,
        response: 0.0,
        max_turn_rate: Angle::from_radians(2.0),
        forces,
        integrator: Integrator::Euler,
        ..flies
    };
    draw.one_of(&[walks, walks, flies, car, slow, glider, drone])
}

/// The behaviour of an actor that is not tested.
fn company(draw: &mut Draw) -> BoxedBehaviour {
    let target = Target::Point(vector(draw, 4.0));
    match draw.index(4) {
        0 => Wander::default().into(),
        1 => Seek { target }.into(),
        2 => MoveForward { part: 0.0 }.into(),
        _ => TargetSpeed { speed: 1.0 }.into(),
    }
}

/// A few vehicles, their goals, and how many are tested. The tested vehicles come first.
struct Situation {
    stage: Stage,
    goals: Vec<Option<Vec3>>,
    tested: usize,
}

/// Random vehicles in random places. On a grid many distances and speeds are equal, or zero.
fn situation(draw: &mut Draw, behaviour: &BoxedBehaviour, on_grid: bool) -> Situation {
    let flat = draw.index(3) > 0;
    let range = draw.one_of(&[1.0, 3.0, 7.0]);
    let plain = |v: Vec3| if on_grid { v.round() } else { v };
    let count = 3 + draw.index(4);
    let tested = 1 + draw.index(count - 1);
    let mut actors: Vec<Actor> = Vec::new();
    for number in 0..count {
        let vehicle = vehicle(draw);
        let level = |v: Vec3| if flat || vehicle.locomotion == Locomotion::Ground { v.with_z(0.0) } else { v };
        let place = plain(vector(draw, range));
        let place = match draw.index(10) {
            0 if number > 0 => actors[number - 1].motion.position,
            _ if flat => place.with_z(0.0),
            _ => place,
        };
        let velocity = level(plain(vector(draw, 1.5))).clamp_length_max(vehicle.max_speed);
        let facing = if draw.index(4) == 0 { level(plain(vector(draw, 1.0))) } else { velocity };
        let motion = Motion { velocity, ..Motion::at_rest(place, facing) };
        let other = company(draw);
        let behaviour = if number < tested { behaviour.clone() } else { other };
        let (group, slot) = (draw.index(3), draw.index(5));
        actors.push(Actor { group, slot, ..Actor::new(motion, vehicle, behaviour) });
    }
    let goals = (0..count).map(|_| (draw.index(4) > 0).then(|| plain(vector(draw, range)))).collect();
    let mut stage = Stage::new(if on_grid { 1.0 / 16.0 } else { draw.one_of(&[1.0 / 60.0, 1.0 / 15.0, 0.2]) }, actors);
    (stage.seed, stage.step) = (draw.bits(), draw.index(20) as u64);
    let time = stage.time();
    let event = |_| Stimulus { position: plain(vector(draw, range)), time: time + draw.between(-2.0, 2.0) };
    stage.stimuli = (0..3).map(event).collect();
    Situation { stage, goals, tested }
}

impl Situation {
    /// Moves all vehicles by a step. If requested, calls `tell` with the traces of the tested vehicles.
    fn step(&mut self, asked: bool, mut tell: impl FnMut(&Actor, &[TraceEntry])) {
        let before = self.stage.clone();
        let figures = [before.step as f64 / 5.0, 2.0];
        for (row, actor) in self.stage.actors.iter_mut().enumerate() {
            let neighbours = before.neighbours(row);
            let view = SteeringInput { goal: self.goals[row], figures: &figures, ..before.view(row, &neighbours) };
            let mut told = Vec::new();
            let mut why = if asked { TraceRecorder::requested(&mut told) } else { TraceRecorder::default() };
            actor.said = actor.behaviour.steer(&view, &mut actor.memory, &mut why);
            actor.vehicle.step(&mut actor.motion, actor.said.unwrap_or_default(), view.seconds);
            if asked && row < self.tested {
                tell(actor, &told);
            }
        }
        self.stage.step += 1;
    }
}

/// Three hundred results for random arguments.
fn answers<A: Debug>(results: &mut Results, name: &str, of: impl Fn(&mut Draw) -> A) {
    let mut draw = Draw::new(11);
    (0..300).for_each(|_| results.add(name, &of(&mut draw)));
}

/// Functions that few behaviours call.
fn functions(results: &mut Results) {
    answers(results, "takeoff", |draw| {
        let (leap, rise) = (vector(draw, 3.0), number(draw, -2.0, 6.0));
        let (leap, rise) = if draw.index(2) == 0 { (leap.round(), rise.round()) } else { (leap, rise) };
        takeoff(leap, rise, number(draw, 1.0, 10.0), number(draw, 1.0, 5.0))
    });
    answers(results, "places of patterns", |draw| {
        let (index, count, spacing) = (draw.index(9), draw.index(10), number(draw, 0.5, 2.0));
        [Pattern::Line, Pattern::Column, Pattern::Wedge, Pattern::Circle, Pattern::Grid]
            .map(|pattern| pattern.place(index, count, spacing))
    });
    answers(results, "assignment", |draw| {
        let agents: Vec<Vec3> = (0..draw.index(7)).map(|_| vector(draw, 3.0).round()).collect();
        let places: Vec<Vec3> = (0..agents.len() + draw.index(4)).map(|_| vector(draw, 3.0).round()).collect();
        assign(&agents, &places)
    });
    answers(results, "noise", |draw| {
        let (period, octaves, gain) = (number(draw, 0.1, 3.0), 1 + draw.index(8) as u32, number(draw, 0.0, 1.0));
        let rng = Rng { seed: draw.bits(), number: 3, step: draw.bits() };
        let (time, k) = (draw.between(-20.0, 20.0), draw.index(3) as u32);
        [true, false].map(|turbulent| Noise { period, octaves, gain, turbulent }.at(time, k, rng))
    });
    answers(results, "wrap around", |draw| {
        let ball = WrapAround { center: vector(draw, 2.0).round(), radius: draw.one_of(&[1.0, 2.0, 0.0, f32::NAN]) };
        (ball.back(vector(draw, 3.0)), ball.back(vector(draw, 3.0).round()), ball.check())
    });
    answers(results, "headings", |draw| {
        let (heading, most) = (number(draw, -3.0, 3.0), draw.one_of(&[f32::INFINITY, 2.0, 0.3]));
        let (velocity, preferred) = (vector(draw, 1.0).truncate(), vector(draw, 1.0).truncate());
        let velocity = velocity * draw.one_of(&[1.0, 1.0, 0.1]);
        (turn(heading, velocity, number(draw, 0.0, 0.7), most), faces(velocity, preferred, most))
    });
    answers(results, "limits", |draw| {
        let limits = Limits {
            speed: number(draw, 0.5, 2.0),
            change: number(draw, 0.1, 2.0),
            turn: draw.one_of(&[0.2, 1.0, FRAC_PI_2, PI, 4.0]),
        };
        let [chosen, velocity] = [0; 2].map(|_| vector(draw, 2.0));
        let random = limit(chosen, velocity, number(draw, -3.0, 3.0), limits);
        (random, limit(chosen.round(), velocity.round(), 0.0, limits))
    });
    answers(results, "motion", |draw| {
        let up = vector(draw, 1.0).round();
        let basis = Basis::facing(vector(draw, 2.0).round()).turned_to(vector(draw, 1.0).normalize(), up);
        let curvature = vector(draw, 1.0) * draw.one_of(&[1.0, 0.0, 3e-3, 0.3]);
        let motion = Motion { basis, curvature, ..Motion::moving(vector(draw, 3.0), vector(draw, 1.0)) };
        let (v, seconds) = (vector(draw, 1.0), number(draw, 0.0, 3.0));
        let basis = (basis, basis.to_local(v), basis.to_world(v), basis.lateral(v), basis.rotation(), basis.heading());
        (basis, motion.position_in(seconds), motion.curved_position_in(seconds))
    });
    answers(results, "vehicles", |draw| {
        let (vehicle, seconds) = (vehicle(draw), draw.one_of(&[0.02, 0.1, 0.3]));
        let mut motion = Motion::moving(vector(draw, 1.0), vector(draw, 1.5) * draw.one_of(&[1.0, 1e-3, 0.0]));
        let diverted = vehicle.diverted(&motion, motion, draw.index(2) == 0, vector(draw, 1.0), seconds);
        let braked = (vehicle.brake(&motion, 2.0, seconds), vehicle.max_braking());
        let mut after = vec![];
        for _ in 0..4 {
            let force = if draw.index(3) == 0 { motion.velocity * -9.0 } else { vector(draw, 9.0) };
            let force = if draw.index(6) == 0 { Vec3::ZERO } else { force };
            let facing = (draw.index(3) == 0).then(|| vector(draw, 1.0).round());
            vehicle.step(&mut motion, Steering { force, facing }, seconds);
            after.push(motion);
        }
        (diverted, braked, after)
    });
    answers(results, "refused vehicles", |draw| {
        let mut one = || draw.one_of(&[1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.5, -1.0, f32::INFINITY, f32::NAN]);
        let forces = Forces { thrust: one(), brake: one(), side: one(), up: one() };
        let [mass, max_force, max_speed, min_speed, max_turn_rate, low_speed, response, smoothing] =
            std::array::from_fn(|_| one());
        let max_turn_rate = Angle::from_radians(max_turn_rate);
        let limits = Vehicle { mass, max_force, max_speed, min_speed, max_turn_rate, ..Vehicle::default() };
        Vehicle { forces, low_speed, response, smoothing, ..limits }.check()
    });
}

/// Behaviours, each with a parameter of this value.
fn with(x: f32) -> Vec<BoxedBehaviour> {
    let part = || BoxedBehaviour::from(TargetSpeed { speed: x });
    let all = || vec![MoveForward { part: 1.0 }.into(), part()];
    let weighted = || vec![(1.0, part()), (x, MoveForward { part: 1.0 }.into())];
    let near = Neighbourhood { always: x, ..SOME };
    let hoods = [near, Neighbourhood { distance: x, ..SOME }, Neighbourhood { angle: radians(x), ..SOME }];
    let predictions =
        [Prediction::Constant(x), Prediction::Distance { per_metre: x, most: 1.0 }, Prediction::Cases { most: x }];
    let noise = Noise { gain: x, ..Noise::default() };
    let (angle, dock) = (Angle::from_radians(x), Dock::new(PLACE, Angle::default()));
    let stations = KeepStation { leader: LEADER, offset: PLACE, slowing_distance: x };
    let shadow = Shadow { quarry: LEADER, distance: 1.0, slowing_distance: x };
    let docking = Docking { place: PLACE, direction: PLACE, speed: x, time: None };
    let evade_all = EvadeAll { ahead: x, ..EvadeAll::default() };
    let slip = SlipThrough::new(POINT);
    let (boids, flocking, rule) = (Boids::default(), Flocking::default(), Flocking::default().cohesion);
    let queue = || Queue::new(MoveForward { part: 1.0 });
    let follow = FollowLeader::new(LEADER);
    let form =
        KeepFormation { leader: LEADER, pattern: Pattern::Line, count: Some(5), spacing: 1.0, slowing_distance: x };
    let waits = || StopAndWait::new(MoveForward { part: 1.0 });
    let irregular = || Irregular {
        angle: Angle::from_radians(x),
        speed: 0.5,
        noise: Noise::default(),
        of: MoveForward { part: 1.0 }.into(),
    };
    let avoid = || AvoidObstacles::from(solids());
    let contain = || Contain::inside(room());
    let wall = || FollowWall::from(solids());
    let hide = || Hide { obstacles: solids(), ..Hide::new(POINT) };
    let path = Arc::new(Pathway::new(&[Vec3::ZERO, Vec3::X], 1.0, false).unwrap());
    let along = || FollowPath::new(path.clone());
    let map = Arc::new(Raster::new(Vec2::ZERO, 1.0, 1, vec![false]).unwrap());
    let drive = || DriveByMap::new(map.clone(), MoveForward { part: 1.0 });
    let state = |condition| State { behaviour: MoveForward { part: 1.0 }.into(), exits: vec![(condition, 0)] };
    let conditions = [
        Condition::Nearer { target: POINT, than: x },
        Condition::Farther { target: POINT, than: x },
        Condition::After(x),
        Condition::Chance(x),
        Condition::Crowded { near, least: 1 },
        Condition::Figure { of: 0, at_least: 1.0, at_most: x.into() },
        Condition::Not(Box::new(Condition::After(x))),
        Condition::All(vec![Condition::Done, Condition::After(x)]),
        Condition::Any(vec![Condition::Done, Condition::After(x)]),
    ];
    let mut many = vec![
        part(),
        Flee { panic_distance: x, ..Flee::new(POINT) }.into(),
        Evade { panic_distance: x, ..Evade::new(POINT) }.into(),
        OffsetPursuit { quarry: POINT, prediction: Prediction::default(), distance: x }.into(),
        stations.into(),
        Arrive { slowing_distance: x, ..Arrive::new(POINT) }.into(),
        Arrive { tolerance: x, ..Arrive::new(POINT) }.into(),
        Interpose { ratio: x, ..Interpose::new(POINT, POINT) }.into(),
        Interpose { slowing_distance: x, ..Interpose::new(POINT, POINT) }.into(),
        shadow.into(),
        Shadow { distance: x, slowing_distance: 1.0, ..shadow }.into(),
        docking.into(),
        Docking { direction: PLACE * x, speed: 1.0, ..docking }.into(),
        Dock { speed: x, ..dock }.into(),
        Dock { heading: angle, ..dock }.into(),
        Dock { pitch: angle, ..dock }.into(),
        Dock { time: Some(x.into()), ..dock }.into(),
        Wander { strength: x, ..Wander::default() }.into(),
        Wander { rate: angle, ..Wander::default() }.into(),
        FractalWander { angle, ..FractalWander::default() }.into(),
        FractalWander { noise, ..FractalWander::default() }.into(),
        FractalWander { noise: Noise { period: x, ..Noise::default() }, ..FractalWander::default() }.into(),
        Forage { food: POINT, range: x, of: Wander::default().into() }.into(),
        Forage { food: POINT, range: 1.0, of: part() }.into(),
        Tether { to: POINT, length: x }.into(),
        MoveForward { part: x }.into(),
        ConstantForce(Vec3::X * x).into(),
        HeadFor::new(angle).into(),
        HeadFor { pitch: angle, ..HeadFor::new(Angle::default()) }.into(),
        HeadFor { full: x, ..HeadFor::new(Angle::default()) }.into(),
        FollowFlow { flow: Arc::new(|_: Vec3, _: f64| Vec3::X), prediction: x }.into(),
        Fear { range: x, fades: 1.0 }.into(),
        Fear { range: 1.0, fades: x }.into(),
        evade_all.into(),
        EvadeAll { near: x, ..EvadeAll::default() }.into(),
        EvadeAll { behind: x, ..EvadeAll::default() }.into(),
        SlipThrough { ahead: x, ..slip }.into(),
        SlipThrough { width: x, ..slip }.into(),
        SlipThrough { turn: angle, ..slip }.into(),
        SlipThrough { evade: evade_all, ..slip }.into(),
        Explore { min: Vec3::ZERO, max: Vec3::splat(x), columns: 1, rows: 1, levels: 1 }.into(),
        Separation { full: x, ..Separation::default() }.into(),
        Cohesion { full: x, ..Cohesion::default() }.into(),
        Alignment { full: x, ..Alignment::default() }.into(),
        Separation { near, ..Separation::default() }.into(),
        Cohesion { near, ..Cohesion::default() }.into(),
        Alignment { near, ..Alignment::default() }.into(),
        Flocking { always: x, ..flocking }.into(),
        Flocking { separation: Rule { weight: x, ..rule }, ..flocking }.into(),
        Flocking { alignment: Rule { distance: x, ..rule }, ..flocking }.into(),
        Flocking { cohesion: Rule { angle: radians(x), ..rule }, ..flocking }.into(),
        Boids { near, ..boids }.into(),
        Boids { forward: x, ..boids }.into(),
        Boids { avoidance: x, ..boids }.into(),
        Boids { strengths: Strengths { center: x, ..boids.strengths }, ..boids }.into(),
        UnalignedAvoidance { horizon: x, ..UnalignedAvoidance::default() }.into(),
        UnalignedAvoidance { gap: x, ..UnalignedAvoidance::default() }.into(),
        AvoidNeighbours { horizon: x, ..AvoidNeighbours::default() }.into(),
        CloseAvoidance { gap: x, ..CloseAvoidance::default() }.into(),
        Queue { distance: x, ..queue() }.into(),
        Queue { width: x, ..queue() }.into(),
        Queue { gap: x, ..queue() }.into(),
        Queue { headway: x, ..queue() }.into(),
        Queue::new(part()).into(),
        FollowLeader { gap: x, ..follow }.into(),
        FollowLeader { free: x, ..follow }.into(),
        FollowLeader { width: x, ..follow }.into(),
        FollowLeader { slowing_distance: x, ..follow }.into(),
        FollowLeader { spacing: x, ..follow }.into(),
        form.into(),
        KeepFormation { spacing: x, slowing_distance: 1.0, ..form }.into(),
        WeightedSum(weighted()).into(),
        RunningSum(weighted()).into(),
        Priority { epsilon: x, parts: vec![] }.into(),
        Priority { epsilon: 0.0, parts: all() }.into(),
        Dithering { every: x, parts: vec![] }.into(),
        Dithering { every: 0.0, parts: weighted() }.into(),
        Allocation { budget: x, parts: vec![] }.into(),
        Allocation { budget: 1.0, parts: all() }.into(),
        Amortised { every: x, of: MoveForward { part: 1.0 }.into() }.into(),
        Amortised { every: 1.0, of: part() }.into(),
        Hold { seconds: x, of: MoveForward { part: 1.0 }.into() }.into(),
        Hold { seconds: 1.0, of: part() }.into(),
        irregular().into(),
        Irregular { angle: Angle::default(), speed: x, ..irregular() }.into(),
        Irregular { angle: Angle::default(), noise, ..irregular() }.into(),
        Irregular { angle: Angle::default(), of: part(), ..irregular() }.into(),
        StopAndWait { within: x, ..waits() }.into(),
        StopAndWait { least_wait: x, most_wait: 1.4, ..waits() }.into(),
        StopAndWait { least_wait: 1.0, most_wait: x, ..waits() }.into(),
        StopAndWait { clear: x, ..waits() }.into(),
        StopAndWait::new(part()).into(),
        Limited { max_speed: x, max_force: 1.0, of: MoveForward { part: 1.0 }.into() }.into(),
        Limited { max_speed: 1.0, max_force: x, of: MoveForward { part: 1.0 }.into() }.into(),
        Limited { max_speed: 1.0, max_force: 1.0, of: part() }.into(),
        ContextSteering::new(weighted()).into(),
        ContextSteering { horizon: x, ..ContextSteering::new(vec![]) }.into(),
        Switch(vec![State { behaviour: part(), exits: vec![] }]).into(),
        AvoidObstacles { horizon: x, ..avoid() }.into(),
        AvoidObstacles { gap: x, ..avoid() }.into(),
        AvoidObstacles { keeps: x, ..avoid() }.into(),
        Contain { horizon: x, ..contain() }.into(),
        Contain { angle: radians(x), ..contain() }.into(),
        Contain { gap: x, ..contain() }.into(),
        FollowWall { offset: x, ..wall() }.into(),
        FollowWall { horizon: x, ..wall() }.into(),
        FollowWall { range: x, ..wall() }.into(),
        Whiskers::parallel(solids(), x, 1.0).into(),
        Whiskers::parallel(solids(), 1.0, x).into(),
        Whiskers::fan(solids(), 1.0, 1.0, radians(x)).into(),
        Whiskers { clearance: x, ..Whiskers::single(solids(), 1.0) }.into(),
        Hide { gap: x, ..hide() }.into(),
        Hide { range: x, ..hide() }.into(),
        Hide { slowing_distance: x, ..hide() }.into(),
        FollowPath { horizon: x, ..along() }.into(),
        FollowPath { inner: x, ..along() }.into(),
        FollowPath { slowing_distance: x, ..along() }.into(),
        StayOnPath { path: path.clone(), horizon: x }.into(),
        DriveByMap { horizon: x, ..drive() }.into(),
        DriveByMap { margin: x, ..drive() }.into(),
        DriveByMap { of: part(), ..drive() }.into(),
    ];
    many.extend(hoods.map(|near| MatchVelocity { near }.into()));
    many.extend(predictions.map(|prediction| Pursue { quarry: POINT, prediction }.into()));
    many.extend(predictions.map(|prediction| Evade { prediction, ..Evade::new(POINT) }.into()));
    many.extend(predictions.map(|prediction| OffsetPursuit { quarry: POINT, prediction, distance: 1.0 }.into()));
    many.extend(conditions.map(|condition| Switch(vec![state(condition)]).into()));
    many
}

/// Behaviours, each with this number of something.
fn with_count(count: usize) -> Vec<BoxedBehaviour> {
    let near = Neighbourhood { most: count, ..SOME };
    let noise = Noise { octaves: count as u32, ..Noise::default() };
    let form = |count| KeepFormation {
        leader: LEADER,
        pattern: Pattern::Line,
        count: Some(count),
        spacing: 1.0,
        slowing_distance: 1.0,
    };
    let state = || State { behaviour: MoveForward { part: 1.0 }.into(), exits: vec![(Condition::Done, 3)] };
    let parts: Vec<(f32, BoxedBehaviour)> = (0..count).map(|_| (1.0, MoveForward { part: 1.0 }.into())).collect();
    vec![
        MatchVelocity { near }.into(),
        FractalWander { angle: Angle::from_radians(1.0), noise }.into(),
        form(count).into(),
        Explore { min: Vec3::ZERO, max: Vec3::ONE, columns: count, rows: 1, levels: 1 }.into(),
        ContextSteering { directions: count, ..ContextSteering::new(vec![]) }.into(),
        ContextSteering::new(parts).into(),
        Switch((0..count).map(|_| state()).collect()).into(),
    ]
}

#[test]
fn steering_and_explanations_are_as_kept() {
    let mut results = Results::default();
    for (name, behaviour) in [single(), group(), combined(), place()].concat() {
        results.add(name, &(behaviour.words(), behaviour.is_flock(), behaviour.perception_range().is_some()));
        let mut draw = Draw::new(7);
        for (stages, steps, every, on_grid) in [(20, 50, 5, false), (8, 50, 5, true), (60, 4, 1, true)] {
            for _ in 0..stages {
                let mut situation = situation(&mut draw, &behaviour, on_grid);
                for step in 0..steps {
                    let tell =
                        |actor: &Actor, told: &[TraceEntry]| results.add(name, &(actor.motion, actor.said, told));
                    situation.step(step % every == 0, tell);
                }
                situation.stage.actors.iter().for_each(|actor| results.add(name, &(&actor.memory, actor.motion)));
            }
        }
    }
    functions(&mut results);
    for x in [-4.0, -1.0, 0.0, 1.0, 1.4, 1.41, 1.5, 1.51, PI, 3.15, f32::INFINITY, f32::NAN] {
        results.add("refused", &with(x).iter().map(|behaviour| behaviour.check()).collect::<Vec<_>>());
    }
    for count in [0, 1, 3, 4, 8, 9, 16, 17, 64, 65, 4096, 4097] {
        results
            .add("refused numbers", &with_count(count).iter().map(|behaviour| behaviour.check()).collect::<Vec<_>>());
    }
    results.assert_kept("all/kept.txt");
}

//! Independence of the time step: with any behaviour, agents move with the same statistics at three time steps.

use crate::harness::{Actor, RATES, Stage};
use glam::{Quat, Vec2, Vec3};
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::parameters::Angle;
use throng::space::surface::{Cuboid, Cylinder, SeenFrom, Sphere};
use throng::space::{Pathway, Raster};
use throng::steer::{Barriers, BoxedBehaviour, GroupFilter, Rng, Stimulus, Target};
use throng_steer::{
    Alignment, Allocation, Amortised, Arrive, AvoidNeighbours, AvoidObstacles, Boids, CloseAvoidance, Cohesion,
    Condition, ConstantForce, Contain, ContextSteering, CrowdPath, Dithering, Dock, Docking, DriveByMap, Evade,
    EvadeAll, Explore, Face, Fear, Flee, Flocking, FollowFlow, FollowLeader, FollowPath, FollowWall, Forage,
    FractalWander, HeadFor, Hide, Hold, Interpose, Irregular, KeepFormation, KeepStation, Limited, LookWhereYouGo,
    MatchOrientation, MatchVelocity, MoveForward, Neighbourhood, Noise, OffsetPursuit, Pattern, Prediction, Priority,
    Pursue, Queue, QueueAtDoor, RunningSum, Seek, Separation, Shadow, SlipThrough, State, StayOnPath, StopAndWait,
    Switch, TargetSpeed, Tether, UnalignedAvoidance, Wander, WeightedSum, Whiskers,
};

/// Number of worlds of each kind, number of agents in each, and seconds.
const WORLDS: u64 = 24;
const AGENTS: usize = 4;
const SECONDS: f32 = 10.0;

/// A leader that walks, and agents with random starts around it.
fn world(seed: u64, seconds: f32, behaviour: &BoxedBehaviour) -> Stage {
    let draw = |row: usize, k: u32| Rng { seed, number: row as u32, step: 0 }.draw(100 + k);
    let leader = TargetSpeed { speed: 0.8 };
    let leader = Actor::new(Motion::moving(Vec3::ZERO, Vec3::X * 0.8), Vehicle::default(), leader);
    let agent = |row: usize| {
        let place = Vec3::new(draw(row, 0) - 0.5, draw(row, 1) - 0.5, 0.0) * 7.0;
        let velocity = Quat::from_rotation_z(6.3 * draw(row, 2)) * Vec3::X;
        let actor = Actor::new(Motion::moving(place, velocity), Vehicle::default(), behaviour.clone());
        Actor { group: 1, slot: row - 1, ..actor }
    };
    let stimuli = vec![Stimulus { position: Vec3::Y, time: 0.5 }];
    let actors = std::iter::once(leader).chain((1..=AGENTS).map(agent)).collect();
    Stage { seed, stimuli, ..Stage::new(seconds, actors) }
}

/// Mean speed, mean distances from the leader and from each other, and final distance.
fn statistics(mut stage: Stage) -> [f64; 4] {
    let mut sums = [0.0f64; 4];
    let mut steps = 0.0;
    stage.run(SECONDS, |stage| {
        let motions = stage.actors[1..].iter().map(|actor| actor.motion);
        let center = motions.clone().map(|motion| motion.position).sum::<Vec3>() / AGENTS as f32;
        for motion in motions {
            sums[0] += f64::from(motion.speed());
            sums[1] += f64::from(motion.position.distance(stage.actors[0].motion.position));
            sums[2] += f64::from(motion.position.distance(center));
        }
        steps += 1.0;
    });
    let end = stage.actors[1..].iter().map(|actor| f64::from(actor.motion.position.length())).sum::<f64>();
    [sums[0] / steps, sums[1] / steps, sums[2] / steps, end].map(|sum| sum / AGENTS as f64)
}

/// Differences between time steps may be random, up to three standard errors, and a little more.
fn check(behaviours: Vec<(&str, BoxedBehaviour)>) {
    for (name, behaviour) in behaviours {
        let of = |seconds| (0..WORLDS).map(|seed| statistics(world(seed, seconds, &behaviour))).collect::<Vec<_>>();
        let [slow, medium, fast] = RATES.map(of);
        for k in 0..4 {
            let (size, _) = mean(fast.iter().map(|fast| fast[k]));
            for (rate, all) in [(15, &slow), (60, &medium)] {
                let (off, error) = mean(all.iter().zip(&fast).map(|(one, fast)| one[k] - fast[k]));
                let most = 0.02 + 0.03 * size + 3.0 * error;
                assert!(off.abs() < most, "{name}: at {rate} Hz number {k} differs by {off} of {size}, at most {most}");
                assert!(most < 0.5 * size + 0.1, "{name}: {k} says nothing, {most} of {size}");
            }
        }
    }
}

/// Returns the mean and its standard error.
fn mean(of: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = WORLDS as f64;
    let mean = of.clone().sum::<f64>() / count;
    (mean, (of.map(|one| (one - mean).powi(2)).sum::<f64>() / (count - 1.0) / count).sqrt())
}

fn at(x: f32, y: f32) -> Target {
    Target::Point(Vec3::new(x, y, 0.0))
}

const LEADER: Target = Target::Agent(0);

#[test]
fn of_one() {
    let field = |place: Vec3, time: f64| Vec3::Z.cross(place).normalize_or_zero() + Vec3::X * (0.3 * time as f32).sin();
    let follow = || FollowFlow { flow: Arc::new(field), prediction: 0.3 };
    let region = (Vec3::new(-3.0, -3.0, 0.0), Vec3::new(3.0, 3.0, 0.0));
    check(vec![
        ("seek", Seek { target: at(15.0, 12.0) }.into()),
        ("flee", Flee { panic_distance: 5.0, ..Flee::new(LEADER) }.into()),
        ("arrive", Arrive::new(at(1.0, 2.0)).into()),
        ("pursue", Pursue::new(LEADER).into()),
        (
            "pursue by distance",
            Pursue { prediction: Prediction::Distance { per_metre: 0.3, most: 2.0 }, quarry: LEADER }.into(),
        ),
        ("evade", Evade { panic_distance: 4.0, ..Evade::new(LEADER) }.into()),
        ("offset pursuit", OffsetPursuit { quarry: LEADER, prediction: Prediction::default(), distance: 1.0 }.into()),
        ("interpose", Interpose { ratio: 0.3, ..Interpose::new(LEADER, at(0.0, 5.0)) }.into()),
        ("shadow", Shadow { quarry: LEADER, distance: 1.0, slowing_distance: 1.0 }.into()),
        (
            "keep station",
            KeepStation { leader: LEADER, offset: Vec3::new(-1.0, 1.0, 0.0), slowing_distance: 1.0 }.into(),
        ),
        ("dock", Dock::new(Vec3::X * 2.0, Angle::degrees(90.0)).into()),
        (
            "docking",
            Docking { place: Vec3::X * 2.0, direction: Vec3::new(1.0, 2.0, 0.0), speed: 0.5, time: None }.into(),
        ),
        ("wander", Wander::default().into()),
        ("fractal wander", FractalWander::default().into()),
        ("explore", Explore { min: region.0, max: region.1, columns: 3, rows: 3, levels: 1 }.into()),
        ("forage", Forage { food: LEADER, range: 3.0, of: Wander::default().into() }.into()),
        ("fear", Fear { range: 6.0, fades: 5.0 }.into()),
        ("follow flow", follow().into()),
        ("move forward", MoveForward { part: 0.2 }.into()),
        ("target speed", TargetSpeed { speed: 1.4 }.into()),
        (
            "tether",
            Priority { epsilon: 0.0, parts: vec![Tether { to: LEADER, length: 2.0 }.into(), Wander::default().into()] }
                .into(),
        ),
        ("face", WeightedSum(vec![(1.0, Face { target: LEADER }.into()), (1.0, follow().into())]).into()),
        (
            "match orientation",
            WeightedSum(vec![(1.0, MatchOrientation { with: LEADER }.into()), (1.0, follow().into())]).into(),
        ),
        ("constant force", ConstantForce(Vec3::new(0.3, 0.2, 0.0)).into()),
        (
            "head for",
            WeightedSum(vec![
                (1.0, HeadFor { full: 0.5, ..HeadFor::new(Angle::degrees(90.0)) }.into()),
                (1.0, TargetSpeed { speed: 1.2 }.into()),
            ])
            .into(),
        ),
        ("slip through", SlipThrough::new(at(15.0, 12.0)).into()),
        ("evade all", EvadeAll::default().into()),
        ("look where you go", WeightedSum(vec![(1.0, LookWhereYouGo.into()), (1.0, Wander::default().into())]).into()),
    ]);
}

#[test]
fn among_others() {
    let seek = || Seek { target: at(6.0, 0.0) };
    let crossing = |avoid: BoxedBehaviour| -> BoxedBehaviour {
        Priority { epsilon: 0.0, parts: vec![avoid, TargetSpeed { speed: 1.2 }.into()] }.into()
    };
    let near = Neighbourhood::default();
    check(vec![
        ("separation", Separation::default().into()),
        (
            "alignment",
            WeightedSum(vec![(1.0, Alignment { full: 0.5, near }.into()), (1.0, TargetSpeed { speed: 1.0 }.into())])
                .into(),
        ),
        ("cohesion", Cohesion { full: 2.0, near }.into()),
        ("match velocity", MatchVelocity::default().into()),
        ("flocking", Flocking::default().into()),
        ("boids", Boids { migration: Some(LEADER), ..Boids::default() }.into()),
        ("avoid neighbours", crossing(AvoidNeighbours::default().into())),
        ("close avoidance", crossing(CloseAvoidance { groups: GroupFilter::All, gap: 0.3 }.into())),
        ("unaligned avoidance", crossing(UnalignedAvoidance::default().into())),
        ("queue", Queue::new(seek()).into()),
        ("follow leader", FollowLeader::new(LEADER).into()),
        (
            "keep formation",
            KeepFormation {
                leader: LEADER,
                pattern: Pattern::Wedge,
                count: Some(4),
                spacing: 1.0,
                slowing_distance: 1.0,
            }
            .into(),
        ),
    ]);
}

#[test]
fn in_places() {
    let pillar = || Cylinder::new(Vec3::new(2.0, 0.3, -1.0), Vec3::new(2.0, 0.3, 1.0), 0.8).unwrap();
    let solid = || Barriers::default().with(pillar(), SeenFrom::Outside);
    let path = Pathway::new(&[Vec3::X * -4.0, Vec3::ZERO, Vec3::new(3.0, 3.0, 0.0), Vec3::Y * 5.0], 0.8, true).unwrap();
    let first = |a: BoxedBehaviour, b: BoxedBehaviour| -> BoxedBehaviour {
        Priority { epsilon: 0.0, parts: vec![a, b] }.into()
    };
    let wander = || -> BoxedBehaviour { Wander::default().into() };
    let goal = at(6.0, 0.0);
    let rocks =
        [(2.0, 0.3, 0.8), (-3.0, 2.5, 0.6), (0.0, -4.0, 1.0), (5.0, 4.0, 0.9)].map(|(x, y, r)| (Vec2::new(x, y), r));
    let rock = |place: Vec2| rocks.iter().any(|(center, radius)| place.distance(*center) < *radius);
    let map = || Arc::new(Raster::of(Vec2::splat(-20.0), Vec2::splat(20.0), 0.2, rock).unwrap());
    let steady = Hold { seconds: 0.5, of: Whiskers::fan(solid(), 2.5, 1.0, Angle::from_radians(0.6)).into() };
    check(vec![
        (
            "avoid obstacles",
            first(AvoidObstacles { towards: goal, ..AvoidObstacles::from(solid()) }.into(), Arrive::new(goal).into()),
        ),
        ("avoid map", DriveByMap::new(map(), wander()).into()),
        ("avoid map, straight", DriveByMap { curved: false, ..DriveByMap::new(map(), wander()) }.into()),
        ("avoid map to a place", DriveByMap::new(map(), Arrive::new(goal)).into()),
        ("whiskers", first(steady.into(), Arrive::new(goal).into())),
        ("contain", first(Contain::inside(Sphere::new(Vec3::ZERO, 6.0).unwrap()).into(), wander())),
        (
            "follow wall",
            FollowWall::from(
                Barriers::default().with(Cuboid::new(Vec3::new(9.0, 9.0, 4.0)).unwrap(), SeenFrom::Inside),
            )
            .into(),
        ),
        ("follow path", first(FollowPath::new(path.clone()).into(), MoveForward { part: 0.5 }.into())),
        ("stay on path", first(StayOnPath { path: Arc::new(path.clone()), horizon: 0.6 }.into(), wander())),
        ("hide", Hide { obstacles: solid(), ..Hide::new(LEADER) }.into()),
        ("crowd path", CrowdPath::new(path).into()),
        ("queue at a door", QueueAtDoor { goal, door: at(4.0, 0.0), obstacles: solid() }.into()),
    ]);
}

#[test]
fn combined() {
    let wander = || -> BoxedBehaviour { Wander::default().into() };
    let go = || -> BoxedBehaviour { Arrive::new(at(3.0, 2.0)).into() };
    let apart = || -> BoxedBehaviour { Separation::default().into() };
    let noise = Noise::default();
    check(vec![
        ("weighted sum", WeightedSum(vec![(1.0, apart()), (0.7, go())]).into()),
        ("running sum", RunningSum(vec![(1.0, apart()), (0.7, go())]).into()),
        ("priority", Priority { epsilon: 0.1, parts: vec![apart(), go()] }.into()),
        ("dithering", Dithering { every: 0.2, parts: vec![(0.5, apart()), (1.0, go())] }.into()),
        ("allocation", Allocation { budget: 0.8, parts: vec![apart(), go()] }.into()),
        (
            "switch",
            Switch(vec![
                State { behaviour: go(), exits: vec![(Condition::Done, 1)] },
                State { behaviour: wander(), exits: vec![(Condition::After(2.0), 0), (Condition::Chance(0.2), 0)] },
            ])
            .into(),
        ),
        ("context", ContextSteering::new(vec![(1.0, go()), (0.5, Seek { target: LEADER }.into())]).into()),
        ("amortised", Amortised { every: 0.2, of: go() }.into()),
        (
            "hold",
            Priority {
                epsilon: 0.0,
                parts: vec![Hold { seconds: 0.5, of: AvoidNeighbours::default().into() }.into(), go()],
            }
            .into(),
        ),
        ("irregular", Irregular { angle: Angle::from_radians(0.3), speed: 0.1, noise, of: go() }.into()),
        ("limited", Limited { max_speed: 0.9, max_force: 2.0, of: go() }.into()),
        ("stop and wait", StopAndWait::new(go()).into()),
    ]);
}

#[test]
fn every_behaviour_is_here() {
    let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src"));
    let files = ["single", "group", "place", "combine"]
        .into_iter()
        .flat_map(|room| std::fs::read_dir(folder.join(room)).unwrap());
    let texts = files.map(|file| std::fs::read_to_string(file.unwrap().path()).unwrap());
    let behaviours: Vec<String> = texts
        .flat_map(|text| {
            text.lines()
                .filter_map(|line| Some(line.strip_prefix("impl Behaviour for ")?.replace(" {", "")))
                .collect::<Vec<_>>()
        })
        .collect();
    assert!(behaviours.len() > 45, "{behaviours:?}");
    let here = include_str!("rates.rs");
    let missing: Vec<&String> = behaviours
        .iter()
        .filter(|name| !here.split(|c: char| !c.is_alphanumeric()).any(|word| word == *name))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

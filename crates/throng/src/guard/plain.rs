//! Reference versions of the guard and its contacts: they evaluate every agent in every pass. The fast versions must
//! agree with them bit for bit.

use super::certify::{CertifyScratch, within_reach};
use super::cores::Cores;
use super::safe::is_safe;
use super::solid::GuardedObjects;
use super::{BodyPose, Contacts, Guard, GuardedBodies, Report, RowContacts, Solids, cell, relax};
use crate::Obstacle;
use crate::agent::GroupId;
use crate::perceive::Grid;
use crate::space::surface::{SeenFrom, Sphere};
use crate::space::{Core, Walls};
use crate::steer::Barriers;
use glam::{DVec2, Vec2, Vec3};
use proptest::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Returns the certified poses and the statistics, without the number of changed agents.
fn certify(
    bodies: &GuardedBodies<'_>,
    contacts: &Contacts,
    walls: &Walls,
    desired_poses: &[BodyPose],
) -> (Vec<BodyPose>, Report) {
    let mut cores = Cores::default();
    cores.rebuild(bodies);
    let solid = GuardedObjects { bodies, contacts, walls, cores: &cores };
    let rows = 0..desired_poses.len();
    let mut now: Vec<BodyPose> = rows.clone().map(|row| within_reach(row, bodies, desired_poses[row])).collect();
    for _ in 0..relax::ITERATIONS {
        now = rows.clone().map(|row| relax::relaxed(row, solid, &now)).collect();
    }
    let mut clamped = vec![false; desired_poses.len()];
    let mut report = Report::default();
    for round in 1.. {
        let clamps = |row: usize| !clamped[row] && !is_safe(row, solid, &now);
        let unsafe_rows: Vec<usize> = rows.clone().filter(|&row| clamps(row)).collect();
        if unsafe_rows.is_empty() {
            break;
        }
        report.rounds = round;
        for row in unsafe_rows {
            now[row] = cell::clamp(row, solid, now[row], &mut CertifyScratch::default());
            clamped[row] = true;
        }
    }
    report.clamped = clamped.iter().filter(|&&clamped| clamped).count();
    (now, report)
}

/// Returns the bodies that `row` could touch, by a test of all bodies. The range is multiplied by `scale`.
fn touching(bodies: &GuardedBodies<'_>, row: usize, scale: f32) -> Vec<u32> {
    let others = (0..bodies.positions.len()).filter(|&other| other != row && meets(row, other));
    let touches = |&other: &usize| {
        let range = bodies.bound(row) + bodies.bound(other) + bodies.reach[row] + bodies.reach[other];
        let distance = if bodies.is_disc(row) && bodies.is_disc(other) {
            bodies.place(row).distance(bodies.place(other))
        } else {
            bodies.positions[row].distance(bodies.positions[other])
        };
        distance <= range * scale
    };
    others.filter(touches).map(|other| other as u32).collect()
}

/// Whether a row is in a pile: it overlaps more than six others.
fn is_piled(bodies: &GuardedBodies<'_>, row: usize) -> bool {
    let least = bodies.radii.iter().fold(f32::INFINITY, f32::min);
    let reach = bodies.radii[row] + 0.8 * least;
    let others = (0..bodies.positions.len()).filter(|&other| other != row && meets(row, other));
    others.filter(|&other| bodies.place(row).distance_squared(bodies.place(other)) < reach * reach).count() > 6
}

/// Whether two rows collide with each other. Some pass through each other.
fn meets(a: usize, b: usize) -> bool {
    !(a + b).is_multiple_of(11)
}

#[derive(Clone, Copy, Debug)]
struct TestBody {
    place: Vec3,
    heading: f32,
    core: Vec2,
    radius: f32,
    reach: f32,
    guarded: bool,
    desired: Vec3,
    turn: f32,
}

fn any_body() -> impl Strategy<Value = TestBody> {
    let place = (-3.0f32..3.0, -3.0f32..3.0, prop_oneof![4 => Just(0.0f32), 1 => 0.0f32..2.0]);
    let extent = || prop_oneof![3 => Just(0.0f32), 1 => 0.0f32..0.75];
    // a few are much larger than the rest, a few much faster
    let radius = prop_oneof![8 => 0.0625f32..0.5, 1 => 1.0f32..3.0];
    let reach = prop_oneof![8 => 0.0f32..0.5, 1 => 0.5f32..4.0];
    let desired = (-1.0f32..1.0, -1.0f32..1.0, prop_oneof![4 => Just(0.0f32), 1 => -0.5f32..0.5]);
    let body = ((extent(), extent()), radius, reach, prop_oneof![4 => Just(true), 1 => Just(false)]);
    (place, -3.0f32..3.0, body, desired, -0.5f32..0.5).prop_map(
        |(place, heading, ((length, width), radius, reach, guarded), desired, turn)| TestBody {
            place: place.into(),
            heading,
            core: Vec2::new(length, width),
            radius,
            reach,
            guarded,
            desired: desired.into(),
            turn,
        },
    )
}

/// Discs on the ground, all alike, some of them at the same place.
fn uniform_body() -> impl Strategy<Value = TestBody> {
    let place = (-12i8..12, -12i8..12).prop_map(|(x, y)| Vec3::new(f32::from(x), f32::from(y), 0.0) * 0.375);
    (place, (-0.25f32..0.25, -0.25f32..0.25)).prop_map(|(place, (x, y))| TestBody {
        place,
        heading: 0.0,
        core: Vec2::ZERO,
        radius: 0.1875,
        reach: 0.25,
        guarded: true,
        desired: Vec3::new(x, y, 0.0),
        turn: 0.0,
    })
}

/// Discs that are alike, and a few bodies that are larger or long.
fn few_others() -> impl Strategy<Value = Vec<TestBody>> {
    const CORES: [Vec2; 4] = [Vec2::ZERO, Vec2::new(2.0, 0.75), Vec2::new(1.0, 0.0), Vec2::new(0.0, 0.25)];
    let other = (uniform_body(), prop::sample::select(&CORES[..]), 0.125f32..1.25, -3.0f32..3.0, -0.5f32..0.5);
    let other = other.prop_map(|(body, core, radius, heading, turn)| TestBody { core, radius, heading, turn, ..body });
    let discs = prop::collection::vec(uniform_body(), 60..200);
    (discs, prop::collection::vec((any::<prop::sample::Index>(), other), 1..6)).prop_map(|(mut bodies, others)| {
        others.into_iter().for_each(|(at, other)| bodies.insert(at.index(bodies.len()), other));
        bodies
    })
}

/// Discs side by side in rows. Most want to go the same way, much farther than they can, and some stand. So clamping
/// spreads from each to the next.
fn jam() -> impl Strategy<Value = Vec<TestBody>> {
    let size = prop_oneof![(12usize..40, 1usize..4), (16usize..24, 16usize..24)];
    let all = (size, 0.0f32..0.0625, 0.25f32..1.0, prop::collection::vec(any::<prop::sample::Index>(), 1..4));
    all.prop_map(|((columns, rows), gap, way, standing)| {
        let place = |at: usize| Vec2::new((at % columns) as f32, (at / columns) as f32) * (0.375 + gap);
        let mut bodies: Vec<TestBody> = (0..columns * rows)
            .map(|at| TestBody {
                place: (place(at) - 3.0).extend(0.0),
                heading: 0.0,
                core: Vec2::ZERO,
                radius: 0.1875,
                reach: way,
                guarded: true,
                desired: Vec3::new(way, 0.125 * (at % 3) as f32, 0.0),
                turn: 0.0,
            })
            .collect();
        let count = bodies.len();
        standing.iter().for_each(|at| bodies[at.index(count)].desired = Vec3::ZERO);
        bodies
    })
}

fn crowd() -> impl Strategy<Value = Vec<TestBody>> {
    prop_oneof![
        prop::collection::vec(any_body(), 1..90),
        prop::collection::vec(uniform_body(), 60..200),
        few_others(),
        few_others().prop_map(|bodies| bodies.into_iter().map(near_origin).collect()),
        prop::collection::vec(piled(uniform_body()), 60..200),
        prop::collection::vec(piled(any_body()), 60..200),
    ]
}

fn near_origin(body: TestBody) -> TestBody {
    TestBody { place: body.place * 0.25, ..body }
}

/// The same bodies, close to the origin.
fn piled(bodies: impl Strategy<Value = TestBody>) -> impl Strategy<Value = TestBody> {
    bodies.prop_map(near_origin)
}

fn room() -> Walls {
    let points = [(-3.0, -3.0), (3.0, -3.0), (3.0, 3.0), (0.0, 0.5), (-3.0, 3.0)].map(DVec2::from).to_vec();
    let obstacles = [Obstacle::Wall { points }, Obstacle::Circle { center: DVec2::new(1.0, -1.5), radius: 0.75 }];
    Walls::new(&[], &obstacles, DVec2::ZERO)
}

/// Two balls that are solid for the second of two groups.
fn pillars() -> Solids {
    let ball = |at: Vec3| Sphere::new(at, 1.0).unwrap();
    let both = Barriers::default().with(ball(Vec3::new(-1.0, 0.0, 0.5)), SeenFrom::Outside);
    let mut solids = Solids::default();
    solids.add(both.with(ball(Vec3::new(1.5, 1.0, 0.0)), SeenFrom::Outside).0);
    solids
}

/// Checks contacts by a test of all bodies, and the result of the guard by the reference. `walled` and `solid`: whether
/// there are walls and solids. `knows`: whether every other row has an earlier search. Returns the number of rounds.
fn check(all: &[TestBody], walled: bool, knows: bool, solid: bool) -> Result<usize, TestCaseError> {
    let walls = if walled { room() } else { Walls::default() };
    let mut solids = if solid { pillars() } else { Solids::default() };
    let positions: Vec<Vec2> = all.iter().map(|body| body.place.truncate()).collect();
    let mut bodies = GuardedBodies {
        positions: &positions,
        altitudes: &all.iter().map(|body| body.place.z).collect(),
        headings: &all.iter().map(|body| body.heading).collect::<Vec<_>>(),
        cores: &all.iter().map(|body| body.core).collect(),
        radii: &all.iter().map(|body| body.radius).collect(),
        reach: &all.iter().map(|body| body.reach).collect(),
        guarded: &all.iter().map(|body| body.guarded).collect(),
        solids: &Solids::default(),
        resting: &[],
    };
    solids.find(&bodies, &(0..all.len()).map(|row| GroupId((row % 2) as u32)).collect());
    bodies.solids = &solids;
    // numbers in descending order of rows
    let numbers: Vec<u32> = (0..all.len() as u32).rev().collect();
    let mut grid = Grid::default();
    grid.rebuild(&positions, &numbers, 1.0);
    // every other row has an earlier search, with a range of 1.5 m between cores and at most seven bodies
    let core = |row: usize| Core::new(positions[row].as_dvec2(), all[row].heading, all[row].core);
    let nearest: Vec<Vec<u32>> = (0..all.len())
        .map(|row| {
            let distance = |other: usize| match (all[row].core, all[other].core) {
                (Vec2::ZERO, Vec2::ZERO) => f64::from(positions[row].distance(positions[other])),
                _ => core(row).separation(&core(other)).distance.max(0.0),
            };
            let others = (0..all.len()).filter(|&other| other != row && meets(row, other));
            let mut near: Vec<(f64, u32)> = others.map(|other| (distance(other), other as u32)).collect();
            near.retain(|&(distance, _)| distance <= 1.5);
            near.sort_by(|a, b| a.0.total_cmp(&b.0));
            near.iter().map(|&(_, other)| other).take(7).collect()
        })
        .collect();
    let known = |row: usize| {
        let nearest = &nearest[row][..];
        (knows && row.is_multiple_of(2)).then_some(RowContacts { nearest, range: 1.5, all: nearest.len() < 7 })
    };
    let mut contacts = Contacts::default();
    contacts.collect(&bodies, &numbers, &grid, &walls, meets, known);
    let mut found = Contacts::default();
    found.collect(&bodies, &numbers, &grid, &walls, meets, |_| None);
    let piled: Vec<bool> = (0..all.len()).map(|row| is_piled(&bodies, row)).collect();
    for row in 0..all.len() {
        let of = contacts.of(row);
        prop_assert_eq!(of, found.of(row), "with and without earlier searches");
        prop_assert!(of.is_sorted_by(|&a, &b| numbers[a as usize] < numbers[b as usize]), "{of:?}");
        prop_assert!(of.iter().all(|&other| contacts.of(other as usize).contains(&(row as u32))));
        let counts = |&other: &u32| !(piled[row] && piled[other as usize]);
        let [surely, maybe] = [1.0, 1.0002].map(|scale| {
            let mut others = touching(&bodies, row, scale);
            others.retain(counts);
            others
        });
        prop_assert!(surely.iter().all(|other| of.contains(other)), "{row}: {of:?} of {surely:?}");
        prop_assert!(of.iter().all(|other| maybe.contains(other)), "{row}: {of:?} of {maybe:?}");
    }
    let pose = |body: &TestBody| {
        BodyPose { heading: body.heading + body.turn, ..BodyPose::default() }.with_place(body.place + body.desired)
    };
    let desired_poses: Vec<BodyPose> = all.iter().map(pose).collect();
    let (plain, report) = certify(&bodies, &contacts, &walls, &desired_poses);
    let (mut guard, mut targets) = (Guard::default(), Vec::new());
    for _ in 0..2 {
        let fast = guard.certify(&bodies, &contacts, &walls, |row| desired_poses[row], &mut targets);
        let bits = |poses: &[BodyPose]| -> Vec<[u32; 4]> {
            let of =
                |pose: &BodyPose| [pose.position.x, pose.position.y, pose.altitude, pose.heading].map(f32::to_bits);
            poses.iter().map(of).collect()
        };
        prop_assert_eq!(bits(&targets), bits(&plain));
        prop_assert_eq!((fast.clamped, fast.rounds), (report.clamped, report.rounds));
        let changed = (0..all.len()).filter(|&row| {
            let (goal, certain) = (desired_poses[row].place(), plain[row].place());
            let tolerance = goal.distance(all[row].place).max(1e-3 * all[row].radius) * 1e-2;
            goal.distance(certain) > tolerance
                || all[row].core != Vec2::ZERO && desired_poses[row].heading != plain[row].heading
        });
        prop_assert_eq!(fast.changed, changed.count());
    }
    Ok(report.rounds)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn evaluating_some_rows_gives_the_bits_of_evaluating_all(all in crowd(), walled: bool, knows: bool, solid: bool) {
        check(&all, walled, knows, solid)?;
    }
}

/// Clamping spreads through a jam for as long as necessary, with the same result on any number of threads.
#[test]
fn rounds_in_a_jam_end_with_the_bits_of_evaluating_all() {
    let most = AtomicUsize::new(0);
    let config = ProptestConfig { source_file: Some(file!()), ..ProptestConfig::with_cases(40) };
    let jams = (jam(), any::<bool>(), 1usize..4);
    proptest!(config, |((all, walled, threads) in jams)| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        most.fetch_max(pool.install(|| check(&all, walled, true, false))?, Ordering::Relaxed);
    });
    assert!(most.into_inner() > 8, "no jam needed many rounds");
}

//! The guard and its contacts as they are described, looking at everybody every time: what the fast ones must agree with,
//! bit for bit.

use super::certify::{ROUNDS, Scratch, within_reach};
use super::cores::Cores;
use super::safe::is_safe;
use super::solid::Solid;
use super::{Bodies, Contacts, Guard, Pose, Report, Seen, Solids, cell, relax};
use crate::Obstacle;
use crate::agent::GroupId;
use crate::perceive::Grid;
use crate::space::Walls;
use crate::space::surface::{SeenFrom, Sphere};
use crate::steer::Barriers;
use glam::{DVec2, Vec2, Vec3};
use proptest::prelude::*;

/// What is certain, and how it came to be: who was changed is not told.
fn certify(bodies: &Bodies<'_>, contacts: &Contacts, walls: &Walls, wishes: &[Pose]) -> (Vec<Pose>, Report) {
    let mut cores = Cores::default();
    cores.rebuild(bodies);
    let solid = Solid { bodies, contacts, walls, cores: &cores };
    let rows = 0..wishes.len();
    let mut now: Vec<Pose> = rows.clone().map(|row| within_reach(row, bodies, wishes[row])).collect();
    for _ in 0..relax::ITERATIONS {
        now = rows.clone().map(|row| relax::relaxed(row, solid, &now)).collect();
    }
    let mut clamped = vec![false; wishes.len()];
    let mut report = Report::default();
    for round in 1.. {
        let clamps = |row: usize| {
            !clamped[row]
                && (round > ROUNDS
                    && (!contacts.of(row).is_empty() || !contacts.is_off_walls(row) || bodies.solids.is_near(row))
                    || !is_safe(row, solid, &now))
        };
        let unsafe_ones: Vec<usize> = rows.clone().filter(|&row| clamps(row)).collect();
        if unsafe_ones.is_empty() {
            break;
        }
        report.rounds = round;
        for row in unsafe_ones {
            now[row] = cell::clamp(row, solid, now[row], &mut Scratch::default());
            clamped[row] = true;
        }
    }
    report.clamped = clamped.iter().filter(|&&clamped| clamped).count();
    (now, report)
}

/// Whom `row` could touch, by a look at everybody, all of it so many times as large.
fn touching(bodies: &Bodies<'_>, row: usize, scale: f32) -> Vec<u32> {
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

/// Whether a row is in a pile: its centre is so near to more than six others that they overlap.
fn is_piled(bodies: &Bodies<'_>, row: usize) -> bool {
    let least = bodies.radii.iter().fold(f32::INFINITY, f32::min);
    let reach = bodies.radii[row] + 0.8 * least;
    let others = (0..bodies.positions.len()).filter(|&other| other != row && meets(row, other));
    others.filter(|&other| bodies.place(row).distance_squared(bodies.place(other)) < reach * reach).count() > 6
}

/// Some pass through each other.
fn meets(a: usize, b: usize) -> bool {
    !(a + b).is_multiple_of(11)
}

#[derive(Clone, Copy, Debug)]
struct One {
    place: Vec3,
    heading: f32,
    core: Vec2,
    radius: f32,
    reach: f32,
    guarded: bool,
    wish: Vec3,
    turn: f32,
}

fn one() -> impl Strategy<Value = One> {
    let place = (-3.0f32..3.0, -3.0f32..3.0, prop_oneof![4 => Just(0.0f32), 1 => 0.0f32..2.0]);
    let extent = || prop_oneof![3 => Just(0.0f32), 1 => 0.0f32..0.75];
    // a few are far larger than the rest, a few far faster
    let radius = prop_oneof![8 => 0.0625f32..0.5, 1 => 1.0f32..3.0];
    let reach = prop_oneof![8 => 0.0f32..0.5, 1 => 0.5f32..4.0];
    let wish = (-1.0f32..1.0, -1.0f32..1.0, prop_oneof![4 => Just(0.0f32), 1 => -0.5f32..0.5]);
    let body = ((extent(), extent()), radius, reach, prop_oneof![4 => Just(true), 1 => Just(false)]);
    (place, -3.0f32..3.0, body, wish, -0.5f32..0.5).prop_map(
        |(place, heading, ((length, width), radius, reach, guarded), wish, turn)| One {
            place: place.into(),
            heading,
            core: Vec2::new(length, width),
            radius,
            reach,
            guarded,
            wish: wish.into(),
            turn,
        },
    )
}

/// Discs on the ground, all alike, now and then at the same place.
fn like() -> impl Strategy<Value = One> {
    let place = (-12i8..12, -12i8..12).prop_map(|(x, y)| Vec3::new(f32::from(x), f32::from(y), 0.0) * 0.375);
    (place, (-0.25f32..0.25, -0.25f32..0.25)).prop_map(|(place, (x, y))| One {
        place,
        heading: 0.0,
        core: Vec2::ZERO,
        radius: 0.1875,
        reach: 0.25,
        guarded: true,
        wish: Vec3::new(x, y, 0.0),
        turn: 0.0,
    })
}

fn crowd() -> impl Strategy<Value = Vec<One>> {
    prop_oneof![
        prop::collection::vec(one(), 1..90),
        prop::collection::vec(like(), 60..200),
        prop::collection::vec(piled(like()), 60..200),
        prop::collection::vec(piled(one()), 60..200),
    ]
}

/// In a heap about the origin.
fn piled(one: impl Strategy<Value = One>) -> impl Strategy<Value = One> {
    one.prop_map(|one| One { place: one.place * 0.25, ..one })
}

fn room() -> Walls {
    let points = [(-3.0, -3.0), (3.0, -3.0), (3.0, 3.0), (0.0, 0.5), (-3.0, 3.0)].map(DVec2::from).to_vec();
    let obstacles = [Obstacle::Wall { points }, Obstacle::Circle { center: DVec2::new(1.0, -1.5), radius: 0.75 }];
    Walls::new(&[], &obstacles, DVec2::ZERO)
}

/// Two balls that every other may not get into.
fn pillars() -> Solids {
    let ball = |at: Vec3| Sphere::new(at, 1.0).unwrap();
    let both = Barriers::default().with(ball(Vec3::new(-1.0, 0.0, 0.5)), SeenFrom::Outside);
    let mut solids = Solids::default();
    solids.add(both.with(ball(Vec3::new(1.5, 1.0, 0.0)), SeenFrom::Outside).0);
    solids
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn looking_at_some_gives_the_bits_of_looking_at_all(all in crowd(), walled: bool, knows: bool, solid: bool) {
        let walls = if walled { room() } else { Walls::default() };
        let mut solids = if solid { pillars() } else { Solids::default() };
        let positions: Vec<Vec2> = all.iter().map(|one| one.place.truncate()).collect();
        let mut bodies = Bodies {
            positions: &positions,
            altitudes: &all.iter().map(|one| one.place.z).collect(),
            headings: &all.iter().map(|one| one.heading).collect::<Vec<_>>(),
            cores: &all.iter().map(|one| one.core).collect(),
            radii: &all.iter().map(|one| one.radius).collect(),
            reach: &all.iter().map(|one| one.reach).collect(),
            guarded: &all.iter().map(|one| one.guarded).collect(),
            solids: &Solids::default(),
            resting: &[],
        };
        solids.find(&bodies, &(0..all.len()).map(|row| GroupId((row % 2) as u32)).collect());
        bodies.solids = &solids;
        // numbers run against the rows
        let numbers: Vec<u32> = (0..all.len() as u32).rev().collect();
        let mut grid = Grid::default();
        grid.rebuild(&positions, &numbers, 1.0);
        // every other row knows its nearest, up to a distance, sometimes too few
        let nearest: Vec<Vec<u32>> = (0..all.len()).map(|row| {
            let distance = |other: &u32| positions[row].distance_squared(positions[*other as usize]);
            let others = (0..all.len()).filter(|&other| other != row && meets(row, other)).map(|other| other as u32);
            let mut near: Vec<u32> = others.filter(|other| distance(other) <= 2.25).collect();
            near.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
            near.truncate(7);
            near
        }).collect();
        let known = |row: usize| {
            let nearest = &nearest[row][..];
            (knows && row.is_multiple_of(2)).then_some(Seen { nearest, range: 1.5, all: nearest.len() < 7 })
        };
        let mut contacts = Contacts::default();
        contacts.collect(&bodies, &numbers, &grid, &walls, meets, known);
        let piled: Vec<bool> = (0..all.len()).map(|row| is_piled(&bodies, row)).collect();
        for row in 0..all.len() {
            let of = contacts.of(row);
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
        let wish = |one: &One| Pose { heading: one.heading + one.turn, ..Pose::default() }.with_place(one.place + one.wish);
        let wishes: Vec<Pose> = all.iter().map(wish).collect();
        let (plain, report) = certify(&bodies, &contacts, &walls, &wishes);
        let (mut guard, mut targets) = (Guard::default(), Vec::new());
        for _ in 0..2 {
            let fast = guard.certify(&bodies, &contacts, &walls, |row| wishes[row], &mut targets);
            let bits = |poses: &[Pose]| -> Vec<[u32; 4]> {
                let of = |pose: &Pose| [pose.position.x, pose.position.y, pose.altitude, pose.heading].map(f32::to_bits);
                poses.iter().map(of).collect()
            };
            prop_assert_eq!(bits(&targets), bits(&plain));
            prop_assert_eq!((fast.clamped, fast.rounds), (report.clamped, report.rounds));
            let changed = (0..all.len()).filter(|&row| {
                let (wish, certain) = (wishes[row].place(), plain[row].place());
                let tolerance = wish.distance(all[row].place).max(1e-3 * all[row].radius) * 1e-2;
                wish.distance(certain) > tolerance
                    || all[row].core != Vec2::ZERO && wishes[row].heading != plain[row].heading
            });
            prop_assert_eq!(fast.changed, changed.count());
        }
    }
}

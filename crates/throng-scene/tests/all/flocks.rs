//! Flocks for ten minutes, in each set of constraints: no agent touches an obstacle, no two guarded agents overlap, and
//! the agents flock. The figures of docs/flocks.md.

use glam::{DMat3, DVec3, Vec3};
use std::io::Write;
use throng::World;
use throng::space::surface::SeenFrom;
use throng_scene::{Built, gallery};

/// Duration, seconds.
const LONG: f64 = 600.0;
/// Agents within this distance are neighbours in the measures, metres.
const NEAR: f32 = 9.0;

/// The measures of a flock.
#[derive(Clone, Copy, Debug)]
struct Figures {
    /// The length of the mean direction of all agents: 0 all different, 1 all the same. The mean over the run.
    order: f64,
    /// The same measure for each agent and its neighbours.
    local_order: f64,
    /// The mean distance between the centres of neighbours, metres.
    nearest: f64,
    /// The extents of the largest flock along its second and its third axis, over that along its thinnest one.
    proportions: [f64; 2],
    /// The cosine of the angle between the thinnest axis and the vertical.
    upright: f64,
    /// The least distance between the centres of two agents, over the sum of their radii.
    separation: f64,
    /// The least distance between a body and a surface, metres.
    clearance: f64,
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    if count > 0 { sum / f64::from(count) } else { f64::NAN }
}

fn clearance(world: &World, built: &Built) -> f64 {
    let agents = world.relative_columns();
    let one = |row: usize| {
        let at = agents.position[row].extend(agents.altitude[row]);
        let off = built.surfaces.iter().map(|(_, barrier)| {
            let distance = barrier.surface.query(at).distance;
            match barrier.seen_from {
                SeenFrom::Outside => distance,
                SeenFrom::Inside => -distance,
                SeenFrom::Both => distance.abs(),
            }
        });
        f64::from(off.fold(f32::INFINITY, f32::min) - agents.radius[row])
    };
    (0..agents.len()).map(one).fold(f64::INFINITY, f64::min)
}

/// Returns the positions of the largest flock: agents within [`NEAR`] of each other belong together.
fn largest(at: &[Vec3]) -> Vec<Vec3> {
    let mut left: Vec<Vec3> = at.to_vec();
    let mut best: Vec<Vec3> = Vec::new();
    while let Some(first) = left.pop() {
        let (mut flock, mut next) = (vec![first], 0);
        while next < flock.len() {
            let here = flock[next];
            next += 1;
            let (near, far) = left.iter().partition(|place| place.distance(here) < NEAR);
            flock.extend::<Vec<Vec3>>(near);
            left = far;
        }
        if flock.len() > best.len() {
            best = flock;
        }
    }
    best
}

/// Returns the root mean square extents of points along their principal axes, ascending, and the axis of the first:
/// eigenvalues and eigenvectors of the covariance, by Jacobi's rotations.
fn axes(points: &[Vec3]) -> ([f64; 3], DVec3) {
    let points: Vec<DVec3> = points.iter().map(|point| point.as_dvec3()).collect();
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut spread = DMat3::ZERO;
    for offset in points.iter().map(|&point| point - middle) {
        spread += DMat3::from_cols(offset * offset.x, offset * offset.y, offset * offset.z);
    }
    let mut turn = DMat3::IDENTITY;
    for (p, q) in [(0, 1), (0, 2), (1, 2)].into_iter().cycle().take(30) {
        let angle = 0.5 * f64::atan2(2.0 * spread.col(q)[p], spread.col(q)[q] - spread.col(p)[p]);
        let (sin, cos) = angle.sin_cos();
        let mut step = DMat3::IDENTITY;
        (step.col_mut(p)[p], step.col_mut(q)[q]) = (cos, cos);
        (step.col_mut(q)[p], step.col_mut(p)[q]) = (sin, -sin);
        (spread, turn) = (step.transpose() * spread * step, turn * step);
    }
    let mut all = [0, 1, 2].map(|k| ((spread.col(k)[k].max(0.0) / points.len() as f64).sqrt(), turn.col(k)));
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    (all.map(|axis| axis.0), all[0].1)
}

#[test]
fn the_axes_of_a_turned_slab_are_found() {
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.7);
    let corner = |k: u8| {
        let side = |bit: u8, half: f64| if k & bit == 0 { -half } else { half };
        (turn * DVec3::new(side(1, 3.0), side(2, 1.0), side(4, 7.0)) + DVec3::splat(20.0)).as_vec3()
    };
    let (extents, thin) = axes(&(0..8).map(corner).collect::<Vec<_>>());
    assert!(extents.iter().zip([1.0, 3.0, 7.0]).all(|(a, b)| (a - b).abs() < 1e-5), "{extents:?}");
    assert!(thin.dot(turn * DVec3::Y).abs() > 1.0 - 1e-6, "{thin}");
    let apart = [0.0, 5.0, 30.0, 35.0, 40.0].map(|x| Vec3::X * x);
    assert_eq!(largest(&apart).len(), 3);
}

/// Returns order, local order, mean distance of neighbours, and of the largest flock the proportions and the cosine of
/// the angle between its thinnest axis and the vertical.
fn moment(world: &World) -> [f64; 6] {
    let agents = world.relative_columns();
    let at = |row: usize| agents.position[row].extend(agents.altitude[row]);
    let way = |row: usize| agents.velocity[row].extend(agents.vertical_velocity[row]).normalize_or_zero();
    let rows = || 0..agents.len();
    let all: Vec3 = rows().map(way).sum();
    let local = |row: usize| {
        let near = rows().filter(|&other| at(other).distance(at(row)) < NEAR);
        let (sum, count) = near.fold((Vec3::ZERO, 0.0), |(sum, count), other| (sum + way(other), count + 1.0));
        (count > 1.0).then(|| f64::from(sum.length() / count))
    };
    let nearest = |row: usize| {
        let others = rows().filter(|&other| other != row).map(|other| at(other).distance(at(row)));
        f64::from(others.fold(f32::INFINITY, f32::min))
    };
    let places: Vec<Vec3> = rows().map(at).collect();
    let ([thin, wide, long], axis) = axes(&largest(&places));
    [
        f64::from(all.length()) / agents.len() as f64,
        mean(rows().filter_map(local)),
        mean(rows().map(nearest)),
        wide / thin,
        long / thin,
        axis.z.abs(),
    ]
}

fn fly(name: &str) -> Figures {
    let scene = gallery::scene(name).unwrap();
    let (mut world, built) = scene.build().unwrap();
    let (mut clear, mut moments) = (f64::INFINITY, Vec::new());
    while world.time() < LONG {
        world.step();
        clear = clear.min(clearance(&world, &built));
        // once a second, after the agents have found each other
        if world.time() > 20.0 && world.time().fract() < scene.time.step {
            moments.push(moment(&world));
        }
    }
    let over = |k: usize| mean(moments.iter().map(|moment| moment[k]));
    let separation = world.summary().least_separation;
    Figures {
        order: over(0),
        local_order: over(1),
        nearest: over(2),
        proportions: [over(3), over(4)],
        upright: over(5),
        separation,
        clearance: clear,
    }
}

fn check(name: &str) {
    let Figures { order, local_order, nearest, proportions: [wide, long], upright, separation, clearance } = fly(name);
    let shape = format!("1 : {wide:.1} : {long:.1} | {upright:.2}");
    let row = format!(
        "| `{name}` | {order:.2} | {local_order:.2} | {nearest:.2} | {shape} | {separation:.3} | {clearance:.3} |"
    );
    std::io::stdout().write_all(format!("{row}\n").as_bytes()).unwrap();
    assert!(clearance > 0.0, "{name}: an agent touched an obstacle: {clearance} m");
    // random directions give less than 0.4: an agent has ten neighbours on average
    assert!(local_order > 0.5, "{name}: neighbours move in the same direction: {local_order}");
    // random positions in the ball that contains most agents give 8.4 m
    assert!((0.9..7.6).contains(&nearest), "{name}: agents keep together, but not too near: {nearest} m");
    if gallery::scene(name).unwrap().plan().unwrap().groups[0].guard {
        assert!(separation > 0.9999, "{name}: no two agents overlap: {separation}");
    }
}

macro_rules! flocks {
    ($($test:ident: $name:literal,)*) => {
        $(
            #[test]
            #[ignore = "ten minutes of a flock take a minute or two"]
            fn $test() {
                check($name);
            }
        )*

        #[test]
        fn all_flocks_are_measured() {
            let (_, names) = gallery::groups().find(|(group, _)| *group == "flocks").unwrap();
            assert_eq!(names.collect::<Vec<_>>(), [$($name),*]);
        }
    };
}

flocks! {
    open: "boids-open",
    in_sphere: "boids-in-sphere",
    between_spheres: "boids-between-spheres",
    in_sphere_spheres: "boids-in-sphere-spheres",
    spheres: "boids-spheres",
    in_sphere_rectangle: "boids-in-sphere-rectangle",
    rectangle: "boids-rectangle",
    outside_box: "boids-outside-box",
    in_box: "boids-in-box",
}

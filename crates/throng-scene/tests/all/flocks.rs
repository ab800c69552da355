//! Flocks for ten minutes, in each set of constraints: no agent touches an obstacle, no two guarded agents overlap, and
//! the agents flock. The figures of docs/flocks.md.

use glam::Vec3;
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

/// Returns order, local order, and mean distance of neighbours.
fn moment(world: &World) -> [f64; 3] {
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
    [f64::from(all.length()) / agents.len() as f64, mean(rows().filter_map(local)), mean(rows().map(nearest))]
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
    Figures { order: over(0), local_order: over(1), nearest: over(2), separation, clearance: clear }
}

fn check(name: &str) {
    let Figures { order, local_order, nearest, separation, clearance } = fly(name);
    let row = format!("| `{name}` | {order:.2} | {local_order:.2} | {nearest:.2} | {separation:.3} | {clearance:.3} |");
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

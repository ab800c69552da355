//! Paths of swarms through space, compared with distances and shortest paths in closed form.

use crate::oracle::Dice;
use glam::{Quat, Vec3};
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::space::surface::{Cuboid, Moved, Pose, Sphere, Surface};
use throng_field::{Smoothing, Spine, SwarmGuide, Tube, VoxelSettings, Voxels};

/// A ball, or a box given by its half extents along its own axes.
#[derive(Clone, Copy, Debug)]
enum Solid {
    Ball(Vec3, f32),
    Block(Vec3, Vec3, Quat),
}

impl Solid {
    fn surface(self) -> Arc<dyn Surface> {
        match self {
            Self::Ball(center, radius) => Arc::new(Sphere::new(center, radius).unwrap()),
            Self::Block(center, half, turn) => {
                let pose = Pose::new(center, turn).unwrap();
                Arc::new(Moved::new(Cuboid::new(2.0 * half).unwrap(), pose))
            }
        }
    }

    fn distance(self, at: Vec3) -> f32 {
        match self {
            Self::Ball(center, radius) => at.distance(center) - radius,
            Self::Block(center, half, turn) => {
                let beside = (turn.inverse() * (at - center)).abs() - half;
                beside.max(Vec3::ZERO).length() + beside.max_element().min(0.0)
            }
        }
    }
}

fn distance(solids: &[Solid], at: Vec3) -> f32 {
    solids.iter().map(|solid| solid.distance(at)).fold(f32::INFINITY, f32::min)
}

fn space(solids: &[Solid], scan: VoxelSettings) -> Arc<Voxels> {
    let scene: Vec<_> = solids.iter().map(|solid| solid.surface()).collect();
    Arc::new(Voxels::of(&scene, scan).unwrap())
}

fn point(rng: &mut Dice, low: f32, high: f32) -> Vec3 {
    Vec3::from([(); 3].map(|()| rng.between(f64::from(low), f64::from(high)) as f32))
}

fn turn(rng: &mut Dice) -> Quat {
    Quat::from_axis_angle(point(rng, -1.0, 1.0).normalize(), rng.between(0.0, 6.0) as f32)
}

/// Solids with at least this distance between them, in a box of 12 m.
fn scattered(rng: &mut Dice, gap: f32) -> Vec<Solid> {
    let mut solids: Vec<(Solid, Vec3, f32)> = Vec::new();
    for _ in 0..200 {
        let (center, size) = (point(rng, 0.0, 12.0), rng.between(0.4, 1.6) as f32);
        let solid = if rng.unit() < 0.5 {
            Solid::Ball(center, size)
        } else {
            Solid::Block(center, point(rng, 0.3, 1.0) * (size / 3.0f32.sqrt()), turn(rng))
        };
        if solids.iter().all(|other| other.1.distance(center) > other.2 + size + gap) {
            solids.push((solid, center, size));
        }
    }
    solids.into_iter().map(|solid| solid.0).collect()
}

#[test]
fn distances_are_those_of_the_nearest_solid() {
    let mut rng = Dice(1);
    let solids = scattered(&mut rng, 0.1);
    let space = space(&solids, VoxelSettings { high: Vec3::splat(12.0), cell: 0.5, ..VoxelSettings::default() });
    assert_eq!(space.counts(), [24; 3]);
    for cell in 0..24 * 24 * 24 {
        let at = space.middle(cell);
        assert_eq!(space.cell_at(at), Some(cell));
        let exact = distance(&solids, at);
        assert!((space.distances()[cell] - exact).abs() < 1e-4, "{} instead of {exact}", space.distances()[cell]);
        assert_eq!(space.cost()[cell].is_finite(), space.distances()[cell] >= 0.05);
    }
}

#[test]
fn in_empty_space_all_ways_are_straight() {
    let mut rng = Dice(2);
    for cell in [0.2, 0.5] {
        let size = 40.0 * cell;
        let space =
            space(&[], VoxelSettings { high: Vec3::splat(size), cell, clearance: 0.0, ..VoxelSettings::default() });
        for _ in 0..3 {
            let target = point(&mut rng, 0.1 * size, 0.9 * size);
            let guide = SwarmGuide::new(space.clone(), target, 0.01, 1.5).unwrap();
            let (mut sum, mut worst, mut count) = (0.0, 0.0f32, 0);
            for _ in 0..2000 {
                let at = point(&mut rng, cell, size - cell);
                let velocity = guide.velocity(at, 0.0);
                assert!((velocity.length() - 1.5).abs() < 1e-4);
                let error = velocity.angle_between(target - at).to_degrees();
                (sum, worst, count) = (sum + error, worst.max(error), count + 1);
            }
            assert!(
                worst < 2.5 && sum / (count as f32) < 1.0,
                "cell {cell}: mean {}, worst {worst}",
                sum / count as f32
            );
            let at = point(&mut rng, cell, size - cell);
            let length = guide.length_from(at).unwrap();
            assert!((length - at.distance(target)).abs() < cell, "{length} instead of {}", at.distance(target));
        }
    }
}

/// Length of the shortest path between two points round a ball.
fn round_ball(radius: f32, from: Vec3, to: Vec3) -> f32 {
    let straight = to - from;
    let part = (-from.dot(straight) / straight.length_squared()).clamp(0.0, 1.0);
    if (from + straight * part).length() >= radius {
        return straight.length();
    }
    let tangent = |p: Vec3| (p.length_squared() - radius * radius).max(0.0).sqrt();
    let seen = |p: Vec3| (radius / p.length()).min(1.0).acos();
    tangent(from) + tangent(to) + radius * (from.angle_between(to) - seen(from) - seen(to))
}

#[test]
fn ways_round_a_ball_are_nearly_the_shortest() {
    let mut rng = Dice(3);
    let ball = Solid::Ball(Vec3::splat(4.0), 1.5);
    let scan = VoxelSettings {
        high: Vec3::splat(8.0),
        cell: 0.2,
        radius: 0.1,
        clearance: 0.0,
        dearest: 0.0,
        ..VoxelSettings::default()
    };
    let space = space(&[ball], scan);
    for _ in 0..12 {
        let target = Vec3::splat(4.0) + point(&mut rng, -1.0, 1.0).normalize() * 2.6;
        let guide = SwarmGuide::new(space.clone(), target, 0.05, 1.0).unwrap();
        for _ in 0..20 {
            let from = Vec3::splat(4.0) + point(&mut rng, -1.0, 1.0).normalize() * 2.7;
            let exact = round_ball(1.6, from - 4.0, target - 4.0);
            let length = guide.length_from(from).unwrap();
            assert!((length - exact).abs() < 0.25 + 0.06 * exact, "{length} instead of {exact}");
            let path = guide.path(from).unwrap();
            let walked: f32 = path.windows(2).map(|ends| ends[0].distance(ends[1])).sum();
            assert!(walked < 1.12 * exact + 0.2, "{walked} instead of {exact}");
            // the shortest path at 0.2 m from the ball
            let smoothing = Smoothing { distance: 0.2, rounds: 2000, ..Smoothing::default() };
            let spine = guide.spine(from, smoothing).unwrap();
            let least = round_ball(1.7, from - 4.0, target - 4.0);
            // from nearly behind the ball the smoothing has not slid all the way round
            assert!(spine.length() < 1.004 * least + 0.003, "{} instead of {least}", spine.length());
            assert!(spine.clearance() >= 0.199, "{}", spine.clearance());
        }
    }
}

/// The least distance along a path, including points between its samples.
fn along(solids: &[Solid], way: &[Vec3]) -> f32 {
    let between = |ends: &[Vec3]| (0..=20).map(|k| distance(solids, ends[0].lerp(ends[1], k as f32 / 20.0))).collect();
    let all: Vec<f32> = way.windows(2).flat_map(|ends| -> Vec<f32> { between(ends) }).collect();
    all.into_iter().fold(f32::INFINITY, f32::min)
}

#[test]
fn smooth_ways_among_solids_keep_off_them() {
    let keep = 0.4;
    let mut longest = 0.0f32;
    for seed in 0..12 {
        let mut rng = Dice(seed + 40);
        let solids = scattered(&mut rng, 2.0 * keep + 0.3);
        let scan = VoxelSettings {
            high: Vec3::splat(12.0),
            cell: 0.25,
            radius: 0.1,
            clearance: 0.02,
            ..VoxelSettings::default()
        };
        let space = space(&solids, scan);
        let mut free = || loop {
            let at = point(&mut rng, 0.5, 11.5);
            if distance(&solids, at) > keep + 0.05 {
                return at;
            }
        };
        let target = free();
        let guide = SwarmGuide::new(space, target, 0.1, 2.0).unwrap();
        for _ in 0..6 {
            let from = loop {
                let from = free();
                if along(&solids, &[from, target]) < 0.0 {
                    break from;
                }
            };
            let path = guide.path(from).unwrap();
            assert_eq!((path[0], path[path.len() - 1]), (from, target));
            assert!(along(&solids, &path) > 0.8 * 0.1, "seed {seed}: {}", along(&solids, &path));
            let smoothing = Smoothing { distance: keep, ..Smoothing::default() };
            let spine = guide.spine(from, smoothing).unwrap();
            let points = spine.points();
            assert_eq!((points[0], points[points.len() - 1]), (from, target));
            assert!(spine.clearance() >= keep * 0.999, "seed {seed}: {} from {from} to {target}", spine.clearance());
            let exact = points.iter().map(|&at| distance(&solids, at)).fold(f32::INFINITY, f32::min);
            assert!((spine.clearance() - exact).abs() < 1e-4);
            assert!(along(&solids, points) > keep * 0.9, "seed {seed}: {} between", along(&solids, points));
            longest = longest.max(spine.length() / from.distance(target));
            let bend = |points: &[Vec3]| {
                let turns = points.windows(3).map(|q| (q[1] - q[0]).angle_between(q[2] - q[1]));
                turns.filter(|turn| turn.is_finite()).fold(0.0, f32::max)
            };
            assert!(bend(points) < 0.8, "seed {seed}: a bend of {}", bend(points));
        }
    }
    assert!(longest < 1.15, "{longest} times as long as straight");
}

/// A wall with a hole narrower than the clearance that is set: the path leads through its centre.
#[test]
fn narrow_holes_are_gone_through_in_the_middle() {
    let block = |low: Vec3, high: Vec3| Solid::Block((low + high) * 0.5, (high - low) * 0.5, Quat::IDENTITY);
    let solids = [
        block(Vec3::new(3.5, -1.0, -1.0), Vec3::new(4.5, 3.0, 9.0)),
        block(Vec3::new(3.5, 4.2, -1.0), Vec3::new(4.5, 9.0, 9.0)),
        block(Vec3::new(3.5, -1.0, -1.0), Vec3::new(4.5, 9.0, 5.0)),
        block(Vec3::new(3.5, -1.0, 6.2), Vec3::new(4.5, 9.0, 9.0)),
    ];
    let space =
        space(&solids, VoxelSettings { high: Vec3::splat(8.0), cell: 0.2, radius: 0.1, ..VoxelSettings::default() });
    let guide = SwarmGuide::new(space, Vec3::new(7.0, 2.0, 2.0), 0.1, 1.0).unwrap();
    let spine = guide.spine(Vec3::new(1.0, 2.0, 2.1), Smoothing { distance: 1.0, ..Smoothing::default() }).unwrap();
    assert!(spine.clearance() > 0.5, "{} of the possible 0.6", spine.clearance());
    assert!(along(&solids, spine.points()) > 0.45);
}

/// Follows a field until it is 0; returns the path.
fn follow(guide: &SwarmGuide, from: Vec3, step: f32) -> Vec<Vec3> {
    let mut way = vec![from];
    for _ in 0..5000 {
        let at = way[way.len() - 1];
        let velocity = guide.velocity(at, 0.0);
        if velocity == Vec3::ZERO {
            break;
        }
        way.push(at + velocity * step);
    }
    way
}

#[test]
fn followers_arrive_down_the_slope_and_along_the_spine() {
    for seed in 0..6 {
        let mut rng = Dice(seed + 70);
        let solids = scattered(&mut rng, 1.0);
        let scan = VoxelSettings {
            high: Vec3::splat(12.0),
            cell: 0.25,
            radius: 0.1,
            clearance: 0.05,
            ..VoxelSettings::default()
        };
        let space = space(&solids, scan);
        let mut free = || loop {
            let at = point(&mut rng, 0.5, 11.5);
            if distance(&solids, at) > 0.5 {
                return at;
            }
        };
        let (from, target) = (free(), free());
        let guide = SwarmGuide::new(space, target, 0.2, 2.0).unwrap();
        for _ in 0..10 {
            let way = follow(&guide, free(), 0.02);
            assert!(way[way.len() - 1].distance(target) < 0.2, "seed {seed}");
            let least = along(&solids, &way);
            assert!(least > 0.03, "seed {seed}: {least} m off solids");
        }
        let spine = guide.spine(from, Smoothing { distance: 0.4, ..Smoothing::default() }).unwrap();
        let plain = guide.clone();
        let tube = Tube { radius: 0.8, pull: 2.0 };
        let guide = guide.along(spine.clone(), tube).unwrap();
        // within the tube, to the spine and along it
        let start = from + Vec3::new(0.1, 0.2, -0.1);
        let way = follow(&guide, start, 0.02);
        assert!(way[way.len() - 1].distance(target) < 0.2, "seed {seed}");
        let off = |at: Vec3| nearest(&spine, at).distance(at);
        assert!(way.iter().all(|&at| off(at) <= off(start) + 0.05), "seed {seed}");
        let tangent = guide.velocity(spine.points()[3], 0.0).normalize();
        assert!(tangent.dot((spine.points()[4] - spine.points()[2]).normalize()) > 0.95);
        // outside of the tube, down the slope
        let mut beyond = 0;
        while beyond < 100 {
            let at = free();
            if off(at) > 0.8 {
                assert_eq!(guide.velocity(at, 0.0), plain.velocity(at, 0.0));
                beyond += 1;
            }
        }
    }
}

fn nearest(spine: &Spine, at: Vec3) -> Vec3 {
    let on = |ends: &[Vec3]| {
        let along = ends[1] - ends[0];
        ends[0] + along * ((at - ends[0]).dot(along) / along.length_squared().max(1e-30)).clamp(0.0, 1.0)
    };
    let all = spine.points().windows(2).map(on);
    all.min_by(|a, b| a.distance(at).total_cmp(&b.distance(at))).unwrap()
}

#[test]
fn the_bits_do_not_depend_on_threads() {
    let make = || {
        let solids = scattered(&mut Dice(5), 0.6);
        let space = space(&solids, VoxelSettings { high: Vec3::splat(12.0), cell: 0.5, ..VoxelSettings::default() });
        let open = (0..space.cost().len()).rev().find(|&cell| space.is_open(cell)).unwrap();
        let first = (0..space.cost().len()).find(|&cell| space.is_open(cell)).unwrap();
        let guide = SwarmGuide::new(space.clone(), space.middle(open), 0.1, 1.0).unwrap();
        let spine = guide.spine(space.middle(first), Smoothing::default()).unwrap();
        let points: Vec<[u32; 3]> = spine.points().iter().map(|at| at.to_array().map(f32::to_bits)).collect();
        let lengths: Vec<u32> = guide.lengths().iter().map(|length| length.to_bits()).collect();
        let guide = guide.along(spine, Tube::default()).unwrap();
        let mut rng = Dice(6);
        let velocities: Vec<[u32; 3]> =
            (0..1000).map(|_| guide.velocity(point(&mut rng, 0.0, 12.0), 0.0).to_array().map(f32::to_bits)).collect();
        (points, lengths, velocities)
    };
    let with = |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(make);
    let one = with(1);
    for threads in [2, 5] {
        assert!(with(threads) == one);
    }
}

#[test]
fn wrong_spaces_targets_and_ways_are_told() {
    let good = VoxelSettings { high: Vec3::splat(8.0), cell: 0.5, radius: 0.1, ..VoxelSettings::default() };
    let says = |error: Error, what: &str| assert!(error.to_string().contains(what), "{error}: {what}");
    let scans = [
        (VoxelSettings { cell: 0.0, ..good }, "width of a cube of space is 0"),
        (VoxelSettings { cell: f32::NAN, ..good }, "width of a cube of space is NaN"),
        (VoxelSettings { cell: 0.01, ..good }, "800 by 800 by 800 cubes are more than 16777216: make them wider"),
        (VoxelSettings { cell: 1e-30, ..good }, "make them wider"),
        (VoxelSettings { high: Vec3::new(8.0, 0.0, 8.0), ..good }, "it is empty"),
        (VoxelSettings { low: Vec3::NAN, ..good }, "corner of a box of space is NaN"),
        (VoxelSettings { radius: -1.0, ..good }, "radius of bodies in space is -1"),
        (VoxelSettings { clearance: f32::INFINITY, ..good }, "clearance in space is inf"),
        (VoxelSettings { dearest: f32::NAN, ..good }, "greatest cost close to obstacles is NaN"),
    ];
    for (scan, what) in scans {
        says(Voxels::of(&[], scan).unwrap_err(), what);
    }
    // a closed shell round the centre
    let side = |axis: Vec3| {
        let half = Vec3::splat(2.0) - axis.abs() * 1.8;
        Solid::Block(Vec3::splat(4.0) + axis * 1.8, half, Quat::IDENTITY)
    };
    let shell: Vec<Solid> = Vec3::AXES.into_iter().flat_map(|axis| [side(axis), side(-axis)]).collect();
    let space = space(&shell, good);
    let guide = |target: Vec3| SwarmGuide::new(space.clone(), target, 0.1, 1.0);
    says(guide(Vec3::splat(9.0)).unwrap_err(), "the target at [9, 9, 9]: it is beyond the box of space");
    says(guide(Vec3::new(4.0, 4.0, 2.2)).unwrap_err(), "it is inside an obstacle");
    says(guide(Vec3::NAN).unwrap_err(), "place of a target is NaN");
    says(SwarmGuide::new(space.clone(), Vec3::ONE, -1.0, 1.0).unwrap_err(), "tolerance of a target is -1");
    says(SwarmGuide::new(space.clone(), Vec3::ONE, 0.1, 0.0).unwrap_err(), "speed of a guide is 0");
    let inside = guide(Vec3::splat(4.0)).unwrap();
    assert_eq!(inside.velocity(Vec3::ONE, 0.0), Vec3::ZERO);
    assert_eq!((inside.length_from(Vec3::ONE), inside.length_from(Vec3::NAN)), (None, None));
    assert_eq!(inside.velocity(Vec3::splat(-1.0), 0.0), Vec3::ZERO);
    assert!(inside.velocity(Vec3::new(4.0, 4.0, 3.0), 0.0).z > 0.9);
    says(inside.path(Vec3::ONE).unwrap_err(), "the way from [1, 1, 1] to [4, 4, 4]: no way leads there");
    says(inside.path(Vec3::splat(-1.0)).unwrap_err(), "its start is beyond the box of space");
    says(inside.path(Vec3::new(4.0, 4.0, 2.2)).unwrap_err(), "its start is inside an obstacle");
    says(inside.path(Vec3::new(4.0, 4.0, 1.95)).unwrap_err(), "a body has no room at its start");
    let from = Vec3::new(4.0, 4.0, 3.0);
    let wrong = [
        (Smoothing { spacing: 0.0, ..Smoothing::default() }, "spacing of the samples of a way is 0"),
        (Smoothing { spacing: 1e-7, ..Smoothing::default() }, "more than 100000 samples"),
        (Smoothing { stiffness: f32::NAN, ..Smoothing::default() }, "stiffness of a way is NaN"),
        (Smoothing { rounds: 1_000_000, ..Smoothing::default() }, "rounds of smoothing is 1000000"),
    ];
    for (smoothing, what) in wrong {
        says(inside.spine(from, smoothing).unwrap_err(), what);
    }
    let spine = inside.spine(from, Smoothing::default()).unwrap();
    says(inside.clone().along(spine.clone(), Tube { radius: 0.0, pull: 1.0 }).unwrap_err(), "radius of the tube");
    says(inside.along(spine, Tube { radius: 1.0, pull: -1.0 }).unwrap_err(), "pull towards a way is -1");
    // lengths of zero
    let there = guide(Vec3::ONE).unwrap().spine(Vec3::ONE, Smoothing::default()).unwrap();
    assert_eq!(there.length(), 0.0);
}

//! Hashes of the velocities of fields of every kind at random places and times.

use crate::draw::Draw;
use crate::results::Results;
use glam::{DVec2, DVec3, Quat, Vec2, Vec2Swizzles, Vec3};
use std::sync::Arc;
use throng::agent::Guidance;
use throng::field::{Adaptive, Field, Governed, Interaction};
use throng::space::surface::{Capsule, Cuboid, Moved, Pose, Sphere, Surface};
use throng::space::{Place, Walls};
use throng::{Agent, Error, Goal, Group, Journey, Obstacle, Settings, Stop, SubSteps, Walkable, World};
use throng_field::{
    Anchor, Anchors, AnchorsInSpace, AroundWalls, Blend, Brush, Critical, CurlNoise, Density, Destination, FadeOut,
    FieldPart, Kernel, Keyframes, Map, NoiseWall, Octave, Potential, Rigid, RoundJams, Sampled, Sketch, Smoothing,
    Stamp, Stroke, Sum, SwarmGuide, Terrain, TerrainSettings, ToGoal, Tube, Uniform, VoxelSettings, Voxels, erase,
};

/// The inner corner of two walls, places beside it, and the centre of a pillar.
const SPECIAL: [Vec3; 5] = [
    Vec3::new(1.0, 3.0, 0.0),
    Vec3::new(1.0003, 2.9996, 0.0),
    Vec3::new(1.02, 2.9, 1.0),
    Vec3::new(-3.0, 2.0, 1.0),
    Vec3::ZERO,
];

fn number(draw: &mut Draw, low: f64, high: f64) -> f32 {
    draw.between(low, high) as f32
}

fn flat(draw: &mut Draw, half: f64) -> DVec2 {
    draw.point(DVec2::splat(-half), DVec2::splat(half))
}

fn solid(draw: &mut Draw, half: f64) -> DVec3 {
    flat(draw, half).extend(draw.between(-half, half))
}

/// Most fields reach from -6 to 6 along both axes: places lie in them, and beyond. An eighth of the places lies on the
/// borders of cells.
fn place(draw: &mut Draw) -> Vec3 {
    let place = flat(draw, 7.0).extend(draw.between(-2.0, 4.0));
    if draw.index(8) == 0 { (place * 2.0).round() * 0.5 } else { place }.as_vec3()
}

/// Adds the velocities of a field: at single places, and in rows.
fn ask(results: &mut Results, name: &str, field: &dyn Field) {
    let mut draw = Draw::new(9);
    for at in SPECIAL {
        results.add(name, &field.velocity(at, 1.5));
    }
    for _ in 0..200 {
        let (at, time) = (place(&mut draw), draw.between(-5.0, 20.0));
        results.add(name, &field.velocity(at, time));
    }
    for _ in 0..6 {
        let row = (draw.point(DVec2::splat(-7.0), DVec2::new(2.0, 6.0)), draw.between(0.05, 0.6));
        let mut out = vec![Vec2::ZERO; 1 + draw.index(40)];
        field.row(row, draw.index(9), draw.between(0.0, 9.0), &mut out);
        results.add(name, &out);
    }
}

fn some(draw: &mut Draw, count: usize, stretch: f64) -> Vec<Anchor> {
    let anchor = |_| Anchor { place: flat(draw, 5.0), velocity: flat(draw, 1.5), stretch: draw.between(1.0, stretch) };
    (0..count).map(anchor).collect()
}

fn anchors(results: &mut Results) {
    let mut draw = Draw::new(1);
    let (plain, near) = (some(&mut draw, 14, 1.0), some(&mut draw, 9, 3.0));
    let along = |k: i32| Anchor::new(DVec2::new(1.0, -2.0) + DVec2::new(0.4, 0.3) * f64::from(k * k), DVec2::X * 0.3);
    let line: Vec<Anchor> = (0..4).map(along).collect();
    let beside = |aside: f64| [&line[..], &[Anchor { place: line[1].place + aside, ..line[0] }]].concat();
    let again = |at: usize, aside: f64| Anchor { place: near[at].place + aside, velocity: DVec2::X, stretch: 1.0 };
    let plain_near: Vec<Anchor> = near.iter().map(|anchor| Anchor { stretch: 1.0, ..*anchor }).collect();
    let shared = [&plain_near[..], &[again(0, 2e-9), again(5, 0.0), again(0, 0.0)]].concat();
    // so that more digits cancel than single precision has
    let at_odds = [&plain_near[..], &[again(2, 4e-3)]].concat();
    let sketch = Sketch { fade: Some(1.5), max_speed: 1.1, ..Sketch::default() };
    let reach = |reach: f64| Kernel::Wendland { reach };
    for (name, anchors, sketch) in [
        ("anchors", plain.clone(), Sketch::default()),
        ("anchors, smoothed", plain.clone(), Sketch { smoothing: 3e-3, ..sketch }),
        ("anchors, near", plain_near, Sketch { kernel: reach(3.0), ..Sketch::default() }),
        ("anchors, near, stretched", near.clone(), Sketch { kernel: reach(5.0), smoothing: 0.2, ..sketch }),
        ("anchors, shared", shared, sketch),
        ("anchors, at odds", at_odds, Sketch { max_speed: 3.0, ..Sketch::default() }),
        ("anchors, on a line", line.clone(), sketch),
        ("anchors, all but on a line", beside(1e-6), sketch),
        ("anchors, hardly on a line", beside(1e-4), sketch),
        ("anchors, two", plain[..2].to_vec(), sketch),
        ("anchors, one", plain[..1].to_vec(), sketch),
        ("anchors, none", vec![], sketch),
    ] {
        let mut field = Anchors::new(&anchors, sketch).unwrap();
        results.add(name, &field.notes());
        ask(results, name, &field);
        results.add(name, &field.set_velocity(0, DVec2::new(0.4, -0.9)));
        results.add(name, &field.anchors());
        (0..40).for_each(|_| results.add(name, &field.at(flat(&mut draw, 7.0))));
    }
}

fn anchors_in_space(results: &mut Results) {
    let mut draw = Draw::new(2);
    let plain: Vec<_> = (0..12).map(|_| (solid(&mut draw, 4.0), solid(&mut draw, 1.5))).collect();
    let plane: Vec<_> = plain.iter().map(|&(at, v)| (at.with_z(0.5 * at.x), v)).collect();
    let line: Vec<_> = plain.iter().map(|&(at, v)| (DVec3::new(at.x, 2.0 * at.x, 1.0 - at.x), v)).collect();
    let shared = [&plain[..5], &[(plain[3].0 + 1e-9, DVec3::Z), (plain[3].0, DVec3::X)]].concat();
    let sketch = Sketch { fade: Some(1.2), max_speed: 1.3, ..Sketch::default() };
    for (name, anchors, sketch) in [
        ("anchors in space", &plain[..], Sketch::default()),
        ("anchors in space, smoothed", &plain, Sketch { smoothing: 0.05, ..sketch }),
        ("anchors in space, near", &plain, Sketch { kernel: Kernel::Wendland { reach: 4.0 }, ..Sketch::default() }),
        ("anchors in space, on a plane", &plane, sketch),
        ("anchors in space, on a line", &line, sketch),
        ("anchors in space, shared", &shared, sketch),
        ("anchors in space, one", &plain[..1], sketch),
        ("anchors in space, none", &[], sketch),
    ] {
        let field = AnchorsInSpace::new(anchors, sketch).unwrap();
        results.add(name, &field.notes());
        ask(results, name, &field);
        (0..40).for_each(|_| results.add(name, &field.at(solid(&mut draw, 6.0))));
    }
}

fn drawn(results: &mut Results) {
    let mut draw = Draw::new(3);
    for _ in 0..20 {
        let mut points: Vec<DVec2> = (0..2 + draw.index(4)).map(|_| flat(&mut draw, 5.0)).collect();
        points.push(points[draw.index(points.len())]);
        let (speed, spacing) = (draw.between(-1.0, 2.0), draw.between(0.3, 9.0));
        let mut anchors = Stroke { points, speed, spacing, stretch: 2.0 }.anchors().unwrap();
        results.add("strokes", &anchors);
        results.add("strokes", &erase(&mut anchors, flat(&mut draw, 3.0), 3.0));
    }
    for kind in [Critical::Center, Critical::Source, Critical::Sink, Critical::Saddle] {
        let stamp = Stamp { place: flat(&mut draw, 5.0), kind, radius: 1.7, speed: draw.between(-1.0, 1.0) };
        results.add("stamps", &(kind.traps(), stamp.anchors()));
    }
    let mut field = Sampled::over(DVec2::splat(-6.0), DVec2::splat(6.0), 0.37).unwrap();
    let mut map = Map::over(DVec2::new(-5.0, -3.0), DVec2::new(4.0, 5.0), 0.45).unwrap();
    for (radius, strength, hardness) in [(2.0, 1.0, 0.5), (0.9, 0.6, 0.0), (1.3, 0.8, 1.0), (1.7, 0.5, 0.9)] {
        let brush = Brush { radius, strength, hardness };
        let mut line: Vec<DVec2> = (0..4).map(|_| flat(&mut draw, 6.5)).collect();
        line[2] = line[1];
        field.paint(&brush, &line, draw.between(-1.0, 2.0)).unwrap();
        field.paint(&brush, &[flat(&mut draw, 5.0)], 1.0).unwrap();
        field.rub_out(&brush, &line[2..]).unwrap();
        map.paint(&brush, &line, number(&mut draw, -1.0, 2.0)).unwrap();
        results.add("painted", &(field.velocities(), map.values(), map.bounds()));
    }
    ask(results, "painted", &field);
    (0..60).for_each(|_| results.add("painted", &map.at(flat(&mut draw, 6.0))));
}

fn drift(place: Vec3, time: f64) -> Vec3 {
    Vec3::new(1.0 - 0.3 * place.y, 0.4 * place.x + 0.05 * time as f32, 0.2 - 0.1 * place.z)
}

/// The obstacles of terrains and noises: a corner of two walls, a pillar, a box.
fn obstacles() -> Vec<Obstacle> {
    let wall = [(1.0, -3.0), (1.0, 3.0), (4.0, 3.0)].map(DVec2::from).to_vec();
    vec![
        Obstacle::Wall { points: wall },
        Obstacle::Circle { center: DVec2::new(-3.0, 2.0), radius: 0.8 },
        Obstacle::rectangle(DVec2::new(-2.0, -2.5), DVec2::new(2.5, 1.0), 0.6),
    ]
}

fn combined() -> Vec<(&'static str, Arc<dyn Field>)> {
    let mut draw = Draw::new(4);
    let values = (0..12 * 11).map(|_| number(&mut draw, -0.3, 1.2)).collect();
    let map = Arc::new(Map::new(DVec2::new(-5.0, -4.0), 0.75, 12, values).unwrap());
    let values = (0..10 * 9).map(|_| flat(&mut draw, 1.5).as_vec2()).collect();
    let sampled = Sampled::new(DVec2::new(-4.0, -5.0), 0.8, 10, values).unwrap();
    let mapped = |part: FieldPart| FieldPart { map: Some(map.clone()), ..part };
    let parts = |weight: f32| {
        vec![
            FieldPart::new(drift, 0.5),
            mapped(FieldPart::new(sampled.clone(), 1.5)),
            mapped(FieldPart::new(Uniform(Vec3::new(0.3, -1.0, 0.4)), weight)),
            FieldPart::new(Uniform(Vec3::X), 0.0),
        ]
    };
    let against = [Vec3::X, Vec3::NEG_X * 2.0, Vec3::Z, Vec3::NEG_Z, Vec3::ZERO, Vec3::Y];
    let up = [Vec3::Z, Vec3::NEG_Z * 1.5];
    let blend = |all: &[Vec3]| {
        let part = |(k, &v): (usize, &Vec3)| FieldPart::new(Uniform(v), 1.0 + 0.3 * k as f32);
        Arc::new(Blend::new(all.iter().enumerate().map(part).collect()).unwrap())
    };
    let frames: [(f64, Arc<dyn Field>); 3] =
        [(1.0, Arc::new(drift)), (4.0, Arc::new(sampled.clone())), (4.5, Arc::new(Uniform(Vec3::NEG_Y)))];
    let keyframes = |count: usize, period| Arc::new(Keyframes::new(frames[..count].to_vec(), period).unwrap());
    let ground = Walkable {
        outer: [(-6.0, -6.0), (6.0, -6.0), (6.0, 6.0), (-6.0, 5.0)].map(DVec2::from).to_vec(),
        holes: vec![[(4.0, -4.0), (5.0, -4.5), (5.0, -2.0)].map(DVec2::from).to_vec()],
    };
    let walls = Walls::new(&[ground], &obstacles(), DVec2::ZERO);
    let around = |field: Arc<dyn Field>, width| Arc::new(AroundWalls::new(field, walls.clone(), width).unwrap());
    vec![
        ("uniform", Arc::new(Uniform(Vec3::new(0.1, 0.2, 0.3)))),
        ("sampled", Arc::new(sampled.clone())),
        ("sum", Arc::new(Sum::new(parts(-0.7)).unwrap())),
        ("blend", Arc::new(Blend::new(parts(0.7)).unwrap())),
        ("blend of opposites", blend(&against)),
        ("blend of up and down", blend(&up)),
        ("keyframes", keyframes(3, None)),
        ("keyframes, one", keyframes(1, None)),
        ("keyframes, again and again", keyframes(3, Some(6.5))),
        ("around walls", around(Arc::new(drift), 1.4)),
        ("around walls, into a corner", around(Arc::new(Uniform(Vec3::new(-1.0, 1.0, 0.3))), 0.7)),
        ("around walls, shared", Arc::new(around(Arc::new(sampled), 3.0) as Arc<dyn Field>)),
    ]
}

/// Grids on two threads, so that their parts begin and end within rows.
fn grids(results: &mut Results) {
    let name = "sampled from fields";
    let threads = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    let wild = |place: Vec3, time: f64| if place.x > 5.5 { Vec3::NAN } else { drift(place, time) };
    let octaves = Octave::turbulence(3.0, 2.0, 1.0, 2).unwrap();
    let noise = CurlNoise::new(Potential::Plane, &octaves, 7).unwrap();
    threads.install(|| {
        let mut field = Sampled::of(&wild, DVec2::new(-6.1, -5.0), DVec2::new(6.0, 4.4), 0.33, 2.0).unwrap();
        results.add(name, &(field.velocities(), field.low(), field.high(), field.columns(), field.rows()));
        for (low, high) in [((-3.0, -2.2), (4.1, 3.0)), ((-9.0, 1.0), (1.0, 9.0)), ((2.0, 2.0), (1.0, 3.0))] {
            field.sample(&noise, low.into(), high.into(), 3.0);
            results.add(name, &(field.velocities(), field.cell()));
        }
        field.sample(&noise, field.low() + field.cell(), field.high() - field.cell(), 4.0);
        results.add(name, &field.velocities());
    });
}

fn critical(results: &mut Results) {
    let mut draw = Draw::new(5);
    for k in 0..120 {
        let (columns, rows) = (2 + draw.index(6), 2 + draw.index(6));
        // whole numbers, so that some vectors are exactly zero
        let corner = |_| if k % 2 == 0 { flat(&mut draw, 1.0) } else { flat(&mut draw, 3.0).round() }.as_vec2();
        let all = (0..columns * rows).map(corner).collect();
        let field = Sampled::new(DVec2::new(3.0, -1.0), 0.7, columns, all).unwrap();
        results.add("critical points", &field.critical_points());
    }
    // from centres over spirals to sinks and sources
    for part in [0.0, 5e-4, 9e-4, 1.1e-3, 2e-3, 0.3, 1.5] {
        for sign in [1.0, -1.0] {
            let spiral = |p: Vec3, _: f64| Vec3::new(sign * part * p.x - 2.0 * p.y, 0.5 * p.x + part * sign * p.y, 0.0);
            let field = Sampled::of(&spiral, DVec2::splat(-2.03), DVec2::splat(2.0), 0.31, 0.0).unwrap();
            results.add("critical points", &field.critical_points());
        }
    }
}

fn noises(results: &mut Results) {
    let name = "octaves";
    for count in [1, 3, 16] {
        results.add(name, &Octave::turbulence(0.8, 1.3, 0.7, count));
    }
    let sphere = |x: f32, radius: f32| Sphere::new(Vec3::new(x, 1.0, 0.5), radius).unwrap();
    let turned = Pose::new(Vec3::new(-2.0, -1.0, 0.5), Quat::from_xyzw(0.3, -0.2, 0.5, 0.8)).unwrap();
    let block = Moved::new(Cuboid::new(Vec3::new(2.0, 1.0, 3.0)).unwrap(), turned);
    let tube = Capsule::new(Vec3::new(3.0, -3.0, 0.0), Vec3::new(3.5, 2.0, 1.0), 0.6).unwrap();
    let moving = |velocity: Vec3, spin: Vec3| {
        move |time: f64| {
            let pose = Pose::at(Vec3::new(0.5, 2.5, 0.0) + velocity * (0.1 * time as f32)).unwrap();
            Rigid { pose, velocity, spin }
        }
    };
    let growing = |place: Vec3, time: f64| (1.0 + 0.1 * place.x + 0.02 * time as f32, Vec3::X * 0.1);
    for (kind, potential) in [("plane", Potential::Plane), ("space", Potential::Space), ("crossed", Potential::Crossed)]
    {
        let mut octaves = Octave::turbulence(2.3, 1.5, 0.7, 3).unwrap();
        octaves.push(Octave { length: 0.6, period: f32::INFINITY, speed: 0.4 });
        let noise = |seed: u64| CurlNoise::new(potential, &octaves, seed).unwrap();
        let wall = NoiseWall::new(block.clone(), 0.9).unwrap();
        let walls = noise(5).with_wall(wall.clone()).with_wall(NoiseWall::new(tube.clone(), 1.6).unwrap());
        let velocity = (Vec3::new(0.4, -0.3, 0.2), Vec3::new(0.3, -0.1, 0.8));
        let moved =
            NoiseWall::moving(Sphere::new(Vec3::ZERO, 0.8).unwrap(), 1.5, moving(velocity.0, velocity.1)).unwrap();
        let other = NoiseWall::moving(Cuboid::new(Vec3::ONE).unwrap(), 2.0, moving(-velocity.1, velocity.0)).unwrap();
        let all = [
            ("noise", noise(3)),
            ("noise beside walls", walls.clone()),
            ("noise beside what moves", noise(6).with_wall(moved.clone())),
            ("noise beside all", walls.with_wall(moved).with_wall(other).with_amplitude(growing)),
            ("noise that fades", noise(7).with_amplitude(FadeOut::new(sphere(0.0, 2.0), 6.0).unwrap())),
            ("noise that fades beside a wall", noise(8).with_amplitude(growing).with_wall(wall)),
        ];
        for (name, noise) in all {
            let (name, mut draw) = (&format!("{name}, {kind}"), Draw::new(11));
            results.add(name, &(noise.potential(), noise.octaves().collect::<Vec<_>>()));
            ask(results, name, &noise);
            let places: Vec<Vec3> = (0..61).map(|_| place(&mut draw)).collect();
            let numbers: Vec<u32> = (0..61).map(|_| draw.bits() as u32 % 9).collect();
            let mut out = vec![Vec3::ZERO; 61];
            noise.velocities(&places, 2.0, &mut out);
            results.add(name, &out);
            noise.velocities_of_individuals(&places, &numbers, 3.0, &mut out);
            results.add(name, &out);
            results.add(name, &[Vec3::NAN, Vec3::splat(1e4)].map(|at| noise.velocity(at, 1e5)));
        }
    }
}

fn point(x: f64, y: f64) -> Destination {
    Destination::Point { at: DVec2::new(x, y), tolerance: 0.3 }
}

fn area(corners: &[(f64, f64)]) -> Destination {
    Destination::Area { corners: corners.iter().map(|&corner| corner.into()).collect() }
}

/// A room with a hole, walls, a pillar, a box and a door of 0.9 m, and another room that no path leads to.
fn rooms(origin: DVec2) -> Place {
    let ring = |corners: &[(f64, f64)]| corners.iter().map(|&corner| origin + DVec2::from(corner)).collect::<Vec<_>>();
    let wall = |points: &[(f64, f64)]| Some(Obstacle::Wall { points: ring(points) });
    let outer = ring(&[(-5.5, -5.5), (5.6, -5.2), (5.3, 5.5), (0.2, 4.6), (-5.4, 5.1)]);
    let holes = vec![ring(&[(-3.0, -3.0), (-1.6, -3.2), (-1.8, -1.4)])];
    let beside = Walkable { outer: ring(&[(5.8, -2.0), (6.6, -2.0), (6.6, 2.0), (5.8, 2.0)]), holes: vec![] };
    let obstacles = vec![
        wall(&[(-1.0, 5.0), (-0.5, 1.2), (1.0, 0.6)]),
        None,
        Some(Obstacle::Circle { center: origin + DVec2::new(2.5, -2.2), radius: 0.9 }),
        Some(Obstacle::rectangle(origin + DVec2::new(2.6, 2.2), DVec2::new(1.8, 0.7), 0.5)),
        wall(&[(-4.5, 1.0), (-2.4, 1.3)]),
        wall(&[(-0.4, -5.4), (-0.2, -2.4)]),
        wall(&[(-0.2, -1.5), (0.4, -0.2)]),
    ];
    Place { areas: vec![Walkable { outer, holes }, beside], obstacles }
}

fn survey(cell: f64, radius: f64) -> TerrainSettings {
    TerrainSettings { low: DVec2::splat(-6.5), high: DVec2::splat(6.5), cell, radius, ..TerrainSettings::default() }
}

fn flows(results: &mut Results) {
    let mut draw = Draw::new(6);
    let place = rooms(DVec2::new(100.0, -50.0));
    let rooms = |survey: TerrainSettings| Terrain::of_place(&place, DVec2::new(100.0, -50.0), survey).unwrap();
    let mut painted = rooms(survey(0.31, 0.2));
    painted.paint(|at| if at.x * at.x + at.y < 4.0 { 1.7 } else { 0.6 }).unwrap();
    let pillar = |_| Some(Obstacle::Circle { center: flat(&mut draw, 5.0), radius: draw.between(0.05, 0.4) });
    let pillars = Place { areas: vec![], obstacles: (0..40).map(pillar).collect() };
    let post = |k: u32| {
        let center = DVec2::new(f64::from(k % 8) - 4.0, f64::from(k / 8) - 4.0) * 0.45 + flat(&mut draw, 0.1);
        Some(Obstacle::Circle { center, radius: 0.03 })
    };
    let posts = Place { areas: vec![], obstacles: (0..64).map(post).collect() };
    let wide = TerrainSettings { clearance: 0.2, dearest: 4.0, ..survey(0.25, 0.35) };
    let blocks = |at: DVec2| (at.x + 0.3 * at.y).rem_euclid(4.0) < 1.0 && (at.y - at.x).rem_euclid(5.0) < 4.0;
    let row = TerrainSettings {
        low: DVec2::new(-6.0, 0.0),
        high: DVec2::new(6.0, 0.4),
        cell: 0.4,
        ..TerrainSettings::default()
    };
    let column = TerrainSettings { low: row.low.yx(), high: row.high.yx(), ..row };
    let disc = |x: f64, y: f64, radius: f64| Destination::Disc { center: DVec2::new(x, y), radius };
    let several =
        vec![point(-4.0, 3.0), disc(3.6, 4.2, 0.8), area(&[(3.0, -4.6), (4.7, -4.2), (4.4, -3.0), (3.6, -3.9)])];
    let open = TerrainSettings { clearance: 0.0, dearest: 3.0, ..survey(0.4, 0.0) };
    for (name, ground, goals, slowing) in [
        ("flow", painted.clone(), vec![point(4.2, 4.0)], 1.0),
        ("flow to several", rooms(survey(0.27, 0.15)), several.clone(), 2.0),
        ("flow of the wide", rooms(wide), vec![disc(-5.0, -5.6, 1.1), point(4.6, 0.1)], 0.0),
        ("flow over wide cells", rooms(survey(1.3, 0.2)), vec![point(4.2, 4.0), point(-4.0, -4.0)], 1.0),
        ("flow among blocks", Terrain::of(blocks, open).unwrap(), vec![point(-1.0, -5.0), disc(6.0, 6.4, 0.7)], 3.0),
        ("flow in a row", Terrain::of(|_| false, row).unwrap(), vec![point(3.0, 0.3)], 1.0),
        ("flow in a column", Terrain::of(|at| at.y > 4.0, column).unwrap(), vec![point(0.1, -2.0)], 1.0),
        (
            "flow among posts",
            Terrain::of_place(&posts, DVec2::ZERO, survey(1.15, 0.02)).unwrap(),
            vec![point(-0.3, 0.2), point(5.0, -5.0)],
            1.0,
        ),
        (
            "flow among pillars",
            Terrain::of_place(&pillars, DVec2::ZERO, survey(0.6, 0.05)).unwrap(),
            vec![area(&[(-6.0, -6.0), (-5.0, -6.0), (-5.0, -5.0)])],
            1.0,
        ),
    ] {
        let ground = Arc::new(ground);
        let cells = 0..ground.cost().len();
        results.add(name, &(ground.cost(), ground.distances(), ground.low(), ground.high(), ground.rows()));
        let kinds = cells.map(|cell| (ground.is_open(cell), ground.is_solid(cell), ground.middle(cell)));
        results.add(name, &kinds.collect::<Vec<_>>());
        let flow = ToGoal::new(ground.clone(), goals, 1.3).unwrap().slowing(slowing).unwrap();
        results.add(name, &(flow.speed(), flow.goals(), flow.lengths(), flow.unreachable().collect::<Vec<_>>()));
        ask(results, name, &flow);
        let mut near = vec![];
        for _ in 0..400 {
            let at = draw.point(ground.low() - 0.1, ground.high() + 0.1);
            results.add(name, &(ground.cell_at(at), flow.time_to_goal(at)));
            results.add(name, &flow.velocity(at.as_vec2().extend(0.0), 0.0));
            near.push((at * 0.4).as_vec2());
        }
        jammed(results, name, flow, &near);
    }
    for goal in several {
        results.add("flow refused", &ToGoal::new(Arc::new(painted.clone()), vec![goal; 2], 1.0).map(drop));
    }
    for goal in [point(9.0, 0.0), point(2.5, -2.2), point(-1.0, 4.9), point(5.25, 5.4)] {
        results.add("flow refused", &ToGoal::new(Arc::new(rooms(wide)), vec![goal], 1.0).map(drop));
    }
}

/// The same flow in a crowd: the density, and ways round it.
fn jammed(results: &mut Results, name: &str, flow: ToGoal, people: &[Vec2]) {
    let mut before = Density::empty(flow.terrain());
    for (count, radius) in [(60, 0.8), (400, 2.3), (25, 0.03)] {
        let now = Density::of(flow.terrain(), people[..count].iter().copied(), radius).unwrap();
        before.follow(&now, 0.3);
        results.add(name, &(now.cells(), before.cells()));
    }
    let jams = RoundJams { weary: 0.7, radius: 0.9, interval: 0.4, part: 0.6, flow };
    let adaptive: &dyn Adaptive = Field::adaptive(&jams).unwrap();
    let mut memory = adaptive.memory();
    for part in people.chunks(150) {
        adaptive.notice(&mut memory, part);
    }
    results.add(name, &(adaptive.interval(), &memory));
    let adapted = adaptive.adapted(&memory);
    ask(results, name, &jams);
    ask(results, name, &adapted);
}

fn cuboid(low: (f32, f32, f32), high: (f32, f32, f32)) -> Arc<dyn Surface> {
    let (low, high) = (Vec3::from(low), Vec3::from(high));
    Arc::new(Moved::new(Cuboid::new(high - low).unwrap(), Pose::at(0.5 * (low + high)).unwrap()))
}

fn guides(results: &mut Results) {
    let scan =
        VoxelSettings { low: Vec3::new(-3.0, -3.0, -1.0), high: Vec3::new(3.0, 3.0, 1.7), ..VoxelSettings::default() };
    let scan = VoxelSettings { cell: 0.31, radius: 0.1, ..scan };
    let turned = Pose::new(Vec3::new(1.3, 1.0, 0.3), Quat::from_xyzw(0.3, -0.2, 0.5, 0.8)).unwrap();
    // a wall with a gap, a ball, a block and a sheet
    let scene: Vec<Arc<dyn Surface>> = vec![
        cuboid((-0.2, -4.0, -2.0), (0.1, -0.5, 2.0)),
        cuboid((-0.2, 0.3, -2.0), (0.1, 4.0, 2.0)),
        Arc::new(Sphere::new(Vec3::new(-1.6, 1.2, 0.2), 0.7).unwrap()),
        Arc::new(Moved::new(Cuboid::new(Vec3::new(1.0, 0.5, 1.2)).unwrap(), turned)),
        Arc::new(Moved::new(Cuboid::rectangle(Vec2::new(1.5, 3.0)).unwrap(), turned)),
    ];
    let smooth = Smoothing { rounds: 40, ..Smoothing::default() };
    let stiff = Smoothing { stiffness: 3.0, tension: 0.1, keep_off: 2.0, distance: 0.3, spacing: 0.4, ..smooth };
    let coarse = Smoothing { spacing: 1.5, keep_off: 0.0, distance: 0.2, rounds: 5, ..smooth };
    // smoothing so strong that it would cut corners
    let tight = Smoothing { spacing: 0.7, stiffness: 2.0, tension: 2.0, keep_off: 0.0, distance: 0.05, rounds: 60 };
    let tube = Tube { radius: 0.6, pull: 2.5 };
    for (name, scene, scan, smoothing, tube) in [
        ("guide", &scene[..], scan, smooth, Tube::default()),
        (
            "guide of the wide",
            &scene,
            VoxelSettings { radius: 0.27, clearance: 0.2, dearest: 3.0, ..scan },
            stiff,
            tube,
        ),
        ("guide of points", &scene, VoxelSettings { radius: 0.0, clearance: 0.0, cell: 0.4, ..scan }, coarse, tube),
        ("guide over wide cubes", &scene, VoxelSettings { cell: 1.15, radius: 0.05, ..scan }, smooth, tube),
        ("guide in the open", &[], scan, coarse, tube),
        ("guide in a layer", &scene, VoxelSettings { high: scan.high.with_z(-0.7), ..scan }, smooth, tube),
    ] {
        let mut draw = Draw::new(8);
        let space = Arc::new(Voxels::of(scene, scan).unwrap());
        results.add(name, &(space.distances(), space.cost(), space.counts(), space.low(), space.high()));
        let size = (space.high() - space.low()).as_dvec3() + 0.1;
        let at = |draw: &mut Draw| (space.low().as_dvec3() - 0.05 + size * (solid(draw, 0.5) + 0.5)).as_vec3();
        let target = Vec3::new(2.2, -1.5, -0.85);
        let guide = SwarmGuide::new(space.clone(), target, 0.2, 1.5).unwrap();
        results.add(name, &guide.lengths());
        for _ in 0..300 {
            let at = at(&mut draw);
            let cell = space.cell_at(at);
            results.add(name, &(guide.velocity(at, 0.0), guide.length_from(at), cell, cell.map(|c| space.is_open(c))));
        }
        for _ in 0..30 {
            results.add(name, &guide.path(at(&mut draw)));
        }
        let starts = [Vec3::new(-2.7, 2.3, -0.8), Vec3::new(-2.1, -1.1, -0.9), Vec3::new(2.6, 2.6, -0.75)];
        for (from, smoothing) in starts.into_iter().flat_map(|from| [(from, smoothing), (from, tight)]) {
            let Ok(spine) = guide.spine(from, smoothing) else { continue };
            let middle = spine.points().to_vec();
            results.add(name, &(&middle, spine.length(), spine.clearance()));
            let along = guide.clone().along(spine, tube).unwrap();
            for _ in 0..80 {
                let at = draw.one_of(&middle) + (solid(&mut draw, 0.6)).as_vec3();
                results.add(name, &along.velocity(at, 0.0));
            }
        }
        // towards the low sides of all axes
        let back = SwarmGuide::new(space.clone(), Vec3::new(-2.6, -2.4, -0.9), 0.2, 1.5);
        for _ in 0..30 {
            results.add(name, &back.as_ref().map(|guide| guide.path(at(&mut draw))));
        }
        // on the other side of the wall
        let [from, to] = [-0.32, 0.22].map(|x| Vec3::new(x, 1.0, -0.8));
        results.add(name, &SwarmGuide::new(space.clone(), to, 0.0, 1.0).and_then(|guide| guide.path(from)));
        for target in [Vec3::new(0.0, 1.0, 0.0), Vec3::splat(9.0), Vec3::new(-0.35, 1.0, -0.8)] {
            results.add(name, &SwarmGuide::new(space.clone(), target, 0.0, 1.0).map(|guide| guide.lengths().to_vec()));
        }
    }
}

/// How agents blend fields with their own directions, and fields that move with other agents, can only be tested in
/// worlds.
fn crowds(results: &mut Results) {
    let (mut draw, origin) = (Draw::new(10), DVec2::new(40.0, -7.0));
    let mut world = World::new(Settings { step: 0.1, sub_steps: SubSteps::Auto, seed: 3, origin }).unwrap();
    world.add_obstacle(Obstacle::Circle { center: origin + DVec2::new(-4.0, 2.0), radius: 0.7 }).unwrap();
    let values = (0..49).map(|_| number(&mut draw, 0.0, 1.5)).collect();
    let map = Map::new(DVec2::splat(-6.0), 2.0, 7, values).unwrap();
    let away = |place: Vec3, _: f64| if place.x > -1.0 { place.normalize_or_zero() } else { Vec3::ZERO };
    let star = world.add_group(Group { name: "star".into(), ..Group::default() }).unwrap();
    let looks: Option<Arc<dyn Field>> = Some(Arc::new(|place: Vec3, _: f64| -place));
    let about = Interaction { looks, weight: 2.0, carried: 0.6, reach: 4.0, ..Interaction::new(star.index(), away) };
    let second = Interaction { carried: -0.3, ..Interaction::new(star.index(), drift) };
    let led = Governed { map: Some(Arc::new(map)), around: vec![about, second], ..Governed::new(drift, 0.8) };
    let terrain = Terrain::of_place(world.place(), origin, survey(0.4, 0.2)).unwrap();
    let flow = ToGoal::new(Arc::new(terrain), vec![point(5.0, -4.0)], 1.2).unwrap();
    let jams = Governed::new(RoundJams { interval: 0.35, ..RoundJams::new(flow) }, 0.9);
    let mut groups = vec![star];
    for field in [led, jams, Governed::new(Uniform(Vec3::new(-1.0, 0.1, 0.0)), 0.45)] {
        groups.push(
            world.add_group(Group { origin, guidance: Guidance::JOURNEY.governed(field), ..Group::default() }).unwrap(),
        );
    }
    let stops = [DVec2::new(6.0, 0.5), DVec2::new(-5.0, -5.0)].map(|at| {
        let goal = world.add_goal(Goal::Point { at: origin + at, tolerance: 0.3 }).unwrap();
        Stop { goal, wait: 0.0 }
    });
    let journeys = stops.map(|stop| world.add_journey(Journey { stops: vec![stop], repeat: false }).unwrap());
    for k in 0..30 {
        let position = origin + DVec2::new(f64::from(k % 6) * 1.1 - 2.5, f64::from(k / 6) * 1.1 - 2.5);
        let group = if k % 10 == 0 { groups[0] } else { groups[1 + draw.index(3)] };
        let governed = number(&mut draw, 0.3, 1.0);
        let journey = journeys[usize::from(k % 4 == 0)];
        world
            .add_agent(Agent { position: position.extend(0.0), group, journey, governed, ..Agent::default() })
            .unwrap();
    }
    for _ in 0..80 {
        world.step();
        results.add("crowds that fields govern", &world.state_hash());
    }
}

/// Refused settings at the limits, and the errors.
fn refused(results: &mut Results) {
    let mut add = |what: Result<(), Error>| results.add("refused", &what);
    let (one, plain) = (Anchor::new(DVec2::ONE, DVec2::X), Sketch::default());
    for stretch in [0.99, 1.0, 100.0, 100.1] {
        let kernel = Kernel::Wendland { reach: 1.0 };
        add(Anchors::new(&[Anchor { stretch, ..one }], Sketch { kernel, ..plain }).map(drop));
        add(Anchors::new(&[Anchor { stretch, ..one }], plain).map(drop));
    }
    for count in [4000, 4001] {
        add(Anchors::new(&vec![one; count], plain).map(drop));
        add(AnchorsInSpace::new(&vec![(DVec3::ONE, DVec3::X); count], plain).map(drop));
    }
    let out = |v: f64| [0.0, 0.5, 1.0, 1.1, f64::INFINITY].map(|limit| limit * v);
    let low = DVec2::ZERO;
    for value in out(1.0).into_iter().chain(out(-1.0)) {
        let single = value as f32;
        for sketch in [
            Sketch { smoothing: value, ..plain },
            Sketch { fade: Some(value), ..plain },
            Sketch { max_speed: value, ..plain },
            Sketch { kernel: Kernel::Wendland { reach: value }, ..plain },
        ] {
            add(Anchors::new(&[one], sketch).map(drop));
        }
        add(Stroke { points: vec![low, DVec2::X], spacing: value, ..Stroke::default() }.anchors().map(drop));
        add(Stroke { points: vec![low, DVec2::X * value], ..Stroke::default() }.anchors().map(drop));
        add(Stamp { place: low, kind: Critical::Sink, radius: value, speed: 1.0 }.anchors().map(drop));
        let mut field = Sampled::over(low, DVec2::ONE, 0.5).unwrap();
        for brush in [
            Brush { radius: value, ..Brush::default() },
            Brush { strength: value, ..Brush::default() },
            Brush { hardness: value, ..Brush::default() },
        ] {
            add(field.paint(&brush, &[low, DVec2::ONE], 1.0));
        }
        add(Sampled::over(low, DVec2::ONE, value).map(drop));
        add(Blend::new(vec![FieldPart::new(drift, single)]).map(drop));
        add(Sum::new(vec![FieldPart::new(drift, single)]).map(drop));
        add(AroundWalls::new(Arc::new(drift), Walls::default(), value).map(drop));
        let frame = |time: f64| (time, Arc::new(drift) as Arc<dyn Field>);
        add(Keyframes::new(vec![frame(0.0), frame(1.0)], Some(value)).map(drop));
        add(Keyframes::new(vec![frame(0.5), frame(value)], None).map(drop));
        for octave in [(single, 1.0, 1.0), (1.0, single, 1.0), (1.0, 1.0, single)] {
            let (length, period, speed) = octave;
            add(CurlNoise::new(Potential::Plane, &[Octave { length, period, speed }], 1).map(drop));
        }
        add(NoiseWall::new(Sphere::new(Vec3::ZERO, 1.0).unwrap(), single).map(drop));
        add(FadeOut::new(Sphere::new(Vec3::ZERO, 1.0).unwrap(), single).map(drop));
        let good = TerrainSettings { high: DVec2::splat(4.0), ..TerrainSettings::default() };
        for survey in [
            TerrainSettings { cell: value, ..good },
            TerrainSettings { radius: value, ..good },
            TerrainSettings { clearance: single, ..good },
            TerrainSettings { dearest: single, ..good },
            TerrainSettings { high: DVec2::new(value, 1.0), ..good },
        ] {
            add(Terrain::of(|_| false, survey).map(drop));
        }
        let ground = Arc::new(Terrain::of(|_| false, good).unwrap());
        let (at, wide) = (DVec2::ONE, Smoothing::default());
        for goal in [Destination::Point { at, tolerance: value }, Destination::Disc { center: at, radius: value }] {
            add(ToGoal::new(ground.clone(), vec![goal], 1.0).map(drop));
        }
        add(Density::of(&ground, [], value).map(drop));
        let flow = ToGoal::new(ground.clone(), vec![point(1.0, 1.0)], 1.0).unwrap();
        add(ToGoal::new(ground, vec![point(1.0, 1.0)], single).map(drop));
        add(flow.clone().slowing(single).map(drop));
        add(flow.with_density(&vec![single; flow.lengths().len()], 1.0).map(drop));
        for jams in [
            RoundJams { weary: single, ..RoundJams::new(flow.clone()) },
            RoundJams { radius: value, ..RoundJams::new(flow.clone()) },
            RoundJams { interval: value, ..RoundJams::new(flow.clone()) },
            RoundJams { part: single, ..RoundJams::new(flow.clone()) },
        ] {
            add(jams.check());
        }
        let good = VoxelSettings { high: Vec3::splat(2.0), cell: 0.5, ..VoxelSettings::default() };
        for scan in [
            VoxelSettings { cell: single, ..good },
            VoxelSettings { radius: single, ..good },
            VoxelSettings { clearance: single, ..good },
            VoxelSettings { dearest: single, ..good },
            VoxelSettings { high: Vec3::new(1.0, single, 1.0), ..good },
        ] {
            add(Voxels::of(&[], scan).map(drop));
        }
        let space = Arc::new(Voxels::of(&[], good).unwrap());
        add(SwarmGuide::new(space.clone(), Vec3::ONE, single, 1.0).map(drop));
        add(SwarmGuide::new(space.clone(), Vec3::ONE, 1.0, single).map(drop));
        let guide = SwarmGuide::new(space, Vec3::ONE, 0.1, 1.0).unwrap();
        for smoothing in [
            Smoothing { spacing: single, ..wide },
            Smoothing { stiffness: single, ..wide },
            Smoothing { tension: single, ..wide },
            Smoothing { keep_off: single, ..wide },
            Smoothing { distance: single, ..wide },
            Smoothing { rounds: if value < 1.0 { 10_000 } else { 10_001 }, ..wide },
        ] {
            add(guide.spine(Vec3::splat(0.3), smoothing).map(drop));
        }
        let spine = guide.spine(Vec3::splat(0.3), wide).unwrap();
        for tube in [Tube { radius: single, pull: 1.0 }, Tube { radius: 1.0, pull: single }] {
            add(guide.clone().along(spine.clone(), tube).map(drop));
        }
        let about = Interaction::new(0, drift);
        for field in [
            Governed::new(drift, single),
            Governed { around: vec![Interaction { weight: single, ..about.clone() }], ..Governed::new(drift, 1.0) },
            Governed { around: vec![Interaction { carried: single, ..about.clone() }], ..Governed::new(drift, 1.0) },
            Governed { around: vec![Interaction { reach: single, ..about }], ..Governed::new(drift, 1.0) },
        ] {
            let mut world = World::new(Settings::default()).unwrap();
            add(world.add_group(Group { guidance: Guidance::JOURNEY.governed(field), ..Group::default() }).map(drop));
        }
    }
    let many = DVec2::splat(100.0);
    add(Sampled::over(low, many, 1e-6).map(drop));
    add(Terrain::of(|_| false, TerrainSettings { high: many, cell: 1e-6, ..TerrainSettings::default() }).map(drop));
    add(Voxels::of(&[], VoxelSettings { high: Vec3::splat(100.0), cell: 1e-4, ..VoxelSettings::default() }).map(drop));
    for (columns, count) in [(1, 4), (2, 2), (2, 4), (3, 7), (3, 9)] {
        add(Map::new(low, 1.0, columns, vec![1.0; count]).map(drop));
    }
    for count in [0, 1, 16, 17] {
        add(CurlNoise::new(Potential::Plane, &vec![Octave { length: 1.0, period: 1.0, speed: 1.0 }; count], 1)
            .map(drop));
    }
}

#[test]
fn what_fields_say_is_as_kept() {
    let mut results = Results::default();
    anchors(&mut results);
    anchors_in_space(&mut results);
    drawn(&mut results);
    for (name, field) in combined() {
        ask(&mut results, name, &field);
    }
    grids(&mut results);
    critical(&mut results);
    noises(&mut results);
    flows(&mut results);
    guides(&mut results);
    crowds(&mut results);
    refused(&mut results);
    results.assert_kept("all/kept.txt");
}

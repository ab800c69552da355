//! Shortest paths, compared with the visibility graph, with their reverse, and with another implementation.

use crate::navigation::oracle::{Dice, Scene, VisibilityGraph, clearance, leaves_by, shoelace};
use glam::DVec2;
use polyanya::Coords;
use throng::navigate::{NavMesh, Path, PathSearch, Unreachable};

fn legs(path: &Path) -> Vec<[DVec2; 2]> {
    std::iter::once(path.start)
        .chain(path.corners.iter().copied())
        .collect::<Vec<_>>()
        .array_windows()
        .copied()
        .collect()
}

#[test]
fn paths_are_as_short_as_in_the_visibility_graph_and_the_same_backwards() {
    let mut search = PathSearch::new();
    let (mut compared, mut bent) = (0, 0);
    for seed in 0..60 {
        let scene = Scene::random(seed);
        let mesh = scene.mesh(0.15 + 0.05 * (seed % 3) as f64);
        let graph = VisibilityGraph::new(mesh.outline());
        let mut rng = Dice(seed + 1000);
        for round in 0..20 {
            let mut from = scene.free_point(&mesh, &mut rng);
            let mut to = scene.free_point(&mesh, &mut rng);
            if round >= 10 {
                from = mesh.vertices()[(rng.unit() * mesh.vertices().len() as f64) as usize];
            }
            if round >= 15 {
                to = mesh.vertices()[(rng.unit() * mesh.vertices().len() as f64) as usize];
            }
            let there = mesh.path(&mut search, from, to);
            let back = mesh.path(&mut search, to, from);
            let expected = graph.distance(from, to);
            match (there, back) {
                (Ok(there), Ok(back)) => {
                    assert!(
                        (there.length - expected).abs() <= 1e-7 * expected.max(1.0),
                        "seed {seed}.{round} {from} -> {to}: {} instead of {expected}",
                        there.length
                    );
                    assert!((there.length - back.length).abs() <= 1e-9 * expected.max(1.0));
                    let sum: f64 = legs(&there).iter().map(|[a, b]| a.distance(*b)).sum();
                    assert!((sum - there.length).abs() < 1e-7);
                    for [a, b] in legs(&there) {
                        assert!(leaves_by(mesh.outline(), a, b) < 1e-7);
                        for k in 0..=20 {
                            let at = a.lerp(b, k as f64 / 20.0);
                            assert!(clearance(&scene.walkable, &scene.obstacles, at) >= mesh.radius() - 1e-6);
                        }
                    }
                    compared += 1;
                    bent += usize::from(there.corners.len() > 1);
                }
                (Err(Unreachable::NoWay { .. }), Err(Unreachable::NoWay { .. })) => assert!(expected.is_infinite()),
                other => panic!("seed {seed}: {other:?}"),
            }
        }
    }
    assert!(compared > 800 && bent > 300, "only {compared} compared, {bent} with corners");
}

#[test]
fn paths_of_many_are_as_short_as_in_the_visibility_graph() {
    let mut compared = 0;
    for seed in 0..60 {
        let scene = Scene::random(seed);
        let mesh = scene.mesh(0.15 + 0.05 * (seed % 3) as f64);
        let graph = VisibilityGraph::new(mesh.outline());
        let mut rng = Dice(seed + 1500);
        let mut place = |vertex: bool| match vertex {
            true => mesh.vertices()[(rng.unit() * mesh.vertices().len() as f64) as usize],
            false => scene.free_point(&mesh, &mut rng),
        };
        for round in 0..3 {
            let to = place(round == 2);
            let from: Vec<DVec2> = (0..16).map(|k| place(k >= 10)).collect();
            let paths = mesh.paths(&from, to);
            for (k, path) in paths.iter().enumerate() {
                let expected = graph.distance(from[k], to);
                let Ok(path) = path else {
                    assert!(expected.is_infinite(), "seed {seed}: {path:?}");
                    continue;
                };
                let label = || format!("seed {seed}.{round} {} -> {to}: {} {expected}", from[k], path.length);
                assert!((path.length - expected).abs() <= 1e-7 * expected.max(1.0), "{}", label());
                let sum: f64 = legs(path).iter().map(|[a, b]| a.distance(*b)).sum();
                assert!((sum - path.length).abs() < 1e-7, "{}", label());
                assert!(legs(path).iter().all(|&[a, b]| leaves_by(mesh.outline(), a, b) < 1e-7), "{}", label());
                compared += 1;
            }
            // the result does not depend on the order of the starts
            let backwards: Vec<DVec2> = from.iter().rev().copied().collect();
            assert!(mesh.paths(&backwards, to).into_iter().rev().eq(paths.iter().cloned()));
            for (k, path) in paths.into_iter().enumerate() {
                assert_eq!(mesh.paths(&from[k..=k], to), [path]);
            }
        }
    }
    assert!(compared > 2000, "only {compared} compared");
}

#[test]
fn paths_on_lattices_of_aligned_blocks_are_shortest_too() {
    // Rows of equal blocks: lines of sight graze many corners at once.
    let mut obstacles = Vec::new();
    for x in 0..4 {
        for y in 0..4 {
            let at = DVec2::new(2.0 + 2.0 * x as f64, 2.0 + 2.0 * y as f64);
            obstacles.push(throng::Obstacle::rectangle(at, DVec2::splat(1.0), 0.0));
        }
    }
    let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(DVec2::from);
    let hall = throng::Walkable { outer: corners.to_vec(), holes: vec![] };
    let mesh = NavMesh::build(&[hall], &obstacles, 0.25, (DVec2::ZERO, DVec2::ZERO)).unwrap();
    let graph = VisibilityGraph::new(mesh.outline());
    let mut search = PathSearch::new();
    let mut rng = Dice(5);
    let grid: Vec<DVec2> =
        (0..36).map(|k| DVec2::new(1.0 + 1.6 * (k % 6) as f64, 1.0 + 1.6 * (k / 6) as f64)).collect();
    for round in 0..120 {
        let mut pick = || match round % 3 {
            0 => mesh.vertices()[(rng.unit() * mesh.vertices().len() as f64) as usize],
            1 => mesh.nearest(grid[(rng.unit() * 36.0) as usize]),
            _ => DVec2::new(1.0 + 2.0 * (rng.unit() * 5.0).floor(), 1.0 + 2.0 * (rng.unit() * 5.0).floor()),
        };
        let (from, to) = (pick(), pick());
        let (found, expected) = (mesh.path(&mut search, from, to).unwrap().length, graph.distance(from, to));
        assert!((found - expected).abs() < 1e-7, "{from} -> {to}: {found} instead of {expected}");
        let shared = mesh.paths(&[from], to)[0].clone().unwrap().length;
        assert!((shared - expected).abs() < 1e-7, "{from} -> {to}: {shared} instead of {expected}");
        assert!(search.expanded() < 5000, "{} nodes", search.expanded());
    }
}

#[test]
fn paths_agree_with_the_crate_polyanya() {
    let mut search = PathSearch::new();
    let mut compared = 0;
    for seed in (0..60).filter(|seed| seed % 3 == 0) {
        let scene = Scene::random(seed);
        let mesh = scene.mesh(0.2);
        let outers: Vec<_> = mesh.outline().iter().filter(|ring| shoelace(std::slice::from_ref(ring)) > 0.0).collect();
        if outers.len() != 1 {
            continue;
        }
        // The crate polyanya uses another version of the vector crate.
        let single = |at: &DVec2| [at.x as f32, at.y as f32];
        let outer: Vec<_> = outers[0].iter().map(|at| single(at).into()).collect();
        let mut theirs = polyanya::Triangulation::from_outer_edges(&outer);
        for hole in mesh.outline().iter().filter(|ring| shoelace(std::slice::from_ref(ring)) < 0.0) {
            theirs.add_obstacle(hole.iter().map(|at| single(at).into()).collect::<Vec<_>>());
        }
        let theirs = theirs.as_navmesh();
        let place = |at: DVec2| Coords::on_mesh(single(&at).into());
        let mut rng = Dice(seed + 2000);
        for _ in 0..20 {
            let (from, to) = (scene.free_point(&mesh, &mut rng), scene.free_point(&mesh, &mut rng));
            let Some(their) = theirs.path(place(from), place(to)) else { continue };
            let ours = mesh.path(&mut search, from, to).unwrap().length;
            assert!((ours - f64::from(their.length)).abs() < 2e-4 * ours.max(1.0), "{ours} {}", their.length);
            compared += 1;
        }
    }
    assert!(compared > 100, "only {compared} compared");
}

#[test]
fn paths_to_areas_end_at_the_nearest_point_along_the_path() {
    let mut search = PathSearch::new();
    let mut compared = 0;
    for seed in 0..30 {
        let scene = Scene::random(seed);
        let mesh = scene.mesh(0.2);
        let mut rng = Dice(seed + 3000);
        for _ in 0..4 {
            let at = scene.point(&mut rng);
            let corners = [(-0.8, -0.6), (0.9, -0.4), (0.1, 0.0), (0.7, 0.8)].map(|(x, y)| at + DVec2::new(x, y));
            let area = mesh.area(&corners).unwrap();
            let from = scene.free_point(&mesh, &mut rng);
            if area.is_empty() || area.gap() > 0.0 {
                continue;
            }
            let shared = mesh.paths_to(&[from, scene.free_point(&mesh, &mut rng), from], &area);
            assert_eq!(shared[0], shared[2]);
            let Ok(path) = mesh.path_to(&mut search, from, &area) else {
                assert!(shared[0].is_err() && !area.islands().contains(&mesh.island(from).unwrap()));
                continue;
            };
            let length = shared[0].as_ref().unwrap().length;
            assert!((length - path.length).abs() < 1e-7, "seed {seed}: {length} instead of {}", path.length);
            let end = *path.corners.last().unwrap();
            assert!(mesh.locate(end).is_some());
            assert!((mesh.path(&mut search, from, end).unwrap().length - path.length).abs() < 1e-7);
            assert!(area.nearest(end).unwrap().distance(end) < 1e-6);
            // No point of the area is nearer.
            for x in 0..30 {
                for y in 0..30 {
                    let other = at + DVec2::new(-0.8 + 0.06 * x as f64, -0.6 + 0.05 * y as f64);
                    if area.nearest(other).unwrap().distance(other) < 1e-9 {
                        let length = mesh.path(&mut search, from, other).map_or(f64::INFINITY, |path| path.length);
                        assert!(
                            length > path.length - 1e-7,
                            "seed {seed}: {other} is at {length}, not {}",
                            path.length
                        );
                    }
                }
            }
            compared += 1;
        }
    }
    assert!(compared > 50, "only {compared} compared");
}

#[test]
fn an_exit_at_a_wall_is_used_over_its_whole_width() {
    let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)].map(DVec2::from);
    let hall = throng::Walkable { outer: corners.to_vec(), holes: vec![] };
    let mesh = NavMesh::build(&[hall], &[], 0.25, (DVec2::ZERO, DVec2::ZERO)).unwrap();
    let mut search = PathSearch::new();
    for (depth, gap) in [(0.2, 0.05), (0.1, 0.15), (0.5, 0.0), (-0.005, 0.255)] {
        let exit = [(10.3, 1.0), (10.3, 5.0), (10.0 - depth, 5.0), (10.0 - depth, 1.0)].map(DVec2::from);
        let area = mesh.area(&exit).unwrap();
        assert!((area.gap() - gap).abs() < 1e-5, "{} {gap}", area.gap());
        for y in [1.2, 2.0, 3.5, 4.8] {
            let end = *mesh.path_to(&mut search, DVec2::new(2.0, y), &area).unwrap().corners.last().unwrap();
            assert!((end.y - y).abs() < 1e-9 && end.x > 10.0 - depth.max(0.26), "{end} {y}");
        }
    }
    let off = [(10.3, 1.0), (10.5, 1.0), (10.5, 5.0), (10.3, 5.0)].map(DVec2::from);
    let area = mesh.area(&off).unwrap();
    assert!(area.is_empty());
    assert!(matches!(mesh.path_to(&mut search, DVec2::ONE, &area), Err(Unreachable::GoalInWall { .. })));
}

#[test]
fn an_agent_inside_the_area_is_there() {
    let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)].map(DVec2::from);
    let hall = throng::Walkable { outer: corners.to_vec(), holes: vec![] };
    let mesh = NavMesh::build(&[hall], &[], 0.25, (DVec2::ZERO, DVec2::ZERO)).unwrap();
    let area = mesh.area(&[(2.0, 2.0), (4.0, 2.0), (4.0, 4.0), (2.0, 4.0)].map(DVec2::from)).unwrap();
    let path = mesh.path_to(&mut PathSearch::new(), DVec2::new(3.0, 3.2), &area).unwrap();
    assert!(path.length < 1e-12 && path.corners == [DVec2::new(3.0, 3.2)]);
}

#[test]
fn a_search_that_was_used_before_finds_the_same_bits() {
    let scenes = [Scene::random(3), Scene::random(8)];
    let meshes = scenes.each_ref().map(|scene| scene.mesh(0.2));
    let mut used = PathSearch::new();
    for round in 0..50 {
        let (scene, mesh) = (&scenes[round % 2], &meshes[round % 2]);
        let mut rng = Dice(round as u64);
        let (from, to) = (scene.free_point(mesh, &mut rng), scene.free_point(mesh, &mut rng));
        assert_eq!(mesh.path(&mut used, from, to), mesh.path(&mut PathSearch::new(), from, to));
    }
}

//! Real floor plans.

use crate::area::shoelace;
use crate::oracle::{Dice, VisibilityGraph, clearance};
use crate::outside::data;
use glam::DVec2;
use throng::Walkable;
use throng::navigate::{NavMesh, PathSearch};
use wkt::Wkt;

/// Returns the plans.
fn plans() -> Vec<(String, Vec<Walkable>)> {
    let entries = std::fs::read_dir(data("geometry")).unwrap();
    let mut files: Vec<_> = entries.filter_map(|entry| entry.ok().map(|entry| entry.path())).collect();
    files.retain(|file| file.extension().is_some_and(|ending| ending == "wkt"));
    files.sort();
    let mut plans = Vec::new();
    for file in files {
        let parsed: Wkt<f64> = std::fs::read_to_string(&file).unwrap().parse().unwrap();
        let mut areas = Vec::new();
        collect(&parsed, &mut areas);
        plans.push((file.file_stem().unwrap().to_string_lossy().into_owned(), areas));
    }
    plans
}

fn collect(geometry: &Wkt<f64>, areas: &mut Vec<Walkable>) {
    match geometry {
        Wkt::Polygon(polygon) => {
            let mut rings = polygon
                .rings()
                .iter()
                .map(|ring| ring.coords().iter().map(|at| DVec2::new(at.x, at.y)).collect::<Vec<_>>());
            if let Some(outer) = rings.next() {
                areas.push(Walkable { outer, holes: rings.collect() });
            }
        }
        Wkt::GeometryCollection(parts) => parts.geometries().iter().for_each(|part| collect(part, areas)),
        Wkt::MultiPolygon(parts) => {
            parts.polygons().iter().for_each(|part| collect(&Wkt::Polygon(part.clone()), areas));
        }
        _ => {}
    }
}

pub fn all_floor_plans_mesh_and_their_paths_keep_clear_of_walls() {
    let plans = plans();
    let mut search = PathSearch::new();
    for (name, areas) in &plans {
        for radius in [0.1, 0.2, 0.25, 0.3, 0.4] {
            let mesh = match NavMesh::build(areas, &[], radius, (DVec2::ZERO, DVec2::ZERO)) {
                Ok(mesh) => mesh,
                Err(error) => {
                    assert!(name == "narrow_passage" && radius == 0.4, "{name}, {radius}: {error}");
                    continue;
                }
            };
            let (triangles, outline) = (mesh.area_size(), shoelace(mesh.outline()));
            assert!((triangles - outline).abs() < 1e-8 * outline, "{name}: {triangles} {outline}");
            if areas.len() == 1 {
                for &vertex in mesh.vertices() {
                    assert!(clearance(areas, &[], vertex) >= radius - 1e-6, "{name} {radius} {vertex}");
                }
            }
            let mut rng = Dice(11);
            for _ in 0..30 {
                let pick = |rng: &mut Dice| mesh.vertices()[(rng.unit() * mesh.vertices().len() as f64) as usize];
                let (from, to) = (pick(&mut rng), pick(&mut rng));
                let there = mesh.path(&mut search, from, to);
                assert_eq!(there.is_ok(), mesh.island(from) == mesh.island(to), "{name} {radius} {from} {to}");
                let Ok(there) = there else { continue };
                let shared = mesh.paths(&[from], to)[0].clone().unwrap();
                assert!((there.length - shared.length).abs() <= 1e-7 * there.length.max(1.0), "{name} {from} {to}");
                let back = mesh.path(&mut search, to, from).unwrap();
                assert!((there.length - back.length).abs() <= 1e-7 * there.length.max(1.0), "{name} {from} {to}");
                let mut before = from;
                for &corner in &there.corners {
                    assert!(mesh.visible(before, corner), "{name} {radius}: {before} {corner}");
                    before = corner;
                }
            }
        }
    }
    assert_eq!(plans.len(), 11);
}

pub fn paths_in_small_floor_plans_are_as_short_as_in_the_visibility_graph() {
    let mut search = PathSearch::new();
    for (name, mut areas) in plans() {
        let origin = areas[0].outer[0];
        let rings = areas.iter_mut().flat_map(|area| std::iter::once(&mut area.outer).chain(&mut area.holes));
        rings.flatten().for_each(|at| *at -= origin);
        let mesh = NavMesh::build(&areas, &[], 0.25, (DVec2::ZERO, DVec2::ZERO)).unwrap();
        if mesh.vertices().len() > 500 {
            continue;
        }
        let graph = VisibilityGraph::new(mesh.outline());
        let mut rng = Dice(17);
        for _ in 0..20 {
            let mut pick = || {
                let corners = mesh.triangles()[(rng.unit() * mesh.triangles().len() as f64) as usize];
                let [a, b, c] = corners.map(|vertex| mesh.vertices()[vertex as usize]);
                a.lerp(b, rng.unit()).lerp(c, rng.unit())
            };
            let (from, to) = (pick(), pick());
            let expected = graph.distance(from, to);
            match mesh.path(&mut search, from, to) {
                Ok(path) => assert!((path.length - expected).abs() <= 1e-7 * expected.max(1.0), "{name} {from} {to}"),
                Err(error) => assert!(expected.is_infinite(), "{name}: {error}"),
            }
        }
    }
}

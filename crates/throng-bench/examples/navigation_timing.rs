//! Times meshes and paths on a floor plan in WKT: `navigation_timing PLAN.wkt [RADIUS]`.

#![allow(clippy::print_stdout)]

use glam::DVec2;
use std::time::Instant;
use throng::Walkable;
use throng::navigate::{NavMesh, PathSearch, Route};
use wkt::Wkt;

fn collect(geometry: &Wkt<f64>, areas: &mut Vec<Walkable>) {
    match geometry {
        Wkt::Polygon(polygon) => {
            let ring = |ring: &wkt::types::LineString<f64>| -> Vec<DVec2> {
                ring.coords().iter().map(|at| DVec2::new(at.x, at.y)).collect()
            };
            if let Some((outer, holes)) = polygon.rings().split_first() {
                areas.push(Walkable { outer: ring(outer), holes: holes.iter().map(ring).collect() });
            }
        }
        Wkt::GeometryCollection(parts) => parts.geometries().iter().for_each(|part| collect(part, areas)),
        _ => {}
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let plan: Wkt<f64> = std::fs::read_to_string(arguments.next().ok_or("which plan?")?)?.parse()?;
    let radius = arguments.next().map_or(Ok(0.2), |text| text.parse())?;
    let mut areas = Vec::new();
    collect(&plan, &mut areas);

    let clock = Instant::now();
    let mesh = NavMesh::build(&areas, &[], radius, (DVec2::ZERO, DVec2::ZERO))?;
    println!(
        "mesh: {:?}; {} vertices, {} triangles, {} islands, {:.1} m2",
        clock.elapsed(),
        mesh.vertices().len(),
        mesh.triangles().len(),
        mesh.island_count(),
        mesh.area_size()
    );

    // Centres of triangles, spread over the mesh by a step that is coprime to their number.
    let centre = |index: usize| {
        let [a, b, c] = mesh.triangles()[index % mesh.triangles().len()].map(|vertex| mesh.vertices()[vertex as usize]);
        (a + b + c) / 3.0
    };
    let pairs: Vec<_> = (0..500).map(|k| (centre(k * 7919), centre(k * 104_729 + 17))).collect();
    let mut search = PathSearch::new();
    let mut paths = Vec::new();
    for _ in 0..2 {
        paths.clear();
        let mut expanded = 0_u64;
        let clock = Instant::now();
        for &(from, to) in &pairs {
            paths.extend(mesh.path(&mut search, from, to));
            expanded += u64::from(search.expanded());
        }
        println!(
            "500 paths: {:?}; {} found, {:.1} m and {:.1} corners on average, {expanded} nodes",
            clock.elapsed(),
            paths.len(),
            paths.iter().map(|path| path.length).sum::<f64>() / paths.len() as f64,
            paths.iter().map(|path| path.corners.len()).sum::<usize>() as f64 / paths.len() as f64,
        );
    }

    let (starts, exit) = (pairs.iter().map(|pair| pair.0).collect::<Vec<_>>(), pairs[0].1);
    for count in [1, 10, 500] {
        let clock = Instant::now();
        let found = mesh.paths(&starts[..count], exit).iter().filter(|path| path.is_ok()).count();
        println!("{count} paths to one point: {:?}; {found} found", clock.elapsed());
    }

    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| exit + DVec2::new(x, y));
    let clock = Instant::now();
    let area = mesh.area(&corners)?;
    let cut = clock.elapsed();
    let clock = Instant::now();
    let found = pairs.iter().filter(|pair| mesh.path_to(&mut search, pair.0, &area).is_ok()).count();
    println!("500 paths to an area: {:?}; {found} found; cutting it took {cut:?}", clock.elapsed());
    let clock = Instant::now();
    let found = mesh.paths_to(&starts, &area).iter().filter(|path| path.is_ok()).count();
    println!("the same together: {:?}; {found} found", clock.elapsed());

    let clock = Instant::now();
    let seen = pairs.iter().cycle().take(50_000).filter(|(a, b)| mesh.visible(*a, a.lerp(*b, 0.05))).count();
    println!("50 000 sights: {:?}; {seen} clear", clock.elapsed());

    let mut routes: Vec<_> = paths.iter().map(|path| (path.start, Route::new(path))).collect();
    let clock = Instant::now();
    let mut steps = 0;
    for _ in 0..200 {
        for (at, route) in &mut routes {
            use throng::navigate::Heading::{Corner, End};
            if let Corner(aim) | End(aim) = route.advance(&mesh, *at) {
                *at += (aim - *at).clamp_length_max(0.025);
                steps += 1;
            }
        }
    }
    println!("{steps} steps of followers: {:?}", clock.elapsed());
    Ok(())
}

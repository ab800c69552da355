//! The place as WKT (well-known text): writes and reads it.
//!
//! The walkable area is a `MULTIPOLYGON`. The obstacles are a `GEOMETRYCOLLECTION` of `POLYGON`s and, for thin walls,
//! `LINESTRING`s. WKT has no circles: a circle becomes a polygon of 64 corners. Its sides are within 0.13 % of the
//! radius of the arc.

use glam::DVec2;
use std::f64::consts::TAU;
use throng::{Obstacle, Walkable};
use throng_scene::import::wkt::parse;
use wkt::Wkt;
use wkt::types::{Coord, Dimension, GeometryCollection, LineString, MultiPolygon, Polygon};

/// Corners of a circle.
const CORNERS: u32 = 64;

/// Returns the walkable areas as WKT.
pub(super) fn ground(areas: &[Walkable]) -> String {
    let polygons = areas.iter().map(polygon).collect();
    Wkt::MultiPolygon(MultiPolygon::new(polygons, Dimension::XY)).to_string()
}

/// Returns the obstacles as WKT.
pub(super) fn solid(obstacles: &[Obstacle]) -> String {
    let geometry = |obstacle: &Obstacle| match obstacle {
        Obstacle::Wall { points } => Wkt::LineString(line(points.iter().copied())),
        closed => Wkt::Polygon(Polygon::new(vec![ring(&corners(closed))], Dimension::XY)),
    };
    let solids = obstacles.iter().map(geometry).collect();
    Wkt::GeometryCollection(GeometryCollection::new(solids, Dimension::XY)).to_string()
}

/// Returns the corners of an obstacle, or the points of a wall.
pub(super) fn corners(obstacle: &Obstacle) -> Vec<DVec2> {
    match obstacle {
        Obstacle::Circle { center, radius } => {
            let at = |k: u32| DVec2::from_angle(TAU * f64::from(k) / f64::from(CORNERS));
            (0..CORNERS).map(|k| center + radius * at(k)).collect()
        }
        Obstacle::Polygon { corners } => corners.clone(),
        Obstacle::Wall { points } => points.clone(),
    }
}

fn polygon(area: &Walkable) -> Polygon<f64> {
    let rings = std::iter::once(&area.outer).chain(&area.holes);
    Polygon::new(rings.map(|corners| ring(corners)).collect(), Dimension::XY)
}

/// Returns a closed line: WKT repeats the first corner.
fn ring(corners: &[DVec2]) -> LineString<f64> {
    line(corners.iter().chain(corners.first()).copied())
}

fn line(points: impl Iterator<Item = DVec2>) -> LineString<f64> {
    LineString::new(points.map(|p| Coord { x: p.x, y: p.y, z: None, m: None }).collect(), Dimension::XY)
}

/// Reads polygons as walkable areas and lines as walls, also within collections. Other geometries are ignored.
///
/// # Errors
/// The text is not WKT, or a coordinate is not finite.
pub(super) fn read(text: &str) -> Result<(Vec<Walkable>, Vec<Obstacle>), String> {
    let parsed = parse(text).map_err(|error| error.message)?;
    let (mut areas, mut walls) = (Vec::new(), Vec::new());
    collect(&parsed, &mut areas, &mut walls);
    let points = areas.iter().flat_map(|area: &Walkable| area.outer.iter().chain(area.holes.iter().flatten()));
    let points = points.chain(walls.iter().flat_map(|wall| match wall {
        Obstacle::Wall { points } => points.as_slice(),
        _ => &[],
    }));
    match points.copied().find(|p| !p.is_finite()) {
        Some(p) => Err(format!("the geometry has the coordinates {} {}", p.x, p.y)),
        None => Ok((areas, walls)),
    }
}

/// Reads the obstacles of WKT that [`solid`] wrote.
///
/// # Errors
/// As [`read`].
pub(super) fn read_solid(text: &str) -> Result<Vec<Obstacle>, String> {
    let (areas, walls) = read(text)?;
    Ok(areas.into_iter().map(|area| Obstacle::Polygon { corners: area.outer }).chain(walls).collect())
}

fn collect(geometry: &Wkt<f64>, areas: &mut Vec<Walkable>, walls: &mut Vec<Obstacle>) {
    match geometry {
        Wkt::Polygon(polygon) => areas.extend(area(polygon)),
        Wkt::MultiPolygon(many) => areas.extend(many.polygons().iter().filter_map(area)),
        Wkt::LineString(line) => walls.push(Obstacle::Wall { points: places(line) }),
        Wkt::GeometryCollection(many) => many.geometries().iter().for_each(|one| collect(one, areas, walls)),
        _ => {}
    }
}

fn area(polygon: &Polygon<f64>) -> Option<Walkable> {
    let mut rings = polygon.rings().iter().map(|ring| {
        let mut corners = places(ring);
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        corners
    });
    let outer = rings.next()?;
    Some(Walkable { outer, holes: rings.collect() })
}

fn places(line: &LineString<f64>) -> Vec<DVec2> {
    line.coords().iter().map(|c| DVec2::new(c.x, c.y)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn points(least: usize) -> impl Strategy<Value = Vec<DVec2>> {
        proptest::collection::vec((-1e6..1e6, -1e-3..1e3), least..9)
            .prop_map(|points| points.into_iter().map(|(x, y)| DVec2::new(x, y)).collect())
    }

    proptest! {
        #[test]
        fn ground_and_solids_come_back(
            ground_ in proptest::collection::vec((points(3), proptest::collection::vec(points(3), 0..3)), 0..4),
            solids in proptest::collection::vec(points(3), 0..4),
            walls in proptest::collection::vec(points(2), 0..4),
        ) {
            let areas: Vec<_> = ground_.into_iter().map(|(outer, holes)| Walkable { outer, holes }).collect();
            prop_assert_eq!(read(&ground(&areas)).unwrap(), (areas, vec![]));
            let solids = solids.into_iter().map(|corners| Obstacle::Polygon { corners });
            let obstacles: Vec<_> = solids.chain(walls.into_iter().map(|points| Obstacle::Wall { points })).collect();
            prop_assert_eq!(read_solid(&solid(&obstacles)).unwrap(), obstacles);
        }
    }

    #[test]
    fn a_circle_is_nearly_one() {
        let (center, radius) = (DVec2::new(3.0, -7.0), 2.0);
        let back = read_solid(&solid(&[Obstacle::Circle { center, radius }])).unwrap();
        let [Obstacle::Polygon { corners }] = &back[..] else { panic!("{back:?}") };
        assert_eq!(corners.len(), 64);
        for k in 0..64 {
            let middle = corners[k].midpoint(corners[(k + 1) % 64]);
            assert!((corners[k].distance(center) - radius).abs() < 1e-12);
            assert!((1.0 - middle.distance(center) / radius).abs() < 0.0013);
        }
    }

    #[test]
    fn what_is_no_geometry_is_none() {
        assert!(read("no").is_err() && read("").is_err() && read(&"GEOMETRYCOLLECTION (".repeat(100)).is_err());
        assert!(read("POLYGON ((0 0, 1 0, 1e999 1, 0 0))").is_err());
        assert_eq!(read("POINT (1 2)").unwrap(), (vec![], vec![]));
        assert_eq!(read("MULTIPOLYGON EMPTY").unwrap(), (vec![], vec![]));
    }
}

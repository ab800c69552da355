//! Floor plans in WKT (well-known text): polygons with holes, metres.

use crate::error::{Error, Kind};
use crate::scene::{Area, Point};
use std::str::FromStr;
use wkt::Wkt;
use wkt::types::Polygon;

/// Maximum nesting depth of collections.
const DEEPEST: usize = 64;

const HINT: &str = "a floor plan is WKT text such as POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))";

/// Parses a WKT text of any kind, nested no more than 64 deep.
///
/// # Errors
/// The text is not WKT, or is nested deeper.
pub fn parse(text: &str) -> Result<Wkt<f64>, Error> {
    let wrong = |what: String| Error::new(Kind::Syntax, what).hint(HINT);
    let mut depth = 0usize;
    for byte in text.bytes() {
        match byte {
            b'(' => depth += 1,
            b')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST {
            return Err(wrong(format!("this WKT is nested more than {DEEPEST} deep")));
        }
    }
    Wkt::from_str(text.trim()).map_err(|error| wrong(format!("this is not WKT: {error}")))
}

/// Reads all polygons of a WKT text: POLYGON, MULTIPOLYGON, and GEOMETRYCOLLECTIONs of them, nested or not. Points and
/// lines are left out.
///
/// # Errors
/// The text is not WKT, has no polygons, or a coordinate is not finite.
pub fn areas(text: &str) -> Result<Vec<Area>, Error> {
    let parsed = parse(text)?;
    let mut out = vec![];
    collect(&parsed, &mut out);
    if out.is_empty() {
        return Err(Error::new(Kind::Geometry, "this WKT has no polygon").hint(HINT));
    }
    let points = out.iter().flat_map(|area| area.holes.iter().flatten().chain(&area.outer));
    if let Some([x, y]) = points.into_iter().find(|p| !p.iter().all(|x| x.is_finite())) {
        return Err(Error::new(Kind::OutOfRange, format!("this WKT has the coordinates {x} {y}")));
    }
    Ok(out)
}

fn collect(geometry: &Wkt<f64>, out: &mut Vec<Area>) {
    match geometry {
        Wkt::Polygon(polygon) => out.extend(area(polygon)),
        Wkt::MultiPolygon(many) => out.extend(many.polygons().iter().filter_map(area)),
        Wkt::GeometryCollection(many) => many.geometries().iter().for_each(|geometry| collect(geometry, out)),
        _ => {}
    }
}

fn area(polygon: &Polygon<f64>) -> Option<Area> {
    let ring = |i: usize| -> Vec<Point> {
        let mut ring: Vec<Point> = polygon.rings()[i].coords().iter().map(|c| [c.x, c.y]).collect();
        if ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        // drop repeated corners
        ring.dedup();
        ring
    };
    let rings = polygon.rings().len();
    (rings > 0).then(|| Area { outer: ring(0), holes: (1..rings).map(ring).filter(|hole| hole.len() > 2).collect() })
}

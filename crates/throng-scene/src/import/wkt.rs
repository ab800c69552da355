//! Floor plans in WKT (well-known text): polygons with holes, metres.

use crate::build::has_room;
use crate::error::{Error, Kind};
use crate::geometry::{Solid, bounds, points, rectangle};
use crate::scene::{Area, Goal, Group, Place, Point, Rectangle, Region, Scene, Walkable, WalkablePlace};
use std::path::Path;
use std::str::FromStr;
use wkt::Wkt;
use wkt::types::Polygon;

/// Collections may be nested this deep.
const DEEPEST: usize = 64;

const HINT: &str = "a floor plan is WKT text such as POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))";

/// A WKT text of any kind, nested no more than 64 deep.
///
/// # Errors
/// It is not WKT, or nested deeper.
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

/// All polygons of a WKT text: POLYGON, MULTIPOLYGON, and GEOMETRYCOLLECTIONs of them, nested or not. Points and
/// lines are left out.
///
/// # Errors
/// It is not WKT, has no polygons, or a coordinate is not finite.
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
        // Neighbouring corners at one place add nothing.
        ring.dedup();
        ring
    };
    let rings = polygon.rings().len();
    (rings > 0).then(|| Area { outer: ring(0), holes: (1..rings).map(ring).filter(|hole| hole.len() > 2).collect() })
}

/// A scene from a floor plan alone: people anywhere on it walk to an exit, a rectangle `[x, y, width, height]` with
/// its lower left corner at (x, y).
///
/// # Errors
/// The file cannot be read or is not WKT, or the exit is where nobody can stand.
pub fn evacuation(plan: impl AsRef<Path>, exit: [f64; 4], people: u64) -> Result<Scene, Error> {
    let plan = plan.as_ref();
    let shown = plan.display().to_string();
    let text = crate::file::read_text(plan)?;
    let mut areas = areas(&text).map_err(|error| error.file(shown.clone()))?;
    let [x, y, width, height] = exit;
    let region = Rectangle::between([x, y], [x + width, y + height]);
    reachable(&areas, &region).map_err(|error| error.file(shown))?;
    let walkable = if areas.len() == 1 { Walkable::Polygon(areas.remove(0)) } else { Walkable::Polygons(areas) };
    Ok(Scene {
        title: format!("{people} people leave {}", plan.file_stem().unwrap_or_default().to_string_lossy()),
        walkable: Some(walkable),
        groups: vec![Group {
            name: "people".into(),
            count: Some(people),
            place: Place::Walkable(WalkablePlace { gap: 0.05 }),
            goal: Some(Goal::Exit(Region::Rectangle(region))),
            ..Group::default()
        }],
        ..Scene::default()
    })
}

/// That a body of the usual size fits somewhere in an exit.
fn reachable(areas: &[Area], exit: &Rectangle) -> Result<(), Error> {
    let ground = |area: &Area| throng::Walkable {
        outer: points(&area.outer),
        holes: area.holes.iter().map(|hole| points(hole)).collect(),
    };
    let ground: Vec<_> = areas.iter().map(ground).collect();
    let usual = throng::Agent::default().radius;
    let radius = f64::from(usual);
    if has_room(&Solid::new(&ground, &[], radius), &rectangle(exit), radius) {
        return Ok(());
    }
    let reach = bounds(ground.iter().flat_map(|area| area.outer.iter().copied())).unwrap_or_default();
    let [low, high] = reach.map(|p| format!("({:.1}, {:.1})", p.x, p.y));
    let ([x, y], [width, height]) = (exit.center, exit.size);
    Err(Error::new(
        Kind::GoalInWall,
        format!(
            "the exit, {width} by {height} m round ({x}, {y}), has no room for a body of radius {usual} m on the \
             ground, which lies between {low} and {high}"
        ),
    )
    .hint("move it, or make it reach further in: it counts as entered when the body's centre is inside"))
}

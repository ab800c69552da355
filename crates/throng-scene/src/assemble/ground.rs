//! Ground and obstacles: converts those of a scene to those of the world.

use super::annulus;
use super::check::{check_points, check_rectangle};
#[cfg(feature = "plans")]
use super::limits::{Limit, check_some};
use crate::error::{Error, Kind};
use crate::file::{Path, Problem};
use crate::geometry::{DVec2, Solid, bounds, contains, crossing, points, rectangle, signed_area};
#[cfg(feature = "plans")]
use crate::import::plan;
use crate::import::plan::PlanGround;
use crate::scene::{Area, As, Obstacle, PlanFile, Point, Rectangle, Scene, Shape, Walkable};

/// An error in a value of the scene, or in a file that it names.
pub(super) enum GroundError {
    Problem(Problem),
    Error(Box<Error>),
}

impl From<Problem> for GroundError {
    fn from(problem: Problem) -> Self {
        Self::Problem(problem)
    }
}

/// Returns the walkable areas; none: everywhere. Adds notes about parts of a floor plan that are left out.
pub(super) fn areas(scene: &Scene, notes: &mut Vec<String>) -> Result<Vec<throng::Walkable>, GroundError> {
    let path = Path::of("walkable");
    let one = |path: &Path, area: &Area| -> Result<throng::Walkable, Problem> {
        check_points(&path.key("outer"), &area.outer)?;
        check_polygon(&path.key("outer"), &area.outer, "the ground")?;
        for (i, hole) in area.holes.iter().enumerate() {
            let path = path.key("holes").index(i);
            check_points(&path, hole)?;
            check_polygon(&path, hole, "the hole")?;
        }
        Ok(area.walkable())
    };
    match &scene.walkable {
        None => Ok(vec![]),
        Some(Walkable::Rectangle(r)) => {
            check_rectangle(&path.key("rectangle"), r)?;
            Ok(vec![throng::Walkable { outer: rectangle(r), holes: vec![] }])
        }
        Some(Walkable::Rectangles(all)) => {
            let path = path.key("rectangles");
            let one = |(i, r): (usize, &Rectangle)| {
                check_rectangle(&path.index(i), r)?;
                Ok(throng::Walkable { outer: rectangle(r), holes: vec![] })
            };
            let areas = all.iter().enumerate().map(one).collect::<Result<_, Problem>>()?;
            // as one ground: the edge of a rectangle inside another rectangle is not a wall
            let ground = throng::Walkable::union(areas);
            Ok(ground.map_err(|error| Problem::new(&path, Kind::Geometry, error.to_string()))?)
        }
        Some(Walkable::Ring(ring)) => {
            annulus::check_annulus(&path.key("ring"), ring)?;
            Ok(vec![annulus::ground(ring)])
        }
        Some(Walkable::Polygon(area)) => Ok(vec![one(&path.key("polygon"), area)?]),
        Some(Walkable::Polygons(areas)) => {
            let path = path.key("polygons");
            let areas: Result<Vec<_>, _> =
                areas.iter().enumerate().map(|(i, area)| one(&path.index(i), area)).collect();
            Ok(areas?)
        }
        Some(Walkable::File(plan)) => {
            let ground = in_file(scene, plan, &path.key("file"))?;
            notes.extend(ground.notes);
            Ok(ground.areas)
        }
    }
}

/// Returns the ground of a floor plan.
#[cfg(feature = "plans")]
fn in_file(scene: &Scene, said: &PlanFile, path: &Path) -> Result<PlanGround, GroundError> {
    check_some(&path.key("unit"), said.unit, Limit::Positive)?;
    let ask = plan::PlanOptions { unit: said.unit, level: said.level, ..plan::PlanOptions::default() };
    plan::ground(scene.origin.folder.join(&said.name), &ask).map_err(|error| match error.kind {
        Kind::File | Kind::NotAScene => {
            Problem { hint: error.hint, ..Problem::new(path, error.kind, error.message) }.into()
        }
        _ => GroundError::Error(Box::new(error)),
    })
}

/// Returns an error: the feature `plans` is off.
#[cfg(not(feature = "plans"))]
fn in_file(_: &Scene, said: &PlanFile, path: &Path) -> Result<PlanGround, GroundError> {
    let message = format!("{}: no files of floor plans are read here, such as in a web page", said.name);
    Err(Problem::new(path, Kind::File, message).hint("write the corners in the scene: walkable.polygons").into())
}

/// Checks that a polygon has three corners and an area, and does not cross itself.
pub(super) fn check_polygon(path: &Path, corners: &[Point], what: &str) -> Result<(), Problem> {
    let corners = points(corners);
    if corners.len() < 3 {
        let message = format!("{what} has {} corners", corners.len());
        return Err(Problem::new(path, Kind::Geometry, message).hint("a polygon has at least three corners"));
    }
    if let Some((at, first, second)) = crossing(&corners) {
        let n = corners.len();
        let edge = |i: usize| format!("{} to {}", show(corners[i]), show(corners[(i + 1) % n]));
        let message = format!(
            "{what} crosses itself at {}: the edge from {} and that from {}",
            show(at),
            edge(first),
            edge(second)
        );
        return Err(Problem::new(path, Kind::Geometry, message).hint("list the corners in order along the outline"));
    }
    if signed_area(&corners).abs() < 1e-9 {
        return Err(Problem::new(path, Kind::Geometry, format!("{what} has no area: its corners lie on one line")));
    }
    Ok(())
}

/// Returns the obstacles of a scene.
pub(super) fn obstacles(scene: &Scene) -> Result<Vec<throng::Obstacle>, Problem> {
    let all = scene.obstacles.iter().enumerate();
    all.map(|(i, said)| obstacle(said, &Path::of("obstacle").index(i), &obstacle_name(&said.name, i))).collect()
}

/// Returns an obstacle; `name` is its name in messages.
pub(super) fn obstacle(said: &Obstacle, path: &Path, name: &str) -> Result<throng::Obstacle, Problem> {
    if let Shape::Polygon(corners) = &said.shape {
        check_polygon(&path.key("shape").key("polygon"), corners, name)?;
    }
    Ok(solid(said))
}

/// Returns the solid form of an obstacle with a valid shape.
pub(super) fn solid(said: &Obstacle) -> throng::Obstacle {
    match said.solid_as {
        As::Shape => solid_shape(&said.shape),
        As::Circle => bounding_circle(&said.shape),
    }
}

/// Returns the solid form of a shape.
pub(crate) fn solid_shape(shape: &Shape) -> throng::Obstacle {
    match shape {
        Shape::Circle(circle) => {
            throng::Obstacle::Circle { center: DVec2::from_array(circle.center), radius: circle.radius }
        }
        Shape::Rectangle(r) => throng::Obstacle::Polygon { corners: rectangle(r) },
        Shape::Polygon(corners) => throng::Obstacle::Polygon { corners: points(corners) },
        Shape::Wall(corners) => {
            throng::Obstacle::Wall { points: corners.iter().map(|p| DVec2::from_array(*p)).collect() }
        }
    }
}

/// Returns the circle around the bounding box.
fn bounding_circle(shape: &Shape) -> throng::Obstacle {
    let (low, high) = match shape {
        Shape::Circle(_) => return solid_shape(shape),
        Shape::Rectangle(r) => {
            let (center, half) = (DVec2::from_array(r.center), DVec2::from_array(r.size) * 0.5);
            (center - half, center + half)
        }
        Shape::Polygon(corners) | Shape::Wall(corners) => match bounds(points(corners)) {
            Some([low, high]) => (low, high),
            None => return solid_shape(shape),
        },
    };
    throng::Obstacle::Circle { center: (low + high) * 0.5, radius: low.distance(high) * 0.5 }
}

/// Returns an obstacle's name in messages.
pub(super) fn obstacle_name(name: &str, position: usize) -> String {
    if name.is_empty() { format!("obstacle {}", position + 1) } else { format!("obstacle `{name}`") }
}

/// Whether a body fits somewhere in a polygon: tests a grid, and points between the centre and each corner.
pub(crate) fn has_room(solid: &Solid, corners: &[DVec2], radius: f64) -> bool {
    const GRID: u32 = 48;
    let Some([low, high]) = bounds(corners.iter().copied()) else { return false };
    let fits = |p: DVec2| contains(corners, p) && solid.fits(p, radius);
    let middle = corners.iter().sum::<DVec2>() / corners.len() as f64;
    let n = corners.len();
    let rays = (0..n).flat_map(|i| {
        let edge = corners[i].lerp(corners[(i + 1) % n], 0.5);
        [0.02, 0.25, 0.5, 0.75, 0.98].into_iter().flat_map(move |t| [middle.lerp(corners[i], t), middle.lerp(edge, t)])
    });
    let cell = |i: u32| (f64::from(i) + 0.5) / f64::from(GRID);
    let grid = (0..GRID)
        .flat_map(|i| (0..GRID).map(move |j| (i, j)))
        .map(|(i, j)| low + (high - low) * DVec2::new(cell(i), cell(j)));
    std::iter::once(middle).chain(rays).chain(grid).any(fits)
}

/// Formats a point for messages, with at most three decimals.
pub(super) fn show(p: DVec2) -> String {
    format!("({}, {})", short(p.x), short(p.y))
}

/// Formats a number for messages, with at most three decimals.
pub(super) fn short(x: f64) -> String {
    let text = format!("{x:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

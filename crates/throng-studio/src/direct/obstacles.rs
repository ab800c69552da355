//! Editing of obstacles and walls.

use super::parts::{OutlineKind, Parts, Removal, length, point, points};
use super::shapes::{Owner, circle, corners, rectangle};
use crate::document::Edit;
use glam::DVec2;
use throng_scene::{Scene, Shape, Walkable};
use toml_edit::{InlineTable, Value};

/// Adds the handles of obstacles and of holes in the walkable area.
pub fn parts(scene: &Scene, parts: &mut Parts) {
    for (k, obstacle) in scene.obstacles.iter().enumerate() {
        let path = format!("obstacle.{k}");
        let owner = &Owner { kind: OutlineKind::Obstacle, removal: Some(Removal::Path(path.clone())) };
        match &obstacle.shape {
            Shape::Circle(round) => circle(parts, &format!("{path}.shape.circle"), round.center, round.radius, owner),
            Shape::Rectangle(sides) => rectangle(parts, &format!("{path}.shape.rectangle"), sides, owner),
            Shape::Polygon(points) => corners(parts, &format!("{path}.shape.polygon"), points, true, owner),
            Shape::Wall(points) => corners(parts, &format!("{path}.shape.wall"), points, false, owner),
        }
    }
    if let Some(Walkable::Polygon(area)) = &scene.walkable {
        for (k, hole) in area.holes.iter().enumerate() {
            let path = format!("walkable.polygon.holes.{k}");
            let owner = Owner { kind: OutlineKind::Obstacle, removal: Some(Removal::Path(path.clone())) };
            corners(parts, &path, hole, true, &owner);
        }
    }
}

/// Adds a polygon.
///
/// # Errors
/// It has fewer than three corners.
pub fn polygon(edit: &mut Edit, corners: &[DVec2]) -> Result<(), String> {
    if corners.len() < 3 {
        return Err("an obstacle has at least three corners".into());
    }
    add(edit, "polygon", points(corners))
}

/// Adds a wall.
///
/// # Errors
/// It has fewer than two corners.
pub fn wall(edit: &mut Edit, corners: &[DVec2]) -> Result<(), String> {
    if corners.len() < 2 {
        return Err("a wall has at least two ends".into());
    }
    add(edit, "wall", points(corners))
}

/// Adds a disc, from its centre to its rim.
///
/// # Errors
/// The text has no place for it.
pub fn disc(edit: &mut Edit, middle: DVec2, rim: DVec2) -> Result<(), String> {
    let radius = length(middle.distance(rim).max(0.1));
    add(edit, "circle", InlineTable::from_iter([("center", point(middle)), ("radius", radius.into())]).into())
}

/// Adds a rectangle, from corner to corner.
///
/// # Errors
/// The text has no place for it.
pub fn block(edit: &mut Edit, from: DVec2, to: DVec2) -> Result<(), String> {
    add(edit, "rectangle", sides(from, to))
}

/// Returns a rectangle as a TOML value.
pub fn sides(from: DVec2, to: DVec2) -> Value {
    let size = (to - from).abs().max(DVec2::splat(0.1));
    InlineTable::from_iter([("center", point((from + to) * 0.5)), ("size", point(size))]).into()
}

fn add(edit: &mut Edit, shape: &str, value: Value) -> Result<(), String> {
    let position = edit.push("obstacle", InlineTable::new())?;
    edit.set(&format!("obstacle.{position}.shape.{shape}"), value)
}

//! Shapes that places, obstacles and goals share, with their handles.

use super::parts::{Change, Look, Outline, OutlineKind, Parts, Removal};
use glam::DVec2;
use throng_scene::{Point, Rectangle, Region};

const ROUND: usize = 48;

/// The item that a shape belongs to.
pub struct Owner {
    /// The kind of the item.
    pub kind: OutlineKind,
    /// What is removed with the shape.
    pub removal: Option<Removal>,
}

/// Adds a circle, with a handle at its centre and another on its rim.
pub fn circle(parts: &mut Parts, path: &str, center: Point, radius: f64, owner: &Owner) {
    let middle = DVec2::from(center);
    let changes = vec![Change::point(format!("{path}.center"), center)];
    let whole = parts.handle(middle, Look::Dot, changes, owner.removal.clone());
    let rim = vec![Change::Length { path: format!("{path}.radius"), center: middle }];
    parts.handle(middle + DVec2::X * radius, Look::Corner, rim, owner.removal.clone());
    let out = |k: usize| middle + DVec2::from_angle(k as f64 * std::f64::consts::TAU / ROUND as f64) * radius;
    outline(parts, (0..ROUND).map(out).collect(), true, Some(whole), owner);
}

/// Adds a rectangle, with a handle at its centre and one at each corner.
pub fn rectangle(parts: &mut Parts, path: &str, rectangle: &Rectangle, owner: &Owner) {
    let (middle, half) = (DVec2::from(rectangle.center), DVec2::from(rectangle.size) * 0.5);
    let changes = vec![Change::point(format!("{path}.center"), rectangle.center)];
    let whole = parts.handle(middle, Look::Dot, changes, owner.removal.clone());
    let turn = DVec2::from_angle(rectangle.rotation.to_radians());
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corners = corners.map(|corner| middle + turn.rotate(DVec2::from(corner) * half));
    for corner in corners {
        let size = Change::Size { path: format!("{path}.size"), center: middle, rotation: rectangle.rotation };
        parts.handle(corner, Look::Corner, vec![size], owner.removal.clone());
    }
    outline(parts, corners.to_vec(), true, Some(whole), owner);
}

/// Adds an outline with a handle at each corner. A closed outline has a handle at its centre that moves it. A corner
/// can be removed alone while enough corners remain (3 of a closed outline, 2 of an open one).
pub fn corners(parts: &mut Parts, path: &str, points: &[Point], closed: bool, owner: &Owner) {
    let corners: Vec<DVec2> = points.iter().copied().map(DVec2::from).collect();
    let all: Vec<Change> =
        points.iter().enumerate().map(|(k, &from)| Change::point(format!("{path}.{k}"), from)).collect();
    let middle = corners.iter().sum::<DVec2>() / corners.len().max(1) as f64;
    let whole = closed.then(|| parts.handle(middle, Look::Dot, all.clone(), owner.removal.clone()));
    for (k, (&at, change)) in corners.iter().zip(all).enumerate() {
        let spare = points.len() > if closed { 3 } else { 2 };
        let itself = spare.then(|| Removal::Path(format!("{path}.{k}")));
        parts.handle(at, Look::Corner, vec![change], itself.or_else(|| owner.removal.clone()));
    }
    outline(parts, corners, closed, whole, owner);
}

/// Adds the outline of a region.
pub fn region(parts: &mut Parts, path: &str, region: &Region, owner: &Owner) {
    match region {
        Region::Disc(disc) => circle(parts, &format!("{path}.disc"), disc.center, disc.radius, owner),
        Region::Rectangle(sides) => rectangle(parts, &format!("{path}.rectangle"), sides, owner),
        Region::Polygon(points) => corners(parts, &format!("{path}.polygon"), points, true, owner),
    }
}

/// Adds a single point.
pub fn spot(parts: &mut Parts, path: &str, at: Point, owner: &Owner) {
    parts.handle(at.into(), Look::Dot, vec![Change::point(path, at)], owner.removal.clone());
}

/// Adds an outline.
pub fn outline(parts: &mut Parts, points: Vec<DVec2>, closed: bool, whole: Option<usize>, owner: &Owner) {
    parts.outlines.push(Outline { kind: owner.kind, points, closed, whole });
}

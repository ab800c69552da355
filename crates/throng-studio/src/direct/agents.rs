//! Editing of groups: which agents exist and where they start.

use super::parts::{Change, Look, OutlineKind, Parts, Removal, point};
use super::shapes::{Owner, circle, corners, outline, rectangle, spot};
use crate::document::Edit;
use glam::DVec2;
use throng_scene::{
    Body, Described, DiscPlace, Goal, Grid, Line, Place, PointPlace, PointsGoal, PointsPlace, PolygonPlace, Rectangle,
    RectanglePlace, Ring, Scene,
};
use toml_edit::Array;

/// The gap between the bounding circles of added agents, and the part of it left for rounding, metres.
const GAP: f64 = 0.1;
const SLACK: f64 = 1e-6;

/// Adds the handles of the places of the groups.
pub fn parts(scene: &Scene, parts: &mut Parts) {
    for (g, group) in scene.groups.iter().enumerate() {
        let path = format!("group.{g}.place");
        let owner = &Owner { kind: OutlineKind::Place(g), removal: Some(Removal::Group(g)) };
        place_parts(parts, &path, &group.place, owner);
    }
}

/// Adds the handles of a place. `owner` is the group.
fn place_parts(parts: &mut Parts, path: &str, place: &Place, owner: &Owner) {
    if let Some(PointPlace(at)) = place.read() {
        spot(parts, &format!("{path}.point"), at, owner);
    } else if let Some(PointsPlace(points)) = place.read() {
        let OutlineKind::Place(g) = owner.kind else { return };
        for (k, &at) in points.iter().enumerate() {
            let owner = Owner { kind: owner.kind, removal: Some(Removal::Agent(g, k)) };
            spot(parts, &format!("{path}.points.{k}"), at, &owner);
        }
    } else if let Some(line) = place.read::<Line>() {
        let ends = [line.from, line.to].map(DVec2::from);
        let changes =
            [("from", line.from), ("to", line.to)].map(|(key, from)| Change::point(format!("{path}.line.{key}"), from));
        let middle = (ends[0] + ends[1]) * 0.5;
        let whole = parts.handle(middle, Look::Dot, changes.to_vec(), owner.removal.clone());
        for (at, change) in ends.into_iter().zip(changes) {
            parts.handle(at, Look::Corner, vec![change], owner.removal.clone());
        }
        outline(parts, ends.to_vec(), false, Some(whole), owner);
    } else if let Some(ring) = place.read::<Ring>() {
        circle(parts, &format!("{path}.ring"), ring.center, ring.radius, owner);
    } else if let Some(disc) = place.read::<DiscPlace>() {
        circle(parts, &format!("{path}.disc"), disc.center, disc.radius, owner);
    } else if let Some(grid) = place.read::<Grid>() {
        let middle = DVec2::from(grid.center);
        let changes = vec![Change::point(format!("{path}.grid.center"), grid.center)];
        let whole = parts.handle(middle, Look::Dot, changes, owner.removal.clone());
        let turn = DVec2::from_angle(grid.rotation.to_radians());
        let half = DVec2::new(grid.columns as f64, grid.rows as f64) * grid.spacing * 0.5;
        let rim = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let rim = rim.map(|corner| middle + turn.rotate(DVec2::from(corner) * half));
        outline(parts, rim.to_vec(), true, Some(whole), owner);
    } else if let Some(place) = place.read::<RectanglePlace>() {
        let sides = Rectangle { center: place.center, size: place.size, rotation: place.rotation };
        rectangle(parts, &format!("{path}.rectangle"), &sides, owner);
    } else if let Some(place) = place.read::<PolygonPlace>() {
        corners(parts, &format!("{path}.polygon.corners"), &place.corners, true, owner);
    }
}

/// Adds agents along a line. Each keeps the gap to the agents before it and to `others`. If the place of the group is a
/// list of points, they are added to the list. Otherwise a new group with the same properties holds them. Returns the
/// group that holds them.
///
/// # Errors
/// There is no free space, or the text has no place for the change.
pub fn add(edit: &mut Edit, scene: &Scene, g: usize, line: &[DVec2], others: &[DVec2]) -> Result<usize, String> {
    let group = scene.groups.get(g).ok_or("there is no group to add to")?;
    let apart = 2.0 * bound(&group.body) + GAP - SLACK;
    let mut new: Vec<DVec2> = Vec::new();
    for at in along(line, apart / 8.0) {
        if others.iter().chain(&new).all(|other| other.distance(at) >= apart) {
            new.push(at);
        }
    }
    if new.is_empty() {
        return Err("another agent stands there already".into());
    }
    let mut g = g;
    let single = group.source.is_empty() && group.count.unwrap_or(1) == 1;
    if let (Some(PointPlace(first)), true) = (group.place.read(), single) {
        edit.remove(&format!("group.{g}.place"))?;
        let list = Array::from_iter([point(DVec2::from(first))]);
        edit.set(&format!("group.{g}.place.points"), list)?;
    } else if group.place.name != PointsPlace::NAME {
        let name = free_name(scene, &group.name);
        g = edit.copy("group", g)?;
        for key in ["place", "count", "source"] {
            edit.remove(&format!("group.{g}.{key}"))?;
        }
        edit.set(&format!("group.{g}.name"), name)?;
        edit.set(&format!("group.{g}.place.points"), Array::new())?;
    }
    let goals: Option<PointsGoal> = group.goal.as_ref().and_then(Goal::read);
    for &at in &new {
        edit.push(&format!("group.{g}.place.points"), point(at))?;
        if let Some(goals) = &goals {
            let last = goals.at.last().copied().unwrap_or_default();
            edit.push(&format!("group.{g}.goal.points.at"), point(last.into()))?;
        }
    }
    count(edit, g, new.len() as i64)?;
    Ok(g)
}

/// Returns points along a line, at most `step` apart.
fn along(line: &[DVec2], step: f64) -> impl Iterator<Item = DVec2> {
    let between = line.windows(2).flat_map(move |pair| {
        let (from, to) = (pair[0], pair[1]);
        let parts = (from.distance(to) / step).ceil().max(1.0);
        (1..=parts as usize).map(move |k| from.lerp(to, k as f64 / parts))
    });
    line.first().copied().into_iter().chain(between)
}

/// Adds an agent to a group that has a rule as its place, or removes the last agent of any group.
///
/// # Errors
/// The group has no count, or its place does not allow the change, or it holds the last agent of the scene.
pub fn more(edit: &mut Edit, scene: &Scene, g: usize, by: i64) -> Result<(), String> {
    let group = scene.groups.get(g).ok_or("there is no such group")?;
    let listed = edit.len(&format!("group.{g}.place.points"));
    match (group.place.name.as_str(), group.count) {
        (PointsPlace::NAME, _) if by < 0 => remove(edit, g, listed.saturating_sub(1)),
        (PointsPlace::NAME | PointPlace::NAME, _) => {
            Err("the group lists the position of each agent: add agents with a click (P)".into())
        }
        (_, Some(1)) if by < 0 => remove_group(edit, g),
        (_, Some(_)) => count(edit, g, by),
        (_, None) => Err("the group has no `count`: set it in the text".into()),
    }
}

/// Removes an agent of a group. Removes the group with its last agent.
///
/// # Errors
/// It is the last agent of the scene.
pub fn remove(edit: &mut Edit, g: usize, k: usize) -> Result<(), String> {
    let list = format!("group.{g}.place.points");
    if edit.len(&list) < 2 {
        return remove_group(edit, g);
    }
    edit.remove(&format!("{list}.{k}"))?;
    edit.remove(&format!("group.{g}.goal.points.at.{k}"))?;
    count(edit, g, -1)
}

/// Removes a group.
///
/// # Errors
/// It is the last group.
pub fn remove_group(edit: &mut Edit, g: usize) -> Result<(), String> {
    if edit.len("group") < 2 {
        return Err("a scene needs at least one group: this is the last one".into());
    }
    edit.remove(&format!("group.{g}")).map(drop)
}

/// Returns a name that no group has.
fn free_name(scene: &Scene, name: &str) -> String {
    let base = if name.is_empty() { "people" } else { name };
    let taken = |name: &String| scene.groups.iter().any(|group| group.name == *name);
    (2..).map(|k| format!("{base}-{k}")).find(|name| !taken(name)).unwrap_or_default()
}

/// Adds `more` to the count of a group, if it has a count.
fn count(edit: &mut Edit, g: usize, more: i64) -> Result<(), String> {
    let path = format!("group.{g}.count");
    match edit.value(&path).and_then(toml_edit::Value::as_integer) {
        Some(old) => edit.set(&path, old + more),
        None => Ok(()),
    }
}

/// Returns the largest bounding radius of a body, metres.
fn bound(body: &Body) -> f64 {
    match body {
        Body::Radius(radius) => radius.bounds()[1],
        Body::Capsule(sides) | Body::Rectangle(sides) => 0.5 * sides.length.bounds()[1].hypot(sides.width.bounds()[1]),
    }
}

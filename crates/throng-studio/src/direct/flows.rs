//! Sketching, painting and erasing the field of a group.

use super::Brush;
use super::fields::AHEAD;
use super::parts::{length, point, points};
use crate::document::Edit;
use glam::DVec2;
use throng_draw::WorldBox;
use throng_scene::flow::{Named, Paint, Sketch};
use throng_scene::{Described, Flow, Scene};
use toml_edit::InlineTable;

/// The speed of a field without a given speed, m/s.
const SPEED: f64 = 1.3;
/// The radius of a stamp that is placed with a click, metres.
const STAMP: f64 = 3.0;

/// Adds a velocity at a position. The velocity is the drag divided by `AHEAD`.
///
/// # Errors
/// The group follows a field that is no sketch.
pub fn anchor(edit: &mut Edit, scene: &Scene, g: usize, at: DVec2, tip: DVec2) -> Result<(), String> {
    let velocity = (tip - at) / AHEAD;
    let velocity = if velocity.length() < 0.05 { DVec2::X * SPEED } else { velocity };
    let anchor = InlineTable::from_iter([("at", point(at)), ("velocity", point(velocity))]);
    let sketch = sketch(edit, scene, g)?;
    edit.push(&format!("{sketch}.anchors"), anchor).map(drop)
}

/// Adds a stroke to follow.
///
/// # Errors
/// As [`anchor`]. The line has a single point.
pub fn stroke(edit: &mut Edit, scene: &Scene, g: usize, line: &[DVec2]) -> Result<(), String> {
    let stroke = InlineTable::from_iter([("points", points(long(line)?))]);
    let sketch = sketch(edit, scene, g)?;
    edit.push(&format!("{sketch}.strokes"), stroke).map(drop)
}

/// Adds a stamp, from its centre to its rim.
///
/// # Errors
/// As [`anchor`].
pub fn stamp(edit: &mut Edit, scene: &Scene, g: usize, kind: &str, [at, rim]: [DVec2; 2]) -> Result<(), String> {
    let radius = Some(length(at.distance(rim))).filter(|radius| *radius > 0.3).unwrap_or(STAMP);
    let stamp = InlineTable::from_iter([("at", point(at)), ("kind", kind.into()), ("radius", radius.into())]);
    let sketch = sketch(edit, scene, g)?;
    edit.push(&format!("{sketch}.stamps"), stamp).map(drop)
}

/// Paints along a line. A new paint field covers `bounds`.
///
/// # Errors
/// The line has a single point, or the group follows a field without a name.
pub fn paint(
    edit: &mut Edit,
    scene: &Scene,
    g: usize,
    brush: Brush,
    line: &[DVec2],
    bounds: WorldBox,
) -> Result<(), String> {
    let line = long(line)?;
    let paint = match found::<Paint>(scene, g) {
        Some((path, _)) => format!("{path}.paint"),
        None => {
            let on = named(scene, g)?;
            let path = new_field(edit, scene, g, "paint")? + ".paint";
            edit.set(&format!("{path}.min"), point(bounds.min.floor()))?;
            edit.set(&format!("{path}.max"), point(bounds.max.ceil()))?;
            if let Some(on) = on {
                edit.set(&format!("{path}.on.named"), on)?;
            }
            path
        }
    };
    let mut stroke = InlineTable::from_iter([("points", points(line)), ("radius", length(brush.radius).into())]);
    for (key, value, usual) in [("speed", brush.speed, SPEED), ("strength", brush.strength, 1.0)] {
        if value != usual {
            stroke.insert(key, length(value).into());
        }
    }
    edit.push(&format!("{paint}.strokes"), stroke).map(drop)
}

/// Erases along a line. In a paint field it adds an erasing stroke. In a sketch it removes the anchors and stamps on
/// the line and erases parts of the strokes.
///
/// # Errors
/// The group follows neither a sketch nor paint.
pub fn erase(edit: &mut Edit, scene: &Scene, g: usize, radius: f64, line: &[DVec2]) -> Result<(), String> {
    if let Some((path, _)) = found::<Paint>(scene, g) {
        let line = [line, &line[..usize::from(line.len() == 1)]].concat();
        let stroke = [("points", points(&line)), ("radius", length(radius).into()), ("erase", true.into())];
        return edit.push(&format!("{path}.paint.strokes"), InlineTable::from_iter(stroke)).map(drop);
    }
    let (path, sketch) = found::<Sketch>(scene, g).ok_or("the group follows no sketch and no paint")?;
    let touched = |at: &[f64; 2]| line.iter().any(|dab| dab.distance(DVec2::from(*at)) <= radius);
    let gone = |touched: Vec<bool>| (0..touched.len()).rev().filter(move |&k| touched[k]).collect::<Vec<_>>();
    for k in gone(sketch.anchors.iter().flatten().map(|anchor| touched(&anchor.at)).collect()) {
        edit.remove(&format!("{path}.sketch.anchors.{k}"))?;
    }
    for k in gone(sketch.stamps.iter().flatten().map(|stamp| touched(&stamp.at)).collect()) {
        edit.remove(&format!("{path}.sketch.stamps.{k}"))?;
    }
    let mut last: Option<DVec2> = None;
    let met = |dab: DVec2| {
        let near = |pair: &[[f64; 2]]| from_segment(pair[0].into(), pair[1].into(), dab) <= radius;
        sketch.strokes.iter().flatten().any(|stroke| stroke.points.windows(2).any(near))
    };
    for &dab in line {
        if last.is_none_or(|last| last.distance(dab) >= 0.5 * radius) && met(dab) {
            let round = InlineTable::from_iter([("at", point(dab)), ("radius", length(radius).into())]);
            edit.push(&format!("{path}.sketch.erase"), round)?;
            last = Some(dab);
        }
    }
    Ok(())
}

fn long(line: &[DVec2]) -> Result<&[DVec2], String> {
    if line.len() < 2 { Err("draw a line".into()) } else { Ok(line) }
}

fn from_segment(a: DVec2, b: DVec2, at: DVec2) -> f64 {
    let way = b - a;
    let share = ((at - a).dot(way) / way.length_squared().max(1e-12)).clamp(0.0, 1.0);
    (a + way * share).distance(at)
}

/// Returns the path of the sketch that a group follows. Creates the sketch if the group follows no field.
fn sketch(edit: &mut Edit, scene: &Scene, g: usize) -> Result<String, String> {
    let path = found::<Sketch>(scene, g).map(|(path, _)| path);
    let path = match (path, scene.groups.get(g).is_some_and(|group| group.field.is_some())) {
        (Some(path), _) => path,
        (None, false) => new_field(edit, scene, g, "sketch")?,
        (None, true) => return Err("the group follows a field that is no sketch: choose another group".into()),
    };
    Ok(format!("{path}.sketch"))
}

/// Creates a field that the group follows, and returns its path.
fn new_field(edit: &mut Edit, scene: &Scene, g: usize, kind: &str) -> Result<String, String> {
    let group = scene.groups.get(g).ok_or("there is no group to lead")?;
    let base = if group.name.is_empty() { format!("group-{}", g + 1) } else { group.name.clone() };
    let taken = |name: &String| scene.fields.iter().any(|field| field.name == *name);
    let names = std::iter::once(format!("{base}-{kind}")).chain((2..).map(|k| format!("{base}-{kind}-{k}")));
    let name = names.into_iter().find(|name| !taken(name)).unwrap_or_default();
    let position = edit.push("field", InlineTable::from_iter([("name", name.as_str())]))?;
    edit.remove(&format!("group.{g}.field.of"))?;
    edit.set(&format!("group.{g}.field.of.named"), name)?;
    Ok(format!("field.{position}.flow"))
}

/// Returns the name of the field that a group follows, or `None` if it follows none.
fn named(scene: &Scene, g: usize) -> Result<Option<String>, String> {
    match scene.groups.get(g).and_then(|group| group.field.as_ref()).map(|field| field.of.as_ref()) {
        None => Ok(None),
        Some(flow) => match flow.and_then(Flow::read) {
            Some(Named(name)) => Ok(Some(name)),
            None => Err("the field of the group has no name: it cannot be painted on".into()),
        },
    }
}

/// Returns the path and the description of the first field of a kind: the field of the group, or a field that it is
/// composed of.
fn found<D: Described>(scene: &Scene, g: usize) -> Option<(String, D)> {
    let flow = scene.groups.get(g)?.field.as_ref()?.of.as_ref()?;
    within(scene, format!("group.{g}.field.of"), flow)
}

fn within<D: Described>(scene: &Scene, path: String, flow: &Flow) -> Option<(String, D)> {
    if let Some(described) = flow.read() {
        return Some((path, described));
    }
    if let Some(Named(name)) = flow.read() {
        // a field refers only to fields above it, so the recursion ends
        let k = scene.fields.iter().position(|field| field.name == name)?;
        return within(scene, format!("field.{k}.flow"), &scene.fields[k].flow);
    }
    let parts = scene.plugins.fields.parts(flow);
    parts.iter().find_map(|(below, part)| within(scene, format!("{path}.{below}"), part))
}

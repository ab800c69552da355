//! Handles of sketched and painted fields.

use super::parts::{Change, Look, OutlineKind, Parts, Removal};
use super::shapes::{Owner, circle, corners};
use glam::DVec2;
use throng_scene::flow::{Paint, Sketch};
use throng_scene::{Flow, Scene};

/// The time that the arrow of a velocity spans, seconds: its length is velocity times `AHEAD`.
pub const AHEAD: f64 = 1.5;

/// Adds the handles of anchors, strokes and stamps.
pub fn parts(scene: &Scene, parts: &mut Parts) {
    for (k, field) in scene.fields.iter().enumerate() {
        flow_parts(scene, parts, &format!("field.{k}.flow"), &field.flow);
    }
    for (g, group) in scene.groups.iter().enumerate() {
        if let Some(flow) = group.field.as_ref().and_then(|field| field.of.as_ref()) {
            flow_parts(scene, parts, &format!("group.{g}.field.of"), flow);
        }
    }
}

fn flow_parts(scene: &Scene, parts: &mut Parts, path: &str, flow: &Flow) {
    let owner = |path: &str| Owner { kind: OutlineKind::Field, removal: Some(Removal::Path(path.to_owned())) };
    if let Some(sketch) = flow.read::<Sketch>() {
        for (k, anchor) in sketch.anchors.iter().flatten().enumerate() {
            let path = format!("{path}.sketch.anchors.{k}");
            let (at, removal) = (DVec2::from(anchor.at), owner(&path).removal);
            let velocity = Change::Point { path: format!("{path}.velocity"), from: anchor.velocity, rate: 1.0 / AHEAD };
            let moved = vec![Change::point(format!("{path}.at"), anchor.at)];
            parts.handle(at, Look::Dot, moved, removal.clone());
            let tip = at + DVec2::from(anchor.velocity) * AHEAD;
            parts.handle(tip, Look::Arrow(at), vec![velocity], removal);
        }
        for (k, stroke) in sketch.strokes.iter().flatten().enumerate() {
            let path = format!("{path}.sketch.strokes.{k}");
            corners(parts, &format!("{path}.points"), &stroke.points, false, &owner(&path));
        }
        for (k, stamp) in sketch.stamps.iter().flatten().enumerate() {
            let path = format!("{path}.sketch.stamps.{k}");
            stamp_parts(parts, &path, DVec2::from(stamp.at), stamp.radius, &owner(&path));
        }
    } else if let Some(paint) = flow.read::<Paint>() {
        for (k, stroke) in paint.strokes.iter().enumerate() {
            let path = format!("{path}.paint.strokes.{k}");
            corners(parts, &format!("{path}.points"), &stroke.points, false, &owner(&path));
        }
    }
    for (below, part) in scene.plugins.fields.parts(flow) {
        flow_parts(scene, parts, &format!("{path}.{below}"), &part);
    }
}

/// Adds the handles of a stamp: a circle with the key `at` for its centre.
fn stamp_parts(parts: &mut Parts, path: &str, at: DVec2, radius: f64, owner: &Owner) {
    let first = parts.handles.len();
    circle(parts, path, at.to_array(), radius, owner);
    parts.handles[first].changes = vec![Change::point(format!("{path}.at"), at.to_array())];
}

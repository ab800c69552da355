//! The world of a scene as files and pictures show it.

use crate::{Flow, Frame, Setting, Shell};
use glam::DVec2;
use std::sync::Arc;
use throng::World;
use throng::space::surface::{Barrier, Bounds, Surface};
use throng_scene::Built;

/// The place and the names. The group every world has from the start is left out: no scene puts anybody into it.
pub fn setting(world: &World, built: &Built, title: &str) -> Setting {
    let mut setting = Setting::of(world, title);
    setting.groups.remove(0);
    setting.flows = flows(world, built);
    let room = room(built, setting.origin);
    setting.shells = built.surfaces.iter().map(|(_, surface)| Shell::of(surface, &shown(surface, &room))).collect();
    setting.paths = built.paths.iter().map(|(_, path)| path.clone()).collect();
    setting
}

/// The fields that govern groups, with what they were sketched by; where none does, those of the scene, which behaviours may follow.
fn flows(world: &World, built: &Built) -> Vec<Flow> {
    let mut flows = Flow::all(world);
    flows.iter_mut().flat_map(|flow| &mut flow.groups).for_each(|group| *group = group.saturating_sub(1));
    if flows.is_empty() {
        flows = built.fields.iter().map(|planned| Flow::of(planned.field.clone())).collect();
    }
    for flow in &mut flows {
        let planned = built.fields.iter().find(|planned| Arc::ptr_eq(&planned.field, &flow.field));
        flow.anchors = planned.map(|planned| planned.anchors.clone()).unwrap_or_default();
    }
    flows
}

/// In which part of space surfaces without end are shown: round everything else, as high as that is wide.
fn room(built: &Built, origin: DVec2) -> Bounds {
    let [low, high] = built.bounds.map(|corner| (corner - origin).as_vec2());
    let side = (high - low).max_element().max(10.0);
    Bounds { low: low.extend(-side), high: high.extend(side) }
}

/// In which part of space a surface is shown: all of it, or, if it is too large for that, the room.
fn shown(surface: &Barrier<Arc<dyn Surface>>, room: &Bounds) -> Bounds {
    let (bounds, most) = (surface.surface.bounds(), (room.high - room.low).max_element());
    let fits = bounds.is_finite() && (bounds.high - bounds.low).max_element() <= most;
    // by rounding nothing is cut off
    if fits { bounds.grown(0.01 * most) } else { *room }
}

/// Makes `frame` show the world as it is now; groups are counted as in [`setting`].
pub fn capture(world: &World, frame: &mut Frame) {
    frame.capture(world);
    for body in &mut frame.bodies {
        body.group = body.group.saturating_sub(1);
    }
}

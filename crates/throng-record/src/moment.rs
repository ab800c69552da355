//! The setting and the frames of a scene's world, as files and pictures show them.

use crate::{Flow, Frame, SetMesh, Setting, Shell};
use glam::DVec2;
#[cfg(feature = "glb")]
use glam::DVec3;
use std::sync::Arc;
use throng::space::surface::{Barrier, Bounds, Surface};
use throng::{TraceRequest, World};
use throng_figure::Character;
use throng_scene::{Built, Error, Scene};

/// Returns the place and the names. The group that every world has from the start is left out: no scene puts agents
/// into it.
pub fn setting(world: &World, built: &Built, title: &str) -> Setting {
    let mut setting = Setting::of(world, title);
    setting.groups.remove(0);
    setting.flows = flows(world, built);
    let room = room(built, setting.origin);
    setting.shells = built.surfaces.iter().map(|(_, surface)| Shell::of(surface, &shown(surface, &room))).collect();
    setting.paths = built.paths.iter().map(|(_, path)| path.clone()).collect();
    setting
}

/// Returns the place and the names, and what it reads from files: the bodies of groups ([`throng_scene::Group::figure`])
/// and the [`set`]. Without the feature `glb` no files are read, and all people are throng's.
///
/// # Errors
/// A file does not exist, its body cannot walk ([`people::character`](crate::people::character)), or it is no set.
pub fn setting_with_files(world: &World, built: &Built, scene: &Scene, title: &str) -> Result<Setting, Error> {
    let setting = setting(world, built, title);
    Ok(Setting { characters: characters(scene)?, set: set(scene, setting.origin)?, ..setting })
}

/// How far a set lies below its place, metres, so that what is drawn on the ground is above its floor.
#[cfg(feature = "glb")]
const SUNK: f64 = 0.005;

/// Reads the set of a scene ([`throng_scene::View::set`]), metres from `origin`; `None` if there is no set. Without the feature
/// `glb`, no set is read.
///
/// # Errors
/// The file does not exist, or it is no set ([`SetMesh::read`]).
#[cfg(feature = "glb")]
pub fn set(scene: &Scene, origin: DVec2) -> Result<Option<Arc<SetMesh>>, Error> {
    let (Some(said), Some(bytes)) = (&scene.view.set, scene.stage_set()?) else { return Ok(None) };
    let read = SetMesh::read(&bytes);
    let mesh = read.map_err(|flaw| scene.wrong_set(&format!("{}: {flaw}", said.file), flaw.hint))?;
    let at = DVec3::from_array(said.at) - origin.extend(SUNK);
    let placed = mesh.placed(at, said.turn.to_radians(), said.scale.unwrap_or(1.0));
    Ok(Some(Arc::new(SetMesh { replaces: said.replaces, ..placed })))
}

/// Returns `None`: without the feature `glb`, no set is read.
///
/// # Errors
/// None.
#[cfg(not(feature = "glb"))]
pub fn set(_: &Scene, _: DVec2) -> Result<Option<Arc<SetMesh>>, Error> {
    Ok(None)
}

/// Reads the bodies of groups ([`throng_scene::Group::figure`]), by group. A file that several groups name is read once.
/// Without the feature `glb`, none is read.
///
/// # Errors
/// A file does not exist, or its body cannot walk ([`people::character`](crate::people::character)).
#[cfg(feature = "glb")]
pub fn characters(scene: &Scene) -> Result<Vec<Option<Arc<Character>>>, Error> {
    let mut all: Vec<Option<Arc<Character>>> = Vec::new();
    for (at, group) in scene.groups.iter().enumerate() {
        let Some(name) = &group.figure else { continue };
        let same = scene.groups[..at].iter().position(|other| other.figure.as_ref() == Some(name));
        let character = match same {
            Some(same) => all[same].clone(),
            None => {
                let bytes = scene.figure(at)?.unwrap_or_default();
                let read = crate::people::character(&bytes);
                Some(Arc::new(read.map_err(|flaw| scene.wrong_figure(at, &format!("{name}: {flaw}"), flaw.hint))?))
            }
        };
        all.resize(at, None);
        all.push(character);
    }
    Ok(all)
}

/// Returns no bodies: without the feature `glb`, none is read.
///
/// # Errors
/// None.
#[cfg(not(feature = "glb"))]
pub fn characters(_: &Scene) -> Result<Vec<Option<Arc<Character>>>, Error> {
    Ok(Vec::new())
}

/// Returns the fields that guide groups, with their anchors. If no field guides a group, returns the fields of the scene.
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

/// Returns the box in which unbounded surfaces are shown: the bounds of the scene, as high as they are wide.
fn room(built: &Built, origin: DVec2) -> Bounds {
    let [low, high] = built.bounds.map(|corner| (corner - origin).as_vec2());
    let side = (high - low).max_element().max(10.0);
    Bounds { low: low.extend(-side), high: high.extend(side) }
}

/// Returns the box in which a surface is shown: its bounds, or the room if they are too large.
fn shown(surface: &Barrier<Arc<dyn Surface>>, room: &Bounds) -> Bounds {
    let (bounds, most) = (surface.surface.bounds(), (room.high - room.low).max_element());
    let fits = bounds.is_finite() && (bounds.high - bounds.low).max_element() <= most;
    // the margin keeps edges that rounding would cut off
    if fits { bounds.grown(0.01 * most) } else { *room }
}

/// Sets `frame` to the world as it is now; groups are numbered as in [`setting`].
pub fn capture(world: &World, frame: &mut Frame) {
    frame.capture(world);
    for body in &mut frame.bodies {
        body.group = body.group.saturating_sub(1);
    }
    for adapted in &mut frame.fields {
        adapted.group = adapted.group.saturating_sub(1);
    }
}

/// Adds the obstacles to a frame of a run of a scene, if its interventions have changed those of the setting.
pub fn capture_obstacles(world: &World, scene: &Scene, setting: &Setting, frame: &mut Frame) {
    if scene.interventions.is_empty() {
        return;
    }
    let now = || world.place().obstacles();
    if now().eq(&setting.obstacles) {
        frame.obstacles = None;
    } else if !frame.obstacles.as_ref().is_some_and(|known| now().eq(known.iter())) {
        frame.obstacles = Some(now().cloned().collect());
    }
}

/// Adds what the local models permit and forbid these agents in the next sub-step ([`World::explain_all`]) to a frame.
pub fn explain(world: &World, agents: &TraceRequest, frame: &mut Frame) {
    frame.explanations = world.explain_all(agents);
}

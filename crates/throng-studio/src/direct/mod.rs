//! Direct manipulation: the scene is edited with the mouse in the view. A finished gesture is one edit of the text.
//! Before that, its result is drawn as a preview and no world is built.

pub mod agents;
pub mod fields;
pub mod flows;
pub mod goals;
pub mod obstacles;
mod overlay;
pub mod parts;
mod precision;
mod shapes;
mod tool;

pub use overlay::Sight;
pub use precision::{Snap, Snapping};
pub use tool::Tool;

use crate::document::{Document, Edit};
use glam::DVec2;
use parts::{Handle, Parts, Removal};
use std::sync::Arc;
use throng_draw::WorldBox;
use throng_record::Frame;
use throng_scene::Scene;

/// The distance at which the pointer takes a handle, points of the screen.
const REACH: f64 = 9.0;
/// A shorter drag is a click, points of the screen.
const CLICK: f64 = 5.0;

/// The settings of the brush.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Radius, metres.
    pub radius: f64,
    /// Painted speed, m/s.
    pub speed: f64,
    /// Weight over the existing field, 0 to 1.
    pub strength: f64,
}

impl Default for Brush {
    fn default() -> Self {
        Self { radius: 2.0, speed: 1.3, strength: 1.0 }
    }
}

/// An event of the pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The button is pressed.
    Press,
    /// The pointer moves.
    Move,
    /// The button is released.
    Release,
    /// The outline drawn click by click is complete.
    Finish,
}

/// The world that is edited.
#[derive(Clone, Copy, Debug)]
pub struct DirectedWorld<'a> {
    /// The agents at the start.
    pub first: &'a Frame,
    /// The bounding box of the scene.
    pub bounds: WorldBox,
    /// The scale, points of the screen per metre.
    pub scale: f64,
}

/// A gesture of the mouse under way.
#[derive(Clone, Debug, Default)]
struct Gesture {
    /// The path of the pointer, or the corners of an outline drawn click by click.
    points: Vec<DVec2>,
    /// The position of the pointer.
    at: DVec2,
    /// The dragged handle.
    held: Option<Handle>,
    /// The typed size.
    typed: String,
}

/// Turns events of the pointer into edits of the text.
#[derive(Clone, Debug, Default)]
pub struct Director {
    /// The tool of the primary button.
    pub tool: Tool,
    /// The group that goals, fields and new agents belong to, by position.
    pub group: usize,
    /// The settings of the brush.
    pub brush: Brush,
    /// What gestures snap to.
    pub snapping: Snapping,
    /// What the pointer has snapped to.
    snap: Option<(DVec2, Snap)>,
    gesture: Option<Gesture>,
    /// The position of the selected item, and what is removed with it.
    selected: Option<(DVec2, Removal)>,
}

impl Director {
    /// Selects a tool and cancels the gesture under way.
    pub fn take(&mut self, tool: Tool) {
        self.tool = tool;
        self.cancel();
    }

    /// Cancels the gesture and clears the selection. Returns whether there was either.
    pub fn cancel(&mut self) -> bool {
        let begun = self.gesture.take().is_some();
        self.selected.take().is_some() || begun
    }

    /// Handles an event of the pointer at a position on the ground. Returns whether the document was edited.
    ///
    /// # Errors
    /// The gesture is invalid there. The message says why, and the document is unchanged.
    pub fn point(
        &mut self,
        document: &mut Document,
        at: DVec2,
        event: Event,
        stage: DirectedWorld<'_>,
    ) -> Result<bool, String> {
        if let Some(gesture) = &mut self.gesture {
            gesture.at = at;
        }
        match event {
            Event::Press if self.tool != Tool::Hand && !self.tool.intervenes() => self.press(document, at, stage),
            Event::Move if !self.tool.clicks() => {
                let apart = 0.5 * CLICK / stage.scale;
                let gesture = self.gesture.as_mut();
                let far = |gesture: &&mut Gesture| gesture.points.last().is_none_or(|last| last.distance(at) >= apart);
                gesture.filter(far).into_iter().for_each(|gesture| gesture.points.push(at));
                Ok(false)
            }
            Event::Release if !self.tool.clicks() => self.finish(document, stage),
            Event::Finish => self.finish(document, stage),
            _ => Ok(false),
        }
    }

    /// Whether the gesture under way takes digits as its size.
    pub fn takes_numbers(&self) -> bool {
        self.gesture.is_some() && self.tool.has_size()
    }

    /// Types characters of a size, or removes the last one.
    fn write(&mut self, text: &str, remove: bool) {
        let sized = self.tool.has_size();
        let Some(gesture) = self.gesture.as_mut().filter(|_| sized) else { return };
        gesture.typed.extend(precision::signs(text));
        if remove {
            gesture.typed.pop();
        }
    }

    /// Returns the position that a gesture takes for the pointer at a position: the typed size, or what is near. `straight`:
    /// in directions of multiples of 45°. `free`: without snapping.
    fn aim(&mut self, document: &Document, at: DVec2, (straight, free): (bool, bool), scale: f64) -> DVec2 {
        let gesture = self.gesture.as_ref();
        let from =
            gesture.and_then(|gesture| if self.tool.clicks() { gesture.points.last() } else { gesture.points.first() });
        let from = from.copied().filter(|_| self.tool.has_size() || self.tool == Tool::Select);
        let typed = gesture.map_or("", |gesture| &gesture.typed);
        if let Some(at) = from.and_then(|from| precision::sized(self.tool, from, at, typed)) {
            self.snap = None;
            return at;
        }
        let snaps = self.tool.snaps() && !free && (straight || self.snapping.on);
        let Some(scene) = document.scene().ok().filter(|_| snaps) else {
            self.snap = None;
            return at;
        };
        let held = gesture.and_then(|gesture| gesture.held.as_ref()).map(|held| held.at);
        // a handle is dragged by its own position, not by that of the pointer in it
        let off = held.zip(from).map_or(DVec2::ZERO, |(held, from)| held - from);
        let ends = (from.map(|from| from + off), at + off);
        let reach = (REACH / scale, held.or(from.filter(|_| self.tool.clicks())));
        let (to, snap) = precision::snapped(self.snapping, &Parts::of(scene), ends, straight, reach);
        self.snap = snap.map(|snap| (to, snap));
        to - off
    }

    fn press(&mut self, document: &mut Document, at: DVec2, stage: DirectedWorld<'_>) -> Result<bool, String> {
        let reach = REACH / stage.scale;
        if self.tool.clicks() {
            let gesture = self.gesture.get_or_insert_default();
            gesture.at = at;
            // a click on the first corner closes a polygon, a second click on the last corner ends the outline
            let ends = [gesture.points.first().filter(|_| self.tool == Tool::Polygon), gesture.points.last()];
            if ends.into_iter().flatten().any(|end| end.distance(at) <= reach) {
                return self.finish(document, stage);
            }
            gesture.points.push(at);
            gesture.typed.clear();
            return Ok(false);
        }
        let held = (self.tool == Tool::Select).then(|| {
            let scene = document.scene().ok()?;
            Parts::of(scene).at(at, reach).cloned()
        });
        let held = held.flatten();
        self.selected = held.as_ref().and_then(|held| Some((held.at, held.removal.clone()?)));
        if self.tool != Tool::Select || held.is_some() {
            self.gesture = Some(Gesture { points: vec![at], at, held, typed: String::new() });
        }
        Ok(false)
    }

    fn finish(&mut self, document: &mut Document, stage: DirectedWorld<'_>) -> Result<bool, String> {
        let Some(gesture) = self.gesture.take() else { return Ok(false) };
        if self.tool == Tool::Select && !gesture.dragged(stage.scale) {
            return Ok(false);
        }
        let scene = self.sound(document)?;
        let before = document.text().to_owned();
        let mut group = self.group;
        document.change(|edit| {
            group = self.apply(edit, &scene, &gesture, stage)?;
            Ok(())
        })?;
        self.group = group;
        if let (Some(held), Some((at, _))) = (&gesture.held, &mut self.selected) {
            *at = held.at + gesture.by();
        }
        Ok(document.text() != before)
    }

    /// Returns the scene of the text.
    fn sound(&self, document: &Document) -> Result<Arc<Scene>, String> {
        document.scene().cloned().map_err(|error| format!("fix the text first: {error}"))
    }

    /// Applies the edit of a gesture. Returns the group that is edited next.
    fn apply(
        &self,
        edit: &mut Edit,
        scene: &Scene,
        gesture: &Gesture,
        stage: DirectedWorld<'_>,
    ) -> Result<usize, String> {
        let (g, brush, line) = (self.group.min(scene.groups.len().saturating_sub(1)), self.brush, &gesture.points);
        let (from, to) = (line.first().copied().unwrap_or(gesture.at), gesture.at);
        let dragged = gesture.dragged(stage.scale);
        let corners = dragged.then_some((from, to));
        let smooth = || simplified(line, 2.0 / stage.scale);
        let needs_drag = || if dragged { Ok(()) } else { Err("drag to set the size".to_owned()) };
        match self.tool {
            Tool::Hand
            | Tool::Grab
            | Tool::Lead
            | Tool::Push
            | Tool::Crowd
            | Tool::Barrier
            | Tool::Door
            | Tool::Send => {}
            Tool::Select => {
                if let Some(held) = &gesture.held {
                    let to = held.at + gesture.by();
                    held.changes.iter().try_for_each(|change| change.apply(edit, gesture.by(), to))?;
                }
            }
            Tool::Agents => {
                let others: Vec<DVec2> = stage.first.bodies.iter().map(|body| body.position).collect();
                return agents::add(edit, scene, g, line, &others);
            }
            Tool::Polygon => obstacles::polygon(edit, line)?,
            Tool::Wall => obstacles::wall(edit, line)?,
            Tool::Disc => needs_drag().and_then(|()| obstacles::disc(edit, from, to))?,
            Tool::Rectangle => needs_drag().and_then(|()| obstacles::block(edit, from, to))?,
            Tool::Goal => goals::goal(edit, g, corners, to)?,
            Tool::Exit => goals::exit(edit, g, corners, to)?,
            Tool::Anchor => flows::anchor(edit, scene, g, from, to)?,
            Tool::Stroke => flows::stroke(edit, scene, g, &smooth())?,
            Tool::Vortex => flows::stamp(edit, scene, g, "vortex", [from, to])?,
            Tool::Source => flows::stamp(edit, scene, g, "source", [from, to])?,
            Tool::Sink => flows::stamp(edit, scene, g, "sink", [from, to])?,
            Tool::Saddle => flows::stamp(edit, scene, g, "saddle", [from, to])?,
            Tool::Brush => flows::paint(edit, scene, g, brush, &smooth(), stage.bounds)?,
            Tool::Eraser => flows::erase(edit, scene, g, brush.radius, line)?,
        }
        Ok(g)
    }

    /// Adds an agent to a group, given by position, or removes one.
    ///
    /// # Errors
    /// The text has no place for it, or it is the last agent of the scene.
    pub fn more(&self, document: &mut Document, group: usize, by: i64) -> Result<bool, String> {
        let scene = self.sound(document)?;
        document.change(|edit| agents::more(edit, &scene, group, by))?;
        Ok(true)
    }

    /// Removes the selected item from the scene. Returns whether an item was selected.
    ///
    /// # Errors
    /// The scene needs it.
    pub fn remove(&mut self, document: &mut Document) -> Result<bool, String> {
        let Some((_, removal)) = self.selected.take() else { return Ok(false) };
        document.change(|edit| match &removal {
            Removal::Path(path) => edit.remove(path).map(drop),
            Removal::Group(g) => agents::remove_group(edit, *g),
            Removal::Agent(g, k) => agents::remove(edit, *g, *k),
        })?;
        Ok(true)
    }
}

impl Gesture {
    /// Returns the displacement of the pointer.
    fn by(&self) -> DVec2 {
        self.at - self.points.first().copied().unwrap_or(self.at)
    }

    fn dragged(&self, scale: f64) -> bool {
        self.by().length() * scale >= CLICK || self.points.len() > 2
    }
}

/// Returns the line without the points that lie within `tolerance` of the simplified line (Douglas and Peucker).
pub(crate) fn simplified(line: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let [first, .., last] = line else { return line.to_vec() };
    let way = (*last - *first).normalize_or_zero();
    let off = |at: &DVec2| {
        let beside = *at - *first;
        if way == DVec2::ZERO { beside.length() } else { way.perp_dot(beside).abs() }
    };
    let farthest = (1..line.len() - 1).max_by(|&a, &b| off(&line[a]).total_cmp(&off(&line[b])));
    match farthest.filter(|&k| off(&line[k]) > tolerance) {
        None => vec![*first, *last],
        Some(k) => {
            let mut kept = simplified(&line[..=k], tolerance);
            kept.pop();
            kept.extend(simplified(&line[k..], tolerance));
            kept
        }
    }
}

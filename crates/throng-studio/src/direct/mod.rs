//! Directing: the scene is edited with the mouse in the view. A gesture, once it is finished, is one edit of the scene's text; until
//! then what it would make is drawn, and nothing is built.

pub mod agents;
pub mod fields;
pub mod flows;
pub mod goals;
pub mod obstacles;
mod overlay;
pub mod parts;
mod shapes;
mod tool;

pub use overlay::Sight;
pub use tool::Tool;

use crate::document::{Document, Edit};
use glam::DVec2;
use parts::{Handle, Parts, Removal};
use std::sync::Arc;
use throng_draw::WorldBox;
use throng_record::Frame;
use throng_scene::Scene;

/// How near one must point, points of the screen.
const REACH: f64 = 9.0;
/// A drag that is shorter is a click, points of the screen.
const CLICK: f64 = 5.0;

/// How the brush paints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Metres.
    pub radius: f64,
    /// The speed that it leaves, m/s.
    pub speed: f64,
    /// How much it covers of what was there, 0 to 1.
    pub strength: f64,
}

impl Default for Brush {
    fn default() -> Self {
        Self { radius: 2.0, speed: 1.3, strength: 1.0 }
    }
}

/// What the pointer does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The button is pressed.
    Press,
    /// The pointer moves.
    Move,
    /// The button is let go.
    Release,
    /// What goes from click to click is done.
    Finish,
}

/// Where the world is while it is directed.
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
    /// Everybody at the start.
    pub first: &'a Frame,
    /// The box that holds the place.
    pub bounds: WorldBox,
    /// Points of the screen that a metre takes.
    pub scale: f64,
}

/// What is being done with the mouse.
#[derive(Clone, Debug, Default)]
struct Gesture {
    /// Where it has been, or, from click to click, the corners.
    points: Vec<DVec2>,
    /// Where the pointer is.
    at: DVec2,
    /// What is dragged.
    held: Option<Handle>,
}

/// Turns what the pointer does into edits.
#[derive(Clone, Debug, Default)]
pub struct Director {
    /// What the first button does.
    pub tool: Tool,
    /// Whom goals, fields and new agents are for, by position.
    pub group: usize,
    /// How the brush paints.
    pub brush: Brush,
    gesture: Option<Gesture>,
    /// Where what is selected is, and what is taken out with it.
    selected: Option<(DVec2, Removal)>,
}

impl Director {
    /// Takes another tool; what was begun with the one before is let go.
    pub fn take(&mut self, tool: Tool) {
        self.tool = tool;
        self.cancel();
    }

    /// Lets go of what was begun and of what is selected; whether there was something.
    pub fn cancel(&mut self) -> bool {
        let begun = self.gesture.take().is_some();
        self.selected.take().is_some() || begun
    }

    /// Lets the pointer do something at a place of the ground; whether the document was edited.
    ///
    /// # Errors
    /// What was done makes no sense there: in words; the document is as it was.
    pub fn point(
        &mut self,
        document: &mut Document,
        at: DVec2,
        event: Event,
        stage: Stage<'_>,
    ) -> Result<bool, String> {
        if let Some(gesture) = &mut self.gesture {
            gesture.at = at;
        }
        match event {
            Event::Press if self.tool != Tool::Hand => self.press(document, at, stage),
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

    fn press(&mut self, document: &mut Document, at: DVec2, stage: Stage<'_>) -> Result<bool, String> {
        let reach = REACH / stage.scale;
        if self.tool.clicks() {
            let gesture = self.gesture.get_or_insert_default();
            gesture.at = at;
            // a click on the first corner closes a polygon, a second one on the last ends
            let ends = [gesture.points.first().filter(|_| self.tool == Tool::Polygon), gesture.points.last()];
            if ends.into_iter().flatten().any(|end| end.distance(at) <= reach) {
                return self.finish(document, stage);
            }
            gesture.points.push(at);
            return Ok(false);
        }
        let held = (self.tool == Tool::Select).then(|| {
            let scene = document.scene().ok()?;
            Parts::of(scene).at(at, reach).cloned()
        });
        let held = held.flatten();
        self.selected = held.as_ref().and_then(|held| Some((held.at, held.removal.clone()?)));
        if self.tool != Tool::Select || held.is_some() {
            self.gesture = Some(Gesture { points: vec![at], at, held });
        }
        Ok(false)
    }

    fn finish(&mut self, document: &mut Document, stage: Stage<'_>) -> Result<bool, String> {
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

    /// The scene that the text says.
    fn sound(&self, document: &Document) -> Result<Arc<Scene>, String> {
        document.scene().cloned().map_err(|error| format!("mend the text first: {error}"))
    }

    /// Makes the edit that a gesture says; the group that is directed then.
    fn apply(&self, edit: &mut Edit, scene: &Scene, gesture: &Gesture, stage: Stage<'_>) -> Result<usize, String> {
        let (g, brush, line) = (self.group.min(scene.groups.len().saturating_sub(1)), self.brush, &gesture.points);
        let (from, to) = (line.first().copied().unwrap_or(gesture.at), gesture.at);
        let dragged = gesture.dragged(stage.scale);
        let corners = dragged.then_some((from, to));
        let smooth = || simplified(line, 2.0 / stage.scale);
        let needs_drag = || if dragged { Ok(()) } else { Err("drag it as large as it is to be".to_owned()) };
        match self.tool {
            Tool::Hand => {}
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

    /// Adds an agent to a group, by position, or takes one out.
    ///
    /// # Errors
    /// The text has no place for it, or the scene needs them.
    pub fn more(&self, document: &mut Document, group: usize, by: i64) -> Result<bool, String> {
        let scene = self.sound(document)?;
        document.change(|edit| agents::more(edit, &scene, group, by))?;
        Ok(true)
    }

    /// Takes what is selected out of the scene; whether something was.
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
    /// How far it has gone.
    fn by(&self) -> DVec2 {
        self.at - self.points.first().copied().unwrap_or(self.at)
    }

    fn dragged(&self, scale: f64) -> bool {
        self.by().length() * scale >= CLICK || self.points.len() > 2
    }
}

/// A line without the points that lie within `tolerance` of what is left (Douglas and Peucker).
fn simplified(line: &[DVec2], tolerance: f64) -> Vec<DVec2> {
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

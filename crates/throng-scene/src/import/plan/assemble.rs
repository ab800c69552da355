//! Assembles the parts of a scene from a drawing: ground, obstacles, exits, start places.

use super::super::notes::Notes;
use super::PlanGround;
use super::chain::chain;
use super::curve::{TOLERANCE, arc};
use super::drawing::{Drawing, Item, PlanShape};
use super::layer::{KNOWN, Role};
use super::overlay::{difference, parts, wall};
use crate::error::{Error, Kind};
use crate::geometry::{DVec2, contains, points, rectangle};
use crate::scene::{Area, Circle, Obstacle, Point, Shape};
use std::collections::BTreeMap;

/// How far an exit drawn as a line reaches to both sides of it, and one drawn as a point around it, metres.
const REACH: f64 = 0.5;
/// Smaller areas of ground are dropped, m².
const SLIVER: f64 = 1e-6;

/// The parts of a plan.
#[derive(Debug, Default)]
pub(super) struct PlanParts {
    pub walkable: Vec<Area>,
    pub obstacles: Vec<Obstacle>,
    /// The corners of exits.
    pub exits: Vec<Vec<DVec2>>,
    pub starts: Vec<Start>,
    pub notes: Notes,
    /// Why its unit is likely to be wrong, if it is.
    pub doubt: Option<String>,
}

/// A start place.
#[derive(Debug)]
pub(super) struct Start {
    pub corners: Vec<DVec2>,
    /// The number of agents, if the plan gives it.
    pub people: Option<u64>,
    /// The radius of their bodies, if the plan gives it, metres.
    pub radius: Option<f64>,
}

impl PlanParts {
    /// Sorts the shapes of a drawing by their roles.
    ///
    /// # Errors
    /// Those of [`Drawing::check`]; or no layer has a known role.
    pub fn of(mut drawing: Drawing) -> Result<Self, Error> {
        drawing.check()?;
        let unknown = drawing.unknown();
        let nothing = unknown.values().sum::<usize>() == drawing.items.len();
        if nothing && !drawing.plain {
            return Err(nothing_known(&unknown));
        }
        let mut notes = std::mem::take(&mut drawing.notes);
        if !nothing {
            for (layer, count) in &drawing.unknown() {
                let shapes = if *count == 1 { "a shape".to_owned() } else { format!("{count} shapes") };
                notes.about(&format!("layer `{layer}`"), format!("{shapes} without a known role: left out"));
            }
        } else {
            drawing.items.iter_mut().for_each(|item| item.role = Some(Role::Walkable));
        }
        let mut parts = Self { notes, ..Self::default() };
        let items = joined(drawing.items);
        parts.grounds_and_places(&items);
        parts.solids(&items);
        for (at, text) in &drawing.labels {
            parts.label(*at, text);
        }
        Ok(parts)
    }

    /// Returns the ground without obstacles.
    ///
    /// # Errors
    /// There is no ground.
    pub fn ground(self) -> Result<PlanGround, Error> {
        let solids = self.obstacles.iter().flat_map(|obstacle| outlines(&obstacle.shape));
        let solids: Vec<Vec<DVec2>> = solids.collect();
        let free = if solids.is_empty() && self.walkable.len() < 2 {
            self.walkable
        } else {
            difference(&self.walkable, &solids).into_iter().filter(|area| area.size() > SLIVER).collect()
        };
        if free.is_empty() {
            let hint =
                "name the layer of the ground, drawn as closed shapes, by a word such as `walkable`, `floor` or `room`";
            let hint = self.doubt.as_deref().unwrap_or(hint);
            return Err(Error::new(Kind::Geometry, "nothing of this plan can be walked on").hint(hint));
        }
        Ok(PlanGround { areas: free.iter().map(Area::walkable).collect(), notes: self.notes.lines() })
    }

    fn grounds_and_places(&mut self, items: &[Item]) {
        for item in items {
            let layer = format!("layer `{}`", item.layer);
            match (item.role, &item.form) {
                (Some(Role::Walkable), PlanShape::Area(outer, holes)) => {
                    self.walkable
                        .push(Area { outer: plain(outer), holes: holes.iter().map(|hole| plain(hole)).collect() });
                }
                (Some(Role::Walkable), PlanShape::Disc(center, radius)) => {
                    self.walkable.push(Area { outer: plain(&disc(*center, *radius)), holes: vec![] });
                }
                (Some(Role::Walkable), _) => self.notes.about(&layer, "open lines are no ground: left out"),
                (Some(Role::Exit), PlanShape::Line(points)) => {
                    self.notes.about(&layer, format!("a line: an exit that reaches {REACH} m to both sides"));
                    self.exits.extend(points.windows(2).map(|ends| strip(ends[0], ends[1])));
                }
                (Some(Role::Exit), form) => self.exits.extend(form.region()),
                (Some(Role::Start), PlanShape::Line(_)) => {
                    self.notes.about(&layer, "open lines are no start places: left out")
                }
                (Some(Role::Start), form) => {
                    let start = |corners| Start { corners, people: item.people, radius: None };
                    self.starts.extend(form.region().map(start));
                }
                _ => {}
            }
        }
    }

    fn solids(&mut self, items: &[Item]) {
        // points that agents must reach
        let inside: Vec<DVec2> = self
            .walkable
            .iter()
            .filter_map(|area| area.outer.first())
            .map(|p| DVec2::from_array(*p))
            .chain(
                self.exits.iter().chain(self.starts.iter().map(|start| &start.corners)).map(|corners| middle(corners)),
            )
            .collect();
        let holds = |outline: &[DVec2]| inside.iter().any(|p| contains(outline, *p));
        for item in items.iter().filter(|item| item.role == Some(Role::Obstacle)) {
            let wall = |points: &[DVec2]| Shape::Wall(plain(points));
            let closed = |outline: &[DVec2]| {
                let mut points = outline.to_vec();
                points.extend(outline.first());
                wall(&points)
            };
            let shapes = match &item.form {
                PlanShape::Area(outer, holes) if holes.is_empty() && holds(outer) => vec![closed(outer)],
                PlanShape::Area(outer, holes) if holes.is_empty() => vec![Shape::Polygon(plain(outer))],
                PlanShape::Area(outer, holes) => {
                    let area = Area { outer: plain(outer), holes: holes.iter().map(|hole| plain(hole)).collect() };
                    parts(area).into_iter().map(Shape::Polygon).collect()
                }
                PlanShape::Line(points) => vec![wall(points)],
                PlanShape::Disc(center, radius) => {
                    vec![Shape::Circle(Circle { center: center.to_array(), radius: *radius })]
                }
                PlanShape::Point(_) => {
                    self.notes.about(&format!("layer `{}`", item.layer), "a point is no obstacle: left out");
                    vec![]
                }
            };
            self.obstacles.extend(shapes.into_iter().map(Obstacle::from));
        }
    }

    /// Reads a text inside a start place, as in JuPedSim's drawings: `number=20`, `radius=0.2`.
    fn label(&mut self, at: DVec2, text: &str) {
        let Some(start) = self.starts.iter_mut().find(|start| contains(&start.corners, at)) else { return };
        for said in text.split([';', ',', ' ', '\n']).flat_map(|part| part.split("\\P")) {
            let Some((key, value)) = said.split_once('=') else { continue };
            match key.trim() {
                "number" | "people" | "count" => start.people = value.trim().parse().ok().or(start.people),
                "radius" => {
                    let radius = value.trim().parse().ok().filter(|radius| (0.01..=10.0).contains(radius));
                    start.radius = radius.or(start.radius);
                }
                _ => {}
            }
        }
    }
}

impl PlanShape {
    /// Returns the ground it covers; none for lines.
    fn region(&self) -> Option<Vec<DVec2>> {
        match self {
            Self::Area(outer, _) => Some(outer.clone()),
            Self::Disc(center, radius) => Some(disc(*center, *radius)),
            Self::Point(at) => Some(disc(*at, REACH)),
            Self::Line(_) => None,
        }
    }
}

/// Returns the outlines of the solid parts of an obstacle.
fn outlines(shape: &Shape) -> Vec<Vec<DVec2>> {
    match shape {
        Shape::Circle(circle) => vec![disc(DVec2::from_array(circle.center), circle.radius)],
        Shape::Rectangle(r) => vec![rectangle(r)],
        Shape::Polygon(corners) => vec![points(corners)],
        Shape::Wall(corners) => points(corners).windows(2).map(|ends| wall(ends[0], ends[1])).collect(),
    }
}

/// Returns a layer's name in quotes, or that it has none.
fn quoted(layer: &str) -> String {
    if layer.is_empty() { "one without a name".to_owned() } else { format!("`{layer}`") }
}

fn nothing_known(unknown: &BTreeMap<&str, usize>) -> Error {
    let some: Vec<String> = unknown.keys().take(6).map(|layer| quoted(layer)).collect();
    let more = if unknown.len() > some.len() { " and others" } else { "" };
    let message = match some.as_slice() {
        [] => "this plan has no shapes".to_owned(),
        some => format!("no layer of this plan says what is on it: it has {}{more}", some.join(", ")),
    };
    Error::new(Kind::Geometry, message)
        .hint(format!("name layers by what is on them, with words that begin so: {KNOWN}"))
}

/// Joins lines of the same layer that meet.
fn joined(items: Vec<Item>) -> Vec<Item> {
    let mut lines: BTreeMap<(Option<Role>, String), Vec<Item>> = BTreeMap::new();
    let mut out = vec![];
    for item in items {
        match item.form {
            PlanShape::Line(_) => lines.entry((item.role, item.layer.clone())).or_default().push(item),
            _ => out.push(item),
        }
    }
    for ((role, layer), items) in lines {
        let Some(place) = items.first().map(|item| item.place) else { continue };
        let points = items
            .into_iter()
            .filter_map(|item| if let PlanShape::Line(points) = item.form { Some(points) } else { None });
        for (points, closed) in chain(points.collect()) {
            let form = if closed { PlanShape::Area(points, vec![]) } else { PlanShape::Line(points) };
            out.push(Item { role, layer: layer.clone(), form, place, people: None });
        }
    }
    out
}

fn plain(points: &[DVec2]) -> Vec<Point> {
    points.iter().map(DVec2::to_array).collect()
}

fn disc(center: DVec2, radius: f64) -> Vec<DVec2> {
    let mut points = arc(center, [DVec2::X * radius, DVec2::Y * radius], [0.0, std::f64::consts::TAU], TOLERANCE);
    points.pop();
    points
}

fn strip(from: DVec2, to: DVec2) -> Vec<DVec2> {
    let across = (to - from).normalize_or_zero().perp() * REACH;
    vec![from - across, to - across, to + across, from + across]
}

pub(super) fn middle(corners: &[DVec2]) -> DVec2 {
    corners.iter().sum::<DVec2>() / corners.len().max(1) as f64
}

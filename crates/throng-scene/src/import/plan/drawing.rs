//! The drawing in a file of any kind: shapes on layers, metres, y up.

use super::super::notes::Notes;
use super::layer::{Role, role};
use crate::error::{Error, Kind};
use crate::geometry::{DVec2, crossing, signed_area};
use std::collections::BTreeMap;
use std::fmt;

/// The contents of a drawing.
#[derive(Debug)]
pub(super) struct Drawing {
    pub items: Vec<Item>,
    /// Texts and their positions.
    pub labels: Vec<(DVec2, String)>,
    pub notes: Notes,
    /// Whether polygons without a known role are ground.
    pub plain: bool,
    /// The length of the unit in which the file was read, metres; 1 if it has none.
    pub unit: f64,
    /// The number of points that were added.
    points: usize,
}

/// A shape on a layer.
#[derive(Debug)]
pub(super) struct Item {
    /// The role of the shape, if known.
    pub role: Option<Role>,
    /// The name of its layer.
    pub layer: String,
    pub form: PlanShape,
    pub place: FilePosition,
    /// The number of agents that start there, if the file gives it.
    pub people: Option<u64>,
}

/// A shape.
#[derive(Clone, Debug)]
pub(super) enum PlanShape {
    /// A closed outline, the first corner not repeated, and holes.
    Area(Vec<DVec2>, Vec<Vec<DVec2>>),
    /// A line from point to point, not closed.
    Line(Vec<DVec2>),
    /// A disc.
    Disc(DVec2, f64),
    /// A point.
    Point(DVec2),
}

/// A position in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FilePosition {
    /// A line, from 1.
    Line(usize),
    /// A feature of GeoJSON, from 0.
    Feature(usize),
    /// A polygon, from 0.
    Polygon(usize),
}

impl fmt::Display for FilePosition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Feature(index) => write!(f, "features[{index}]"),
            Self::Polygon(index) => write!(f, "polygon {}", index + 1),
        }
    }
}

/// Greater coordinates, metres, are mistakes.
pub(super) const FARTHEST: f64 = 1e7;

/// How to change a unit, for hints.
pub(super) const UNIT: &str = "set the length of its unit: --plan-unit METRES, or in a scene `unit` beside the name";

/// The maximum number of points of a drawing.
const MOST: usize = 4_000_000;

impl Default for Drawing {
    fn default() -> Self {
        Self { items: vec![], labels: vec![], notes: Notes::default(), plain: false, unit: 1.0, points: 0 }
    }
}

impl Drawing {
    /// Returns an empty drawing in which polygons without a known role are ground.
    pub fn of_ground() -> Self {
        Self { plain: true, ..Self::default() }
    }

    /// Adds a shape on a layer. Shapes beyond the maximum number of points are dropped; [`Self::check`] reports them.
    pub fn add(&mut self, layer: &str, form: PlanShape, place: FilePosition) {
        self.points += form.points().len();
        if self.points > MOST {
            return;
        }
        self.items.push(Item { role: role(layer), layer: layer.to_owned(), form, place, people: None });
    }

    /// Checks that coordinates are valid, that there are not too many points, and that no outline crosses itself. Drops
    /// shapes without an extent, and closes outlines with ends that meet.
    ///
    /// # Errors
    /// One of these checks fails. The error has the layer and the position.
    pub fn check(&mut self) -> Result<(), Error> {
        for item in &self.items {
            let points = item.form.points();
            if let Some(p) = points.iter().find(|p| !p.is_finite() || p.abs().max_element() > FARTHEST) {
                let message = format!("a coordinate of ({}, {}) m is farther than {FARTHEST} m away", p.x, p.y);
                return Err(item.wrong(Kind::OutOfRange, message).hint(UNIT));
            }
        }
        if self.points > MOST {
            return Err(Error::new(Kind::OutOfRange, format!("this plan has more than {MOST} points"))
                .hint("leave out layers that people do not walk into, such as hatching"));
        }
        self.items.retain_mut(|item| item.form.tidy());
        let known = |item: &&Item| item.role.is_some() || self.plain;
        for item in self.items.iter().filter(known) {
            let PlanShape::Area(outer, holes) = &item.form else { continue };
            for ring in std::iter::once(outer).chain(holes) {
                if let Some((at, ..)) = crossing(ring) {
                    let message = format!("this outline crosses itself at ({:.3}, {:.3}) m", at.x, at.y);
                    let hint = "draw it in order along the outline";
                    return Err(item.wrong(Kind::Geometry, message).hint(hint));
                }
            }
        }
        Ok(())
    }

    /// Moves all points.
    pub fn map(&mut self, to: impl Fn(DVec2) -> DVec2) {
        self.items.iter_mut().for_each(|item| item.form.each(&to));
        for (at, _) in &mut self.labels {
            *at = to(*at);
        }
    }

    /// Returns the names of the layers without a known role, with the number of shapes on each.
    pub fn unknown(&self) -> BTreeMap<&str, usize> {
        let mut unknown = BTreeMap::new();
        for item in self.items.iter().filter(|item| item.role.is_none()) {
            *unknown.entry(item.layer.as_str()).or_default() += 1;
        }
        unknown
    }
}

impl Item {
    /// Returns an error about this shape.
    pub fn wrong(&self, kind: Kind, message: impl fmt::Display) -> Error {
        let layer = if self.layer.is_empty() { String::new() } else { format!("layer `{}`, ", self.layer) };
        let mut error = Error::new(kind, format!("{layer}{}: {message}", self.place));
        if let FilePosition::Line(line) = self.place {
            error.at = Some((line, 1));
        }
        error
    }
}

impl PlanShape {
    /// Returns a line, or an area if it is closed or its ends meet.
    pub fn of_line(mut points: Vec<DVec2>, closed: bool) -> Self {
        let ends = points.first().zip(points.last()).is_some_and(|(a, b)| points.len() > 3 && a.distance(*b) < 1e-6);
        if ends {
            points.pop();
        }
        if closed || ends { Self::Area(points, vec![]) } else { Self::Line(points) }
    }

    /// Moves all points. The new radius of a disc is its radius along x.
    pub fn each(&mut self, to: impl Fn(DVec2) -> DVec2) {
        match self {
            Self::Area(outer, holes) => outer.iter_mut().chain(holes.iter_mut().flatten()).for_each(|p| *p = to(*p)),
            Self::Line(points) => points.iter_mut().for_each(|p| *p = to(*p)),
            Self::Disc(center, radius) => {
                let rim = to(*center + DVec2::X * *radius);
                *center = to(*center);
                *radius = center.distance(rim);
            }
            Self::Point(at) => *at = to(*at),
        }
    }

    /// Returns all points; for a disc its centre and a point on its circle.
    pub fn points(&self) -> Vec<DVec2> {
        match self {
            Self::Area(outer, holes) => outer.iter().chain(holes.iter().flatten()).copied().collect(),
            Self::Line(points) => points.clone(),
            Self::Disc(center, radius) => vec![*center, *center + DVec2::X * *radius],
            Self::Point(at) => vec![*at],
        }
    }

    /// Drops repeated points. Returns whether the shape still has an extent.
    fn tidy(&mut self) -> bool {
        let ring = |ring: &mut Vec<DVec2>| {
            ring.dedup();
            while ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
            // a ring that crosses itself may have no area: keep it, it is an error
            ring.len() > 2 && (signed_area(ring).abs() > 1e-9 || crossing(ring).is_some())
        };
        match self {
            Self::Area(outer, holes) => {
                holes.retain_mut(ring);
                ring(outer)
            }
            Self::Line(points) => {
                points.dedup();
                points.len() > 1
            }
            Self::Disc(_, radius) => *radius > 0.0,
            Self::Point(_) => true,
        }
    }
}

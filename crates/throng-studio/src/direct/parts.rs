//! What of a scene can be taken with the mouse: handles, and the outlines that they belong to.

use super::{agents, fields, goals, obstacles};
use crate::document::Edit;
use glam::DVec2;
use throng_scene::{Point, Scene};
use toml_edit::{Array, Value};

/// What a drag does to the text.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// A point is moved, `rate` times as far as the pointer.
    Point {
        /// Where it stands in the text.
        path: String,
        /// What it was.
        from: Point,
        /// How far it goes with the pointer.
        rate: f64,
    },
    /// A length becomes the distance from a middle.
    Length {
        /// Where it stands in the text.
        path: String,
        /// The middle.
        center: DVec2,
    },
    /// Two sides become such that a corner is at the pointer, round a middle.
    Size {
        /// Where they stand in the text.
        path: String,
        /// The middle.
        center: DVec2,
        /// How far the rectangle is turned, degrees.
        rotation: f64,
    },
}

/// What is taken out of the text with a thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Removal {
    /// What is at a path.
    Path(String),
    /// A group; the last one stays.
    Group(usize),
    /// An agent of a group, by its position in the list of places.
    Agent(usize, usize),
}

/// What a handle looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Look {
    /// A dot.
    Dot,
    /// A small square: a corner, or a rim.
    Corner,
    /// The tip of an arrow from here.
    Arrow(DVec2),
}

/// Something that can be taken with the mouse.
#[derive(Clone, Debug, PartialEq)]
pub struct Handle {
    /// Where it is.
    pub at: DVec2,
    /// What it looks like.
    pub look: Look,
    /// What dragging it does.
    pub changes: Vec<Change>,
    /// What is taken out with it.
    pub removal: Option<Removal>,
}

/// What an outline is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A place of a group, by its position.
    Place(usize),
    /// An obstacle.
    Obstacle,
    /// A goal.
    Goal,
    /// A field.
    Field,
}

/// The outline of something.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// What it is of.
    pub kind: Kind,
    /// Its corners.
    pub points: Vec<DVec2>,
    /// Whether it goes round something.
    pub closed: bool,
    /// The handle that moves all of it.
    pub whole: Option<usize>,
}

/// All that can be taken of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// The handles.
    pub handles: Vec<Handle>,
    /// The outlines.
    pub outlines: Vec<Outline>,
}

impl Parts {
    /// Of a scene.
    pub fn of(scene: &Scene) -> Self {
        let mut parts = Self::default();
        agents::parts(scene, &mut parts);
        obstacles::parts(scene, &mut parts);
        goals::parts(scene, &mut parts);
        fields::parts(scene, &mut parts);
        parts
    }

    /// The handle at a place, or else that of the smallest thing round it.
    pub fn at(&self, at: DVec2, reach: f64) -> Option<&Handle> {
        let near = self.handles.iter().filter(|handle| handle.at.distance(at) <= reach);
        near.min_by(|a, b| a.at.distance(at).total_cmp(&b.at.distance(at))).or_else(|| {
            let round = self.outlines.iter().filter(|outline| outline.closed && inside(&outline.points, at));
            let smallest = round.min_by(|a, b| area(&a.points).total_cmp(&area(&b.points)))?;
            self.handles.get(smallest.whole?)
        })
    }

    /// Adds a handle; its position.
    pub fn handle(&mut self, at: DVec2, look: Look, changes: Vec<Change>, removal: Option<Removal>) -> usize {
        self.handles.push(Handle { at, look, changes, removal });
        self.handles.len() - 1
    }
}

impl Change {
    /// A point that goes with the pointer.
    pub fn point(path: impl Into<String>, from: Point) -> Self {
        Self::Point { path: path.into(), from, rate: 1.0 }
    }

    /// Does it: the pointer has gone `by`, and is at `to`.
    ///
    /// # Errors
    /// The path does not fit the text.
    pub fn apply(&self, edit: &mut Edit, by: DVec2, to: DVec2) -> Result<(), String> {
        match self {
            Self::Point { path, from, rate } => {
                // a point may be written `[x, y]`, or as what a table says
                let inner = format!("{path}.at");
                let path = if edit.has(&inner) { &inner } else { path };
                edit.set(path, point(DVec2::from(*from) + by * *rate))
            }
            Self::Length { path, center } => edit.set(path, length(to.distance(*center).max(0.05))),
            Self::Size { path, center, rotation } => {
                let corner = DVec2::from_angle(-rotation.to_radians()).rotate(to - *center).abs();
                edit.set(path, point((corner * 2.0).max(DVec2::splat(0.1))))
            }
        }
    }
}

/// A length as people write it: to the millimetre.
pub fn length(metres: f64) -> f64 {
    (metres * 1000.0).round() / 1000.0 + 0.0
}

/// A point as scene files have it.
pub fn point(at: DVec2) -> Value {
    Array::from_iter([length(at.x), length(at.y)]).into()
}

/// Points as scene files have them.
pub fn points(points: &[DVec2]) -> Value {
    Array::from_iter(points.iter().copied().map(point)).into()
}

fn area(corners: &[DVec2]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>().abs() * 0.5
}

fn inside(corners: &[DVec2], at: DVec2) -> bool {
    let next = corners.iter().cycle().skip(1);
    let crosses = |(a, b): (&DVec2, &DVec2)| {
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y)
    };
    corners.iter().zip(next).filter(|&pair| crosses(pair)).count() % 2 == 1
}

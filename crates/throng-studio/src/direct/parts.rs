//! The editable parts of a scene: handles, and the outlines that they belong to.

use super::{agents, fields, goals, obstacles};
use crate::document::Edit;
use glam::DVec2;
use throng_scene::{Point, Scene};
use toml_edit::{Array, Value};

/// The effect of a drag on the text.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Moves a point by `rate` times the displacement of the pointer.
    Point {
        /// The path in the text.
        path: String,
        /// The original position.
        from: Point,
        /// Displacement of the point per displacement of the pointer.
        rate: f64,
    },
    /// Sets a length to the distance from a centre.
    Length {
        /// The path in the text.
        path: String,
        /// The centre.
        center: DVec2,
    },
    /// Sets two side lengths such that a corner lies at the pointer.
    Size {
        /// The path in the text.
        path: String,
        /// The centre.
        center: DVec2,
        /// The rotation of the rectangle, degrees.
        rotation: f64,
    },
}

/// What is removed from the text with an item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Removal {
    /// The item at a path.
    Path(String),
    /// A group. The last group cannot be removed.
    Group(usize),
    /// An agent of a group, by its position in the list of places.
    Agent(usize, usize),
}

/// The appearance of a handle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Look {
    /// A dot.
    Dot,
    /// A small square on a corner or a rim.
    Corner,
    /// The tip of an arrow that starts here.
    Arrow(DVec2),
}

/// A point that the mouse can drag.
#[derive(Clone, Debug, PartialEq)]
pub struct Handle {
    /// The position.
    pub at: DVec2,
    /// The appearance.
    pub look: Look,
    /// The effects of a drag.
    pub changes: Vec<Change>,
    /// What is removed with it.
    pub removal: Option<Removal>,
}

/// What an outline belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutlineKind {
    /// The place of a group, by the position of the group.
    Place(usize),
    /// An obstacle.
    Obstacle,
    /// A goal.
    Goal,
    /// A field.
    Field,
}

/// An outline of an editable part.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// What it belongs to.
    pub kind: OutlineKind,
    /// The corners.
    pub points: Vec<DVec2>,
    /// Whether the outline is closed.
    pub closed: bool,
    /// The handle that moves the whole outline.
    pub whole: Option<usize>,
}

/// All editable parts of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// The handles.
    pub handles: Vec<Handle>,
    /// The outlines.
    pub outlines: Vec<Outline>,
}

impl Parts {
    /// Collects the parts of a scene.
    pub fn of(scene: &Scene) -> Self {
        let mut parts = Self::default();
        agents::parts(scene, &mut parts);
        obstacles::parts(scene, &mut parts);
        goals::parts(scene, &mut parts);
        fields::parts(scene, &mut parts);
        parts
    }

    /// Returns the nearest handle within `reach`, or else the handle of the smallest outline around the position.
    pub fn at(&self, at: DVec2, reach: f64) -> Option<&Handle> {
        let near = self.handles.iter().filter(|handle| handle.at.distance(at) <= reach);
        near.min_by(|a, b| a.at.distance(at).total_cmp(&b.at.distance(at))).or_else(|| {
            let round = self.outlines.iter().filter(|outline| outline.closed && inside(&outline.points, at));
            let smallest = round.min_by(|a, b| area(&a.points).total_cmp(&area(&b.points)))?;
            self.handles.get(smallest.whole?)
        })
    }

    /// Adds a handle and returns its index.
    pub fn handle(&mut self, at: DVec2, look: Look, changes: Vec<Change>, removal: Option<Removal>) -> usize {
        self.handles.push(Handle { at, look, changes, removal });
        self.handles.len() - 1
    }
}

impl Change {
    /// Returns the change of a point that moves with the pointer.
    pub fn point(path: impl Into<String>, from: Point) -> Self {
        Self::Point { path: path.into(), from, rate: 1.0 }
    }

    /// Applies the change. The pointer has moved by `by` and is at `to`.
    ///
    /// # Errors
    /// The path does not fit the text.
    pub fn apply(&self, edit: &mut Edit, by: DVec2, to: DVec2) -> Result<(), String> {
        match self {
            Self::Point { path, from, rate } => {
                // a point is written as `[x, y]` or as a table with the key `at`
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

/// Rounds a length to millimetres.
pub fn length(metres: f64) -> f64 {
    (metres * 1000.0).round() / 1000.0 + 0.0
}

/// Returns a point as a TOML value.
pub fn point(at: DVec2) -> Value {
    Array::from_iter([length(at.x), length(at.y)]).into()
}

/// Returns points as a TOML value.
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

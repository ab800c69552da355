//! What a picture is made of besides agents: shapes and type, in pixels. Pictures and SVG draw the same marks.

use crate::insect::Insect;
use crate::rounded::Rounded;
use crate::trail::Trail;
use crate::{Color, Image};
use glam::Vec2;

/// A shape or a line of type.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Mark {
    /// Filled rings of corners, even-odd: what is inside two rings is a hole.
    Area { rings: Vec<Vec<Vec2>>, fill: Color },
    /// A line through points.
    Line { points: Vec<Vec2>, closed: bool, stroke: Stroke },
    /// A filled disc.
    Disc { center: Vec2, radius: f32, fill: Color },
    /// An agent.
    Agent(Rounded),
    /// An insect.
    Insect(Insect),
    /// Streaks, which add up.
    Streaks(Vec<Trail>),
    /// Trails, none darker where they cross or meet.
    Trails(Vec<Trail>),
    /// A circle.
    Ring { center: Vec2, radius: f32, stroke: Stroke },
    /// What of some marks lies within a rectangle of whole pixels.
    Within { low: Vec2, high: Vec2, marks: Vec<Mark> },
    /// A layer over all of the picture, with its own opacity.
    Pixels(Image),
    /// A line of type.
    Text { text: String, at: Vec2, anchor: Anchor, size: f32, color: Color },
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stroke {
    pub width: f32,
    pub color: Color,
    /// Length of dashes and gaps.
    pub dash: Option<f32>,
}

impl Stroke {
    pub(crate) fn plain(width: f32, color: Color) -> Self {
        Self { width, color, dash: None }
    }
}

/// Which end of a line of type stands at its point on the baseline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// The left end.
    Start,
    /// The middle.
    Middle,
    /// The right end.
    End,
}

impl Anchor {
    /// What of its width a line of type lies left of its point.
    pub(crate) fn part(self) -> f32 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

//! What a picture is made of besides agents: shapes and type, in pixels. Pictures and SVG draw the same marks.

use crate::insect::Insect;
use crate::rounded::Rounded;
use crate::trail::Trail;
use crate::{Color, Image};
use glam::Vec2;

/// A shape or a line of type.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// Filled rings of corners, even-odd: what is inside two rings is a hole.
    Area {
        /// Closed lines.
        rings: Vec<Vec<Vec2>>,
        /// The colour inside.
        fill: Color,
    },
    /// A line through points.
    Line {
        /// From the first to the last.
        points: Vec<Vec2>,
        /// Whether it comes back to the first.
        closed: bool,
        /// How it is drawn.
        stroke: Stroke,
    },
    /// A filled disc.
    Disc {
        /// Its middle.
        center: Vec2,
        /// Its radius.
        radius: f32,
        /// Its colour.
        fill: Color,
    },
    /// An agent.
    Agent(Rounded),
    /// An insect.
    Insect(Insect),
    /// Streaks, which add up.
    Streaks(Vec<Trail>),
    /// Trails, none darker where they cross or meet.
    Trails(Vec<Trail>),
    /// A circle.
    Ring {
        /// Its middle.
        center: Vec2,
        /// Its radius.
        radius: f32,
        /// How it is drawn.
        stroke: Stroke,
    },
    /// What of some marks lies within a rectangle of whole pixels.
    Within {
        /// The upper left corner.
        low: Vec2,
        /// The lower right corner.
        high: Vec2,
        /// What is cut off at it.
        marks: Vec<Mark>,
    },
    /// A layer over all of the picture, with its own opacity.
    Pixels(Image),
    /// A line of type.
    Text {
        /// What it says.
        text: String,
        /// Where on the baseline.
        at: Vec2,
        /// Which end of it is there.
        anchor: Anchor,
        /// Size of the type.
        size: f32,
        /// Its colour.
        color: Color,
    },
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Pixels.
    pub width: f32,
    /// Its colour.
    pub color: Color,
    /// Length of dashes and gaps.
    pub dash: Option<f32>,
}

impl Stroke {
    /// Without dashes.
    pub fn plain(width: f32, color: Color) -> Self {
        Self { width, color, dash: None }
    }
}

/// Which end of a line of type stands at its point on the baseline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
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

//! Drawing primitives: shapes and type, in pixels. Raster pictures and SVG draw the same primitives.

use crate::insect::Insect;
use crate::rounded::Rounded;
use crate::trail::Trail;
use crate::{Color, Image};
use glam::Vec2;

/// A drawing primitive.
#[derive(Clone, Debug, PartialEq)]
pub enum Primitive {
    /// Filled rings of corners with the even-odd rule: the inside of two rings is a hole.
    Area {
        /// The rings, each closed.
        rings: Vec<Vec<Vec2>>,
        /// The fill colour.
        fill: Color,
    },
    /// A line through points.
    Line {
        /// The points in order.
        points: Vec<Vec2>,
        /// Whether the line returns to the first point.
        closed: bool,
        /// The stroke.
        stroke: Stroke,
    },
    /// A filled disc.
    Disc {
        /// The centre.
        center: Vec2,
        /// The radius.
        radius: f32,
        /// The colour.
        fill: Color,
    },
    /// An agent.
    Agent(Rounded),
    /// An insect.
    Insect(Insect),
    /// Streaks; their light adds up.
    Streaks(Vec<Trail>),
    /// Trails, without darkening where they cross or meet.
    Trails(Vec<Trail>),
    /// A circle.
    Ring {
        /// The centre.
        center: Vec2,
        /// The radius.
        radius: f32,
        /// The stroke.
        stroke: Stroke,
    },
    /// Primitives clipped to a rectangle of whole pixels.
    Within {
        /// The upper left corner.
        low: Vec2,
        /// The lower right corner.
        high: Vec2,
        /// The primitives.
        marks: Vec<Primitive>,
    },
    /// A layer over the whole picture, with its own opacity.
    Pixels(Image),
    /// A line of type.
    Text {
        /// The text.
        text: String,
        /// The anchor point on the baseline.
        at: Vec2,
        /// The part of the text at the anchor point.
        anchor: Anchor,
        /// The size of the type.
        size: f32,
        /// The colour.
        color: Color,
    },
}

/// The style of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The width, pixels.
    pub width: f32,
    /// The colour.
    pub color: Color,
    /// The length of dashes and gaps, pixels; `None` for a solid line.
    pub dash: Option<f32>,
}

impl Stroke {
    /// Creates a solid stroke.
    pub fn plain(width: f32, color: Color) -> Self {
        Self { width, color, dash: None }
    }
}

/// The part of a text that is placed at its point on the baseline.
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
    /// Returns the share of the text's width to the left of its point.
    pub(crate) fn part(self) -> f32 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

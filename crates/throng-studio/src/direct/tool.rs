//! The tools: what the first button of the mouse does in the view.

use eframe::egui::Key;

/// What the first button of the mouse does in the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Moves the view, and selects agents.
    #[default]
    Hand,
    /// Moves what is in the scene.
    Select,
    /// Adds agents.
    Agents,
    /// A polygon, corner by corner.
    Polygon,
    /// A round obstacle, from its middle to its rim.
    Disc,
    /// A rectangle, from corner to corner.
    Rectangle,
    /// A wall, corner by corner.
    Wall,
    /// Where the group goes.
    Goal,
    /// Where the group leaves.
    Exit,
    /// A velocity at a place.
    Anchor,
    /// A line that the group goes along.
    Stroke,
    /// A whirl.
    Vortex,
    /// A place that all go away from.
    Source,
    /// A place that all go to.
    Sink,
    /// Away along x, to it along y.
    Saddle,
    /// Paints a way.
    Brush,
    /// Rubs out what was sketched and painted.
    Eraser,
}

impl Tool {
    /// All of them, as they are used: looking, who is there, what is in the way, where to, fields.
    pub const GROUPS: [&[Self]; 5] = [
        &[Self::Hand, Self::Select],
        &[Self::Agents],
        &[Self::Polygon, Self::Rectangle, Self::Disc, Self::Wall],
        &[Self::Goal, Self::Exit],
        &[Self::Anchor, Self::Stroke, Self::Vortex, Self::Source, Self::Sink, Self::Saddle, Self::Brush, Self::Eraser],
    ];

    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::GROUPS.into_iter().flatten().copied()
    }

    /// The key that takes it, that key in words, and what it does.
    pub fn says(self) -> (Key, &'static str, &'static str) {
        match self {
            Self::Hand => (Key::Escape, "Esc", "look: drag the view, click an agent"),
            Self::Select => (Key::V, "V", "move: drag what is in the scene; Delete takes it out"),
            Self::Agents => (Key::P, "P", "people: click for one, drag for many"),
            Self::Polygon => (Key::O, "O", "obstacle: click its corners, then the first again"),
            Self::Rectangle => (Key::B, "B", "block: drag from corner to corner"),
            Self::Disc => (Key::K, "K", "pillar: drag from its middle to its rim"),
            Self::Wall => (Key::L, "L", "wall: click its corners, the last one twice"),
            Self::Goal => (Key::J, "J", "goal of the group: click a point, or drag an area"),
            Self::Exit => (Key::X, "X", "exit of the group: click, or drag an area"),
            Self::Anchor => (Key::N, "N", "anchor: drag a velocity"),
            Self::Stroke => (Key::M, "M", "stroke: drag a line to go along"),
            Self::Vortex => (Key::Num1, "1", "vortex: drag from its middle to its rim"),
            Self::Source => (Key::Num2, "2", "source: drag from its middle to its rim"),
            Self::Sink => (Key::Num3, "3", "sink: drag from its middle to its rim"),
            Self::Saddle => (Key::Num4, "4", "saddle: drag from its middle to its rim"),
            Self::Brush => (Key::Q, "Q", "brush: paint a way"),
            Self::Eraser => (Key::Num0, "0", "eraser: rub out what was sketched and painted"),
        }
    }

    /// The tool that a key takes.
    pub fn of_key(key: Key) -> Option<Self> {
        Self::all().find(|tool| tool.says().0 == key)
    }

    /// Whether it goes from click to click, not along a drag.
    pub fn clicks(self) -> bool {
        matches!(self, Self::Polygon | Self::Wall)
    }

    /// Whether it has a brush.
    pub fn brushes(self) -> bool {
        matches!(self, Self::Brush | Self::Eraser)
    }

    /// Whether it needs a group to work for.
    pub fn directs(self) -> bool {
        matches!(self, Self::Agents | Self::Goal | Self::Exit) || Self::GROUPS[4].contains(&self)
    }
}

//! The tools of the primary mouse button in the view.

use eframe::egui::Key;

/// The tool of the primary mouse button in the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Moves the view and selects agents.
    #[default]
    Hand,
    /// Moves items of the scene.
    Select,
    /// Adds agents.
    Agents,
    /// Adds a polygon, corner by corner.
    Polygon,
    /// Adds a round obstacle, from its centre to its rim.
    Disc,
    /// Adds a rectangle, from corner to corner.
    Rectangle,
    /// Adds a wall, corner by corner.
    Wall,
    /// Sets the goal of the group.
    Goal,
    /// Sets the exit of the group.
    Exit,
    /// Adds a velocity at a position.
    Anchor,
    /// Adds a line that the group follows.
    Stroke,
    /// Adds a vortex.
    Vortex,
    /// Adds a source: velocities point away from it.
    Source,
    /// Adds a sink: velocities point towards it.
    Sink,
    /// Adds a saddle: velocities point away from it along x and towards it along y.
    Saddle,
    /// Paints velocities.
    Brush,
    /// Erases sketched and painted parts.
    Eraser,
}

impl Tool {
    /// All tools in groups: view, agents, obstacles, goals, fields.
    pub const GROUPS: [&[Self]; 5] = [
        &[Self::Hand, Self::Select],
        &[Self::Agents],
        &[Self::Polygon, Self::Rectangle, Self::Disc, Self::Wall],
        &[Self::Goal, Self::Exit],
        &[Self::Anchor, Self::Stroke, Self::Vortex, Self::Source, Self::Sink, Self::Saddle, Self::Brush, Self::Eraser],
    ];

    /// All tools.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::GROUPS.into_iter().flatten().copied()
    }

    /// Returns the key of the tool, the label of the key, and the description of the tool.
    pub fn says(self) -> (Key, &'static str, &'static str) {
        match self {
            Self::Hand => (Key::Escape, "Esc", "view: drag to move it, click an agent to select it"),
            Self::Select => (Key::V, "V", "move: drag items of the scene; Delete removes the selected item"),
            Self::Agents => (Key::P, "P", "agents: click to add one, drag to add many"),
            Self::Polygon => (Key::O, "O", "obstacle: click its corners, then the first again"),
            Self::Rectangle => (Key::B, "B", "block: drag from corner to corner"),
            Self::Disc => (Key::K, "K", "pillar: drag from its centre to its rim"),
            Self::Wall => (Key::L, "L", "wall: click its corners, the last one twice"),
            Self::Goal => (Key::J, "J", "goal of the group: click a point, or drag an area"),
            Self::Exit => (Key::X, "X", "exit of the group: click, or drag an area"),
            Self::Anchor => (Key::N, "N", "anchor: drag a velocity"),
            Self::Stroke => (Key::M, "M", "stroke: drag a line to follow"),
            Self::Vortex => (Key::Num1, "1", "vortex: drag from its centre to its rim"),
            Self::Source => (Key::Num2, "2", "source: drag from its centre to its rim"),
            Self::Sink => (Key::Num3, "3", "sink: drag from its centre to its rim"),
            Self::Saddle => (Key::Num4, "4", "saddle: drag from its centre to its rim"),
            Self::Brush => (Key::Q, "Q", "brush: paint velocities along a line"),
            Self::Eraser => (Key::Num0, "0", "eraser: erase sketched and painted parts"),
        }
    }

    /// Returns the tool that a key selects.
    pub fn of_key(key: Key) -> Option<Self> {
        Self::all().find(|tool| tool.says().0 == key)
    }

    /// Whether the tool works click by click instead of along a drag.
    pub fn clicks(self) -> bool {
        matches!(self, Self::Polygon | Self::Wall)
    }

    /// Whether the tool uses the brush.
    pub fn brushes(self) -> bool {
        matches!(self, Self::Brush | Self::Eraser)
    }

    /// Whether the tool edits a group.
    pub fn directs(self) -> bool {
        matches!(self, Self::Agents | Self::Goal | Self::Exit) || Self::GROUPS[4].contains(&self)
    }
}

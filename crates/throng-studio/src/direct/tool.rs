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
    /// Moves an agent of the running scene.
    Grab,
    /// Leads an agent of the running scene.
    Lead,
    /// Drives agents of the running scene away.
    Push,
    /// Adds agents to the running scene.
    Crowd,
    /// Puts a wall into the running scene.
    Barrier,
    /// Opens and closes obstacles of the running scene.
    Door,
    /// Gives a group of the running scene another goal.
    Send,
}

impl Tool {
    /// All tools in groups: view, agents, obstacles, goals, fields, running scene.
    pub const GROUPS: [&[Self]; 6] = [
        &[Self::Hand, Self::Select],
        &[Self::Agents],
        &[Self::Polygon, Self::Rectangle, Self::Disc, Self::Wall],
        &[Self::Goal, Self::Exit],
        &[Self::Anchor, Self::Stroke, Self::Vortex, Self::Source, Self::Sink, Self::Saddle, Self::Brush, Self::Eraser],
        &[Self::Grab, Self::Lead, Self::Push, Self::Crowd, Self::Barrier, Self::Door, Self::Send],
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
            Self::Grab => (Key::Num5, "5", "grab: drag an agent of the running scene"),
            Self::Lead => (Key::Num6, "6", "lead: press on an agent, and it follows the pointer, such as a predator"),
            Self::Push => (Key::Num7, "7", "drive away: agents move away from the pressed pointer"),
            Self::Crowd => (Key::Num8, "8", "crowd: click to drop agents into the running scene"),
            Self::Barrier => (Key::Num9, "9", "barrier: drag a wall into the running scene"),
            Self::Door => (Key::Y, "Y", "door: click an obstacle to open it, and again to close it"),
            Self::Send => (Key::Z, "Z", "send: click a new goal for the group of the running scene"),
        }
    }

    /// Returns the tool that a key selects.
    pub fn of_key(key: Key) -> Option<Self> {
        Self::all().find(|tool| tool.says().0 == key)
    }

    /// Whether a gesture of the tool has a size that can be typed: a length, or two sides.
    pub fn has_size(self) -> bool {
        matches!(
            self,
            Self::Polygon | Self::Wall | Self::Disc | Self::Vortex | Self::Source | Self::Sink | Self::Saddle
        ) || self.spans()
    }

    /// Whether a gesture of the tool spans a rectangle.
    pub fn spans(self) -> bool {
        matches!(self, Self::Rectangle | Self::Goal | Self::Exit)
    }

    /// Whether gestures of the tool snap.
    pub fn snaps(self) -> bool {
        self.has_size() || matches!(self, Self::Select | Self::Anchor)
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
        matches!(self, Self::Agents | Self::Goal | Self::Exit | Self::Crowd | Self::Send)
            || Self::GROUPS[4].contains(&self)
    }

    /// Whether the tool changes the running scene instead of the text.
    pub fn intervenes(self) -> bool {
        Self::GROUPS[5].contains(&self)
    }
}

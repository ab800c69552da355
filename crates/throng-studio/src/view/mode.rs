//! Camera modes.

use throng_draw::Chase;

/// A camera mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Mode {
    /// From straight above, to scale.
    #[default]
    Plan,
    /// From a point on a sphere around the target.
    Orbit,
    /// Behind the selected agent, at a fixed distance.
    Distance,
    /// At a fixed offset in the frame of the selected agent.
    Offset,
    /// From the position of the selected agent, in its direction.
    PointOfView,
    /// From above the selected agent.
    Down,
}

impl Mode {
    /// All modes, in the order in which the key C selects them.
    pub const ALL: [Self; 6] = [Self::Plan, Self::Orbit, Self::Distance, Self::Offset, Self::PointOfView, Self::Down];

    /// Returns the label.
    pub fn label(self) -> &'static str {
        match self {
            Self::Plan => "plan",
            Self::Orbit => "orbit",
            Self::Distance => "fixed distance",
            Self::Offset => "local offset",
            Self::PointOfView => "point of view",
            Self::Down => "straight down",
        }
    }

    /// Returns how the camera follows an agent, `None` if it follows none.
    pub fn chase(self) -> Option<Chase> {
        match self {
            Self::Plan | Self::Orbit => None,
            Self::Distance => Some(Chase::Distance),
            Self::Offset => Some(Chase::Offset),
            Self::PointOfView => Some(Chase::PointOfView),
            Self::Down => Some(Chase::Down),
        }
    }

    /// Whether the camera follows an agent.
    pub fn follows(self) -> bool {
        self.chase().is_some()
    }

    /// Returns the next mode.
    pub fn next(self) -> Self {
        let now = Self::ALL.iter().position(|&mode| mode == self).unwrap_or_default();
        Self::ALL[(now + 1) % Self::ALL.len()]
    }
}

impl std::str::FromStr for Mode {
    type Err = String;

    /// Parses a label, with `-` for spaces.
    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|mode| mode.label() == name.replace('-', " "));
        found.ok_or_else(|| {
            let all = Self::ALL.map(Self::label).join(", ");
            format!("there is no camera `{name}`: {all}")
        })
    }
}

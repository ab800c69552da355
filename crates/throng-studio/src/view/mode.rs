//! Ways of looking at the world.

use throng_draw::Chase;

/// How the world is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Mode {
    /// From straight above, true to scale.
    #[default]
    Plan,
    /// From a point that goes round what it looks at.
    Orbit,
    /// Behind the selected agent, drawn along at a fixed distance.
    Distance,
    /// At a fixed place beside the selected agent: it turns with it.
    Offset,
    /// With the eyes of the selected agent.
    PointOfView,
    /// From above the selected agent.
    Down,
}

impl Mode {
    /// All of them, in the order in which `c` goes through them.
    pub const ALL: [Self; 6] = [Self::Plan, Self::Orbit, Self::Distance, Self::Offset, Self::PointOfView, Self::Down];

    /// What it is called.
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

    /// How it goes with an agent; `None` where it looks at no one.
    pub fn chase(self) -> Option<Chase> {
        match self {
            Self::Plan | Self::Orbit => None,
            Self::Distance => Some(Chase::Distance),
            Self::Offset => Some(Chase::Offset),
            Self::PointOfView => Some(Chase::PointOfView),
            Self::Down => Some(Chase::Down),
        }
    }

    /// Whether it looks at an agent.
    pub fn follows(self) -> bool {
        self.chase().is_some()
    }

    /// The next one.
    pub fn next(self) -> Self {
        let now = Self::ALL.iter().position(|&mode| mode == self).unwrap_or_default();
        Self::ALL[(now + 1) % Self::ALL.len()]
    }
}

impl std::str::FromStr for Mode {
    type Err = String;

    /// What it is called.
    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|mode| mode.label() == name.replace('-', " "));
        found.ok_or_else(|| {
            let all = Self::ALL.map(Self::label).join(", ");
            format!("there is no camera `{name}`: {all}")
        })
    }
}

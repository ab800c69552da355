//! What agents have in mind, drawn beside them: thin quiet lines, and a key that says what they are.

mod key;
mod layers;
mod pen;

pub(crate) use key::{Row, key, rows};
pub use layers::Annotator;

use crate::{Color, Theme};
use throng::Asked;
use throng::steer::Reason;
use throng_record::{Body, Frame};

/// One of the things that can be drawn beside agents, in the order in which they are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Annotation {
    /// How far they look, and whom they see.
    Neighbourhoods,
    /// Where they have been for the last ten seconds.
    Trails,
    /// The paths they follow.
    Paths,
    /// What they feel their way along.
    Feelers,
    /// Where they expect others, or themselves, to be.
    Predictions,
    /// Where they aim at.
    Targets,
    /// Who will come too near, and where the two will be then.
    Threats,
    /// The velocity they would like: the way of half a second.
    Preferred,
    /// The velocity they have: the way of half a second.
    Velocity,
    /// The force they steer by, over their mass: a metre for every 4 m/s².
    Force,
}

impl Annotation {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Neighbourhoods,
        Self::Trails,
        Self::Paths,
        Self::Feelers,
        Self::Predictions,
        Self::Targets,
        Self::Threats,
        Self::Preferred,
        Self::Velocity,
        Self::Force,
    ];

    /// What it is called in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Neighbourhoods => "neighbourhoods",
            Self::Trails => "trails",
            Self::Paths => "paths",
            Self::Feelers => "feelers",
            Self::Predictions => "predictions",
            Self::Targets => "targets",
            Self::Threats => "threats",
            Self::Preferred => "preferred",
            Self::Velocity => "velocity",
            Self::Force => "force",
        }
    }

    /// What the key says.
    pub fn says(self) -> &'static str {
        match self {
            Self::Preferred => "preferred velocity",
            Self::Force => "steering force",
            kind => kind.name(),
        }
    }

    /// Its colour; the colour of the agent where it is the agent's.
    pub fn color(self, theme: &Theme) -> Color {
        match self {
            Self::Neighbourhoods => theme.quiet.alpha(0.5),
            Self::Trails | Self::Velocity => theme.quiet,
            Self::Paths => theme.goal,
            Self::Feelers => Color::rgb(0x2fa37c),
            Self::Predictions => Color::rgb(0x8f65b0),
            Self::Targets => Color::rgb(0x4a7bc8),
            Self::Threats => Color::rgb(0xc8372d),
            Self::Preferred => Color::rgb(0x2b94a6),
            Self::Force => Color::rgb(0xdd7a1f),
        }
    }

    /// How thick its lines are, in units of the layout.
    fn width(self) -> f32 {
        match self {
            Self::Neighbourhoods => 0.7,
            Self::Preferred | Self::Velocity | Self::Force => 1.4,
            _ => 1.0,
        }
    }

    /// Whether its lines are dashed: what is not there, or not yet.
    pub fn is_dashed(self) -> bool {
        matches!(self, Self::Paths | Self::Preferred | Self::Predictions)
    }

    /// Whether what is told is of this kind.
    fn shows(self, reason: &Reason) -> bool {
        match reason {
            Reason::Looks { distance, .. } => self == Self::Neighbourhoods && distance.is_finite(),
            Reason::Regards(_) => self == Self::Neighbourhoods,
            Reason::Via(_) => self == Self::Paths,
            Reason::Feels(_) => self == Self::Feelers,
            Reason::Expects(_) => self == Self::Predictions,
            Reason::Aim(_) => self == Self::Targets,
            Reason::Threat { .. } => self == Self::Threats,
            Reason::Wishes(_) => self == Self::Preferred,
            _ => false,
        }
    }

    /// Whether anything of this kind is in a frame.
    fn is_in(self, frame: &Frame) -> bool {
        let accounts = || frame.accounts.iter();
        match self {
            Self::Trails | Self::Velocity => !frame.bodies.is_empty(),
            Self::Preferred => accounts().next().is_some(),
            Self::Force => accounts().any(|account| account.steering != glam::Vec3::ZERO),
            _ => accounts().any(|account| account.told.iter().any(|told| self.shows(&told.reason))),
        }
    }
}

/// What is drawn beside whom.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Annotations {
    /// What.
    pub kinds: Vec<Annotation>,
    /// Beside whom, by number; `None`: everybody.
    pub agents: Option<Vec<u32>>,
}

impl Annotations {
    /// Who must be asked for it ([`throng::World::ask`]).
    pub fn asked(&self) -> Asked {
        match &self.agents {
            _ if self.kinds.is_empty() => Asked::Nobody,
            None => Asked::Everybody,
            Some(numbers) => Asked::Numbers(numbers.clone()),
        }
    }

    /// Whether something is drawn beside this one.
    pub(crate) fn concern(&self, body: &Body) -> bool {
        !self.kinds.is_empty() && self.agents.as_ref().is_none_or(|numbers| numbers.contains(&body.number))
    }

    /// The kinds that are asked for and that there is something of in a frame.
    pub fn in_frame(&self, frame: &Frame) -> impl Iterator<Item = Annotation> {
        self.kinds.iter().copied().filter(|kind| kind.is_in(frame))
    }
}

//! Annotations: thin lines beside agents that show what they perceive and choose, and the key of these lines.

mod key;
mod layers;
mod pen;

pub(crate) use key::{Row, key, rows};
pub use layers::Annotator;

use crate::{Color, Theme};
use throng::TraceRequest;
use throng::steer::SteeringReason;
use throng_record::{Body, Frame};

/// A kind of annotation, in drawing order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Annotation {
    /// The distance that an agent perceives, and the agents it perceives.
    Neighbourhoods,
    /// The agent's positions of the last ten seconds.
    Trails,
    /// The path that the agent follows.
    Paths,
    /// The feelers for obstacles.
    Feelers,
    /// Predicted positions of other agents, or of the agent itself.
    Predictions,
    /// The points that the agent aims at.
    Targets,
    /// Agents that will come too near, with the predicted positions of both.
    Threats,
    /// The preferred velocity, as the motion in half a second.
    Preferred,
    /// The velocity, as the motion in half a second.
    Velocity,
    /// The steering force per mass: 1 m of arrow for 4 m/s².
    Force,
}

impl Annotation {
    /// All kinds.
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

    /// Returns the name in files and on the command line.
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

    /// Returns the text of the key.
    pub fn says(self) -> &'static str {
        match self {
            Self::Preferred => "preferred velocity",
            Self::Force => "steering force",
            kind => kind.name(),
        }
    }

    /// Returns the colour; trails use the colour of the agent instead.
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

    /// Returns the width of lines, in units of the layout.
    fn width(self) -> f32 {
        match self {
            Self::Neighbourhoods => 0.7,
            Self::Preferred | Self::Velocity | Self::Force => 1.4,
            _ => 1.0,
        }
    }

    /// Whether lines are dashed: they show something planned or predicted.
    pub fn is_dashed(self) -> bool {
        matches!(self, Self::Paths | Self::Preferred | Self::Predictions)
    }

    /// Whether a reason belongs to this kind.
    fn shows(self, reason: &SteeringReason) -> bool {
        match reason {
            SteeringReason::Looks { distance, .. } => self == Self::Neighbourhoods && distance.is_finite(),
            SteeringReason::Regards(_) => self == Self::Neighbourhoods,
            SteeringReason::Via(_) => self == Self::Paths,
            SteeringReason::Feels(_) => self == Self::Feelers,
            SteeringReason::Expects(_) => self == Self::Predictions,
            SteeringReason::Aim(_) => self == Self::Targets,
            SteeringReason::Threat { .. } => self == Self::Threats,
            SteeringReason::Wishes(_) => self == Self::Preferred,
            _ => false,
        }
    }

    /// Whether a frame has something of this kind.
    fn is_in(self, frame: &Frame) -> bool {
        let accounts = || frame.accounts.iter();
        match self {
            Self::Trails | Self::Velocity => !frame.bodies.is_empty(),
            Self::Preferred => accounts().next().is_some(),
            Self::Force => accounts().any(|account| account.steering != glam::Vec3::ZERO),
            _ => accounts().any(|account| account.entries.iter().any(|told| self.shows(&told.reason))),
        }
    }
}

/// The annotations to draw, and the agents to draw them for.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Annotations {
    /// The kinds.
    pub kinds: Vec<Annotation>,
    /// The numbers of the agents; `None` for all agents.
    pub agents: Option<Vec<u32>>,
}

impl Annotations {
    /// Returns the agents to request traces of ([`throng::World::request_traces`]).
    pub fn asked(&self) -> TraceRequest {
        match &self.agents {
            _ if self.kinds.is_empty() => TraceRequest::None,
            None => TraceRequest::All,
            Some(numbers) => TraceRequest::Numbers(numbers.clone()),
        }
    }

    /// Whether something is drawn for this body.
    pub(crate) fn concern(&self, body: &Body) -> bool {
        !self.kinds.is_empty() && self.agents.as_ref().is_none_or(|numbers| numbers.contains(&body.number))
    }

    /// Returns the requested kinds that a frame has something of.
    pub fn in_frame(&self, frame: &Frame) -> impl Iterator<Item = Annotation> {
        self.kinds.iter().copied().filter(|kind| kind.is_in(frame))
    }
}

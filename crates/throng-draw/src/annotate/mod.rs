//! Annotations: thin lines beside agents that show what they perceive and choose, and the key of these lines.

mod constructions;
mod key;
mod layers;
mod obstacles;
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
    /// The path or the wall that the agent follows: the stretch ahead, its width, and the nearest point on it.
    Paths,
    /// The circles and rectangles with which behaviours construct their targets: wander's two circles, the slowing
    /// circle, the leader's rectangle, a place in a formation.
    Constructions,
    /// The feelers for obstacles, and the cylinder that the agent will sweep.
    Feelers,
    /// The velocity of the field that the agent follows, at the place where the agent reads it.
    Flow,
    /// Predicted positions of other agents, or of the agent itself.
    Predictions,
    /// The points that the agent aims at, and those that it moves away from.
    Targets,
    /// Agents that will come too near, with the predicted positions of both, and the most threatening obstacle.
    Threats,
    /// The velocities that neighbours and walls forbid, as the motion in one second: velocity obstacles and half-planes.
    VelocityObstacles,
    /// The preferred velocity, as the motion in half a second.
    Preferred,
    /// The velocity, as the motion in half a second.
    Velocity,
    /// The terms of the steering force per mass, head to tail: 1 m of arrow for 4 m/s².
    Terms,
    /// The steering force per mass: 1 m of arrow for 4 m/s².
    Force,
}

impl Annotation {
    /// All kinds.
    pub const ALL: [Self; 14] = [
        Self::Neighbourhoods,
        Self::Trails,
        Self::Paths,
        Self::VelocityObstacles,
        Self::Constructions,
        Self::Feelers,
        Self::Flow,
        Self::Predictions,
        Self::Targets,
        Self::Threats,
        Self::Preferred,
        Self::Velocity,
        Self::Terms,
        Self::Force,
    ];

    /// Returns the name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Neighbourhoods => "neighbourhoods",
            Self::Trails => "trails",
            Self::Paths => "paths",
            Self::VelocityObstacles => "velocity_obstacles",
            Self::Constructions => "constructions",
            Self::Feelers => "feelers",
            Self::Flow => "flow",
            Self::Predictions => "predictions",
            Self::Targets => "targets",
            Self::Threats => "threats",
            Self::Preferred => "preferred",
            Self::Velocity => "velocity",
            Self::Terms => "terms",
            Self::Force => "force",
        }
    }

    /// Returns the text of the key.
    pub fn says(self) -> &'static str {
        match self {
            Self::VelocityObstacles => "velocity obstacles",
            Self::Flow => "flow at the place where it is read",
            Self::Preferred => "preferred velocity",
            Self::Terms => "terms of the steering force",
            Self::Force => "steering force",
            kind => kind.name(),
        }
    }

    /// Returns the colour, with a contrast with the ground; trails use the colour of the agent instead.
    pub fn color(self, theme: &Theme) -> Color {
        let color = match self {
            Self::Neighbourhoods | Self::Trails | Self::Velocity => theme.quiet,
            Self::Paths => theme.goal,
            Self::Constructions => Color::rgb(0xb0547f),
            Self::Feelers => Color::rgb(0x2fa37c),
            Self::Flow => Color::rgb(0x5b7f2c),
            Self::Predictions => Color::rgb(0x8f65b0),
            Self::Targets => Color::rgb(0x4a7bc8),
            Self::Threats | Self::VelocityObstacles => Color::rgb(0xc8372d),
            Self::Preferred => Color::rgb(0x2b94a6),
            Self::Terms | Self::Force => Color::rgb(0xdd7a1f),
        };
        theme.ink(color)
    }

    /// Returns the width of lines, in units of the layout.
    fn width(self) -> f32 {
        match self {
            Self::Neighbourhoods => 0.7,
            Self::Preferred | Self::Velocity | Self::Flow | Self::Force => 1.4,
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
            SteeringReason::Via(_) | SteeringReason::Stretch { .. } | SteeringReason::Projects { .. } => {
                self == Self::Paths
            }
            SteeringReason::Circle { .. } | SteeringReason::Rectangle(_) => self == Self::Constructions,
            SteeringReason::Feels(_) | SteeringReason::Cylinder { .. } => self == Self::Feelers,
            SteeringReason::Samples { .. } => self == Self::Flow,
            SteeringReason::Expects { .. } => self == Self::Predictions,
            SteeringReason::Aim(_) | SteeringReason::Shuns(_) => self == Self::Targets,
            SteeringReason::Threat { .. } | SteeringReason::Hits { .. } => self == Self::Threats,
            SteeringReason::Wishes(_) => self == Self::Preferred,
            SteeringReason::Adds(_) => self == Self::Terms,
            _ => false,
        }
    }

    /// Whether a frame has something of this kind.
    fn is_in(self, frame: &Frame) -> bool {
        let accounts = || frame.accounts.iter();
        match self {
            Self::Trails | Self::Velocity => !frame.bodies.is_empty(),
            Self::Preferred => accounts().next().is_some(),
            Self::VelocityObstacles => frame.explanations.iter().any(|why| !why.reasons.is_empty()),
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

    /// Returns the agents of which the forbidden velocities are drawn ([`throng_record::moment::explain`]).
    pub fn explained(&self) -> TraceRequest {
        if self.kinds.contains(&Annotation::VelocityObstacles) { self.asked() } else { TraceRequest::None }
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

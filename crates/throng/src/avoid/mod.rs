//! What is safe: local models turn the preferred velocity into a new one.
//!
//! A model is one file implementing [`LocalModel`]. It sees one agent and what is near it, frozen at the start of
//! the step, and answers with a velocity; it keeps no state. What it answers need not be safe: the
//! [guard](crate::guard) makes it so.

mod anticipation_velocity;
mod avo;
mod clearpath;
mod collision;
mod collision_free_speed;
mod descent;
mod explain;
mod forbidden;
mod half_plane;
mod half_space;
mod hrvo;
mod imminence;
mod moussaid;
mod none;
mod obstacle_lines;
mod orca;
mod orca_3d;
mod orca_lanes;
mod outline;
mod power_law;
mod rvo;
mod rvo_lab;
mod sampling;
mod separation;
mod social_force;
mod turning;
mod vo;

pub use anticipation_velocity::AnticipationVelocity;
pub use avo::Avo;
pub use clearpath::{ClearPath, closest_outside};
pub(crate) use collision::times_to_discs;
pub use collision::{time_to_disc, time_to_segment};
pub use collision_free_speed::CollisionFreeSpeed;
pub use explain::{Cause, Reason};
pub use forbidden::Forbidden;
use forbidden::Piece;
pub use half_plane::{Line, closest_velocity, least_violation};
pub use half_space::{Plane, closest_velocity_in_space, least_violation_in_space};
pub use hrvo::Hrvo;
pub use moussaid::Moussaid2009;
pub use none::Unavoiding;
pub use orca::{BuiltFrom, Orca};
pub use orca_3d::Orca3d;
pub(crate) use orca_lanes::{MOST, MOST_WALLS, MOST_WITH_WALLS, Others, Own, Views, choose};
pub use outline::Outline;
pub use power_law::PowerLaw;
pub use rvo::Rvo;
pub use rvo_lab::RvoLab;
pub use sampling::Search;
pub use social_force::SocialForce;
pub use vo::Vo;

pub use crate::random::Dice;
use crate::space::{Disc, Edge};
use glam::{Vec2, Vec3};

/// Another agent, seen from the one that chooses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// Its centre, from the choosing agent's.
    pub offset: Vec2,
    /// How much higher its centre is.
    pub above: f32,
    /// Its velocity upwards.
    pub climb: f32,
    /// Its velocity.
    pub velocity: Vec2,
    /// The velocity it would like to have.
    pub preferred: Vec2,
    /// Sum of the two radii, with the margin that the model keeps (see [`MARGIN`]).
    pub radii: f32,
    /// What lies within `radii` of this polygon round `offset` touches; a point for two discs.
    pub outline: Outline,
    /// The choosing agent's share of the avoiding, 0 (none) to 1 (all).
    pub share: f32,
    /// The choosing agent's part of the room that is left while the two are on no collision course, 0 to 1. Who
    /// has the right of way avoids little and has most of the room; with someone who doesn't avoid, both are 1.
    pub room: f32,
    /// A unit vector for two agents in exactly one place; the other sees its opposite.
    pub aside: Vec2,
}

impl Neighbour {
    /// Something that stands and does not avoid.
    pub(crate) fn resting(offset: Vec2, radii: f32) -> Self {
        Self {
            offset,
            above: 0.0,
            climb: 0.0,
            velocity: Vec2::ZERO,
            preferred: Vec2::ZERO,
            radii,
            outline: Outline::POINT,
            share: 1.0,
            room: 1.0,
            aside: Vec2::X,
        }
    }
}

/// A wall edge near the choosing agent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearEdge {
    /// Its start, from the agent's centre.
    pub start: Vec2,
    /// Its end, from the agent's centre.
    pub end: Vec2,
    /// The edge.
    pub edge: Edge,
}

/// A solid disc near the choosing agent; near one that is no disc, a wall edge too, as a disc without radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearDisc {
    /// Its centre, from the agent's.
    pub offset: Vec2,
    /// The disc.
    pub disc: Disc,
    /// What lies within both radii of this polygon round `offset` touches; a point for an agent that is a disc.
    pub outline: Outline,
}

/// What a model sees: one agent and what is near it. The default is a pedestrian that stands alone.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// Current velocity.
    pub velocity: Vec2,
    /// Direction of the body, radians counter-clockwise from +x.
    pub heading: f32,
    /// Velocity it would like to have.
    pub preferred: Vec2,
    /// Current velocity upwards.
    pub climb: f32,
    /// Velocity upwards that it would like to have.
    pub preferred_climb: f32,
    /// Radius of the body.
    pub radius: f32,
    /// Speed not to exceed.
    pub max_speed: f32,
    /// Greatest change of velocity a second; infinite for none.
    pub max_acceleration: f32,
    /// How far off the way it chose the body may get while it turns, metres; 0: it moves in any direction at once.
    /// See [`Agent::tracking_error`](crate::Agent::tracking_error).
    pub tracking_error: f32,
    /// Greatest change of heading a second; infinite for none.
    pub max_turn_rate: f32,
    /// By what factor the radii of neighbours are larger than those of the bodies.
    pub margin: f32,
    /// Seconds until it can choose again.
    pub step: f32,
    /// Others, nearest first.
    pub neighbours: &'a [Neighbour],
    /// Wall edges within [`LocalModel::wall_range`], nearest first.
    pub edges: &'a [NearEdge],
    /// Solid discs within [`LocalModel::wall_range`], nearest first.
    pub discs: &'a [NearDisc],
    /// What random numbers depend on, for models that draw some.
    pub dice: Dice,
}

impl Default for View<'_> {
    fn default() -> Self {
        Self {
            velocity: Vec2::ZERO,
            heading: 0.0,
            preferred: Vec2::ZERO,
            climb: 0.0,
            preferred_climb: 0.0,
            radius: 0.2,
            max_speed: 1.8,
            max_acceleration: 5.0,
            tracking_error: 0.0,
            max_turn_rate: f32::INFINITY,
            margin: 1.0,
            step: 0.02,
            neighbours: &[],
            edges: &[],
            discs: &[],
            dice: Dice::default(),
        }
    }
}

/// Memory that models use while they choose; kept from agent to agent so that a step allocates nothing.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    /// Half-planes of permitted velocities.
    pub lines: Vec<Line>,
    /// Half-planes of the fallback.
    pub fallback: Vec<Line>,
    /// Half-spaces of permitted velocities.
    pub planes: Vec<Plane>,
    /// Half-spaces of the fallback.
    pub fallback_planes: Vec<Plane>,
    /// Regions of forbidden velocities.
    pub forbidden: Vec<Forbidden>,
    /// What the half-planes, or the regions, come from.
    pub causes: Vec<Cause>,
}

/// How the preferred velocity becomes a safe one.
pub trait LocalModel: std::fmt::Debug + Send + Sync {
    /// The new velocity of one agent. Pure: the same view gives the same bits.
    fn velocity(&self, view: &View<'_>, workspace: &mut Workspace) -> Vec2;

    /// The new velocity of one agent that flies, in space. Models of the plane choose the part along the ground, and
    /// leave going up and down as it is wanted.
    fn velocity_in_space(&self, view: &View<'_>, workspace: &mut Workspace) -> Vec3 {
        self.velocity(view, workspace).extend(view.preferred_climb)
    }

    /// Whether the model looks up and down. One that does not sees nobody who passes clear above or below.
    fn looks_in_space(&self) -> bool {
        false
    }

    /// Whether the model avoids anybody. One that does not takes the preferred velocity, as far as the top speed allows.
    fn avoids(&self) -> bool {
        true
    }

    /// Whether the model itself brings agents to their preferred velocities by and by. Then
    /// [`Group::relaxation_time`](crate::Group::relaxation_time) does not count.
    fn relaxes(&self) -> bool {
        false
    }

    /// Whether the model has forces that part bodies. Then agents do not squeeze past each other (docs/look-ahead.md).
    fn parts_bodies(&self) -> bool {
        false
    }

    /// The model as a plain ORCA, if it is one: the step makes those choose many at a time, with the same bits.
    fn as_orca(&self) -> Option<Orca> {
        None
    }

    /// Why [`velocity`](Self::velocity) answers as it does for this view, as data to draw: what each neighbour and
    /// each wall forbids, or what the model tried and what it found. Never called in a step.
    fn explain(&self, view: &View<'_>, workspace: &mut Workspace) -> Vec<Reason> {
        let _ = (view, workspace);
        Vec::new()
    }

    /// How far from its centre an agent of this radius and top speed needs to see walls, metres.
    fn wall_range(&self, radius: f32, max_speed: f32) -> f32;

    /// What is wrong with the parameters, if anything is.
    ///
    /// # Errors
    /// [`Error::Limit`](crate::Error::Limit) names the parameter.
    fn check(&self) -> Result<(), crate::Error> {
        Ok(())
    }
}

/// By how much larger than the [guard](crate::guard) models take two bodies to be: without it the guard must act
/// in every contact, which jams corridors; with 8 % doors get arches.
pub const MARGIN: f32 = 0.03;
/// [`MARGIN`] for time steps of 0.1 s and longer.
pub const MARGIN_LONG_STEP: f32 = 0.05;

/// By what factor models take the radii of two bodies to be larger in a step of so many seconds.
pub(crate) fn margin(seconds: f32) -> f32 {
    1.0 + if seconds >= 0.1 { MARGIN_LONG_STEP } else { MARGIN }
}

//! Collision avoidance: local models turn the preferred velocity into a new velocity.
//!
//! A model is one file that declares its [parameters](crate::parameters) and implements [`LocalModel`]. Its input is one agent and the agent's surroundings, frozen at
//! the start of the step. It returns a velocity and keeps no state. The velocity need not be safe: the
//! [guard](crate::guard) makes it so.

mod anticipation_velocity;
mod avo;
mod avoidance;
mod batch;
mod batch_simd;
mod clearpath;
mod closest_outside;
mod collision_free_speed;
mod crowd;
mod crowd_arrays;
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
mod orca_simd;
mod outline;
mod power_law;
mod relax;
mod rvo;
mod rvo_lab;
mod sampling;
mod separation;
mod simd_input;
mod social_force;
mod squeeze;
mod turning;
mod vo;

pub use crate::agent::{MARGIN, MARGIN_LONG_STEP};
pub use crate::space::{time_to_disc, time_to_segment};
pub use anticipation_velocity::AnticipationVelocity;
pub use avo::Avo;
pub(crate) use avoidance::{Avoid, Visibility};
pub use batch::AvoidanceBatch;
pub use clearpath::ClearPath;
pub use closest_outside::closest_outside;
pub use collision_free_speed::CollisionFreeSpeed;
pub use crowd::{Crowd, CrowdModel};
pub use crowd_arrays::CrowdArrays;
pub use explain::{AvoidanceReason, Cause};
use forbidden::BoundaryPiece;
pub use forbidden::Forbidden;
pub use half_plane::{HalfPlane, closest_velocity, least_violation};
pub use half_space::{HalfSpace, closest_velocity_in_space, least_violation_in_space};
pub use hrvo::Hrvo;
pub use moussaid::Moussaid2009;
pub use none::NoAvoidance;
pub use orca::{BuiltFrom, Orca};
pub use orca_3d::Orca3d;
pub use outline::Outline;
pub use power_law::PowerLaw;
pub use rvo::Rvo;
pub use rvo_lab::RvoLab;
pub use simd_input::{MOST_SIMD_NEIGHBOURS, SimdInput, SimdNeighbour};
pub use social_force::SocialForce;
pub use vo::Vo;

pub use crate::random::Rng;
use crate::space::{Disc, Edge};
use glam::{Vec2, Vec3};
use std::any::Any;

/// A neighbour, relative to the agent that chooses a velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AvoidanceNeighbour {
    /// Offset of its centre from the choosing agent's centre, metres.
    pub offset: Vec2,
    /// Height of its centre above the choosing agent's centre, metres.
    pub above: f32,
    /// Its vertical velocity, m/s, positive upwards.
    pub vertical_velocity: f32,
    /// Its velocity, m/s.
    pub velocity: Vec2,
    /// Its preferred velocity, m/s.
    pub preferred: Vec2,
    /// Sum of the two radii, with the margin that the model keeps (see [`MARGIN`]), metres.
    pub radii: f32,
    /// A polygon around `offset`: the bodies touch if the choosing agent's centre is within `radii` of it. A point for
    /// two discs.
    pub outline: Outline,
    /// The choosing agent's share of the avoidance, 0 (none) to 1 (all).
    pub share: f32,
    /// The choosing agent's fraction of the free room while the two are on no collision course, 0 to 1. The agent with
    /// the right of way has a small share of the avoidance and a large fraction of the room. If the neighbour does not
    /// avoid, both are 1.
    pub room: f32,
    /// A unit vector for two agents at exactly the same place. The neighbour has the opposite vector.
    pub aside: Vec2,
}

impl AvoidanceNeighbour {
    /// Returns a neighbour that stands still and does not avoid.
    pub(crate) fn resting(offset: Vec2, radii: f32) -> Self {
        Self {
            offset,
            above: 0.0,
            vertical_velocity: 0.0,
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
    /// Its start, relative to the agent's centre.
    pub start: Vec2,
    /// Its end, relative to the agent's centre.
    pub end: Vec2,
    /// The edge.
    pub edge: Edge,
}

/// A solid disc near the choosing agent. If the agent is not a disc, a wall edge is represented too, as a disc without
/// radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearDisc {
    /// Offset of its centre from the agent's centre.
    pub offset: Vec2,
    /// The disc.
    pub disc: Disc,
    /// A polygon around `offset`: the bodies touch if the agent's centre is within both radii of it. A point if the
    /// agent is a disc.
    pub outline: Outline,
}

/// The input of a model: one agent and its surroundings. The default is a pedestrian that stands alone.
#[derive(Clone, Copy, Debug)]
pub struct AvoidanceInput<'a> {
    /// Current velocity, m/s.
    pub velocity: Vec2,
    /// Heading, radians counter-clockwise from +x.
    pub heading: f32,
    /// Preferred velocity, m/s.
    pub preferred: Vec2,
    /// Current vertical velocity, m/s, positive upwards.
    pub vertical_velocity: f32,
    /// Preferred vertical velocity, m/s.
    pub preferred_vertical_velocity: f32,
    /// Radius of the body, metres.
    pub radius: f32,
    /// Top speed, m/s.
    pub max_speed: f32,
    /// Greatest acceleration, m/s²; infinite for no limit.
    pub max_acceleration: f32,
    /// Greatest deviation from the chosen path while the body turns, metres; 0 if the body can move in any direction at
    /// once. See [`TwoWheels::tracking_error`](crate::motion::TwoWheels::tracking_error).
    pub tracking_error: f32,
    /// Greatest turn rate, rad/s; infinite for no limit.
    pub max_turn_rate: f32,
    /// Factor by which the radii of neighbours are larger than those of the bodies.
    pub margin: f32,
    /// Seconds until the agent chooses again.
    pub step: f32,
    /// The neighbours, nearest first.
    pub neighbours: &'a [AvoidanceNeighbour],
    /// Wall edges within [`LocalModel::wall_range`], nearest first.
    pub edges: &'a [NearEdge],
    /// Solid discs within [`LocalModel::wall_range`], nearest first.
    pub discs: &'a [NearDisc],
    /// The random number generator, for models that sample.
    pub rng: Rng,
}

impl Default for AvoidanceInput<'_> {
    fn default() -> Self {
        Self {
            velocity: Vec2::ZERO,
            heading: 0.0,
            preferred: Vec2::ZERO,
            vertical_velocity: 0.0,
            preferred_vertical_velocity: 0.0,
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
            rng: Rng::default(),
        }
    }
}

/// Scratch memory of models. It is reused from agent to agent, so that a step allocates nothing.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    /// Half-planes of permitted velocities.
    pub lines: Vec<HalfPlane>,
    /// Half-planes of the fallback optimisation.
    pub fallback: Vec<HalfPlane>,
    /// Half-spaces of permitted velocities.
    pub planes: Vec<HalfSpace>,
    /// Half-spaces of the fallback optimisation.
    pub fallback_planes: Vec<HalfSpace>,
    /// Regions of forbidden velocities.
    pub forbidden: Vec<Forbidden>,
    /// The causes of the half-planes, or of the regions.
    pub causes: Vec<Cause>,
}

/// A local collision avoidance model: it chooses a velocity near the preferred one that avoids collisions.
pub trait LocalModel: Any + std::fmt::Debug + Send + Sync {
    /// Returns the new velocity of one agent. A pure function: the same input gives the same bits.
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2;

    /// Returns the new velocity in space of one agent that flies. Models of the plane choose the horizontal part and
    /// keep the preferred vertical velocity.
    fn velocity_in_space(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec3 {
        self.velocity(view, workspace).extend(view.preferred_vertical_velocity)
    }

    /// Whether the model considers altitudes. If not, it does not get neighbours that pass clear above or below.
    fn looks_in_space(&self) -> bool {
        false
    }

    /// Whether the model avoids other agents. If not, it takes the preferred velocity, limited to the top speed.
    fn avoids(&self) -> bool {
        true
    }

    /// Whether the model itself lets agents approach their preferred velocities gradually. Then
    /// [`Group::relaxation_time`](crate::Group::relaxation_time) has no effect.
    fn relaxes(&self) -> bool {
        false
    }

    /// Whether the model has forces that push bodies apart. Then agents do not squeeze past each other
    /// (docs/look-ahead.md).
    fn parts_bodies(&self) -> bool {
        false
    }

    /// Returns the reach of the neighbour search that scene files give agents with this model, unless they state
    /// another, metres between centres.
    fn neighbour_distance(&self) -> f32 {
        8.0
    }

    /// Whether the guard keeps agents with this model apart in scene files, unless they state that it does not.
    fn wants_guard(&self) -> bool {
        true
    }

    /// Chooses the velocities of agents that are near each other, if the model has a faster way for several agents than
    /// for one: see [`AvoidanceBatch::with_simd`]. The agents that it leaves out get the velocity of
    /// [`velocity_in_space`](Self::velocity_in_space), which is the same.
    fn velocities(&self, batch: &mut AvoidanceBatch<'_>) {
        let _ = batch;
    }

    /// Returns the model as one that chooses for all of its agents together, if it does. The other ways of choosing are
    /// then not used in a step.
    fn together(&self) -> Option<&dyn CrowdModel> {
        None
    }

    /// Whether another model gives the same velocities for the same input. A batch may then hold agents of both.
    fn is_same(&self, other: &dyn LocalModel) -> bool {
        let _ = other;
        false
    }

    /// Whether the velocity may depend on [`AvoidanceInput::rng`]. If it does not, agents can sleep while their
    /// surroundings stay the same.
    fn is_random(&self) -> bool {
        true
    }

    /// Returns the reasons for the result of [`velocity`](Self::velocity) for this input, as data to draw: what each
    /// neighbour and each wall forbids, or which velocities the model evaluated. Never called in a step.
    fn explain(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec<AvoidanceReason> {
        let _ = (view, workspace);
        Vec::new()
    }

    /// Returns how far from its centre an agent of this radius and top speed needs to see walls, metres.
    fn wall_range(&self, radius: f32, max_speed: f32) -> f32;

    /// Checks the parameters.
    ///
    /// # Errors
    /// [`Error::Limit`](crate::Error::Limit) names the parameter.
    fn check(&self) -> Result<(), crate::Error> {
        Ok(())
    }
}

/// A collection of local models by name.
pub trait Models {
    /// Adds a model. Its name is [`Parameters::NAME`](crate::parameters::Parameters::NAME).
    fn add<M: LocalModel + crate::parameters::Parameters + Default>(&mut self);
}

/// Adds the models of the engine to a collection.
pub fn register(models: &mut impl Models) {
    models.add::<Orca>();
    models.add::<Orca3d>();
    models.add::<Avo>();
    models.add::<Hrvo>();
    models.add::<ClearPath>();
    models.add::<Rvo>();
    models.add::<RvoLab>();
    models.add::<Vo>();
    models.add::<CollisionFreeSpeed>();
    models.add::<AnticipationVelocity>();
    models.add::<SocialForce>();
    models.add::<Moussaid2009>();
    models.add::<PowerLaw>();
    models.add::<NoAvoidance>();
}

/// Returns the factor by which models enlarge the radii of two bodies in a step of `seconds`.
pub(crate) fn margin(seconds: f32) -> f32 {
    1.0 + if seconds >= 0.1 { MARGIN_LONG_STEP } else { MARGIN }
}

impl AvoidanceInput<'_> {
    /// Returns the seconds until a body of `radius` that keeps `velocity` touches a wall in view; infinite if it never
    /// does.
    pub(super) fn time_to_walls(&self, velocity: Vec2, radius: f32) -> f32 {
        let edges = self.edges.iter().map(|near| time_to_segment(near.start, near.end, velocity, radius));
        let discs = self
            .discs
            .iter()
            .map(|near| near.outline.time_to_collision(near.offset, velocity, near.disc.radius as f32 + radius));
        edges.chain(discs).fold(f32::INFINITY, f32::min)
    }
}

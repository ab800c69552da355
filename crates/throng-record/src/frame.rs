//! A frame of a world, and the setting that is constant over a recording.

use crate::people::Walks;
use crate::{Flow, SetMesh};
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::borrow::Cow;
use std::f32::consts::{PI, TAU};
use std::fmt;
use std::sync::Arc;
use throng::field::Field;
use throng::motion::Basis;
use throng::space::Pathway;
use throng::space::surface::{Barrier, Bounds, SeenFrom, Surface};
use throng::{Explanation, Goal, Obstacle, Status, Trace, Walkable};
use throng_figure::Character;

/// The constant part of a recording: the place and the names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setting {
    /// Title of the scene.
    pub title: String,
    /// Walkable areas, which do not overlap (a world keeps their union); empty: everywhere outside obstacles.
    pub walkable: Vec<Walkable>,
    /// The obstacles.
    pub obstacles: Vec<Obstacle>,
    /// Surfaces that behaviours steer by, for display.
    pub shells: Vec<Shell>,
    /// Paths that behaviours steer by, relative to [`Setting::origin`].
    pub paths: Vec<Arc<Pathway>>,
    /// Fields that guide groups.
    pub flows: Vec<Flow>,
    /// Names of the groups; [`Body::group`] indexes them.
    pub groups: Vec<String>,
    /// The bodies that people of a group have, by group; groups beyond the end and `None`: throng's own.
    pub characters: Vec<Option<Arc<Character>>>,
    /// How people walk, if all of their ways are known.
    pub walks: Option<Arc<Walks>>,
    /// The set to look at, metres from [`Setting::origin`].
    pub set: Option<Arc<SetMesh>>,
    /// The goals; [`Body::goal`] indexes them.
    pub goals: Vec<Goal>,
    /// Whether some agents fly, now or later.
    pub in_space: bool,
    /// World coordinates of the point to which shells, paths, flows and positions in [`Frame::accounts`] are relative.
    pub origin: DVec2,
}

impl Setting {
    /// Returns the name of a group; its index if it has no name.
    pub fn group_name(&self, group: u32) -> Cow<'_, str> {
        match self.groups.get(group as usize) {
            Some(name) if !name.is_empty() => name.into(),
            _ => group.to_string().into(),
        }
    }

    /// Whether a set stands in place of the ground and the obstacles ([`SetMesh::replaces`]).
    pub fn is_replaced(&self) -> bool {
        self.set.as_ref().is_some_and(|set| set.replaces)
    }

    /// Returns the body that people of a group have; `None`: throng's own.
    pub fn character(&self, group: u32) -> Option<&Arc<Character>> {
        self.characters.get(group as usize)?.as_ref()
    }
}

/// The visible shape of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Shell {
    /// Flat polygons, their corners counter-clockwise seen from outside, metres from [`Setting::origin`].
    pub facets: Vec<Vec<Vec3>>,
    /// Whether the surface is drawn like a container, which a viewer looks into or through.
    pub hollow: bool,
}

impl Shell {
    /// Returns the shape of a surface; of an unbounded surface, the part within a box.
    pub fn of(barrier: &Barrier<Arc<dyn Surface>>, within: &Bounds) -> Self {
        let facets = barrier.surface.facets(within);
        Self { hollow: barrier.seen_from != SeenFrom::Outside && facets.len() > 1, facets }
    }
}

/// All agents at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Seconds since the start.
    pub time: f64,
    /// All agents that are present, by number.
    pub bodies: Vec<Body>,
    /// Traces of the agents for which [a trace was requested](throng::World::request_traces), by number; positions are relative to
    /// [`Setting::origin`].
    pub accounts: Vec<Trace>,
    /// What the local models permit and forbid agents ([`moment::explain`](crate::moment::explain)), by number.
    pub explanations: Vec<Explanation>,
    /// Number of agents at the end of their journeys, including removed agents.
    pub arrived: usize,
    /// Number of all agents: present, removed, and yet to come.
    pub total: usize,
    /// The score of the game ([`World::standing`](throng::World::standing)); empty without rules.
    pub standing: String,
    /// The present states of fields that adapt to the positions of the agents, by group. Files do not hold them.
    pub fields: Vec<AdaptedField>,
    /// The obstacles, if they are others than at the start ([`moment::capture_obstacles`](crate::moment::capture_obstacles)).
    /// Files do not hold them.
    pub obstacles: Option<Arc<[Obstacle]>>,
}

/// The present state of a field that adapts to the positions of the agents ([`throng::field::Adaptive`]).
#[derive(Clone)]
pub struct AdaptedField {
    /// The group that the field governs, an index into [`Setting::groups`].
    pub group: u32,
    /// The field; positions are relative to [`Setting::origin`].
    pub field: Arc<dyn Field>,
}

/// Equal states share the same field object.
impl PartialEq for AdaptedField {
    fn eq(&self, other: &Self) -> bool {
        self.group == other.group && Arc::ptr_eq(&self.field, &other.field)
    }
}

impl fmt::Debug for AdaptedField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AdaptedField").field("group", &self.group).finish_non_exhaustive()
    }
}

/// An agent at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// The agent number.
    pub number: u32,
    /// Index into [`Setting::groups`].
    pub group: u32,
    /// Index into [`Setting::goals`] of the agent's goal.
    pub goal: Option<u32>,
    /// Centre, world coordinates, metres.
    pub position: DVec2,
    /// Height of the centre above the ground, metres.
    pub altitude: f32,
    /// Velocity along the ground, m/s.
    pub velocity: Vec2,
    /// Velocity upwards, m/s.
    pub vertical_velocity: f32,
    /// Direction of the body, radians counter-clockwise from +x.
    pub heading: f32,
    /// Orientation of an agent that flies as a vehicle, which pitches and banks; `None`: upright, along the heading.
    pub basis: Option<Basis>,
    /// Radius of a disc, or of the rounding of another body, metres.
    pub radius: f32,
    /// Half extents of the core, along and across the heading, metres; zero for a disc ([`throng::Body`]).
    pub core: Vec2,
    /// The preferred speed, m/s.
    pub preferred_speed: f32,
    /// The agent's status.
    pub status: Status,
}

#[cfg(test)]
impl Body {
    /// Returns a walking disc, for tests.
    pub(crate) fn walking(number: u32, position: DVec2) -> Self {
        Self {
            number,
            group: 0,
            goal: None,
            position,
            altitude: 0.0,
            velocity: Vec2::X,
            vertical_velocity: 0.0,
            heading: 0.0,
            basis: None,
            radius: 0.2,
            core: Vec2::ZERO,
            preferred_speed: 1.0,
            status: Status::Walking,
        }
    }
}

impl Body {
    /// Returns the speed in space, m/s.
    pub fn speed(&self) -> f32 {
        self.velocity.extend(self.vertical_velocity).length()
    }

    /// Returns the position in space, metres.
    pub fn center(&self) -> DVec3 {
        self.position.extend(f64::from(self.altitude))
    }

    /// Interpolates linearly towards a later state: position, altitude, velocity, and heading by the shorter rotation.
    /// `share` is the fraction of the interval. All other values are those of this state.
    pub fn between(&self, later: &Self, share: f64) -> Self {
        let turn = (later.heading - self.heading + PI).rem_euclid(TAU) - PI;
        Self {
            position: self.position.lerp(later.position, share),
            altitude: self.altitude + (later.altitude - self.altitude) * share as f32,
            heading: self.heading + turn * share as f32,
            velocity: self.velocity.lerp(later.velocity, share as f32),
            vertical_velocity: self.vertical_velocity
                + (later.vertical_velocity - self.vertical_velocity) * share as f32,
            ..*self
        }
    }

    /// Returns the shape.
    pub fn shape(&self) -> throng::Body {
        throng::Body { core: self.core, radius: self.radius }
    }
}

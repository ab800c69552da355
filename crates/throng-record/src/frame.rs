//! One moment of a world, and what stays the same from moment to moment.

use crate::Flow;
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::borrow::Cow;
use std::f32::consts::{PI, TAU};
use std::sync::Arc;
use throng::motion::Basis;
use throng::space::Pathway;
use throng::space::surface::{Barrier, Bounds, SeenFrom, Surface};
use throng::{Account, Goal, Obstacle, Status, Walkable};

/// What stays the same over a recording: the place and the names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setting {
    /// Title of the scene.
    pub title: String,
    /// Areas that can be walked on, apart from each other (a world keeps the union of what it is given); empty:
    /// everywhere but on obstacles.
    pub walkable: Vec<Walkable>,
    /// What is solid.
    pub obstacles: Vec<Obstacle>,
    /// Surfaces that behaviours steer by, to be seen.
    pub shells: Vec<Shell>,
    /// Paths that behaviours steer by, relative to [`Setting::origin`].
    pub paths: Vec<Arc<Pathway>>,
    /// Fields that lead groups.
    pub flows: Vec<Flow>,
    /// Names of the groups; [`Body::group`] indexes them.
    pub groups: Vec<String>,
    /// The goals; [`Body::goal`] indexes them.
    pub goals: Vec<Goal>,
    /// Whether somebody flies, or will.
    pub in_space: bool,
    /// World coordinates of what shells, paths, flows and places in [`Frame::accounts`] are relative to.
    pub origin: DVec2,
}

impl Setting {
    /// What a group is called: its name; its index where it has none.
    pub fn group_name(&self, group: u32) -> Cow<'_, str> {
        match self.groups.get(group as usize) {
            Some(name) if !name.is_empty() => name.into(),
            _ => group.to_string().into(),
        }
    }
}

/// What there is to see of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Shell {
    /// Flat polygons, their corners counter-clockwise seen from outside, metres from [`Setting::origin`].
    pub facets: Vec<Vec<Vec3>>,
    /// Whether one looks into it, or through it, as into a container.
    pub hollow: bool,
}

impl Shell {
    /// Of a surface; of one that has no end, the part within a box.
    pub fn of(barrier: &Barrier<Arc<dyn Surface>>, within: &Bounds) -> Self {
        let facets = barrier.surface.facets(within);
        Self { hollow: barrier.seen_from != SeenFrom::Outside && facets.len() > 1, facets }
    }
}

/// Everybody at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Seconds since the start.
    pub time: f64,
    /// Everybody who is there, by number.
    pub bodies: Vec<Body>,
    /// Why those who are [asked](throng::World::ask) go where they go, by number; places are relative to
    /// [`Setting::origin`].
    pub accounts: Vec<Account>,
    /// How many are at the end of their journeys, the removed ones included.
    pub arrived: usize,
    /// How many there are in all: here, gone, and yet to come.
    pub total: usize,
    /// How the game stands ([`World::standing`](throng::World::standing)); empty without rules.
    pub standing: String,
}

/// One agent at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// The agent's own number.
    pub number: u32,
    /// Index into [`Setting::groups`].
    pub group: u32,
    /// Index into [`Setting::goals`] of where it is going.
    pub goal: Option<u32>,
    /// Centre, world coordinates, metres.
    pub position: DVec2,
    /// Height of its centre above the ground, metres.
    pub altitude: f32,
    /// Velocity along the ground, m/s.
    pub velocity: Vec2,
    /// Velocity upwards, m/s.
    pub climb: f32,
    /// Direction of the body, radians counter-clockwise from +x.
    pub heading: f32,
    /// Which way one faces who flies as a vehicle: it climbs and banks; `None`: upright, along its heading.
    pub basis: Option<Basis>,
    /// Radius of a disc, or of the rounding of another body, metres.
    pub radius: f32,
    /// Half extents of what is rounded, along and across the heading, metres; zero for a disc ([`throng::Body`]).
    pub core: Vec2,
    /// The speed it would like to walk at, m/s.
    pub preferred_speed: f32,
    /// What it is doing.
    pub status: Status,
}

#[cfg(test)]
impl Body {
    /// A disc on its way, for tests.
    pub(crate) fn walking(number: u32, position: DVec2) -> Self {
        Self {
            number,
            group: 0,
            goal: None,
            position,
            altitude: 0.0,
            velocity: Vec2::X,
            climb: 0.0,
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
    /// How fast it is, in space, m/s.
    pub fn speed(&self) -> f32 {
        self.velocity.extend(self.climb).length()
    }

    /// Where it is in space, metres.
    pub fn center(&self) -> DVec3 {
        self.position.extend(f64::from(self.altitude))
    }

    /// A share of the way from here to where it is at a later moment, straight on, turned the short way, with a share of
    /// the change of velocity; all else is as it is here.
    pub fn between(&self, later: &Self, share: f64) -> Self {
        let turn = (later.heading - self.heading + PI).rem_euclid(TAU) - PI;
        Self {
            position: self.position.lerp(later.position, share),
            altitude: self.altitude + (later.altitude - self.altitude) * share as f32,
            heading: self.heading + turn * share as f32,
            velocity: self.velocity.lerp(later.velocity, share as f32),
            climb: self.climb + (later.climb - self.climb) * share as f32,
            ..*self
        }
    }

    /// The shape.
    pub fn shape(&self) -> throng::Body {
        throng::Body { core: self.core, radius: self.radius }
    }
}

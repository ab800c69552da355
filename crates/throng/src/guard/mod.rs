//! The guard: no two bodies, and no body and wall, ever interpenetrate.
//!
//! The guard takes the displacement that each agent would make in a step and returns a safe one, changed as little as
//! possible. It does not depend on models, goals or speeds, so it holds for any model and any time step. It also keeps
//! the agents of a group out of the group's [solids](Solids), whether the agents are guarded or not.
//!
//! # Why it holds
//! A body is the set of points within its radius of its *core*. The core of a disc is a point at the disc's altitude:
//! the disc is a sphere. Other cores, and walls, stand upright and extend up and down without limit. A pair with such a
//! core or a wall is judged in the plan, where the cores are rectangles and altitudes do not matter. Let `R` be the sum
//! of two radii. Over the step each body moves at a constant velocity and turns at a constant rate.
//!
//! 1. A pair is *safe* if the distance of its cores is at least `R`, less a slack of 1e-6 `R`, throughout the step. A
//!    pair that starts closer than that (a bad start) is safe if it is never closer than at the start. Where cores
//!    overlap, their distance is the negative length of the shortest translation that separates them. The same holds
//!    for a body and a wall.
//!    - Two discs: the least of `|xj - xi + t (dj - di)|` over the step, in space, has a closed form.
//!    - Other cores (`sweep.rs`): along any fixed direction `n` the gap between two cores, the least of
//!      `n . (q(t) - p(t))` over their corners, is at most their distance. A corner at distance `r` from a centre that
//!      turns by `a` moves along `n` with a second derivative of at most `r a^2`. So between its values at two times
//!      the gap sags no deeper than a parabola of that curvature. If the parabola stays above the required distance,
//!      the pair is safe between the two times. The test tries the normals between the nearest points at both times. If
//!      neither shows safety, it halves the time interval. For two cores that stand still nothing sags and the normal
//!      gives their distance: standing still is safe.
//! 2. Every agent has a *cell* (`cell.rs`). Along the normal to each near neighbour no point of its core may move
//!    farther, by translation and rotation together, than half the gap between the two beyond the present extent of the
//!    core (not at all if there is no gap). Towards each near wall the limit is the whole gap. Two agents that both
//!    stay in their cells are safe: along that normal they close at most the gap, so the distance of the cores, which
//!    is at least the gap along the normal, stays at least `R`. An edge of a wall lies entirely beyond the line through
//!    its nearest point across the normal, hence a cell is safe for walls too. The ground is a side of every cell, at
//!    the altitude of the centre. If an agent and its target are on the ground, the agent's cell is cut with the
//!    ground. Standing still is in every cell.
//! 3. All agents start free. In each round every free agent in an unsafe pair with another agent, or unsafe with a
//!    wall, is *clamped*: its target is moved into its cell. Its turn is kept if the cell has room for it, else halved,
//!    else dropped. A clamped agent stays clamped. The rounds end when no agent is newly clamped. Each agent is clamped
//!    at most once, so the rounds end. Then every pair is safe, either by the check (one of the two is free) or by 2
//!    (both are clamped).
//! 4. Rounding: the check uses the motion after rounding, `fl(x + d) - x`, and the turn to the stored heading, in
//!    `f64`. A clamped result is checked against its cell after rounding. If rounding moved it out of the cell the
//!    motion is shortened. If that fails too the agent stands still.
//!
//! 5. A *solid* (`solids.rs`) is a surface in space that the agents of a group cannot enter. A body counts as the ball
//!    about its centre that holds it at any heading, so rotation does not matter. The *clearance* at a point is its
//!    distance from the surface, negative on the wrong side. Along a path of length `l` it changes by at most `l`. A
//!    motion is safe if the clearance never falls below the radius, or below its value at the start if that is less.
//!    This holds if the clearance at the start exceeds the required one by at least the length, or if the excesses at
//!    both ends add up to at least the length. Where neither is true, a ball of the required radius is swept along the
//!    path ([`Surface::sweep`](crate::space::surface::Surface::sweep)): it must touch nothing, and the clearance at the
//!    end must be sufficient. The end is the rounded position of the body, so that rounding errors do not add up from
//!    step to step. An agent that starts with its centre on the wrong side has no ball to sweep: it must not end deeper
//!    than it started.
//!
//!    A solid does not move, so the safety of a motion with a solid does not depend on other agents, and cells need no
//!    sides for solids. (Such a side would not be enough: a surface that is not convex has parts beyond the plane
//!    through its nearest point.) Instead, an agent near a solid is *led*: its target is pushed out of the solid, or
//!    its motion is redirected along the surface, up to four times, else cut short, else dropped. The first safe result
//!    counts. Relaxation and clamping lead before all other checks, so that their results are safe with solids, and a
//!    clamped result is in its cell as well. Standing still is safe. An agent with a clearance at the start greater
//!    than the sum of its radius, a skin and its reach cannot touch a solid and is not led.
//!
//! Only a bad start can make an agent overlap more than six others by more than touching. Two agents that are both in
//! such a *pile* (`contacts.rs`) are not kept apart: they leave the pile through each other, as their models direct
//! them.
//!
//! The heading of a disc cannot cause a contact, so the guard leaves it unchanged. Two unguarded agents are not kept
//! apart. An unguarded agent is not kept off walls, but off solids.
//!
//! Only pairs that can meet are checked. No agent moves farther in space than its `reach`, hence not in the plan
//! either. A body that turns stays within the disc about its centre that holds it at any heading. A pair is safe if the
//! gap between these discs exceeds the sum of both reaches.
//!
//! Before certification, a few symmetric relaxations (`relax.rs`) push apart the pairs that would collide,
//! position-based as Weiss et al. (MIG 2017) resolve contacts. They make clamping rare. The proof does not depend on
//! them.
//!
//! # Cost
//! The result of a relaxation or of a round for an agent depends only on its own target and on the targets of the
//! agents that it could touch (`contacts.rs`). So agents that can touch nothing are never evaluated, nor are agents
//! that a cheap test shows to be safe with all their contacts. In later passes an agent is evaluated only if one of
//! these targets changed since its last evaluation (`certify.rs`). The result is bit-identical to that of evaluating
//! every agent in every pass.

mod cell;
mod certify;
mod contacts;
mod cores;
mod keep_apart;
mod lists;
#[cfg(test)]
mod plain;
mod relax;
mod safe;
mod sizes;
mod solid;
mod solids;
mod spread;
mod sweep;

#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub use certify::{Guard, Report};
#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub use contacts::{Contacts, RowContacts};
pub(crate) use keep_apart::{Guarded, KeepApart};
pub(crate) use relax::SKIN;
#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub use safe::{SLACK, nearest_approach};
#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub use solids::Solids;
pub(crate) use spread::{Clamping, Spreading};

use crate::agent::Column;
use glam::{Vec2, Vec3};

/// Bodies at the start of a step.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub struct GuardedBodies<'a> {
    /// Centres.
    pub positions: &'a [Vec2],
    /// Heights of the centres above the ground, not negative.
    pub altitudes: &'a Column<f32>,
    /// Headings, radians counter-clockwise from +x.
    pub headings: &'a [f32],
    /// Half extents of the cores, along and across the heading; zero for discs.
    pub cores: &'a Column<Vec2>,
    /// Radii: how far bodies reach beyond their cores.
    pub radii: &'a Column<f32>,
    /// How far each may move in the step at most, in space, metres.
    pub reach: &'a Column<f32>,
    /// Whether the guard keeps each body from overlapping. A pair is kept apart if at least one of the two is guarded.
    pub guarded: &'a Column<bool>,
    /// The solids, and the rows that are near a solid.
    pub solids: &'a Solids,
    /// Per block of 64 rows: whether it sleeps. A block sleeps if the desired poses of its rows, and of all rows that
    /// the guard can bring into contact with them, are where they stood in the last step, and the guard left them
    /// there. Contacts and targets of a sleeping block are those of the last step. Blocks beyond the end do not sleep.
    pub resting: &'a [bool],
}

/// Length of the longest chain of contacts along which the motion of one agent can move another that would stand still.
/// Only relaxation can: clamping leaves an agent that stands where it stands.
pub(crate) const PASSES: usize = relax::ITERATIONS;

impl GuardedBodies<'_> {
    /// Whether a body is a disc: its centre and radius describe it completely.
    #[inline]
    fn is_disc(&self, row: usize) -> bool {
        self.cores[row] == Vec2::ZERO
    }

    /// Returns the bounding radius: that of the disc about the centre that holds the body at any heading.
    #[inline]
    fn bound(&self, row: usize) -> f32 {
        // most bodies are discs
        if self.is_disc(row) { self.radii[row] } else { self.radii[row] + self.cores[row].length() }
    }

    /// Whether a block of 64 rows sleeps.
    #[inline]
    fn rest(&self, part: usize) -> bool {
        self.resting.get(part) == Some(&true)
    }

    /// Returns the centre of a body in space.
    #[inline]
    fn place(&self, row: usize) -> Vec3 {
        self.positions[row].extend(self.altitudes[row])
    }
}

/// The pose of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub struct BodyPose {
    /// The centre.
    pub position: Vec2,
    /// Height of the centre above the ground.
    pub altitude: f32,
    /// The heading, radians counter-clockwise from +x, -pi to pi.
    pub heading: f32,
}

impl BodyPose {
    /// Returns the centre in space.
    #[inline]
    pub fn place(&self) -> Vec3 {
        self.position.extend(self.altitude)
    }

    /// Returns the pose with its centre at `place`, or on the ground above it if `place` is below the ground.
    #[inline]
    pub(crate) fn with_place(self, place: Vec3) -> Self {
        Self { position: place.truncate(), altitude: place.z.max(0.0), ..self }
    }
}

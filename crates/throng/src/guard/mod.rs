//! What is certain: no two bodies, and no body and wall, ever interpenetrate.
//!
//! The guard takes the displacement that each agent would make in a step and returns one that is safe, changed as
//! little as it can. It knows nothing of models, goals or speeds, so it holds for any model and any time step. Into what is
//! [solid](Solids) to a group nobody of it gets, guarded or not.
//!
//! # Why it holds
//! A body is everything within its radius of its *core*. The core of a disc is a point at its altitude: the disc is a
//! sphere. Other cores, and walls, stand upright without end: whatever they have to do with others is seen in the plan,
//! where their cores are rectangles, and altitudes do not matter. Let `R` be the sum of two radii; over the step all bodies move and turn evenly, each by its own displacement and angle.
//!
//! 1. A pair is *safe* if the distance of its cores is at least `R`, less a slack of 1e-6 `R`, all through the step. A
//!    pair closer than that at the start (a bad start) is safe if it is never closer than at the start; where cores
//!    overlap, the least shift that parts them counts as a negative distance. The same for a body and a wall.
//!    - Two discs: the least of `|xj - xi + t (dj - di)|` over the step, in space, is known exactly.
//!    - Other cores (`sweep.rs`): along any fixed direction the gap between two cores is at most their distance, and
//!      the least of `n . (q(t) - p(t))` over their corners. A corner at `r` from a centre that turns by `a` runs along
//!      `n` with a second derivative of at most `r a^2`. So between its values at two times the gap sags no deeper than
//!      a parabola of that curvature, and if that stays above what is needed, the pair is safe between the two times.
//!      The normals between the nearest points at both times are tried, and the time is halved where neither shows it.
//!      For two that stand nothing sags, and the normal shows their distance: standing is safe.
//! 2. Every agent has a *cell* (`cell.rs`): along the normal to each near neighbour no point of its core gets farther,
//!    by moving and turning together, than half the gap between the two beyond where the core reached (none if there is
//!    no gap), and towards each near wall at most the gap. Two agents that both stay in their cells are safe: along that
//!    normal they close at most the gap, so at every moment the distance of the cores, which is at least the gap along
//!    it, is at least `R`. An edge of a wall lies wholly beyond the line across its nearest point, hence a cell is safe
//!    for walls too. The ground is a side of every cell, at the altitude of the centre. Who is on it and does not want to
//!    leave it has the cell's cut with the ground. Standing still is in every cell.
//! 3. All start free. In each round every agent that is in an unsafe pair with any other, or unsafe with a wall,
//!    while free, is *clamped*: moved into its cell, its turn kept if there is room for it, halved, or given up. A
//!    clamped agent stays clamped. After eight rounds, or when nobody new is clamped, the rest: if rounds ran out
//!    everybody who is still free is clamped. Each agent is clamped at most once, so this ends, and at the end every
//!    pair is either safe by check (one of the two is free) or safe by 2 (both are clamped).
//! 4. Rounding: what is checked is the motion that rounding leaves, `fl(x + d) - x`, and the turn to the heading that is
//!    kept, in `f64`. A clamped result is checked against its cell after rounding; if rounding took it out it is
//!    shortened, and failing that the agent stands.
//!
//! 5. A *solid* (`solids.rs`) is a surface in space that nobody of a group gets into; a body counts as the ball about its
//!    centre that holds it at any heading, so turning does not matter. The *room* at a point is its distance from the
//!    surface, negative on the wrong side: along a way of length `l` it changes by no more than `l`. A motion is safe
//!    if the room never gets less than the radius, or than at the start where that is less. It is, if what the room is more
//!    than needed at the start is no less than the length, or if that at both ends together is. Where this does
//!    not show it, a ball of the radius that is needed is swept along the way ([`Surface::sweep`](crate::space::surface::Surface::sweep)),
//!    which must touch nothing, and at its end the room must be enough. The room at the end is that of the very place where the body
//!    will be, so that rounding does not add up from step to step. Who starts with its centre on the wrong side has
//!    no ball that could be swept: it is held to end no deeper than it began.
//!
//!    A solid stands, so whether a motion is safe with it depends on nobody else, and no side of a cell is needed for it. (One
//!    would not do: beyond the plane across the nearest point there is more of what is not convex.) Instead whoever is
//!    near one is *led*: the end is pushed out of it, the way turned along what it touches, four times at most, else
//!    cut short, else given up; the first that is safe counts. Relaxing and clamping lead before anything
//!    else is checked: what comes of them is safe with solids, and a clamped result in its cell as well. Standing is safe.
//!    Who has more room at the start than its radius, a skin, and its reach, cannot touch a solid and is not led.
//!
//! Only a bad start can have somebody overlap more than six others by more than touching. Two who are both in such a *pile*
//! (`contacts.rs`) are not held apart: they walk out of it through each other, as their models have them, until fewer overlap.
//!
//! The heading of a disc touches nobody: the guard leaves it alone. Two who are both unguarded are not held apart, nor
//! is one who is unguarded held off walls; off solids it is.
//!
//! Only pairs that can meet need a look: nobody moves farther in space than its `reach`, hence in the plan neither, and turning leaves a body within the disc
//! about its centre that holds it at any heading; pairs whose discs are farther apart than both reaches are safe.
//!
//! Before certifying, a few symmetric relaxations (`relax.rs`) part the pairs that would collide: position-based, as
//! Weiss et al. (MIG 2017) resolve contacts. They make clamping rare; nothing depends on them.
//!
//! # What it costs
//! What relaxing or a round finds about an agent depends on its own target, on those of whom it could touch (`contacts.rs`),
//! and on nothing else that changes. So who can touch nobody and nothing is never looked at; nor is who is seen at a glance to pass
//! everybody, nor later anybody for whom none of these targets has changed since the last look (`certify.rs`). The
//! result is that of looking at everybody every time, bit for bit.

mod cell;
mod certify;
mod contacts;
mod cores;
mod lists;
#[cfg(test)]
mod plain;
mod relax;
mod safe;
mod solid;
mod solids;
mod sweep;

pub use certify::{Guard, Report};
pub(crate) use certify::{led, unguarded, within_reach};
pub use contacts::{Contacts, Seen};
pub use safe::{SLACK, nearest_approach};
pub use solids::Solids;

use crate::agent::Column;
use glam::{Vec2, Vec3};

/// Bodies at the start of a step.
#[derive(Clone, Copy, Debug)]
pub struct Bodies<'a> {
    /// Centres.
    pub positions: &'a [Vec2],
    /// Heights of the centres above the ground, not negative.
    pub altitudes: &'a Column<f32>,
    /// Directions, radians counter-clockwise from +x.
    pub headings: &'a [f32],
    /// Half extents of the cores, along and across the heading; zero for discs.
    pub cores: &'a Column<Vec2>,
    /// Radii: how far bodies reach beyond their cores.
    pub radii: &'a Column<f32>,
    /// How far each may move in the step at most, in space, metres.
    pub reach: &'a Column<f32>,
    /// Who is kept from overlapping: of two, one at least must be.
    pub guarded: &'a Column<bool>,
    /// What nobody gets into, and who is near it.
    pub solids: &'a Solids,
    /// Of each 64 rows, whether they, and all whom the guard can have them meet, wish to stand where they stood in the last
    /// step, and the guard left them there: their contacts and targets are those of that step. None beyond the end.
    pub resting: &'a [bool],
}

/// Over how many contacts, one after the other, the motion of one may change that of another.
pub(crate) const PASSES: usize = relax::ITERATIONS + certify::ROUNDS + 1;

impl Bodies<'_> {
    /// Whether a body is a disc: centres and radii say everything about it.
    #[inline]
    fn is_disc(&self, row: usize) -> bool {
        self.cores[row] == Vec2::ZERO
    }

    /// Radius of the disc about the centre that holds the body at any heading.
    #[inline]
    fn bound(&self, row: usize) -> f32 {
        self.radii[row] + self.cores[row].length()
    }

    /// Whether 64 rows rest.
    #[inline]
    fn rest(&self, part: usize) -> bool {
        self.resting.get(part) == Some(&true)
    }

    /// The centre of a body, in space.
    #[inline]
    fn place(&self, row: usize) -> Vec3 {
        self.positions[row].extend(self.altitudes[row])
    }
}

/// Where a body is, or is to be.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Its centre.
    pub position: Vec2,
    /// Height of its centre above the ground.
    pub altitude: f32,
    /// Its direction, radians counter-clockwise from +x, -pi to pi.
    pub heading: f32,
}

impl Pose {
    /// Its centre, in space.
    #[inline]
    pub fn place(&self) -> Vec3 {
        self.position.extend(self.altitude)
    }

    /// The pose with its centre here, on the ground if that is below it.
    #[inline]
    pub(crate) fn with_place(self, place: Vec3) -> Self {
        Self { position: place.truncate(), altitude: place.z.max(0.0), ..self }
    }
}

//! What is certain: no two bodies, and no body and wall, ever interpenetrate.
//!
//! The guard takes the displacement that each agent would make in a step and returns one that is safe, changed as
//! little as it can. It knows nothing of models, goals or speeds, so it holds for any model and any time step.
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
//! The heading of a disc touches nobody: the guard leaves it alone. Two who are both unguarded are not held apart, nor
//! is one who is unguarded held off walls.
//!
//! Only pairs that can meet need a look: nobody moves farther in space than its `reach`, hence in the plan neither, and turning leaves a body within the disc
//! about its centre that holds it at any heading; pairs whose discs are farther apart than both reaches are safe.
//!
//! Before certifying, a few symmetric relaxations (`relax.rs`) part the pairs that would collide: position-based, as
//! Weiss et al. (MIG 2017) resolve contacts. They make clamping rare; nothing depends on them.

mod cell;
mod contacts;
mod relax;
mod solid;
mod sweep;

pub use contacts::Contacts;

use crate::agent::Column;
use crate::avoid::{Line, Plane};
use crate::parallel;
use crate::space::{Core, Walls};
use glam::{DVec2, DVec3, Vec2, Vec3};
use solid::Solid;
use sweep::Sweep;

/// Part of the sum of radii by which a checked pair may be closer than touching.
pub const SLACK: f64 = 1e-6;
/// Rounds of certification after which everybody who is still free is clamped.
const ROUNDS: usize = 8;

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
}

impl Bodies<'_> {
    /// Radius of the disc about the centre that holds the body at any heading.
    fn bound(&self, row: usize) -> f32 {
        self.radii[row] + self.cores[row].length()
    }

    /// The centre of a body, in space.
    fn place(&self, row: usize) -> Vec3 {
        self.positions[row].extend(self.altitudes[row])
    }
}

/// Where a body is, or is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    pub fn place(&self) -> Vec3 {
        self.position.extend(self.altitude)
    }

    /// The pose with its centre here, on the ground if that is below it.
    pub(crate) fn with_place(self, place: Vec3) -> Self {
        Self { position: place.truncate(), altitude: place.z.max(0.0), ..self }
    }
}

/// What the guard did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Agents whose displacement it changed by more than a hundredth.
    pub changed: usize,
    /// Agents it clamped to their cells.
    pub clamped: usize,
    /// Rounds of certification.
    pub rounds: usize,
}

/// The guard, with the memory it keeps from step to step.
#[derive(Clone, Debug, Default)]
pub struct Guard {
    targets: Vec<Pose>,
    next: Vec<Pose>,
    clamped: Vec<bool>,
    verdicts: Vec<bool>,
    cores: Vec<Core>,
}

/// Memory for one agent's cell.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    pub(crate) lines: Vec<Line>,
    pub(crate) planes: Vec<Plane>,
    pub(crate) sides: Vec<cell::Side>,
}

impl Guard {
    /// Makes the motion to `targets` certain, and puts what is certain there instead. `contacts` must hold every pair
    /// and every wall that the bodies' reach lets meet.
    pub fn certify(&mut self, bodies: &Bodies<'_>, contacts: &Contacts, walls: &Walls, targets: &mut [Pose]) -> Report {
        let Self { targets: now, next, clamped, verdicts, cores } = self;
        cores.clear();
        cores.extend(bodies.positions.iter().zip(bodies.headings).zip(bodies.cores.iter()).map(
            |((at, &heading), half)| {
                let center = at.as_dvec2();
                if half == Vec2::ZERO { Core::point(center) } else { Core::new(center, heading, half) }
            },
        ));
        let solid = Solid { bodies, contacts, walls, cores };
        now.clear();
        now.extend(targets.iter().enumerate().map(|(row, target)| {
            let (from, to, reach) = (bodies.place(row), target.place(), bodies.reach[row]);
            // a target that is not a number is no wish at all
            let place = if to.is_finite() { from + (to - from).clamp_length_max(reach) } else { from };
            let turns = target.heading.is_finite() && !solid.is_disc(row);
            let heading = if turns { target.heading } else { bodies.headings[row] };
            Pose { heading, ..*target }.with_place(place)
        }));
        let mut report = Report::default();
        relax::relax(solid, now, next);
        clamped.clear();
        clamped.resize(now.len(), false);
        for round in 1.. {
            verdicts.clear();
            verdicts.resize(now.len(), false);
            let last = round > ROUNDS;
            parallel::rows(
                verdicts,
                1,
                || (),
                |(), row, verdict| {
                    verdict[0] = !clamped[row] && (last && !contacts.is_alone(row) || !is_safe(row, solid, now));
                },
            );
            if !verdicts.contains(&true) {
                break;
            }
            report.rounds = round;
            next.clone_from(now);
            parallel::rows(next, 1, Scratch::default, |scratch, row, target| {
                if verdicts[row] {
                    target[0] = cell::clamp(row, solid, target[0], scratch);
                }
            });
            std::mem::swap(now, next);
            for (clamped, &verdict) in clamped.iter_mut().zip(&*verdicts) {
                *clamped |= verdict;
            }
        }
        report.clamped = clamped.iter().filter(|&&c| c).count();
        for (row, (target, &certain)) in targets.iter_mut().zip(&*now).enumerate() {
            let wish = target.place();
            // beyond a hundredth of the way, or of a thousandth of the body
            let tolerance = wish.distance(bodies.place(row)).max(1e-3 * bodies.radii[row]) * 1e-2;
            let turned = !solid.is_disc(row) && target.heading != certain.heading;
            report.changed += usize::from(!wish.is_finite() || wish.distance(certain.place()) > tolerance || turned);
            *target = certain;
        }
        report
    }
}

/// Whether the motion of `row` is safe with everybody and every wall.
fn is_safe(row: usize, solid: Solid<'_>, targets: &[Pose]) -> bool {
    let bodies = solid.bodies;
    let (from, motion) = (bodies.place(row).as_dvec3(), solid.motion(row, targets[row]));
    solid.others(row).all(|other| {
        let radii = f64::from(bodies.radii[row]) + f64::from(bodies.radii[other]);
        if solid.is_disc(row) && solid.is_disc(other) {
            let offset = bodies.place(other).as_dvec3() - from;
            let relative = solid.motion(other, targets[other]) - motion;
            return nearest_approach(offset, relative) >= needed(radii, offset.length());
        }
        keeps(&solid.sweep(row, targets[row]), &solid.sweep(other, targets[other]), radii)
    }) && if solid.is_disc(row) {
        walls_are_safe(row, solid, from.truncate(), motion.truncate())
    } else {
        let radius = f64::from(bodies.radii[row]);
        let own = solid.sweep(row, targets[row]);
        solid.standing(row).all(|(core, size)| keeps(&own, &Sweep::still(core), radius + size))
    }
}

/// The least distance that two may have who touch at `radii` and are at `distance` now.
fn needed(radii: f64, distance: f64) -> f64 {
    radii.min(distance) - SLACK * radii
}

/// Whether the motion of two cores is safe.
fn keeps(own: &Sweep, other: &Sweep, radii: f64) -> bool {
    own.keeps(other, needed(radii, own.start.separation(&other.start).distance))
}

fn walls_are_safe(row: usize, solid: Solid<'_>, from: DVec2, motion: DVec2) -> bool {
    let radius = f64::from(solid.bodies.radii[row]);
    solid.edges(row).all(|edge| {
        // a segment and the swept centre: apart at an end of one of them, unless they cross
        let at_start = edge.nearest(from).distance(from);
        let to = from + motion;
        let swept = edge
            .nearest(to)
            .distance(to)
            .min(crate::space::nearest_on_segment(from, to, edge.start).distance(edge.start))
            .min(crate::space::nearest_on_segment(from, to, edge.end).distance(edge.end))
            .min(at_start);
        swept >= needed(radius, at_start) && !cross(from, to, edge.start, edge.end)
    }) && solid.discs(row).all(|disc| {
        let offset = disc.center - from;
        nearest_approach(offset.extend(0.0), -motion.extend(0.0)) - disc.radius
            >= needed(radius, offset.length() - disc.radius)
    })
}

/// The least length of `offset + t * motion` for t in [0, 1].
pub fn nearest_approach(offset: DVec3, motion: DVec3) -> f64 {
    let along = -offset.dot(motion);
    if along <= 0.0 {
        return offset.length();
    }
    let t = (along / motion.length_squared()).min(1.0);
    (offset + motion * t).length()
}

/// Whether segments `a b` and `c d` cross.
fn cross(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

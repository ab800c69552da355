//! What is certain: no two bodies, and no body and wall, ever interpenetrate.
//!
//! The guard takes the displacement that each agent would make in a step and returns one that is safe, changed as
//! little as it can. It knows nothing of models, goals or speeds, so it holds for any model and any time step.
//!
//! # Why it holds
//! Let `x` be positions, `d` displacements, `R` the sum of two radii, all motion linear over the step.
//!
//! 1. A pair is *safe* if its swept discs stay apart: the least distance over the step of `xj - xi + t (dj - di)` is
//!    at least `R` less a slack of 1e-6 `R`. A pair closer than that at the start (a bad start) is safe if it is
//!    never closer than at the start. The same for a body and a wall.
//! 2. Every agent has a *cell* (`cell.rs`): its displacement along the line to each near neighbour is at most half the
//!    gap between them (none if there is no gap), and towards each near wall at most the gap. Two agents that both
//!    stay in their cells are safe: along the line between the centres they close at most the gap, so at every
//!    moment the centres' distance, which is at least its part along that line, is at least `R`. An edge of a wall
//!    lies wholly beyond the line across its nearest point, hence a cell is safe for walls too. Standing still is in
//!    every cell.
//! 3. All start free. In each round every agent that is in an unsafe pair with any other, or unsafe with a wall,
//!    while free, is *clamped*: moved into its cell. A clamped agent stays clamped. After eight rounds, or
//!    when nobody new is clamped, the rest: if rounds ran out everybody who is still free is clamped. Each agent is
//!    clamped at most once, so this ends, and at the end every pair is either safe by check (one of the two is free)
//!    or safe by 2 (both are clamped).
//! 4. Rounding: what is checked is the motion that rounding leaves, `fl(x + d) - x`, in `f64`. A clamped result is
//!    checked against its cell after rounding; if rounding took it out it is shortened, and failing that the
//!    agent stands.
//!
//! Only pairs that can meet need a look: nobody moves farther than its `reach`, so pairs farther apart than `R` plus
//! both reaches are safe.
//!
//! Before certifying, a few symmetric relaxations (`relax.rs`) part the pairs that would collide: position-based, as
//! Weiss et al. (MIG 2017) resolve contacts. They make clamping rare; nothing depends on them.

mod cell;
mod contacts;
mod relax;

pub use contacts::Contacts;

use crate::avoid::Line;
use crate::parallel;
use crate::space::Walls;
use glam::{DVec2, Vec2};

/// Part of the sum of radii by which a checked pair may be closer than touching.
pub const SLACK: f64 = 1e-6;
/// Rounds of certification after which everybody who is still free is clamped.
const ROUNDS: usize = 8;

/// Bodies at the start of a step.
#[derive(Clone, Copy, Debug)]
pub struct Bodies<'a> {
    /// Centres.
    pub positions: &'a [Vec2],
    /// Radii.
    pub radii: &'a [f32],
    /// How far each may move in the step at most, metres.
    pub reach: &'a [f32],
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
    targets: Vec<Vec2>,
    next: Vec<Vec2>,
    clamped: Vec<bool>,
    verdicts: Vec<bool>,
}

/// Memory for one agent's cell.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    pub(crate) lines: Vec<Line>,
}

impl Guard {
    /// Makes the motion to `targets` certain, and puts what is certain there instead. `contacts` must hold every pair
    /// and every wall that the bodies' reach lets meet.
    pub fn certify(&mut self, bodies: &Bodies<'_>, contacts: &Contacts, walls: &Walls, targets: &mut [Vec2]) -> Report {
        let Self { targets: now, next, clamped, verdicts } = self;
        now.clear();
        now.extend(targets.iter().zip(bodies.positions).zip(bodies.reach).map(|((&to, &from), &reach)| {
            // a target that is not a number is no wish at all
            if to.is_finite() { from + (to - from).clamp_length_max(reach) } else { from }
        }));
        let mut report = Report::default();
        relax::relax(bodies, contacts, walls, now, next);
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
                    verdict[0] = !clamped[row]
                        && (last && !contacts.is_alone(row) || !is_safe(row, bodies, contacts, walls, now));
                },
            );
            if !verdicts.contains(&true) {
                break;
            }
            report.rounds = round;
            next.clone_from(now);
            parallel::rows(next, 1, Scratch::default, |scratch, row, target| {
                if verdicts[row] {
                    target[0] = cell::clamp(row, bodies, contacts, walls, target[0], scratch);
                }
            });
            std::mem::swap(now, next);
            for (clamped, &verdict) in clamped.iter_mut().zip(&*verdicts) {
                *clamped |= verdict;
            }
        }
        report.clamped = clamped.iter().filter(|&&c| c).count();
        for (row, (target, &certain)) in targets.iter_mut().zip(&*now).enumerate() {
            let wish = *target;
            // beyond a hundredth of the way, or of a thousandth of the body
            let tolerance = wish.distance(bodies.positions[row]).max(1e-3 * bodies.radii[row]) * 1e-2;
            report.changed += usize::from(!wish.is_finite() || wish.distance(certain) > tolerance);
            *target = certain;
        }
        report
    }
}

/// Whether the motion of `row` is safe with everybody and every wall.
fn is_safe(row: usize, bodies: &Bodies<'_>, contacts: &Contacts, walls: &Walls, targets: &[Vec2]) -> bool {
    let from = bodies.positions[row].as_dvec2();
    let motion = targets[row].as_dvec2() - from;
    contacts.of(row).iter().all(|&other| {
        let other = other as usize;
        let offset = bodies.positions[other].as_dvec2() - from;
        let radii = f64::from(bodies.radii[row]) + f64::from(bodies.radii[other]);
        let relative = targets[other].as_dvec2() - bodies.positions[other].as_dvec2() - motion;
        let needed = radii.min(offset.length()) - SLACK * radii;
        nearest_approach(offset, relative) >= needed
    }) && walls_are_safe(row, bodies, contacts, walls, from, motion)
}

fn walls_are_safe(
    row: usize,
    bodies: &Bodies<'_>,
    contacts: &Contacts,
    walls: &Walls,
    from: DVec2,
    motion: DVec2,
) -> bool {
    let radius = f64::from(bodies.radii[row]);
    let needed = |distance: f64| radius.min(distance) - SLACK * radius;
    contacts.edges_of(row).iter().all(|&index| {
        let edge = &walls.edges()[index as usize];
        // a segment and the swept centre: apart at an end of one of them, unless they cross
        let at_start = edge.nearest(from).distance(from);
        let to = from + motion;
        let swept = edge
            .nearest(to)
            .distance(to)
            .min(crate::space::nearest_on_segment(from, to, edge.start).distance(edge.start))
            .min(crate::space::nearest_on_segment(from, to, edge.end).distance(edge.end))
            .min(at_start);
        swept >= needed(at_start) && !cross(from, to, edge.start, edge.end)
    }) && contacts.discs_of(row).iter().all(|&index| {
        let disc = &walls.discs()[index as usize];
        let offset = disc.center - from;
        nearest_approach(offset, -motion) - disc.radius >= needed(offset.length() - disc.radius)
    })
}

/// The least length of `offset + t * motion` for t in [0, 1].
pub fn nearest_approach(offset: DVec2, motion: DVec2) -> f64 {
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

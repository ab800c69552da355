//! SIMD version of ORCA, one agent per element of a vector: the same operations as the [scalar version](super::orca),
//! with the same bits. Branches become selections between both results. Agents without a permitted velocity, few in a
//! sparse crowd, are finished by scalar code.

use super::half_plane::{HalfPlane, PARALLEL, least_violation};
use super::orca::{Orca, RECOVERY};
use super::simd_input::MOST_WALLS;
use super::{MOST_SIMD_NEIGHBOURS, SimdInput, SimdNeighbour, Workspace};
use crate::simd::{Vec2s, load, load_pairs, ones};
use fearless_simd::dispatch;
use fearless_simd::prelude::*;
use glam::Vec2;

/// Maximum number of half-planes of both kinds.
const MOST_WITH_WALLS: usize = MOST_WALLS + MOST_SIMD_NEIGHBOURS;

/// The agents, one in each element.
struct SimdAgents<S: Simd> {
    position: Vec2s<S>,
    velocity: Vec2s<S>,
    preferred: Vec2s<S>,
    max_speed: S::f32s,
}

/// Chooses the velocities of agents with SIMD. Leaves out agents that are at the same place as a neighbour.
pub(super) fn choose_many(orca: &Orca, input: &mut SimdInput, workspace: &mut Workspace) {
    if input.walls.is_empty() {
        dispatch!(input.level, simd => choose::<_, MOST_SIMD_NEIGHBOURS>(simd, orca, input, workspace));
    } else {
        dispatch!(input.level, simd => choose::<_, MOST_WITH_WALLS>(simd, orca, input, workspace));
    }
}

/// One half-plane per agent. An agent without it has the direction zero, which forbids nothing.
#[derive(Clone, Copy)]
struct Lines<S: Simd> {
    point: Vec2s<S>,
    direction: Vec2s<S>,
    /// The agents that have it.
    there: S::mask32s,
}

/// As [`choose_many`]. `N` is the maximum number of half-planes: [`MOST_SIMD_NEIGHBOURS`] if no agent has half-planes of
/// walls, else [`MOST_WITH_WALLS`].
#[inline(always)]
fn choose<S: Simd, const N: usize>(simd: S, orca: &Orca, input: &mut SimdInput, workspace: &mut Workspace) {
    let own = SimdAgents {
        position: Vec2s::load(simd, &input.position),
        velocity: Vec2s::load(simd, &input.velocity),
        preferred: Vec2s::load(simd, &input.preferred),
        max_speed: load(simd, &input.max_speed),
    };
    let none: Vec2s<S> = Vec2s::splat(simd, Vec2::ZERO);
    let none_there = none.x.simd_lt(none.x);
    let mut lines = [Lines { point: none, direction: none, there: none_there }; N];
    let mask = |bits: u64| S::mask32s::from_bitmask(simd, bits);
    let hard = input.walls.len();
    for (line, wall) in lines.iter_mut().zip(&input.walls) {
        let (point, direction) = (Vec2s::load(simd, &wall.point), Vec2s::load(simd, &wall.direction));
        *line = Lines { point, direction, there: mask(wall.there) };
    }
    let (step, most, mut left) = (input.step, input.most, 0);
    let seen = input.neighbours.iter().zip(&input.there);
    for (line, (others, &there)) in lines[hard..hard + most].iter_mut().zip(seen) {
        let (made, coincident) = self::line(simd, orca, &own, others, step);
        let there_lanes = mask(there);
        let direction = Vec2s::select(there_lanes, made.direction, none);
        *line = Lines { direction, there: there_lanes, ..made };
        left |= coincident & there;
    }
    input.agents &= !left;
    let lines = &lines[..hard + most];
    let (mut velocity, failed) = closest_velocity(simd, lines, own.max_speed, own.preferred);
    for lane in ones(failed.lanes.to_bitmask() & input.agents) {
        let Workspace { lines: all, fallback, .. } = workspace;
        all.clear();
        let at = |v: Vec2s<S>| Vec2::new(v.x[lane], v.y[lane]);
        let (mut walls, mut first) = (0, 0);
        for (index, line) in lines.iter().enumerate().filter(|(_, line)| line.there.to_bitmask() >> lane & 1 != 0) {
            walls += usize::from(index < hard);
            first += usize::from(index < failed.line[lane] as usize);
            all.push(HalfPlane { point: at(line.point), direction: at(line.direction) });
        }
        let best = least_violation(all, walls, own.max_speed[lane], (first, at(velocity)), fallback);
        (velocity.x[lane], velocity.y[lane]) = (best.x, best.y);
    }
    velocity.store(&mut input.chosen);
}

/// Returns the half-plane of one neighbour per agent, as [`half_plane`](super::AvoidanceNeighbour::half_plane), and the agents that are at the
/// same place as this neighbour.
#[inline(always)]
fn line<S: Simd>(simd: S, orca: &Orca, own: &SimdAgents<S>, others: &SimdNeighbour, step: f32) -> (Lines<S>, u64) {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let zero = splat(0.0);
    let velocity = own.velocity;
    let [position, other_velocity] = load_pairs(simd, &others.motion);
    let offset: Vec2s<S> = position - own.position;
    let radii = load(simd, &others.radii);
    let relative = velocity - other_velocity;
    let distance_squared = offset.dot(offset);
    let apart = distance_squared.simd_gt(radii * radii);
    // agents that are too close move apart within the recovery time
    let (offset_cut, radii_cut) = over_time(simd, (orca.time_horizon, step.max(RECOVERY)), apart, offset, radii);
    let w = relative - offset_cut;
    let along = w.dot(offset);
    let w_squared = w.dot(w);
    // nearest on the rounded tip: along < 0 and along^2 > (radii |w|)^2; too close agents always
    let backward = along.min(zero);
    let on_tip = (backward * backward).simd_gt(apart.select(radii * radii * w_squared, splat(-1.0)));
    // the change towards the rounded tip, or along a leg: each needs one root and one quotient
    let root = on_tip.select(w_squared, distance_squared - radii * radii).max(zero).sqrt();
    let coincident = !apart.to_bitmask() & root.simd_le(splat(1e-6)).to_bitmask();
    let left = Vec2s { x: offset.x * root - offset.y * radii, y: offset.x * radii + offset.y * root };
    let right = Vec2s { x: -(offset.x * root + offset.y * radii), y: -(offset.y * root - offset.x * radii) };
    let along_leg = Vec2s::select(offset.perp_dot(w).simd_gt(zero), left, right);
    let unit = Vec2s::select(on_tip, w, along_leg).over(on_tip.select(root, distance_squared));
    let tip_change = unit * (radii_cut - root);
    let leg_change = unit * relative.dot(unit) - relative;
    let normal = Vec2s::select(on_tip, unit, unit.perp());
    let change = Vec2s::select(on_tip, tip_change, leg_change);
    let share = load(simd, &others.share);
    let part = change.dot(normal).simd_gt(zero).select(share, splat(1.0) - share);
    let point = velocity + change * part;
    (Lines { point, direction: Vec2s { x: normal.y, y: -normal.x }, there: apart }, coincident)
}

/// Divides an offset and radii by a time: the first of `times` for agents that are apart, else the second. Where the
/// reciprocal of a time is exact, as for powers of two, the product has the same bits as the quotient.
#[inline(always)]
fn over_time<S: Simd>(
    simd: S,
    times: (f32, f32),
    apart: S::mask32s,
    offset: Vec2s<S>,
    radii: S::f32s,
) -> (Vec2s<S>, S::f32s) {
    let lanes = |first: f32, second: f32| apart.select(S::f32s::splat(simd, first), S::f32s::splat(simd, second));
    let is_exact = |time: f32| time.to_bits() & ((1 << (f32::MANTISSA_DIGITS - 1)) - 1) == 0;
    if is_exact(times.0) && is_exact(times.1) {
        let inverse = lanes(times.0.recip(), times.1.recip());
        (offset * inverse, radii * inverse)
    } else {
        let time = lanes(times.0, times.1);
        (offset.over(time), radii / time)
    }
}

/// The agents without a velocity in all half-planes, and the first line of each that could not be satisfied.
struct Failed<S: Simd> {
    lanes: S::mask32s,
    line: S::f32s,
}

/// SIMD version of [`closest_velocity`](super::half_plane::closest_velocity). For agents without a permitted velocity
/// it returns the best velocity before the failed line.
#[inline(always)]
fn closest_velocity<S: Simd>(
    simd: S,
    lines: &[Lines<S>],
    speed: S::f32s,
    preferred: Vec2s<S>,
) -> (Vec2s<S>, Failed<S>) {
    let zero = S::f32s::splat(simd, 0.0);
    let mut v = preferred.clamp_length_max(speed);
    let mut failed: Failed<S> = Failed { lanes: zero.simd_lt(zero), line: zero };
    for (i, line) in lines.iter().enumerate() {
        let violated = line.direction.perp_dot(line.point - v).simd_gt(zero);
        if violated.any_true() {
            let violated = violated & !failed.lanes;
            let (on, fails) = on_line(simd, &lines[..i], line, speed, preferred);
            let fails = fails & violated;
            v = Vec2s::select(violated & !fails, on, v);
            failed.line = fails.select(S::f32s::splat(simd, i as f32), failed.line);
            failed.lanes |= fails;
        }
    }
    (v, failed)
}

/// Returns the point nearest to `aim` on a line within the disc and the lines before it, and the agents that have none.
#[inline(always)]
fn on_line<S: Simd>(
    simd: S,
    before: &[Lines<S>],
    line: &Lines<S>,
    speed: S::f32s,
    aim: Vec2s<S>,
) -> (Vec2s<S>, S::mask32s) {
    let zero = S::f32s::splat(simd, 0.0);
    let (parallel, infinite) = (S::f32s::splat(simd, PARALLEL), S::f32s::splat(simd, f32::INFINITY));
    let Lines { point, direction, .. } = *line;
    let along = point.dot(direction);
    let discriminant = along * along + speed * speed - point.dot(point);
    let mut fails = discriminant.simd_lt(zero);
    let root = discriminant.sqrt();
    let (mut low, mut high) = (-along - root, -along + root);
    for other in before {
        let denominator = direction.perp_dot(other.direction);
        let numerator = other.direction.perp_dot(point - other.point);
        // a parallel line permits all of this line, or nothing
        let level = denominator.abs().simd_le(parallel);
        let t = numerator / denominator;
        let most = level.select(numerator.simd_lt(zero).select(-infinite, infinite), t);
        let is_upper = denominator.simd_ge(-parallel);
        high = is_upper.select(high.min(most), high);
        low = is_upper.select(low, low.max(t));
    }
    fails |= low.simd_gt(high);
    let t = direction.dot(aim - point);
    let t = t.simd_lt(low).select(low, t);
    let t = t.simd_gt(high).select(high, t);
    (point + direction * t, fails)
}

//! Stage 5, motion: agents move to where the guard finds no overlap.

use super::flight_simd::fly_many;
use super::wrap::Wrap;
use crate::agent::{Column, ColumnValue, Columns, Rounding, SEEN, Status};
use crate::guard::{BodyPose, Guarded};
use crate::intend::{Facing, Intended, Velocities};
use crate::motion::{Attitude, Motion, Vehicle, angle, turn, wrap};
use crate::navigate::NeighbourData;
use crate::parallel::{self, RowLists};
use crate::perceive::SubStep;
use crate::sleep::SleepBlocks;
use crate::world::State;
use glam::{Vec2, Vec3};

/// 5. Motion: moves agents to the targets of the guard, turns them, and wraps them around.
#[derive(Clone, Debug, Default)]
pub(crate) struct Move {
    /// Rows that turn on the scalar path, with their headings and the sums of their turns before the motion.
    pub(super) turners: Vec<(usize, f32, f64)>,
    wrap: Wrap,
}

impl Move {
    /// Moves all agents, and records which of them were still.
    pub fn run(
        &mut self,
        state: &mut State,
        shown: &[NeighbourData],
        mut intended: Intended<'_>,
        (chosen, safe): (&Velocities, Guarded<'_>),
        sleep: &mut SleepBlocks,
        SubStep { seconds, .. }: SubStep,
    ) {
        sleep.note_still(state, |row| {
            let is_displaced = state.is_guarded() && safe.has_moved(row) && {
                let to = safe.targets[row].position;
                !to.same(state.agents.position[row])
            };
            !is_displaced
                && !shown[row].way.may_change()
                && is_still(&state.agents, chosen.ground[row], row, seconds)
                // it waits for room on the other side
                && state.other_side(row).is_none()
        });
        let flying = state.lanes_to_fly().filter(|_| !state.is_guarded());
        match (state.lanes_to_move(), flying) {
            (Some(level), _) => self.move_many(level, state, &intended, (chosen, safe), sleep, seconds),
            (None, Some(level)) => fly_many(level, state, &mut intended, chosen, safe, seconds),
            (None, None) => move_each(state, &intended, chosen, safe, seconds),
        }
        self.wrap.run(state, safe.solids, sleep);
        state.agents.pass(seconds);
    }
}

/// Whether an agent that does not walk has the same state after this sub-step as before, if nothing moves it.
fn is_still(agents: &Columns, chosen: Vec2, row: usize, seconds: f32) -> bool {
    // a motion below the resolution of positions is no motion, unless rounding keeps it
    let stays = || {
        let (at, rounding) = (agents.position[row], agents.rounding[row]);
        let way = chosen * seconds + rounding.0;
        (at + way).same(at) && Rounding::of(at, way, Vec2::ZERO).same(rounding)
    };
    chosen.same(agents.velocity[row]) && stays() && chosen.length() < SEEN && agents.travel[row].is_settled()
}

/// Moves all agents on the scalar path.
fn move_each(state: &mut State, intended: &Intended<'_>, chosen: &Velocities, safe: Guarded<'_>, seconds: f32) {
    let (any_vehicle, all_discs) = (state.any_vehicle(), state.agents.all_discs());
    let rounds = rounds(&state.agents, safe);
    let agents = &mut state.agents;
    let (core, max_turn_rate, status) = (&agents.core, &agents.max_turn_rate, &agents.status);
    let (vehicle, script) = (&agents.vehicle, &agents.script);
    let moving = (
        (&mut agents.position[..], &mut agents.velocity[..], &mut agents.heading[..]),
        (
            (
                rows_if(chosen.is_in_space(), &mut agents.altitude),
                rows_if(chosen.is_in_space(), &mut agents.vertical_velocity),
            ),
            (rows_if(any_vehicle, &mut agents.attitude), rows_if(!all_discs, &mut agents.spin)),
            rows_if(rounds, &mut agents.rounding),
        ),
        (&mut agents.turned[..], &mut agents.course_turned[..], &mut agents.walked[..]),
    );
    let (facing, looks) = (intended.facing(), intended.looks);
    let planned = &*intended.planned;
    parallel::ranges(moving, |rows, (place, ((altitude, vertical_velocity), (attitude, spin), rounding), trip)| {
        let (position, velocities, headings) = place;
        let (turned, course_turned, walked) = trip;
        for (at, row) in rows.enumerate() {
            let height = |column: &RowLists<'_, f32>| column.all.get(at).copied().unwrap_or(0.0);
            let from = position[at].extend(height(&altitude));
            let before = velocities[at].extend(height(&vertical_velocity));
            let target = safe.targets[row];
            let place = target.place();
            let wish = chosen.at(row);
            let mut velocity = match rounding.all.get_mut(at) {
                None => velocity(from, place, (wish, wish * seconds), seconds).0,
                Some(rounding) => {
                    let way = wish * seconds + rounding.0.extend(-0.0);
                    let (velocity, unchanged) = velocity(from, place, (wish, way), seconds);
                    let rounds = unchanged && vehicle[row].is_none();
                    let round = || Rounding::of(place.truncate(), way.truncate(), (place - from).truncate());
                    *rounding = if rounds { round() } else { Rounding::NONE };
                    velocity
                }
            };
            let heading = if let Some(vehicle) = vehicle[row].filter(|_| script[row].is_none()) {
                let motion = attitude.all[at].motion(from, before);
                let (moved, mut now) = if facing.is_as_planned(row, velocity) {
                    (planned.velocity[row], planned.attitude[row])
                } else {
                    let planned = (&planned.attitude[row], planned.faces[row]);
                    diverted(&vehicle, &motion, planned, velocity, seconds)
                };
                if core[row] != Vec2::ZERO {
                    // the guard has chosen the heading of a body that is not a disc
                    if target.heading != now.basis.heading() {
                        now.basis = Attitude::heading(target.heading).basis;
                    }
                    spin.all[at] = wrap(target.heading - headings[at]) / seconds;
                }
                (velocity, attitude.all[at]) = (moved, now);
                now.basis.heading()
            } else {
                let is_disc = core[row] == Vec2::ZERO;
                let now = turned_heading(
                    (!is_disc).then_some(target.heading),
                    velocity.truncate(),
                    (facing, looks),
                    (row, max_turn_rate[row]),
                    headings[at],
                    seconds,
                );
                if !is_disc {
                    spin.all[at] = wrap(now - headings[at]) / seconds;
                }
                now
            };
            if status[row] == Status::Walking {
                turned[at] += turn_between(headings[at], heading);
                course_turned[at] += f64::from(angle_between(before.truncate(), velocity.truncate()));
                walked[at] += f64::from((place - from).length());
            }
            (position[at], velocities[at], headings[at]) = (place.truncate(), velocity.truncate(), heading);
            if let (Some(altitude), Some(vertical_velocity)) =
                (altitude.all.get_mut(at), vertical_velocity.all.get_mut(at))
            {
                (*altitude, *vertical_velocity) = (place.z, velocity.z);
            }
        }
    });
}

/// Returns the values of a column, mutable; empty if they are not needed.
pub(super) fn rows_if<T: ColumnValue>(needed: bool, column: &mut Column<T>) -> RowLists<'_, T> {
    RowLists { all: if needed { column.rows_mut() } else { &mut [] }, stride: usize::from(needed) }
}

/// Returns the heading of an agent without a vehicle after its motion. `chosen` is the heading that the guard has chosen
/// for a body that is not a disc.
fn turned_heading(
    chosen: Option<f32>,
    velocity: Vec2,
    (facing, looks): (Facing<'_>, &[Vec2]),
    (row, max_turn_rate): (usize, f32),
    before: f32,
    seconds: f32,
) -> f32 {
    if let Some(chosen) = chosen {
        return chosen;
    }
    let to = match looks.get(row) {
        Some(&looks) if looks != Vec2::ZERO => looks,
        _ => facing.direction(row, velocity, max_turn_rate),
    };
    turn(before, to, seconds, max_turn_rate)
}

/// Turns an agent without a vehicle that has moved, from its heading before.
pub(super) fn turn_walker(
    agents: &mut Columns,
    facing: (Facing<'_>, &[Vec2]),
    targets: &[BodyPose],
    row: usize,
    before: f32,
    seconds: f32,
) {
    let is_disc = agents.is_disc(row);
    let limit = (row, agents.max_turn_rate[row]);
    // without a guard and among discs there are no targets
    let chosen = (!is_disc).then(|| targets[row].heading);
    let heading = turned_heading(chosen, agents.velocity[row], facing, limit, before, seconds);
    if !is_disc {
        agents.spin.set(row, wrap(heading - before) / seconds);
    }
    agents.heading[row] = heading;
    if agents.status[row] == Status::Walking {
        agents.turned[row] += turn_between(before, heading);
    }
}

/// Returns the angle between two headings.
fn turn_between(before: f32, heading: f32) -> f64 {
    let turned = f64::from((heading - before).abs());
    turned.min(std::f64::consts::TAU - turned)
}

/// Returns the angle between two velocities, radians; 0 if either has no visible direction.
fn angle_between(a: Vec2, b: Vec2) -> f32 {
    if a.length() < SEEN || b.length() < SEEN { 0.0 } else { angle(Vec2::new(a.dot(b), a.perp_dot(b))).abs() }
}

/// Returns the motion of a vehicle after the avoidance or the guard changed its velocity.
pub(super) fn diverted(
    vehicle: &Vehicle,
    before: &Motion,
    (planned, faces): (&Attitude, bool),
    velocity: Vec3,
    seconds: f32,
) -> (Vec3, Attitude) {
    let planned = planned.motion(before.position, velocity);
    let moved = vehicle.diverted(before, planned, faces, velocity, seconds);
    (moved.velocity, moved.into())
}

/// Whether the rounding of positions may be more than nothing, before or after a motion.
pub(super) fn rounds(agents: &Columns, safe: Guarded<'_>) -> bool {
    safe.any_far || agents.are_rounded()
}

/// Returns the velocity of a motion, and whether it covers the `way` of its chosen velocity. Such a motion keeps its chosen
/// velocity exactly, because it may be far below the resolution of positions.
pub(crate) fn velocity(from: Vec3, to: Vec3, (chosen, way): (Vec3, Vec3), seconds: f32) -> (Vec3, bool) {
    let unchanged = to.distance(from + way) <= to.abs().max_element() * f32::EPSILON;
    (if unchanged { chosen } else { (to - from) / seconds }, unchanged)
}

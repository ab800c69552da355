//! Stage 5, motion: agents move to where the guard finds no overlap.

use super::flight_simd::fly_many;
use crate::agent::{ColumnValue, Columns, SEEN, Status};
use crate::guard::{BodyPose, Guarded};
use crate::intend::{Intended, Velocities};
use crate::motion::{Attitude, Motion, Vehicle, angle, faces, turn, wrap};
use crate::navigate::NeighbourData;
use crate::perceive::SubStep;
use crate::sleep::SleepBlocks;
use crate::world::State;
use glam::{Vec2, Vec3};

/// 5. Motion: moves agents to the targets of the guard, and turns them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Move {
    /// Rows that turn on the scalar path, with their headings and the sums of their turns before the motion.
    pub(super) turners: Vec<(usize, f32, f64)>,
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
            !is_displaced && !shown[row].way.may_change() && is_still(&state.agents, chosen.ground[row], row, seconds)
        });
        let flying = state.lanes_to_fly(seconds).filter(|_| !state.is_guarded());
        match (state.lanes_to_move(), flying) {
            (Some(level), _) => self.move_many(level, state, &intended, (chosen, safe), sleep, seconds),
            (None, Some((level, _))) => fly_many(level, state, &mut intended, chosen, safe, seconds),
            (None, None) => move_each(state, &intended, chosen, safe, seconds),
        }
        state.agents.pass(seconds);
    }
}

/// Whether an agent that does not walk has the same state after this sub-step as before, if nothing moves it.
fn is_still(agents: &Columns, chosen: Vec2, row: usize, seconds: f32) -> bool {
    let at = agents.position[row];
    chosen.same(agents.velocity[row])
        // a motion below the resolution of positions is no motion
        && (at + chosen * seconds).same(at)
        && chosen.length() < SEEN
        && agents.travel[row].is_settled()
}

/// Moves all agents on the scalar path.
fn move_each(state: &mut State, intended: &Intended<'_>, chosen: &Velocities, safe: Guarded<'_>, seconds: f32) {
    let State { agents, local_groups: groups, .. } = state;
    for row in 0..agents.len() {
        let from = agents.position[row].extend(agents.altitude[row]);
        let target = safe.targets[row];
        let velocity = velocity(from, target.place(), chosen.at(row), seconds);
        agents.position[row] = target.position;
        agents.altitude.set(row, target.altitude);
        let (velocity_before, climb_before) = (agents.velocity[row], agents.vertical_velocity[row]);
        agents.velocity[row] = velocity.truncate();
        agents.vertical_velocity.set(row, velocity.z);
        let before = agents.heading[row];
        let group = &groups[agents.group[row].index()];
        let heading = if group.steering.is_some() {
            let before = agents.attitude[row].motion(from, velocity_before.extend(climb_before));
            let (moved, attitude) = if velocity == intended.preferred.at(row) {
                (intended.planned.velocity[row], intended.planned.attitude[row])
            } else {
                diverted(
                    &group.vehicle,
                    &before,
                    (&intended.planned.attitude[row], intended.planned.faces[row]),
                    velocity,
                    seconds,
                )
            };
            agents.velocity[row] = moved.truncate();
            agents.vertical_velocity.set(row, moved.z);
            agents.attitude.set(row, attitude);
            if let Some(place) = group.wrap_around.and_then(|ball| ball.back(target.place())) {
                agents.position[row] = place.truncate();
                agents.altitude.set(row, place.z);
            }
            attitude.basis.heading()
        } else {
            turned_heading(agents, intended.facing(), safe.targets, row, before, seconds)
        };
        add_turn(agents, row, before, heading);
        if agents.status[row] == Status::Walking {
            agents.course_turned[row] += f64::from(angle_between(velocity_before, agents.velocity[row]));
            agents.walked[row] += f64::from((target.place() - from).length());
        }
    }
}

/// Returns the heading of an agent that does not steer after its motion, and records the spin of a body that is not a disc.
fn turned_heading(
    agents: &mut Columns,
    (preferred, looks): (&Velocities, &[Vec2]),
    targets: &[BodyPose],
    row: usize,
    before: f32,
    seconds: f32,
) -> f32 {
    if !agents.is_disc(row) {
        let heading = targets[row].heading;
        agents.spin.set(row, wrap(heading - before) / seconds);
        return heading;
    }
    let facing = match looks.get(row) {
        Some(&looks) if looks != Vec2::ZERO => looks,
        _ => faces(agents.velocity[row], preferred.ground[row], agents.max_turn_rate[row]),
    };
    turn(before, facing, seconds, agents.max_turn_rate[row])
}

/// Turns an agent that does not steer and has moved, from its heading before.
pub(super) fn turn_walker(
    agents: &mut Columns,
    facing: (&Velocities, &[Vec2]),
    targets: &[BodyPose],
    row: usize,
    before: f32,
    seconds: f32,
) {
    let heading = turned_heading(agents, facing, targets, row, before, seconds);
    add_turn(agents, row, before, heading);
}

/// Sets the heading of an agent, and adds the turn of a walking agent to its trip.
fn add_turn(agents: &mut Columns, row: usize, before: f32, heading: f32) {
    agents.heading[row] = heading;
    if agents.status[row] == Status::Walking {
        let turned = f64::from((heading - before).abs());
        agents.turned[row] += turned.min(std::f64::consts::TAU - turned);
    }
}

/// Returns the angle between two velocities, radians; 0 if either has no visible direction.
fn angle_between(a: Vec2, b: Vec2) -> f32 {
    if a.length() < SEEN || b.length() < SEEN { 0.0 } else { angle(Vec2::new(a.dot(b), a.perp_dot(b))).abs() }
}

/// Returns the motion of a steered agent after the avoidance or the guard changed its velocity.
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

/// Returns the velocity of a motion. A motion that the guard did not change keeps its chosen velocity exactly, because
/// it may be far below the resolution of positions.
pub(crate) fn velocity(from: Vec3, to: Vec3, chosen: Vec3, seconds: f32) -> Vec3 {
    let unchanged = to.distance(from + chosen * seconds) <= to.abs().max_element() * f32::EPSILON;
    if unchanged { chosen } else { (to - from) / seconds }
}

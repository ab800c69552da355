//! The motion of vehicles that are the same, with SIMD, one agent in each element. The bits are the same as those of the
//! [scalar path](super::movement).

use super::movement::{diverted, rows_if};
use super::movement_simd::Trips;
use crate::agent::{Column, SEEN, Status};
use crate::guard::{BodyPose, Guarded, Solids};
use crate::intend::{Intended, Velocities};
use crate::motion::{Attitude, Vehicle, angles};
use crate::parallel;
use crate::simd::{LANES, Vec2s, Vec3s, from_side_by_side, get3, in_space, ones, set, set3};
use crate::world::State;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{Vec2, Vec3};
use std::ops::Range;

/// Moves all agents, if all are discs with the same vehicle, and no agent is guarded.
pub(super) fn fly_many(
    level: Level,
    state: &mut State,
    intended: &mut Intended<'_>,
    chosen: &Velocities,
    safe: Guarded<'_>,
    seconds: f32,
) {
    let agents = &mut state.agents;
    let Some(Some(vehicle)) = agents.vehicle.uniform() else { return };
    let in_air = chosen.is_in_space();
    let flight = Flight {
        preferred: intended.preferred,
        chosen_velocities: chosen,
        before: &agents.attitude,
        faces: &intended.planned.faces,
        reach: safe.reach,
        solids: safe.solids,
        led: safe.targets,
        status: &agents.status,
        vehicle,
        seconds,
    };
    let flying = (
        (&mut agents.position[..], &mut agents.velocity[..], &mut agents.heading[..]),
        (
            (&mut intended.planned.velocity[..], &mut intended.planned.attitude[..]),
            (rows_if(in_air, &mut agents.altitude), rows_if(in_air, &mut agents.vertical_velocity)),
        ),
        (&mut agents.turned[..], &mut agents.course_turned[..], &mut agents.walked[..]),
    );
    parallel::ranges(
        flying,
        |rows, (place, (planned, (altitude, vertical_velocity)), (turned, course_turned, walked))| {
            let trip = Trips { turned, course_turned, walked };
            let mut flying =
                Flying { place, planned, altitude: altitude.all, vertical_velocity: vertical_velocity.all, trip };
            dispatch!(level, simd => flight.all(simd, rows, &mut flying));
        },
    );
    // the planned attitudes are now the present ones
    agents.attitude.exchange(&mut intended.planned.attitude);
}

/// What the motion of flying agents depends on, for all rows.
struct Flight<'a> {
    preferred: &'a Velocities,
    chosen_velocities: &'a Velocities,
    before: &'a Column<Attitude>,
    /// Whether they face a given direction.
    faces: &'a [bool],
    reach: &'a Column<f32>,
    /// Agents near solids take the targets in `led`.
    solids: &'a Solids,
    led: &'a [BodyPose],
    status: &'a [Status],
    vehicle: Vehicle,
    seconds: f32,
}

/// What the motion of flying agents changes, for some rows.
struct Flying<'a> {
    /// Positions, velocities and headings along the ground.
    place: (&'a mut [Vec2], &'a mut [Vec2], &'a mut [f32]),
    /// Velocities and attitudes: first as planned, then as they are.
    planned: (&'a mut [Vec3], &'a mut [Attitude]),
    altitude: &'a mut [f32],
    vertical_velocity: &'a mut [f32],
    trip: Trips<'a>,
}

impl Flight<'_> {
    #[inline(always)]
    fn all<S: Simd>(&self, simd: S, rows: Range<usize>, flying: &mut Flying<'_>) {
        for start in (0..rows.len()).step_by(S::f32s::LEN) {
            let part = start..(start + S::f32s::LEN).min(rows.len());
            self.some(simd, rows.start + start..rows.start + part.end, part, flying);
        }
    }

    /// Moves a SIMD vector of rows. `part` is their range within `flying`.
    #[inline(always)]
    fn some<S: Simd>(&self, simd: S, rows: Range<usize>, part: Range<usize>, flying: &mut Flying<'_>) {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let seconds = splat(self.seconds);
        let Flying { place: (positions, velocities, headings), planned, altitude, vertical_velocity, trip } = flying;
        let planned = (&mut planned.0[part.clone()], &mut planned.1[part.clone()]);
        let air = |column: &[f32]| column.get(part.clone()).map_or(splat(0.0), |part| from_side_by_side(simd, part));
        let from = in_space(simd, &positions[part.clone()], air(altitude));
        let before = in_space(simd, &velocities[part.clone()], air(vertical_velocity));
        let chosen = in_space(
            simd,
            &self.chosen_velocities.ground[rows.clone()],
            self.chosen_velocities.vertical_velocities(simd, rows.clone()),
        );
        // as `within_reach`
        let wished = from + chosen * seconds;
        let motion = wished - from;
        let reached = motion.clamp_length_max(self.reach.lanes(simd, rows.clone()));
        let is_finite = wished.x.is_finite() & wished.y.is_finite() & wished.z.is_finite();
        let to = Vec3s::select(is_finite, from + reached, from);
        // no agent gets below the ground
        let to = Vec3s { z: to.z.simd_gt(splat(0.0)).select(to.z, splat(0.0)), ..to };
        let to = self.led(simd, rows.clone(), to);
        // as `velocity`
        let limit = to.x.abs().max(to.y.abs()).max(to.z.abs()) * splat(f32::EPSILON);
        let unchanged = (to - wished).length().simd_le(limit);
        let velocity = Vec3s::select(unchanged, chosen, (to - from).over(seconds));
        // agents that deviate from the plan
        let wanted = in_space(
            simd,
            &self.preferred.ground[rows.clone()],
            self.preferred.vertical_velocities(simd, rows.clone()),
        );
        let same = velocity.x.simd_eq(wanted.x) & velocity.y.simd_eq(wanted.y) & velocity.z.simd_eq(wanted.z);
        let other = !same.to_bitmask() & ((1 << part.len()) - 1);
        if other != 0 {
            let (mut places, mut were, mut are) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3], [[0.0; LANES]; 3]);
            from.store(&mut places);
            before.store(&mut were);
            velocity.store(&mut are);
            for lane in ones(other) {
                let before = self.before[rows.start + lane].motion(get3(&places, lane), get3(&were, lane));
                let plan = (&planned.1[lane], self.faces[rows.start + lane]);
                (planned.0[lane], planned.1[lane]) =
                    diverted(&self.vehicle, &before, plan, get3(&are, lane), self.seconds);
            }
        }
        let (mut forwards, mut moved) = ([[0.0; LANES]; 2], [[0.0; LANES]; 3]);
        for (lane, (&velocity, attitude)) in planned.0.iter().zip(&*planned.1).enumerate() {
            set(&mut forwards, lane, attitude.basis.forward.truncate());
            set3(&mut moved, lane, velocity);
        }
        let velocity = Vec3s::load(simd, &moved);
        let facing = angles(simd, Vec2s::load(simd, &forwards));
        let heading = from_side_by_side(simd, &headings[part.clone()]);
        // the increments of the trip statistics
        let (before, after) = (before.truncate(), velocity.truncate());
        let seen = |v: Vec2s<S>| v.dot(v).sqrt().simd_ge(splat(SEEN));
        let course = angles(simd, Vec2s { x: before.dot(after), y: before.perp_dot(after) }).abs();
        let course = (seen(before) & seen(after)).select(course, splat(0.0));
        to.truncate().put_side_by_side(&mut positions[part.clone()]);
        after.put_side_by_side(&mut velocities[part.clone()]);
        if let (Some(altitude), Some(vertical_velocity)) =
            (altitude.get_mut(part.clone()), vertical_velocity.get_mut(part.clone()))
        {
            altitude.copy_from_slice(&to.z.as_slice()[..part.len()]);
            vertical_velocity.copy_from_slice(&velocity.z.as_slice()[..part.len()]);
        }
        headings[part.clone()].copy_from_slice(&facing.as_slice()[..part.len()]);
        trip.add(simd, &self.status[rows], part, ((facing - heading).abs(), course, (to - from).length()));
    }
}

impl Flight<'_> {
    /// Returns the targets of a SIMD vector of rows, with the targets of agents near solids replaced.
    #[inline(always)]
    fn led<S: Simd>(&self, simd: S, rows: Range<usize>, to: Vec3s<S>) -> Vec3s<S> {
        let near = self.solids.near_of(rows.clone());
        if near == 0 {
            return to;
        }
        let mut places = [[0.0; LANES]; 3];
        to.store(&mut places);
        ones(near).for_each(|lane| set3(&mut places, lane, self.led[rows.start + lane].place()));
        Vec3s::load(simd, &places)
    }
}

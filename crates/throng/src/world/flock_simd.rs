//! The birds of one flock, or the insects of one swarm, with SIMD, one agent in each element: vehicles and motion. The
//! bits are the same as those of the scalar path in [steering](super::steer) and [motion](super::advance).

use super::{State, World};
use super::advance::{SEEN, diverted};
use super::advance_simd::Trips;
use super::velocities::{Rows, Velocities};
use crate::agent::{Column, Group, Status};
use crate::guard::{BodyPose, Solids};
use crate::motion::{Attitude, Attitudes, Motions, Stepping, angles};
use crate::parallel::{self, RowLists};
use crate::simd::{LANES, Vec2s, Vec3s, from_side_by_side, get3, ones, set, set3};
use crate::steer::SteeringNeighbour;
use crate::steer::swarm::Swarm;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{Vec2, Vec3};
use std::ops::Range;

impl World {
    /// Applies the vehicles of some rows to their steering forces.
    pub(super) fn steer_many(
        &self,
        (level, stepping): (Level, Stepping),
        rows: Range<usize>,
        planned: (&mut [Vec3], &mut [Attitude]),
        preferred: Rows<'_>,
        insects: &mut Insects<'_>,
    ) {
        dispatch!(level, simd => self.steer_all(simd, stepping, rows, planned, preferred, insects));
    }

    #[inline(always)]
    fn steer_all<S: Simd>(
        &self,
        simd: S,
        stepping: Stepping,
        rows: Range<usize>,
        (velocities, attitudes): (&mut [Vec3], &mut [Attitude]),
        (ground, vertical_velocity): Rows<'_>,
        insects: &mut Insects<'_>,
    ) {
        let lanes = S::f32s::LEN;
        let swarm = self.state.swarm(rows.start);
        for start in (0..rows.len()).step_by(lanes) {
            let part = start..(start + lanes).min(rows.len());
            let rows = rows.start + part.start..rows.start + part.end;
            let before = self.state.motions(simd, rows.clone());
            let mut force = [[0.0; LANES]; 3];
            if let Some(swarm) = swarm {
                self.forces_of_insects(simd, swarm, rows, part.start, insects, &mut force);
            } else {
                for (lane, row) in rows.enumerate() {
                    set3(&mut force, lane, self.step.flocks.force(row));
                }
            }
            let after = stepping.step(simd, &before, Vec3s::load(simd, &force));
            let chosen = (after.position - before.position).over(S::f32s::splat(simd, insects.seconds));
            chosen.truncate().put_side_by_side(&mut ground[part.clone()]);
            if let Some(vertical_velocity) = vertical_velocity.all.get_mut(part.clone()) {
                vertical_velocity.copy_from_slice(&chosen.z.as_slice()[..vertical_velocity.len()]);
            }
            let mut velocity = [[0.0; LANES]; 3];
            after.velocity.store(&mut velocity);
            (velocities[part.clone()].iter_mut().enumerate()).for_each(|(lane, v)| *v = get3(&velocity, lane));
            after.attitude.store(simd, &mut attitudes[part]);
        }
    }

    /// Computes the forces of the insects of a SIMD vector of rows. `from` is the index of the first row within the
    /// memory of `insects`. Noise uses SIMD; the rest is the scalar [behaviour](crate::steer::Behaviour).
    #[inline(always)]
    fn forces_of_insects<S: Simd>(
        &self,
        simd: S,
        swarm: &Swarm,
        rows: Range<usize>,
        from: usize,
        insects: &mut Insects<'_>,
        forces: &mut [[f32; LANES]; 3],
    ) {
        let (mut places, mut noise) = ([Vec3::ZERO; LANES], [Vec3::ZERO; LANES]);
        let (start, count) = (rows.start, rows.len());
        (places.iter_mut().zip(rows.clone())).for_each(|(place, row)| *place = self.state.place_in_space(row));
        if let Some(field) = &swarm.noise {
            let numbers = swarm.own_noise.then_some(&self.state.agents.number[rows]);
            let time = insects.now - f64::from(insects.seconds);
            field.vector(simd, (&places[..count], numbers), time, &mut noise[..count]);
        }
        self.forces_one_by_one(swarm, start, from, &noise[..count], insects, forces);
    }

    /// As [`forces_of_insects`](Self::forces_of_insects), with given noise.
    #[inline(never)]
    fn forces_one_by_one(
        &self,
        swarm: &Swarm,
        start: usize,
        from: usize,
        noise: &[Vec3],
        Insects { neighbours, memory, seconds, now }: &mut Insects<'_>,
        forces: &mut [[f32; LANES]; 3],
    ) {
        for (lane, &noise) in noise.iter().enumerate() {
            let words = (from + lane) * memory.stride..(from + lane + 1) * memory.stride;
            let view = self.steering_view(start + lane, *seconds, *now, neighbours);
            let velocity = swarm.velocity(&view, noise, &mut memory.all[words]);
            set3(forces, lane, view.reach(velocity).force);
        }
    }

    /// Moves all agents, if all are birds of one flock or insects of one swarm, and no agent is guarded.
    pub(super) fn fly_many(&mut self, level: Level, seconds: f32) {
        let Self { state: State { agents, local_groups: groups, .. }, step } = self;
        let in_air = step.chosen_velocities.is_in_space();
        let flight = Flight {
            preferred: &step.preferred,
            chosen_velocities: &step.chosen_velocities,
            before: &agents.attitude,
            reach: &step.reach,
            solids: &step.solids,
            led: &step.targets,
            status: &agents.status,
            group: &groups[agents.group[0].index()],
            seconds,
        };
        let flying = (
            (&mut agents.position[..], &mut agents.velocity[..], &mut agents.heading[..]),
            (
                (&mut step.planned.velocity[..], &mut step.planned.attitude[..]),
                (in_the_air(&mut agents.altitude, in_air), in_the_air(&mut agents.vertical_velocity, in_air)),
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
        agents.attitude.exchange(&mut step.planned.attitude);
    }
}

impl State {
    /// Returns the SIMD level and the vehicle step of all agents, if all are birds of one flock or insects of one
    /// swarm.
    pub(crate) fn lanes_to_fly(&self, seconds: f32) -> Option<(Level, Stepping)> {
        let group = &self.local_groups[self.agents.group.uniform()?.index()];
        let alike = self.agents.all_discs() && (self.is_bird(0) || self.swarm(0).is_some());
        let level = self.instructions.level().filter(|_| alike)?;
        Some((level, Stepping::of(&group.vehicle, seconds)?))
    }

    /// Returns the swarm of an agent that steers by a plain [`Swarm`] behaviour and avoids no other agent.
    fn swarm(&self, row: usize) -> Option<&Swarm> {
        let group = &self.local_groups[self.agents.group[row].index()];
        group.steering.as_ref().filter(|_| !group.model.avoids())?.as_swarm()
    }

    /// Returns the motion of the agents of a SIMD vector of rows.
    #[inline(always)]
    fn motions<S: Simd>(&self, simd: S, rows: Range<usize>) -> Motions<S> {
        let agents = &self.agents;
        Motions {
            position: in_space(simd, &agents.position[rows.clone()], agents.altitude.lanes(simd, rows.clone())),
            velocity: in_space(
                simd,
                &agents.velocity[rows.clone()],
                agents.vertical_velocity.lanes(simd, rows.clone()),
            ),
            attitude: Attitudes::load(simd, rows.map(|row| agents.attitude[row])),
        }
    }
}

/// Additional steering input of the insects of some rows, in the sub-step that ends at `now`.
pub(super) struct Insects<'a> {
    pub neighbours: &'a mut Vec<SteeringNeighbour>,
    pub memory: RowLists<'a, f32>,
    pub seconds: f32,
    pub now: f64,
}

/// Returns a column of altitudes or vertical velocities; empty while no agent can leave the ground.
fn in_the_air(column: &mut Column<f32>, in_air: bool) -> RowLists<'_, f32> {
    RowLists { all: if in_air { column.rows_mut() } else { &mut [] }, stride: usize::from(in_air) }
}

/// What the motion of flying agents depends on, for all rows.
struct Flight<'a> {
    preferred: &'a Velocities,
    chosen_velocities: &'a Velocities,
    before: &'a Column<Attitude>,
    reach: &'a Column<f32>,
    /// Agents near solids take the targets in `led`.
    solids: &'a Solids,
    led: &'a [BodyPose],
    status: &'a [Status],
    group: &'a Group,
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
                let planned = (&mut planned.0[lane], &mut planned.1[lane]);
                let (velocity, attitude) =
                    diverted(&self.group.vehicle, &before, (planned.1, false), get3(&are, lane), self.seconds);
                (*planned.0, *planned.1) = (velocity, attitude);
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
        let there = self.wrapped(simd, to);
        there.truncate().put_side_by_side(&mut positions[part.clone()]);
        after.put_side_by_side(&mut velocities[part.clone()]);
        if let (Some(altitude), Some(vertical_velocity)) =
            (altitude.get_mut(part.clone()), vertical_velocity.get_mut(part.clone()))
        {
            altitude.copy_from_slice(&there.z.as_slice()[..part.len()]);
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

    /// Returns the positions after wrapping around.
    #[inline(always)]
    fn wrapped<S: Simd>(&self, simd: S, places: Vec3s<S>) -> Vec3s<S> {
        let Some(ball) = self.group.wrap_around else { return places };
        let offset = places - Vec3s::splat(simd, ball.center);
        if !offset.length().simd_gt(S::f32s::splat(simd, ball.radius)).any_true() {
            return places;
        }
        let mut all = [[0.0; LANES]; 3];
        places.store(&mut all);
        for lane in 0..LANES {
            if let Some(place) = ball.back(get3(&all, lane)) {
                set3(&mut all, lane, place);
            }
        }
        Vec3s::load(simd, &all)
    }
}

/// Combines ground and vertical components into 3D vectors.
#[inline(always)]
fn in_space<S: Simd>(simd: S, ground: &[Vec2], z: S::f32s) -> Vec3s<S> {
    let Vec2s { x, y } = Vec2s::from_side_by_side(simd, ground);
    Vec3s { x, y, z }
}

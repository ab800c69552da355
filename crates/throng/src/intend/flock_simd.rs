//! The vehicles of the birds of one flock, or of the insects of one swarm, with SIMD, one agent in each element. The bits
//! are the same as those of the scalar path in [steering](super::steering).

use super::steering::Behaving;
use super::velocities::Rows;
use crate::motion::{Attitude, Attitudes, Motions, Stepping};
use crate::parallel::RowLists;
use crate::simd::{LANES, Vec3s, get3, in_space, set3};
use crate::steer::SteeringNeighbour;
use crate::steer::swarm::Swarm;
use crate::world::State;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::Vec3;
use std::ops::Range;

impl Behaving<'_> {
    /// Applies the vehicles of some rows to their steering forces.
    pub fn steer_many(
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
                    set3(&mut force, lane, self.force(row));
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
            let view = self.view(start + lane, *seconds, *now, neighbours);
            let velocity = swarm.velocity(&view, noise, &mut memory.all[words]);
            set3(forces, lane, view.reach(velocity).force);
        }
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
pub(crate) struct Insects<'a> {
    pub neighbours: &'a mut Vec<SteeringNeighbour>,
    pub memory: RowLists<'a, f32>,
    pub seconds: f32,
    pub now: f64,
}

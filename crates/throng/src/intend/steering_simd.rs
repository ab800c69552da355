//! The vehicles of agents with behaviours, with SIMD, one agent in each element. The bits are the same as those of
//! [`Vehicle::step`](crate::motion::Vehicle::step), which moves vehicles that the kernel does not support.

use super::steering::{Behaving, GroupSteering, Plans};
use crate::agent::Columns;
use crate::motion::{Attitudes, Motions, Stepping};
use crate::simd::{LANES, Vec2s, Vec3s, get3, in_space, ones, set, set3};
use crate::steer::{BatchAgents, Steer, SteeringBatch, SteeringNeighbour, TraceRecorder};
use crate::world::State;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{Vec2, Vec3};

impl Behaving<'_> {
    /// Computes the planned motions of some rows of a group. The kernel must support its vehicles.
    pub(super) fn steer_many(
        &self,
        (level, stepping): (Level, Stepping),
        of: &GroupSteering<'_>,
        rows: &[u32],
        plans: &mut Plans<'_>,
        neighbours: &mut Vec<SteeringNeighbour>,
    ) {
        dispatch!(level, simd => self.steer_all(simd, stepping, of, rows, plans, neighbours));
    }

    #[inline(always)]
    fn steer_all<S: Simd>(
        &self,
        simd: S,
        stepping: Stepping,
        of: &GroupSteering<'_>,
        rows: &[u32],
        plans: &mut Plans<'_>,
        neighbours: &mut Vec<SteeringNeighbour>,
    ) {
        for rows in rows.chunks(S::f32s::LEN) {
            let mut force = [[0.0; LANES]; 3];
            let faced = self.forces(of, rows, plans, neighbours, &mut force);
            let before = self.state.motions(simd, rows);
            let after = stepping.step(simd, &before, Vec3s::load(simd, &force));
            let preferred = (after.position - before.position).over(S::f32s::splat(simd, of.frame.seconds));
            plans.set_many(simd, (rows, faced), preferred, &after);
        }
    }

    /// Computes the steering forces of some rows. The rows that face a given direction are steered on the scalar path;
    /// returns these, one bit for each row.
    #[inline(never)]
    fn forces(
        &self,
        of: &GroupSteering<'_>,
        rows: &[u32],
        plans: &mut Plans<'_>,
        neighbours: &mut Vec<SteeringNeighbour>,
        forces: &mut [[f32; LANES]; 3],
    ) -> u64 {
        if of.group.is_flock() {
            rows.iter().enumerate().for_each(|(lane, &row)| set3(forces, lane, self.force(row as usize)));
            return 0;
        }
        let mut agents = RowsToSteer { behaving: self, of, rows, plans, neighbours, forces, faced: 0 };
        let mut batch = SteeringBatch::new(&mut agents, rows.len(), of.frame.now - f64::from(of.frame.seconds));
        of.behaviour.steer_many(&mut batch);
        for lane in ones(batch.left()) {
            batch.steer(lane, |view, memory| of.behaviour.steer(view, memory, &mut TraceRecorder::default()));
        }
        agents.faced
    }
}

/// The agents of a batch, which are the elements of a SIMD vector.
struct RowsToSteer<'a, 'p> {
    behaving: &'a Behaving<'a>,
    of: &'a GroupSteering<'a>,
    rows: &'a [u32],
    plans: &'a mut Plans<'p>,
    neighbours: &'a mut Vec<SteeringNeighbour>,
    forces: &'a mut [[f32; LANES]; 3],
    /// The agents that face a given direction, one bit each.
    faced: u64,
}

impl BatchAgents for RowsToSteer<'_, '_> {
    fn position(&self, index: usize) -> Vec3 {
        self.behaving.state.place_in_space(self.rows[index] as usize)
    }

    fn number(&self, index: usize) -> u32 {
        self.behaving.state.agents.number[self.rows[index] as usize]
    }

    fn steer(&mut self, index: usize, steer: Steer<'_>) {
        let Self { behaving, of, plans, .. } = self;
        let row = self.rows[index] as usize;
        let view = behaving.view(row, of.frame.seconds, of.frame.now, self.neighbours);
        let steering = steer(&view, plans.memory(row, of.behaviour.words())).unwrap_or_default();
        if steering.facing.is_some() {
            self.faced |= 1 << index;
            plans.plan(row, steering, (&view.vehicle, view.motion), of.frame.seconds);
        } else {
            set3(self.forces, index, steering.force);
        }
    }
}

impl Plans<'_> {
    /// Sets the planned motions of a SIMD vector of rows that do not face a given direction.
    #[inline(always)]
    fn set_many<S: Simd>(&mut self, simd: S, (rows, faced): (&[u32], u64), preferred: Vec3s<S>, after: &Motions<S>) {
        let from = rows[0] as usize - self.first;
        let mut velocity = [[0.0; LANES]; 3];
        after.velocity.store(&mut velocity);
        if faced == 0 && are_consecutive(rows) {
            let part = from..from + rows.len();
            let (ground, vertical_velocity) = &mut self.preferred;
            preferred.truncate().put_side_by_side(&mut ground[part.clone()]);
            if let Some(vertical_velocity) = vertical_velocity.all.get_mut(part.clone()) {
                vertical_velocity.copy_from_slice(&preferred.z.as_slice()[..rows.len()]);
            }
            (self.velocity[part.clone()].iter_mut().enumerate()).for_each(|(lane, v)| *v = get3(&velocity, lane));
            self.faces[part.clone()].fill(false);
            after.attitude.store(simd, &mut self.attitude[part]);
            return;
        }
        let mut attitudes = [Default::default(); LANES];
        after.attitude.store(simd, &mut attitudes);
        for lane in ones(!faced & u64::MAX >> (u64::BITS as usize - rows.len())) {
            let at = rows[lane] as usize - self.first;
            let Vec3s { x, y, z } = preferred;
            super::velocities::set(&mut self.preferred, at, Vec3::new(x[lane], y[lane], z[lane]));
            (self.velocity[at], self.attitude[at]) = (get3(&velocity, lane), attitudes[lane]);
            self.faces[at] = false;
        }
    }
}

fn are_consecutive(rows: &[u32]) -> bool {
    rows[rows.len() - 1] - rows[0] == rows.len() as u32 - 1
}

impl State {
    /// Returns the SIMD level for the motion of all agents, if all are discs with the same vehicle.
    pub(crate) fn lanes_to_fly(&self) -> Option<Level> {
        let Columns { vehicle, script, .. } = &self.agents;
        let alike = vehicle.uniform()?.is_some() && script.uniform() == Some(None);
        self.instructions.level().filter(|_| alike && self.agents.all_discs())
    }

    /// Returns the motion of the agents of a SIMD vector of rows in ascending order.
    #[inline(always)]
    fn motions<S: Simd>(&self, simd: S, rows: &[u32]) -> Motions<S> {
        let agents = &self.agents;
        let attitude = Attitudes::load(simd, rows.iter().map(|&row| agents.attitude[row as usize]));
        if are_consecutive(rows) {
            let rows = rows[0] as usize..rows[0] as usize + rows.len();
            let altitude = agents.altitude.lanes(simd, rows.clone());
            let climb = agents.vertical_velocity.lanes(simd, rows.clone());
            return Motions {
                position: in_space(simd, &agents.position[rows.clone()], altitude),
                velocity: in_space(simd, &agents.velocity[rows], climb),
                attitude,
            };
        }
        let gather = |column: &[Vec2], z: S::f32s| {
            let mut all = [[0.0; LANES]; 2];
            rows.iter().enumerate().for_each(|(lane, &row)| set(&mut all, lane, column[row as usize]));
            let Vec2s { x, y } = Vec2s::load(simd, &all);
            Vec3s { x, y, z }
        };
        Motions {
            position: gather(&agents.position, agents.altitude.simd_of(simd, rows)),
            velocity: gather(&agents.velocity, agents.vertical_velocity.simd_of(simd, rows)),
            attitude,
        }
    }
}

//! Motion with SIMD, one agent in each element: agents on the ground without behaviours or vehicles. The bits are the
//! same as those of the [scalar path](super::movement), which turns agents with a limit on turning and bodies that are
//! not discs.

use super::movement::{Move, rounds, rows_if, turn_walker};
use crate::agent::{Column, Columns, Rounding, SEEN, Status};
use crate::guard::{BodyPose, Guarded, Solids};
use crate::intend::{Intended, Velocities};
use crate::motion::{Turning, angles};
use crate::parallel::{self, RowLists};
use crate::simd::{LANES, Vec2s, from_side_by_side, ones, set};
use crate::sleep::SleepBlocks;
use crate::world::State;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::Vec2;
use std::ops::Range;

/// The columns that motion changes, for some rows, as they are divided among threads.
type MovedColumns<'a> = (
    (&'a mut [Vec2], &'a mut [Vec2], &'a mut [f32]),
    (&'a mut [f64], &'a mut [f64], &'a mut [f64]),
    RowLists<'a, Rounding>,
);

/// The columns that motion changes, for some rows.
struct Moving<'a> {
    position: &'a mut [Vec2],
    velocity: &'a mut [Vec2],
    heading: &'a mut [f32],
    trip: Trips<'a>,
    /// The rounding of the positions; empty if there is none.
    rounding: &'a mut [Rounding],
}

impl State {
    /// Returns the SIMD level for motion if all agents can use it: they stay on the ground without behaviours or
    /// vehicles, and the guard has chosen the headings of bodies that are not discs.
    pub(crate) fn lanes_to_move(&self) -> Option<Level> {
        let plain = !self.in_space_now() && !self.any_plans() && !self.any_looks_about();
        let headed = self.agents.core.uniform() == Some(Vec2::ZERO) || self.is_guarded();
        self.instructions.level().filter(|_| plain && headed)
    }
}

impl Move {
    /// Notes the agents that the kernel cannot turn, with their headings and the sums of their turns.
    fn note_turners(&mut self, agents: &Columns) {
        self.turners.clear();
        if agents.core.uniform() != Some(Vec2::ZERO) || agents.max_turn_rate.uniform() != Some(f32::INFINITY) {
            let turns = |&row: &usize| !agents.is_disc(row) || agents.max_turn_rate[row] != f32::INFINITY;
            let rows = (0..agents.len()).filter(turns);
            self.turners.extend(rows.map(|row| (row, agents.heading[row], agents.turned[row])));
        }
    }

    /// Moves all agents at this SIMD level.
    pub(super) fn move_many(
        &mut self,
        level: Level,
        state: &mut State,
        intended: &Intended<'_>,
        (chosen, safe): (&Velocities, Guarded<'_>),
        sleep: &SleepBlocks,
        seconds: f32,
    ) {
        let is_guarded = state.is_guarded();
        let rounds = rounds(&state.agents, safe);
        let agents = &mut state.agents;
        self.note_turners(agents);
        let (targets, reach, chosen_velocities, status) = (safe.targets, safe.reach, &chosen.ground, &agents.status);
        let solids = safe.solids;
        let moving = (
            (&mut agents.position[..], &mut agents.velocity[..], &mut agents.heading[..]),
            (&mut agents.turned[..], &mut agents.course_turned[..], &mut agents.walked[..]),
            rows_if(rounds, &mut agents.rounding),
        );
        let turning = Turning::of(seconds);
        let move_part = |rows: Range<usize>, (place, (turned, course_turned, walked), rounding): MovedColumns<'_>| {
            let (position, velocity, heading) = place;
            let trip = Trips { turned, course_turned, walked };
            let mut moving = Moving { position, velocity, heading, trip, rounding: rounding.all };
            let targets = if is_guarded {
                Targets::Certain(&targets[rows.clone()])
            } else {
                let led = if solids.are_near() { &targets[rows.clone()] } else { &[] };
                Targets::Wished { reach, first: rows.start, solids, led }
            };
            let (chosen_velocities, status) = (&chosen_velocities[rows.clone()], &status[rows]);
            dispatch!(level, simd => move_all(simd, &mut moving, (targets, chosen_velocities, status), turning, seconds));
        };
        parallel::ranges(moving, |rows, all| sleep.each(rows, all, move_part));
        for &(row, before, turned) in &self.turners {
            agents.turned[row] = turned;
            turn_walker(agents, (intended.facing(), intended.looks), targets, row, before, seconds);
        }
    }
}

/// The targets of some rows.
#[derive(Clone, Copy)]
enum Targets<'a> {
    /// The targets of the guard.
    Certain(&'a [BodyPose]),
    /// Where the chosen velocities lead, within `reach`; agents near solids take the targets in `led`. `reach` and
    /// `solids` cover all rows, of which `first` is the first one of this part.
    Wished { reach: &'a Column<f32>, first: usize, solids: &'a Solids, led: &'a [BodyPose] },
}

#[inline(always)]
fn move_all<S: Simd>(
    simd: S,
    moving: &mut Moving<'_>,
    (targets, chosen_velocities, status): (Targets<'_>, &[Vec2], &[Status]),
    turning: Turning,
    seconds: f32,
) {
    let splat = |value: f32| S::f32s::splat(simd, value);
    for start in (0..chosen_velocities.len()).step_by(S::f32s::LEN) {
        let rows = start..(start + S::f32s::LEN).min(chosen_velocities.len());
        let vectors = |all: &[Vec2]| Vec2s::from_side_by_side(simd, &all[rows.clone()]);
        let (from, before) = (vectors(moving.position), vectors(moving.velocity));
        let chosen = vectors(chosen_velocities);
        let heading = from_side_by_side(simd, &moving.heading[rows.clone()]);
        let mut way = chosen * splat(seconds);
        if !moving.rounding.is_empty() {
            let mut rounding = [Vec2::ZERO; LANES];
            rounding.iter_mut().zip(&moving.rounding[rows.clone()]).for_each(|(to, from)| *to = from.0);
            way = way + Vec2s::from_side_by_side(simd, &rounding[..rows.len()]);
        }
        let wished = from + way;
        let to = match targets {
            Targets::Certain(targets) => {
                let mut to = [[0.0; LANES]; 2];
                targets[rows.clone()].iter().enumerate().for_each(|(lane, target)| set(&mut to, lane, target.position));
                Vec2s::load(simd, &to)
            }
            Targets::Wished { reach, first, solids, led } => {
                let all = first + rows.start..first + rows.end;
                let near = solids.near_of(all.clone());
                let reached = from + (wished - from).clamp_length_max(reach.lanes(simd, all));
                // an agent with a chosen velocity that is not finite stays
                let to = Vec2s::select(wished.x.is_finite() & wished.y.is_finite(), reached, from);
                if near == 0 {
                    to
                } else {
                    let mut places = [Vec2::ZERO; LANES];
                    let places = &mut places[..rows.len()];
                    to.put_side_by_side(places);
                    ones(near).for_each(|lane| places[lane] = led[rows.start + lane].position);
                    Vec2s::from_side_by_side(simd, places)
                }
            }
        };
        let motion = to - from;
        // as `velocity` on the scalar path
        let off = to - wished;
        let limit = to.x.abs().max(to.y.abs()) * splat(f32::EPSILON);
        let unchanged = off.dot(off).sqrt().simd_le(limit);
        let velocity = Vec2s::select(unchanged, chosen, motion.over(splat(seconds)));
        let facing = turning.turn(simd, heading, velocity);
        // the increments of the trip statistics
        let seen = |v: Vec2s<S>| v.dot(v).sqrt().simd_ge(splat(SEEN));
        let course = angles(simd, Vec2s { x: before.dot(velocity), y: before.perp_dot(velocity) }).abs();
        let course = (seen(before) & seen(velocity)).select(course, splat(0.0));
        if !moving.rounding.is_empty() {
            round::<S>(&mut moving.rounding[rows.clone()], unchanged, [to, way, motion]);
        }
        to.put_side_by_side(&mut moving.position[rows.clone()]);
        velocity.put_side_by_side(&mut moving.velocity[rows.clone()]);
        moving.heading[rows.clone()].copy_from_slice(&facing.as_slice()[..rows.len()]);
        let way = motion.dot(motion).sqrt();
        moving.trip.add(simd, &status[rows.clone()], rows, ((facing - heading).abs(), course, way));
    }
}

/// Sets the rounding of positions after motions to `to` that should have covered `way` and covered `motion`, as
/// `velocity` on the scalar path.
#[inline(always)]
fn round<S: Simd>(rounding: &mut [Rounding], unchanged: S::mask32s, vectors: [Vec2s<S>; 3]) {
    let mut all = [[Vec2::ZERO; LANES]; 3];
    vectors.iter().zip(&mut all).for_each(|(vectors, all)| vectors.put_side_by_side(&mut all[..S::f32s::LEN]));
    let ([to, way, motion], unchanged) = (all, unchanged.to_bitmask());
    for (lane, rounding) in rounding.iter_mut().enumerate() {
        let is_unchanged = unchanged >> lane & 1 != 0;
        *rounding = if is_unchanged { Rounding::of(to[lane], way[lane], motion[lane]) } else { Rounding::NONE };
    }
}

/// The trip statistics of some rows.
pub(super) struct Trips<'a> {
    /// Turning of the headings, radians.
    pub turned: &'a mut [f64],
    /// Turning of the directions of motion, radians.
    pub course_turned: &'a mut [f64],
    /// Distances travelled, metres.
    pub walked: &'a mut [f64],
}

impl Trips<'_> {
    /// Adds the increments of a SIMD vector of rows, for walking agents only.
    #[inline(always)]
    pub fn add<S: Simd>(
        &mut self,
        simd: S,
        status: &[Status],
        rows: Range<usize>,
        (turned, course, way): (S::f32s, S::f32s, S::f32s),
    ) {
        let walks = |bits, &status: &Status| bits << 1 | u64::from(status == Status::Walking);
        let walks = S::mask32s::from_bitmask(simd, status.iter().rev().fold(0, walks));
        let of_walkers = |all: S::f32s| walks.select(all, S::f32s::splat(simd, 0.0));
        let turned = of_walkers(turned);
        for (sum, &turned) in self.turned[rows.clone()].iter_mut().zip(turned.as_slice()) {
            let turned = f64::from(turned);
            *sum += turned.min(std::f64::consts::TAU - turned);
        }
        add(&mut self.course_turned[rows.clone()], of_walkers(course).as_slice());
        add(&mut self.walked[rows], of_walkers(way).as_slice());
    }
}

/// Adds values to sums, element by element.
#[inline(always)]
fn add(sums: &mut [f64], all: &[f32]) {
    sums.iter_mut().zip(all).for_each(|(sum, &value)| *sum += f64::from(value));
}

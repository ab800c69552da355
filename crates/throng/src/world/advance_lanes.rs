//! Many agents move at once, a lane an agent: discs on the ground that turn as they like. The same bits as [one by
//! one](super::advance).

use super::World;
use super::advance::SEEN;
use crate::agent::{Column, Status};
use crate::guard::Pose;
use crate::lanes::{LANES, Vec2s, from_side_by_side, set};
use crate::motion::{Turning, angles};
use crate::parallel;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::Vec2;
use std::ops::Range;

/// What moving changes, of some rows, as it is divided.
type Columns<'a> = ((&'a mut [Vec2], &'a mut [Vec2], &'a mut [f32]), (&'a mut [f64], &'a mut [f64], &'a mut [f64]));

/// What moving changes, of some rows.
struct Moving<'a> {
    position: &'a mut [Vec2],
    velocity: &'a mut [Vec2],
    heading: &'a mut [f32],
    trip: Trips<'a>,
}

impl World {
    /// The instructions that everybody moves with, if many can move at once: discs that stay on the ground and turn as they
    /// like.
    pub(super) fn lanes_to_move(&self) -> Option<Level> {
        let agents = &self.agents;
        let plain = agents.all_discs()
            && !self.in_space_now()
            && !self.anybody_steers()
            && !self.anybody_looks_about()
            && agents.max_turn_rate.uniform() == Some(f32::INFINITY);
        self.instructions.level().filter(|_| plain)
    }

    /// Moves everybody with these instructions.
    pub(super) fn advance_many(&mut self, level: Level, seconds: f32) {
        let is_guarded = self.is_guarded();
        let Self { agents, step, .. } = self;
        let (targets, reach, wishes, status) = (&step.targets, &step.reach, &step.wishes.ground, &agents.status);
        let moving = (
            (&mut agents.position[..], &mut agents.velocity[..], &mut agents.heading[..]),
            (&mut agents.turned[..], &mut agents.course_turned[..], &mut agents.walked[..]),
        );
        let turning = Turning::of(seconds);
        let move_part =
            |rows: Range<usize>, ((position, velocity, heading), (turned, course_turned, walked)): Columns<'_>| {
                let trip = Trips { turned, course_turned, walked };
                let mut moving = Moving { position, velocity, heading, trip };
                let targets = if is_guarded {
                    Targets::Certain(&targets[rows.clone()])
                } else {
                    Targets::Wished { reach, first: rows.start }
                };
                let (wishes, status) = (&wishes[rows.clone()], &status[rows]);
                dispatch!(level, simd => move_all(simd, &mut moving, (targets, wishes, status), turning, seconds));
            };
        parallel::ranges(moving, |rows, all| step.rest.each(rows, all, move_part));
    }
}

/// Where some rows move to.
#[derive(Clone, Copy)]
enum Targets<'a> {
    /// Where the guard says.
    Certain(&'a [Pose]),
    /// Where they wish, as far as they get; of all rows, the first that is meant.
    Wished { reach: &'a Column<f32>, first: usize },
}

#[inline(always)]
fn move_all<S: Simd>(
    simd: S,
    moving: &mut Moving<'_>,
    (targets, wishes, status): (Targets<'_>, &[Vec2], &[Status]),
    turning: Turning,
    seconds: f32,
) {
    let splat = |value: f32| S::f32s::splat(simd, value);
    for start in (0..wishes.len()).step_by(S::f32s::LEN) {
        let rows = start..(start + S::f32s::LEN).min(wishes.len());
        let vectors = |all: &[Vec2]| Vec2s::from_side_by_side(simd, &all[rows.clone()]);
        let (from, before) = (vectors(moving.position), vectors(moving.velocity));
        let wish = vectors(wishes);
        let heading = from_side_by_side(simd, &moving.heading[rows.clone()]);
        let wished = from + wish * splat(seconds);
        let to = match targets {
            Targets::Certain(targets) => {
                let mut to = [[0.0; LANES]; 2];
                targets[rows.clone()].iter().enumerate().for_each(|(lane, target)| set(&mut to, lane, target.position));
                Vec2s::load(simd, &to)
            }
            Targets::Wished { reach, first } => {
                let most = reach.lanes(simd, first + rows.start..first + rows.end);
                let reached = from + (wished - from).clamp_length_max(most);
                // one that is not a number is no wish at all
                Vec2s::select(wished.x.is_finite() & wished.y.is_finite(), reached, from)
            }
        };
        let motion = to - from;
        // as `velocity` one by one
        let off = to - wished;
        let limit = to.x.abs().max(to.y.abs()) * splat(f32::EPSILON);
        let unchanged = off.dot(off).sqrt().simd_le(limit);
        let velocity = Vec2s::select(unchanged, wish, motion.over(splat(seconds)));
        let facing = turning.turn(simd, heading, velocity);
        // what the trip so far grows by
        let seen = |v: Vec2s<S>| v.dot(v).sqrt().simd_ge(splat(SEEN));
        let course = angles(simd, Vec2s { x: before.dot(velocity), y: before.perp_dot(velocity) }).abs();
        let course = (seen(before) & seen(velocity)).select(course, splat(0.0));
        to.put_side_by_side(&mut moving.position[rows.clone()]);
        velocity.put_side_by_side(&mut moving.velocity[rows.clone()]);
        moving.heading[rows.clone()].copy_from_slice(&facing.as_slice()[..rows.len()]);
        let way = motion.dot(motion).sqrt();
        moving.trip.add(simd, &status[rows.clone()], rows, ((facing - heading).abs(), course, way));
    }
}

/// What trips so far came to, of some rows.
pub(super) struct Trips<'a> {
    /// How far they turned, radians.
    pub turned: &'a mut [f64],
    /// How far their courses turned, radians.
    pub course_turned: &'a mut [f64],
    /// How far they went, metres.
    pub walked: &'a mut [f64],
}

impl Trips<'_> {
    /// Adds to those of a vector of rows: of those who walk.
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

/// Adds to sums, as many as there are.
#[inline(always)]
fn add(sums: &mut [f64], all: &[f32]) {
    sums.iter_mut().zip(all).for_each(|(sum, &value)| *sum += f64::from(value));
}

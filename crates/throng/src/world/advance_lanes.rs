//! Many agents move at once, a lane an agent: discs on the ground that turn as they like. The same bits as [one by
//! one](super::advance).

use super::World;
use super::advance::SEEN;
use super::way::Way;
use crate::agent::Column;
use crate::guard::Pose;
use crate::lanes::{LANES, Vec2s, load, set};
use crate::motion::{Turning, angles};
use crate::parallel;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{Vec2, Vec3};
use std::ops::Range;

/// What moving changes, of some rows, as it is divided.
type Columns<'a> = ((&'a mut [Vec2], &'a mut [Vec2], &'a mut [f32]), (&'a mut [f64], &'a mut [f64], &'a mut [f64]));

/// What moving changes, of some rows.
struct Moving<'a> {
    position: &'a mut [Vec2],
    velocity: &'a mut [Vec2],
    heading: &'a mut [f32],
    turned: &'a mut [f64],
    course_turned: &'a mut [f64],
    walked: &'a mut [f64],
}

impl World {
    /// The instructions that everybody moves with, if many can move at once: discs that stay on the ground and turn as they
    /// like.
    pub(super) fn lanes_to_move(&self) -> Option<Level> {
        let agents = &self.agents;
        let plain = agents.all_discs()
            && !agents.anybody_flies()
            && agents.climb.uniform() == Some(0.0)
            && agents.max_turn_rate.uniform() == Some(f32::INFINITY)
            && !self.legs.lead_up();
        self.instructions.level().filter(|_| plain)
    }

    /// Moves everybody with these instructions.
    pub(super) fn advance_many(&mut self, level: Level, seconds: f32) {
        let is_guarded = self.is_guarded();
        let Self { agents, step, .. } = self;
        let (targets, reach, wishes, ways) = (&step.targets, &step.reach, &step.wishes, &step.ways);
        let moving = (
            (&mut agents.position[..], &mut agents.velocity[..], &mut agents.heading[..]),
            (&mut agents.turned[..], &mut agents.course_turned[..], &mut agents.walked[..]),
        );
        let turning = Turning::of(seconds);
        let move_part =
            |rows: Range<usize>, ((position, velocity, heading), (turned, course_turned, walked)): Columns<'_>| {
                let mut moving = Moving { position, velocity, heading, turned, course_turned, walked };
                let targets = if is_guarded {
                    Targets::Certain(&targets[rows.clone()])
                } else {
                    Targets::Wished { reach, first: rows.start }
                };
                let (wishes, ways) = (&wishes[rows.clone()], &ways[rows]);
                dispatch!(level, simd => move_all(simd, &mut moving, (targets, wishes, ways), turning, seconds));
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
    (targets, wishes, ways): (Targets<'_>, &[Vec3], &[Way]),
    turning: Turning,
    seconds: f32,
) {
    let splat = |value: f32| S::f32s::splat(simd, value);
    for start in (0..wishes.len()).step_by(S::f32s::LEN) {
        let rows = start..(start + S::f32s::LEN).min(wishes.len());
        let all = rows.clone().zip(0..);
        let (mut from, mut to, mut wish, mut before) =
            ([[0.0; LANES]; 2], [[0.0; LANES]; 2], [[0.0; LANES]; 2], [[0.0; LANES]; 2]);
        let (mut headings, mut walks, mut most) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for (row, lane) in all.clone() {
            set(&mut from, lane, moving.position[row]);
            match targets {
                Targets::Certain(targets) => set(&mut to, lane, targets[row].position),
                Targets::Wished { reach, first } => most[lane] = reach[first + row],
            }
            set(&mut wish, lane, wishes[row].truncate());
            set(&mut before, lane, moving.velocity[row]);
            headings[lane] = moving.heading[row];
            walks[lane] = if ways[row].walks() { 1.0 } else { 0.0 };
        }
        let [from, to, wish, before]: [Vec2s<S>; 4] = [from, to, wish, before].map(|all| Vec2s::load(simd, &all));
        let wished = from + wish * splat(seconds);
        let to = match targets {
            Targets::Certain(_) => to,
            Targets::Wished { .. } => {
                let reached = from + (wished - from).clamp_length_max(load(simd, &most));
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
        let heading = load(simd, &headings);
        let facing = turning.turn(simd, heading, velocity);
        // what the trip so far grows by
        let seen = |v: Vec2s<S>| v.dot(v).sqrt().simd_ge(splat(SEEN));
        let course = angles(simd, Vec2s { x: before.dot(velocity), y: before.perp_dot(velocity) }).abs();
        let course = (seen(before) & seen(velocity)).select(course, splat(0.0));
        let walks = load(simd, &walks);
        let turned = (facing - heading).abs() * walks;
        let (course, walked) = (course * walks, motion.dot(motion).sqrt() * walks);
        for (row, lane) in all {
            moving.position[row] = Vec2::new(to.x[lane], to.y[lane]);
            moving.velocity[row] = Vec2::new(velocity.x[lane], velocity.y[lane]);
            moving.heading[row] = facing[lane];
            let turned = f64::from(turned[lane]);
            moving.turned[row] += turned.min(std::f64::consts::TAU - turned);
            moving.course_turned[row] += f64::from(course[lane]);
            moving.walked[row] += f64::from(walked[lane]);
        }
    }
}

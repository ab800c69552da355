//! Stage 5, after the motion: agents that have left the ball of their group enter on the other side, where there is room.
//!
//! A jump must not make bodies overlap, because the guard only keeps bodies as far apart as they are. So an agent jumps
//! only if its body, with a skin, is free at the other side: of the agents and walls that the guard keeps it from, and of
//! the solids of its group. Otherwise it tries again after the next sub-step. An agent that nothing guards and that has no
//! solids always jumps. Agents jump in the order of their numbers, and each counts at its new place for the next.

use crate::agent::{Body, ProgressMark, Status};
use crate::guard::{SKIN, Solids};
use crate::motion::Vehicle;
use crate::parallel::{self, WORD, Words};
use crate::perceive::Grid;
use crate::simd::ones;
use crate::sleep::SleepBlocks;
use crate::world::State;
use glam::{Vec2, Vec3};

/// Moves agents to the other side of the balls that they have left.
#[derive(Clone, Debug, Default)]
pub(super) struct Wrap {
    /// Rows outside their balls, one bit for each row.
    outside: Vec<u64>,
    /// The same rows in the order of numbers, with their places on the other side.
    leaving: Vec<(usize, Vec3)>,
    near: Near,
}

/// The agents by their places, to find those near a place. An agent that leaves its ball is also listed at its place on the
/// other side.
#[derive(Clone, Debug, Default)]
struct Near {
    places: Vec<Vec2>,
    rows: Vec<usize>,
    numbers: Vec<u32>,
    grid: Grid,
    /// The greatest bounding radius of a body.
    largest: f32,
}

impl Wrap {
    /// Moves the agents that have left their balls to the other side, if there is room for them.
    pub fn run(&mut self, state: &mut State, solids: &Solids, sleep: &mut SleepBlocks) {
        if state.groups_in_use().all(|group| group.wrap_around.is_none()) {
            return;
        }
        let Self { outside, leaving, near } = self;
        let count = state.agents.len();
        outside.clear();
        outside.resize(count.div_ceil(WORD), 0);
        let is_out = |row: usize| state.other_side(row).is_some();
        parallel::ranges(Words(outside), |rows, Words(outside)| {
            for (first, outside) in rows.step_by(WORD).zip(outside) {
                let rows = first..count.min(first + WORD);
                *outside = rows.rev().fold(0, |bits, row| bits << 1 | u64::from(is_out(row)));
            }
        });
        leaving.clear();
        let rows = (0..).step_by(WORD).zip(&*outside).flat_map(|(first, &set)| ones(set).map(move |at| first + at));
        leaving.extend(rows.filter_map(|row| Some((row, state.other_side(row)?))));
        if leaving.is_empty() {
            return;
        }
        leaving.sort_unstable_by_key(|&(row, _)| state.agents.number[row]);
        let any_guarded = state.groups_in_use().any(|group| group.guard);
        if any_guarded {
            near.find(state, leaving);
        }
        for &(row, there) in &*leaving {
            let here = state.agents.position[row].extend(state.agents.altitude[row]);
            state.set_place(row, there);
            let is_free = solids.leave_room(state.agents.group[row], there, skinned(state, row).bounding_radius())
                && (!any_guarded || near.is_free(state, row));
            if is_free {
                sleep.note_left(here.truncate());
                state.set_out_from_new_place(row);
            } else {
                state.set_place(row, here);
            }
        }
    }
}

impl Near {
    /// Sorts all agents by their places.
    fn find(&mut self, state: &State, leaving: &[(usize, Vec3)]) {
        let Self { places, rows, numbers, grid, largest } = self;
        let agents = &state.agents;
        places.clear();
        places.extend(agents.position.iter().copied().chain(leaving.iter().map(|(_, there)| there.truncate())));
        rows.clear();
        rows.extend((0..agents.len()).chain(leaving.iter().map(|&(row, _)| row)));
        numbers.clear();
        numbers.extend(0..places.len() as u32);
        grid.rebuild(places, numbers, 1.0);
        *largest = agents.bodies().map(|body| body.bounding_radius()).fold(0.0, f32::max);
    }

    /// Whether an agent, at its present place, is free of the agents and walls that the guard keeps it from.
    fn is_free(&self, state: &State, row: usize) -> bool {
        let agents = &state.agents;
        let is_guarded = |row: usize| state.local_groups[agents.group[row].index()].guard;
        let body = skinned(state, row);
        let at = state.world_position(row);
        if is_guarded(row) && state.place.no_room_for(at, &agents.core_of(row), body, &state.walls).is_some() {
            return false;
        }
        let touches = |other: usize| {
            other != row
                && (is_guarded(row) || is_guarded(other))
                && agents.meet(row, other)
                && agents.separation(row, other) < 1.0 + SKIN
        };
        let mut free = true;
        let reach = (body.bounding_radius() + self.largest) * 1.02;
        self.grid.within(agents.position[row], reach, |near| free = free && !touches(self.rows[near.row as usize]));
        free
    }
}

/// Returns the body of an agent, enlarged by the skin that the guard keeps between bodies.
fn skinned(state: &State, row: usize) -> Body {
    let Body { core, radius } = state.agents.body(row);
    Body { core, radius: radius * (1.0 + SKIN as f32) }
}

impl State {
    /// Returns the place opposite to an agent that is outside the ball of its group; `None` for other agents, and for
    /// moving obstacles, which go where their scripts lead them.
    pub(super) fn other_side(&self, row: usize) -> Option<Vec3> {
        let agents = &self.agents;
        let group = &self.local_groups[agents.group[row].index()];
        let ball = group.wrap_around.filter(|_| agents.script[row].is_none())?;
        let at = agents.position[row].extend(agents.altitude[row]);
        if self.vehicle(row).map_or(at.z > 0.0, Vehicle::flies) {
            // the ground is a floor
            ball.back(at).map(|back| back.with_z(back.z.max(0.0)))
        } else {
            ball.at_height(at.z).back(at)
        }
    }

    fn set_place(&mut self, row: usize, place: Vec3) {
        self.agents.position[row] = place.truncate();
        self.agents.altitude.set(row, place.z);
    }

    /// Lets an agent that has jumped plan its way anew.
    fn set_out_from_new_place(&mut self, row: usize) {
        self.revive(row);
        if self.agents.status[row] == Status::Walking {
            self.agents.travel[row].set_out_again();
            self.agents.progress_mark[row] = ProgressMark::default();
        }
    }
}

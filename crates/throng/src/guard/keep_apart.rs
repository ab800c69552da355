//! Stage 4, guard: the stage that finds where agents can move without overlap.

use super::certify::{led, unguarded, within_reach};
use super::contacts::Centers;
use super::spread::Spreading;
use super::{BodyPose, Contacts, Guard, GuardedBodies, RowContacts, Solids};
use crate::agent::{Column, Rounding};
use crate::intend::{Facing, Velocities};
use crate::motion::{turn, wrap};
use crate::parallel::{self, WORD};
use crate::perceive::{AvoidsAll, Perceived, SubStep};
use crate::sleep::SleepBlocks;
use crate::world::State;
use glam::Vec3;
use std::ops::Range;

/// 4. Guard: finds targets at which no two guarded bodies overlap.
#[derive(Clone, Debug, Default)]
pub(crate) struct KeepApart {
    targets: Vec<BodyPose>,
    reach: Column<f32>,
    guarded: Column<bool>,
    contacts: Contacts,
    solids: Solids,
    any_far: bool,
    guard: Guard,
}

/// The result of the guard.
#[derive(Clone, Copy)]
pub(crate) struct Guarded<'a> {
    /// Where each agent moves. If no agent is guarded: only of the agents near solids, or if not all agents can use SIMD.
    pub targets: &'a [BodyPose],
    /// How far each agent may move, metres.
    pub reach: &'a Column<f32>,
    /// Whether each agent is guarded.
    pub guarded: &'a Column<bool>,
    /// The agents and walls that each agent may touch.
    pub contacts: &'a Contacts,
    pub solids: &'a Solids,
    /// Whether any agent may be where positions are rounded too much.
    pub any_far: bool,
    guard: &'a Guard,
}

impl Guarded<'_> {
    /// Whether a pass of the guard has moved an agent from where its chosen velocity leads. Only for guarded worlds.
    pub fn has_moved(&self, row: usize) -> bool {
        self.guard.moved(row / WORD) >> (row % WORD) & 1 != 0
    }
}

/// What the wishes of agents are made of.
#[derive(Clone, Copy)]
struct Wishes<'a> {
    state: &'a State,
    facing: Facing<'a>,
    chosen: &'a Velocities,
    seconds: f32,
    now: f64,
}

impl KeepApart {
    /// Finds the targets of all agents in the sub-step. Targets of agents that sleep stay as they are.
    pub fn run(
        &mut self,
        state: &mut State,
        seen: Perceived<'_>,
        (facing, chosen): (Facing<'_>, &Velocities),
        sleep: &SleepBlocks,
        SubStep { seconds, now, .. }: SubStep,
        elsewhere: &mut dyn Spreading,
    ) -> Guarded<'_> {
        if !sleep.all_asleep() {
            self.any_far = Rounding::is_far(seen.grid.extent());
            let wishes = Wishes { state, facing, chosen, seconds, now };
            let (changed, pushed) = self.find(wishes, seen, sleep, elsewhere);
            state.tally.guard_changed += changed as u64;
            state.tally.pushed += pushed as u64;
        }
        state.tally.agent_steps += state.own().len() as u64;
        state.tally.sub_steps += 1;
        self.result()
    }

    /// Finds the targets. Returns the number of agents that the guard changes, and of those that it pushes.
    fn find(
        &mut self,
        wishes: Wishes<'_>,
        seen: Perceived<'_>,
        sleep: &SleepBlocks,
        elsewhere: &mut dyn Spreading,
    ) -> (usize, usize) {
        let Wishes { state, chosen, seconds, .. } = wishes;
        let State { agents, local_groups: groups, walls, .. } = state;
        self.reach.map_from(&agents.max_speed, |speed| speed * seconds);
        if self.any_far {
            let farther = |rows: Range<usize>, all: &mut [f32]| {
                let from = &agents.position[rows];
                all.iter_mut().zip(from).for_each(|(reach, from)| *reach += Rounding::farther(*from));
            };
            parallel::ranges(self.reach.rows_mut(), farther);
        }
        self.guarded.map_from(&agents.group, |group| groups[group.index()].guard);
        let mut solids = std::mem::take(&mut self.solids);
        solids.find(&self.bodies(state, sleep), &agents.group);
        self.solids = solids;
        let Self { targets, reach, guarded, contacts, solids, guard, .. } = self;
        let bodies = bodies(state, (reach, guarded, solids), sleep);
        let are_rounded = agents.are_rounded();
        let wished = |row: usize| chosen_place(state, chosen, (row, wishes.heading(row)), (seconds, are_rounded));
        if state.is_guarded() {
            let meets = |row, other| agents.meet(row, other);
            let sorted = state.any_looks_at_all() && seen.discs_only && agents.any_flies();
            let centers = Centers { grid: seen.grid, space: sorted.then_some(seen.lattice) };
            let own = state.own().end;
            let all = (&bodies, state.others.least_radius);
            contacts.collect_from(all, &agents.number, centers, walls, meets, covered(state, seen));
            let report = guard.certify_own(&bodies, contacts, walls, wished, targets, (own, elsewhere));
            let is_pushed = |&row: &usize| row < own && state.is_pushed(row, targets[row].place(), seconds);
            return (report.changed, guard.moved_rows().filter(is_pushed).count());
        }
        // for measuring
        contacts.collect_walls_only(&bodies, walls);
        if state.lanes_to_move().is_none() && state.lanes_to_fly().is_none() {
            unguarded(&bodies, wished, targets);
        } else if bodies.solids.are_near() {
            led(&bodies, wished, targets);
        }
        (0, 0)
    }

    /// Returns the result of the last sub-step.
    fn result(&self) -> Guarded<'_> {
        let Self { targets, reach, guarded, contacts, solids, any_far, guard } = self;
        Guarded { targets, reach, guarded, contacts, solids, any_far: *any_far, guard }
    }

    /// Returns the solids of all groups.
    pub fn solids_mut(&mut self) -> &mut Solids {
        &mut self.solids
    }

    /// Returns the place that the guard and solids permit an agent that has yet to move.
    pub fn certain_place(
        &self,
        state: &State,
        chosen: &Velocities,
        sleep: &SleepBlocks,
        row: usize,
        seconds: f32,
    ) -> Vec3 {
        let target = if state.is_guarded() || self.solids.is_near(row) {
            self.targets[row]
        } else {
            let heading = state.agents.heading[row];
            let wished = chosen_place(state, chosen, (row, heading), (seconds, state.agents.are_rounded()));
            within_reach(row, &self.bodies(state, sleep), wished)
        };
        target.place()
    }

    fn bodies<'a>(&'a self, state: &'a State, sleep: &'a SleepBlocks) -> GuardedBodies<'a> {
        bodies(state, (&self.reach, &self.guarded, &self.solids), sleep)
    }
}

impl Wishes<'_> {
    /// Returns the heading that an agent turns to in the sub-step, for bodies that are not discs: the heading of its
    /// script, the planned heading of its vehicle, or the direction of its chosen velocity. To the last, the ends of a
    /// body turn no faster than the agent's preferred speed, because other agents avoid the ends as they move and would
    /// flee from a long body that spins.
    fn heading(&self, row: usize) -> f32 {
        let (agents, seconds) = (&self.state.agents, self.seconds);
        let (heading, most) = (agents.heading[row], agents.max_turn_rate[row]);
        if agents.is_disc(row) {
            return heading;
        }
        if let Some(there) = self.state.scripted(row, self.now) {
            let most = most * seconds;
            let turn = there.heading - f64::from(heading);
            let turn = turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
            wrap(heading + (turn as f32).clamp(-most, most))
        } else {
            if self.state.has_vehicle(row) && self.facing.is_as_planned(row, self.chosen.at(row)) {
                return self.facing.planned.attitude[row].basis.heading();
            }
            let to = self.facing.direction(row, self.chosen.ground[row], most);
            let turned = wrap(turn(heading, to, seconds, most) - heading);
            let most = agents.preferred_speed[row] / agents.core[row].length() * seconds;
            wrap(heading + turned.clamp(-most, most))
        }
    }
}

fn bodies<'a>(
    state: &'a State,
    (reach, guarded, solids): (&'a Column<f32>, &'a Column<bool>, &'a Solids),
    sleep: &'a SleepBlocks,
) -> GuardedBodies<'a> {
    let agents = &state.agents;
    GuardedBodies {
        positions: &agents.position,
        altitudes: &agents.altitude,
        headings: &agents.heading,
        cores: &agents.core,
        radii: &agents.radius,
        reach,
        guarded,
        solids,
        resting: sleep.asleep(),
    }
}

/// Returns the pose that the chosen velocity leads to at the end of the sub-step, with a heading.
fn chosen_place(
    state: &State,
    chosen: &Velocities,
    (row, heading): (usize, f32),
    (seconds, are_rounded): (f32, bool),
) -> BodyPose {
    let agents = &state.agents;
    let mut way = chosen.ground[row] * seconds;
    if are_rounded {
        way += agents.rounding[row].0;
    }
    BodyPose {
        position: agents.position[row] + way,
        altitude: agents.altitude[row] + chosen.vertical_velocity(row) * seconds,
        heading,
    }
}

/// Returns the neighbours that the neighbour search found, and its range, if the search covers every contact: no agent
/// flies, and the agent, a disc, avoids all others.
fn covered<'a>(state: &'a State, seen: Perceived<'a>) -> impl Fn(usize) -> Option<RowContacts<'a>> {
    let State { agents, local_groups: groups, .. } = state;
    let (none_flies, avoids_all, own) = (!agents.any_flies(), AvoidsAll::of(agents), state.own());
    move |row| {
        if row >= own.end {
            return None;
        }
        let group = &groups[agents.group[row].index()];
        let nearest = seen.near.of(row);
        let all = nearest.len() < group.nearest();
        let sees_all = none_flies && group.nearest() > 0 && avoids_all.holds(agents, row);
        sees_all.then_some(RowContacts { nearest, range: group.neighbour_distance, all })
    }
}

impl State {
    /// Whether any agent may be guarded. All worlds of a division give the same answer in a step.
    pub(crate) fn is_guarded(&self) -> bool {
        if self.others.are_there { self.others.any_guarded } else { self.is_any_guarded_here() }
    }

    /// Whether any agent of this world may be guarded.
    pub(crate) fn is_any_guarded_here(&self) -> bool {
        self.agents.group.uniform().is_none_or(|group| self.local_groups[group.index()].guard)
    }

    /// Whether an agent must accelerate harder than its limit to reach a position in this sub-step. Braking does not
    /// count: it may be as hard as necessary.
    fn is_pushed(&self, row: usize, to: Vec3, seconds: f32) -> bool {
        let agents = &self.agents;
        let (from, before) = (agents.center(row).as_vec3(), agents.velocity_in_space(row));
        let after = (to - from) / seconds;
        let kept = (after.dot(before) / before.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        let rounding = 4.0 * f32::EPSILON * from.abs().max_element() / seconds;
        (after - kept * before).length() > 1.01 * agents.max_acceleration[row] * seconds + rounding
    }
}

#[cfg(test)]
mod tests {
    use super::super::spread::Nowhere;
    use super::*;
    use crate::intend::Planned;
    use crate::perceive::Perceive;
    use crate::{Agent, Body, Group, Settings, SubSteps, World};
    use glam::{DVec2, Vec2};
    use proptest::prelude::*;

    /// Returns agents in rows, at heights of up to `height` spacings. Some of them are larger, long, or avoid only some
    /// agents.
    fn crowd((spacing, height): (f64, f64), group: Group, others: &[(usize, u8)]) -> World {
        let settings = Settings { step: 0.1, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
        let mut world = World::new(settings).unwrap();
        let group = world.add_group(group).unwrap();
        for at in 0..240u32 {
            let (x, y) = (f64::from(at % 16), f64::from(at / 16));
            let position = DVec2::new(x + 0.3 * (y * 1.7).sin(), y + 0.3 * (x * 2.3).sin()) * spacing;
            let altitude = spacing * height * (0.5 + 0.5 * f64::from(at).sin());
            let agent = Agent { position: position.extend(altitude), group, radius: 0.2, ..Agent::default() };
            let kind = others.iter().find(|&&(row, _)| row == at as usize).map(|&(_, kind)| kind);
            let agent = match kind {
                None => agent,
                Some(0) => agent.with_body(Body::rectangle(4.2, 1.8)),
                Some(1) => Agent { avoids: 0, ..agent.with_body(Body::rectangle(2.0, 0.3)) },
                Some(2) => agent.with_body(Body::capsule(0.9, 0.4)),
                Some(3) => agent.with_body(Body::disc(1.5)),
                Some(4) => Agent { layers: 2, ..agent },
                Some(_) => Agent { avoids: 2, ..agent },
            };
            world.add_agent(agent).unwrap();
        }
        world
    }

    /// Checks that the guard's contacts are those of a search in the plan.
    fn check_contacts(mut world: World) -> Result<(), TestCaseError> {
        world.step();
        let (mut state, mut sleep) = (world.state, SleepBlocks::default());
        let (mut perceive, mut guard) = (Perceive::default(), KeepApart::default());
        guard.solids_mut().add(Vec::new());
        guard.solids_mut().add(Vec::new());
        let of = SubStep::new(&state, 0, 1);
        let seen = perceive.run(&mut state, &mut sleep, of);
        let mut chosen = Velocities::default();
        chosen.resize(state.agents.len(), state.agents.any_flies());
        chosen.ground.fill(Vec2::new(0.5, 0.2));
        let planned = Planned::default();
        let facing = Facing { preferred: &chosen, planned: &planned };
        guard.run(&mut state, seen, (facing, &chosen), &sleep, of, &mut Nowhere);
        let agents = &state.agents;
        let meets = |row, other| agents.meet(row, other);
        let mut contacts = Contacts::default();
        let bodies = guard.bodies(&state, &sleep);
        contacts.collect(&bodies, &agents.number, seen.grid, &state.walls, meets, |_| None);
        for row in 0..agents.len() {
            prop_assert_eq!(guard.contacts.of(row), contacts.of(row));
        }
        Ok(())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn contacts_from_neighbour_lists_are_those_of_a_search(
            others in prop::collection::vec((0usize..240, 0u8..6), 0..6),
            spacing in 0.2..1.5,
            (neighbours, neighbour_distance) in (1usize..12, 0.5f32..5.0),
        ) {
            let group = Group { neighbours, neighbour_distance, ..Group::default() };
            check_contacts(crowd((spacing, 0.0), group, &others))?;
        }

        #[test]
        fn contacts_from_the_grid_in_space_are_those_of_a_search_in_the_plan(
            others in prop::collection::vec((0usize..240, 3u8..6), 0..6),
            spacing in 0.02..1.0,
            (height, neighbour_distance) in (0.0..10.0, 0.5f32..3.0),
        ) {
            let model = std::sync::Arc::new(crate::avoid::NoAvoidance);
            let group = Group { neighbours: Group::ALL_NEIGHBOURS, neighbour_distance, model, ..Group::default() };
            check_contacts(crowd((spacing, height), group, &others))?;
        }
    }
}

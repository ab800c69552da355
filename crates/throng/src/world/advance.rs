//! Stages 4, guard, and 5, motion: agents move to where the guard finds no overlap.

use super::perceive::AvoidsAll;
use super::{StepMemory, World};
use crate::agent::{Columns, Status};
use crate::guard::{self, BodyPose, GuardedBodies, Report, RowContacts};
use crate::motion::{Attitude, Motion, Vehicle, angle, faces, turn, wrap};
use glam::{Vec2, Vec3};

impl World {
    /// 4. Guard: finds targets at which no two guarded bodies overlap.
    pub(super) fn guard(&mut self, seconds: f32, now: f64) {
        let Self { agents, step, local_groups: groups, .. } = self;
        step.reach.map_from(&agents.max_speed, |speed| speed * seconds);
        step.guarded.map_from(&agents.group, |group| groups[group.index()].guard);
        let mut solids = std::mem::take(&mut self.step.solids);
        solids.find(&self.bodies(), &self.agents.group);
        self.step.solids = solids;
        // taken out, since the closures below borrow the world
        let mut contacts = std::mem::take(&mut self.step.contacts);
        let mut guard = std::mem::take(&mut self.step.guard);
        let mut targets = std::mem::take(&mut self.step.targets);
        let (world, bodies) = (&*self, self.bodies());
        let wished = |row: usize| BodyPose {
            heading: world.chosen_heading(row, seconds, now),
            ..world.chosen_place(row, seconds)
        };
        let Self { agents, step, walls, .. } = world;
        let report = if world.is_guarded() {
            let meets = |row, other| agents.avoids(row, other) || agents.avoids(other, row);
            contacts.collect(&bodies, &agents.number, &step.grid, walls, meets, world.seen());
            guard.certify(&bodies, &contacts, walls, wished, &mut targets)
        } else {
            // for measuring
            contacts.collect_walls_only(&bodies, walls);
            if world.lanes_to_move().is_none() && world.lanes_to_fly(seconds).is_none() {
                guard::unguarded(&bodies, wished, &mut targets);
            } else if bodies.solids.are_near() {
                guard::led(&bodies, wished, &mut targets);
            }
            Report::default()
        };
        let pushed = |&row: &usize| self.is_pushed(row, targets[row].place(), seconds);
        let pushed = if self.is_guarded() { guard.moved_rows().filter(pushed).count() } else { 0 };
        let Self { agents, step, tally, .. } = self;
        (step.contacts, step.guard, step.targets) = (contacts, guard, targets);
        tally.pushed += pushed as u64;
        tally.guard_changed += report.changed as u64;
        tally.agent_steps += agents.len() as u64;
        tally.sub_steps += 1;
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

    /// Whether any agent is guarded.
    pub(super) fn is_guarded(&self) -> bool {
        self.step.guarded.uniform() != Some(false)
    }

    fn bodies(&self) -> GuardedBodies<'_> {
        let Self { agents, step, .. } = self;
        GuardedBodies {
            positions: &agents.position,
            altitudes: &agents.altitude,
            headings: &agents.heading,
            cores: &agents.core,
            radii: &agents.radius,
            reach: &step.reach,
            guarded: &step.guarded,
            solids: &step.solids,
            resting: step.rest.asleep(),
        }
    }

    /// Returns the position that the chosen velocity leads to at the end of the sub-step, with the present heading.
    fn chosen_place(&self, row: usize, seconds: f32) -> BodyPose {
        let Self { agents, step, .. } = self;
        BodyPose {
            position: agents.position[row] + step.chosen_velocities.ground[row] * seconds,
            altitude: agents.altitude[row] + step.chosen_velocities.vertical_velocity(row) * seconds,
            heading: agents.heading[row],
        }
    }

    /// Returns the neighbours that the neighbour search found, and its range, if the search covers every contact: no
    /// agent flies, and the agent, a disc, avoids all others.
    fn seen<'a>(&'a self) -> impl Fn(usize) -> Option<RowContacts<'a>> {
        let Self { agents, step, local_groups: groups, .. } = self;
        let (none_flies, avoids_all) = (!agents.any_flies(), AvoidsAll::of(agents));
        move |row| {
            let group = &groups[agents.group[row].index()];
            let nearest = step.near.of(row);
            let all = nearest.len() < group.nearest();
            let sees_all = none_flies && group.nearest() > 0 && avoids_all.holds(agents, row);
            sees_all.then_some(RowContacts { nearest, range: group.neighbour_distance, all })
        }
    }

    /// Returns the heading that an agent turns to in the sub-step, for bodies that are not discs: the heading of its
    /// script, or the direction of its chosen velocity. The ends of a body turn no faster than the agent's preferred
    /// speed, because other agents avoid the ends as they move and would flee from a long body that spins.
    fn chosen_heading(&self, row: usize, seconds: f32, now: f64) -> f32 {
        let agents = &self.agents;
        let (heading, most) = (agents.heading[row], agents.max_turn_rate[row]);
        if agents.is_disc(row) {
            return heading;
        }
        if let Some(there) = self.scripted(row, now) {
            let most = most * seconds;
            let turn = there.heading - f64::from(heading);
            let turn = turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
            wrap(heading + (turn as f32).clamp(-most, most))
        } else {
            let facing = faces(self.step.chosen_velocities.ground[row], self.step.preferred.ground[row], most);
            let turned = wrap(turn(heading, facing, seconds, most) - heading);
            let most = agents.preferred_speed[row] / agents.core[row].length() * seconds;
            wrap(heading + turned.clamp(-most, most))
        }
    }

    /// 5. Motion: moves agents to the targets of the guard, then updates headings, arrivals and exits.
    pub(super) fn advance(&mut self, seconds: f32, now: f64) {
        self.note_still(seconds);
        let flying = self.lanes_to_fly(seconds).filter(|_| !self.is_guarded());
        match (self.lanes_to_move(), flying) {
            (Some(level), _) => self.advance_many(level, seconds),
            (None, Some((level, _))) => self.fly_many(level, seconds),
            (None, None) => self.advance_each(seconds, now),
        }
        self.agents.pass(seconds);
        self.measure();
        self.arrive(seconds, now);
    }

    /// Moves all agents on the scalar path.
    fn advance_each(&mut self, seconds: f32, now: f64) {
        self.note_looks(now);
        let Self { agents, local_groups: groups, step, .. } = self;
        for row in 0..agents.len() {
            let from = agents.position[row].extend(agents.altitude[row]);
            let target = step.targets[row];
            let velocity = velocity(from, target.place(), step.chosen_velocities.at(row), seconds);
            agents.position[row] = target.position;
            agents.altitude.set(row, target.altitude);
            let (velocity_before, climb_before) = (agents.velocity[row], agents.vertical_velocity[row]);
            agents.velocity[row] = velocity.truncate();
            agents.vertical_velocity.set(row, velocity.z);
            let before = agents.heading[row];
            let group = &groups[agents.group[row].index()];
            let heading = if group.steering.is_some() {
                let before = agents.attitude[row].motion(from, velocity_before.extend(climb_before));
                let (moved, attitude) = if velocity == step.preferred.at(row) {
                    (step.planned.velocity[row], step.planned.attitude[row])
                } else {
                    diverted(
                        &group.vehicle,
                        &before,
                        (&step.planned.attitude[row], step.planned.faces[row]),
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
                turned_heading(agents, step, row, before, seconds)
            };
            add_turn(agents, row, before, heading);
            if agents.status[row] == Status::Walking {
                agents.course_turned[row] += f64::from(angle_between(velocity_before, agents.velocity[row]));
                agents.walked[row] += f64::from((target.place() - from).length());
            }
        }
    }

    /// Returns the velocity that the guard and solids permit an agent that has yet to move.
    pub(super) fn certain_velocity(&self, row: usize, seconds: f32) -> Vec3 {
        let from = self.agents.position[row].extend(self.agents.altitude[row]);
        let target = if self.is_guarded() || self.step.solids.is_near(row) {
            self.step.targets[row]
        } else {
            guard::within_reach(row, &self.bodies(), self.chosen_place(row, seconds))
        };
        velocity(from, target.place(), self.step.chosen_velocities.at(row), seconds)
    }
}

/// Returns the heading of an agent that does not steer after its motion, and records the spin of a body that is not a disc.
fn turned_heading(agents: &mut Columns, step: &StepMemory, row: usize, before: f32, seconds: f32) -> f32 {
    if !agents.is_disc(row) {
        let heading = step.targets[row].heading;
        agents.spin.set(row, wrap(heading - before) / seconds);
        return heading;
    }
    let facing = match step.sources.looks.get(row) {
        Some(&looks) if looks != Vec2::ZERO => looks,
        _ => faces(agents.velocity[row], step.preferred.ground[row], agents.max_turn_rate[row]),
    };
    turn(before, facing, seconds, agents.max_turn_rate[row])
}

/// Turns an agent that does not steer and has moved, from its heading before.
pub(super) fn turn_walker(agents: &mut Columns, step: &StepMemory, row: usize, before: f32, seconds: f32) {
    let heading = turned_heading(agents, step, row, before, seconds);
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

/// Below this speed, m/s, a velocity has no visible direction.
pub(super) const SEEN: f32 = 0.1;

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
fn velocity(from: Vec3, to: Vec3, chosen: Vec3, seconds: f32) -> Vec3 {
    let unchanged = to.distance(from + chosen * seconds) <= to.abs().max_element() * f32::EPSILON;
    if unchanged { chosen } else { (to - from) / seconds }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guard::Contacts;
    use crate::{Agent, Body, Group, Settings, SubSteps};
    use glam::DVec2;
    use proptest::prelude::*;

    /// Returns agents in rows. Some of them are larger, long, or avoid only some agents.
    fn crowd(spacing: f64, group: Group, others: &[(usize, u8)]) -> World {
        let settings = Settings { step: 0.1, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
        let mut world = World::new(settings).unwrap();
        let group = world.add_group(group).unwrap();
        for at in 0..240u32 {
            let (x, y) = (f64::from(at % 16), f64::from(at / 16));
            let position = DVec2::new(x + 0.3 * (y * 1.7).sin(), y + 0.3 * (x * 2.3).sin()) * spacing;
            let agent = Agent { position: position.extend(0.0), group, radius: 0.2, ..Agent::default() };
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

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn contacts_from_neighbour_lists_are_those_of_a_search(
            others in prop::collection::vec((0usize..240, 0u8..6), 0..6),
            spacing in 0.2..1.5,
            (neighbours, neighbour_distance) in (1usize..12, 0.5f32..5.0),
        ) {
            let group = Group { neighbours, neighbour_distance, ..Group::default() };
            let mut world = crowd(spacing, group, &others);
            world.step();
            world.perceive(0.1);
            world.guard(0.1, 0.0);
            let World { agents, step, walls, .. } = &world;
            let meets = |row, other| agents.avoids(row, other) || agents.avoids(other, row);
            let mut contacts = Contacts::default();
            contacts.collect(&world.bodies(), &agents.number, &step.grid, walls, meets, |_| None);
            for row in 0..agents.len() {
                prop_assert_eq!(step.contacts.of(row), contacts.of(row));
            }
        }
    }
}

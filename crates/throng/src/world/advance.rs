//! 4. What is certain, and 5. move: to where the guard says nobody overlaps.

use super::World;
use crate::agent::Status;
use crate::guard::{Bodies, Pose};
use crate::motion::{faces, turn, wrap};
use crate::space::Core;
use glam::{Vec2, Vec3};

impl World {
    /// 4. What is certain: nobody overlaps.
    pub(super) fn guard(&mut self, seconds: f32, now: f64) {
        let mut targets = std::mem::take(&mut self.step.targets);
        targets.clear();
        targets.extend((0..self.agents.len()).map(|row| Pose {
            position: self.agents.position[row] + self.step.wishes[row].truncate() * seconds,
            altitude: self.agents.altitude[row] + self.step.wishes[row].z * seconds,
            heading: self.wished_heading(row, seconds, now),
        }));
        let Self { agents, step, groups, walls, tally, .. } = self;
        step.reach.map_from(&agents.max_speed, |speed| speed * seconds);
        step.guarded.map_from(&agents.group, |group| groups[group.index()].guard);
        let bodies = Bodies {
            positions: &agents.position,
            altitudes: &agents.altitude,
            headings: &agents.heading,
            cores: &agents.core,
            radii: &agents.radius,
            reach: &step.reach,
            guarded: &step.guarded,
        };
        step.contacts.collect(&bodies, &agents.number, &step.grid, walls, |row, other| {
            agents.avoids(row, other) || agents.avoids(other, row)
        });
        let report = step.guard.certify(&bodies, &step.contacts, walls, &mut targets);
        step.targets = targets;
        tally.guard_changed += report.changed as u64;
        tally.agent_steps += agents.len() as u64;
        tally.sub_steps += 1;
    }

    /// The heading that an agent would like at the end of the sub-step, for those whose turning touches others: where
    /// its script says, or where its wish leads.
    fn wished_heading(&self, row: usize, seconds: f32, now: f64) -> f32 {
        let agents = &self.agents;
        let (heading, most) = (agents.heading[row], agents.max_turn_rate[row]);
        if let Some(there) = self.scripted(row, now) {
            let most = most * seconds;
            let turn = there.heading - f64::from(heading);
            let turn = turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
            wrap(heading + (turn as f32).clamp(-most, most))
        } else if agents.is_disc(row) {
            heading
        } else {
            turn(
                heading,
                faces(self.step.wishes[row].truncate(), self.step.preferred[row].truncate(), most),
                seconds,
                most,
            )
        }
    }

    /// 5. Move: to where the guard said, then headings, arrivals, exits.
    pub(super) fn advance(&mut self, seconds: f32, now: f64) {
        let agents = &mut self.agents;
        for row in 0..agents.len() {
            let from = agents.position[row].extend(agents.altitude[row]);
            let target = self.step.targets[row];
            let velocity = velocity(from, target.place(), self.step.wishes[row], seconds);
            agents.position[row] = target.position;
            agents.altitude.set(row, target.altitude);
            let velocity_before = agents.velocity[row];
            agents.velocity[row] = velocity.truncate();
            agents.climb.set(row, velocity.z);
            let before = agents.heading[row];
            let heading = if agents.is_disc(row) {
                let facing =
                    faces(agents.velocity[row], self.step.preferred[row].truncate(), agents.max_turn_rate[row]);
                turn(before, facing, seconds, agents.max_turn_rate[row])
            } else {
                agents.spin.set(row, wrap(target.heading - before) / seconds);
                target.heading
            };
            agents.heading[row] = heading;
            if agents.status[row] == Status::Walking {
                let turned = f64::from((heading - before).abs());
                agents.turned[row] += turned.min(std::f64::consts::TAU - turned);
                agents.course_turned[row] += f64::from(angle_between(velocity_before, agents.velocity[row]));
                agents.walked[row] += f64::from((target.place() - from).length());
            }
        }
        agents.pass(seconds);
        self.measure();
        self.arrive(seconds, now);
    }

    /// The velocity that the guard leaves to an agent that has yet to move.
    pub(super) fn certain_velocity(&self, row: usize, seconds: f32) -> Vec3 {
        let from = self.agents.position[row].extend(self.agents.altitude[row]);
        velocity(from, self.step.targets[row].place(), self.step.wishes[row], seconds)
    }

    /// Notes how close bodies came to each other and to walls.
    pub(super) fn measure(&mut self) {
        let Self { agents, step, walls, tally, .. } = self;
        for row in 0..agents.len() {
            let at = agents.position[row].as_dvec2();
            let radius = f64::from(agents.radius[row]);
            let separation = |other: u32| agents.separation(row, other as usize);
            for &other in step.contacts.of(row) {
                if agents.number[other as usize] > agents.number[row] {
                    let separation = separation(other);
                    tally.least_separation = tally.least_separation.min(separation);
                    tally.overlaps += u64::from(separation < 1.0 - 1e-4);
                }
            }
            // those who can't touch yet: the nearest that was perceived
            if let Some(&near) = step.near.of(row).first() {
                tally.least_separation = tally.least_separation.min(separation(near));
            }
            let core = (!agents.is_disc(row)).then(|| agents.core_of(row));
            let edges = step.contacts.edges_of(row).iter().map(|&i| walls.edges()[i as usize]);
            let edges = edges.map(|edge| match &core {
                None => edge.nearest(at).distance(at),
                Some(core) => core.separation(&Core::segment(edge.start, edge.end)).distance,
            });
            let discs = step.contacts.discs_of(row).iter().map(|&i| walls.discs()[i as usize]);
            let discs = discs.map(|disc| match &core {
                None => disc.center.distance(at) - disc.radius,
                Some(core) => core.separation(&Core::point(disc.center)).distance - disc.radius,
            });
            if let Some(distance) = edges.chain(discs).min_by(f64::total_cmp) {
                let separation = distance / radius;
                tally.least_wall_separation = tally.least_wall_separation.min(separation);
                tally.overlaps += u64::from(separation < 1.0 - 1e-4);
            }
        }
    }
}

/// Below this speed, m/s, a velocity has no direction that could be seen.
const SEEN: f32 = 0.1;

/// The angle between two velocities, radians, if both can be seen.
fn angle_between(a: Vec2, b: Vec2) -> f32 {
    if a.length() < SEEN || b.length() < SEEN { 0.0 } else { libm::atan2f(a.perp_dot(b), a.dot(b)).abs() }
}

/// The velocity of a motion. What was certified as it was wished is the wish: the motion may be far below what
/// positions resolve.
fn velocity(from: Vec3, to: Vec3, wish: Vec3, seconds: f32) -> Vec3 {
    let unchanged = to.distance(from + wish * seconds) <= to.abs().max_element() * f32::EPSILON;
    if unchanged { wish } else { (to - from) / seconds }
}

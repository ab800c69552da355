//! 4. What is certain, and 5. move: to where the guard says nobody overlaps.

use super::World;
use crate::agent::Status;
use crate::guard::Bodies;
use crate::motion::{faces, turn};
use glam::Vec2;

impl World {
    /// 4. What is certain: nobody overlaps.
    pub(super) fn guard(&mut self, seconds: f32) {
        let Self { agents, step, walls, tally, .. } = self;
        step.reach.clear();
        step.reach.extend(agents.max_speed.iter().map(|speed| speed * seconds));
        step.targets.clear();
        step.targets.extend(agents.position.iter().zip(&step.wishes).map(|(&at, &v)| at + v * seconds));
        let bodies = Bodies { positions: &agents.position, radii: &agents.radius, reach: &step.reach };
        step.contacts.collect(&bodies, &agents.number, &step.grid, walls, |row, other| {
            agents.avoids(row, other) || agents.avoids(other, row)
        });
        let report = step.guard.certify(&bodies, &step.contacts, walls, &mut step.targets);
        tally.guard_changed += report.changed as u64;
        tally.agent_steps += agents.len() as u64;
        tally.sub_steps += 1;
    }

    /// 5. Move: to where the guard said, then headings, arrivals, exits.
    pub(super) fn advance(&mut self, seconds: f32, now: f64) {
        let agents = &mut self.agents;
        for row in 0..agents.len() {
            let (from, to) = (agents.position[row], self.step.targets[row]);
            let motion = to - from;
            agents.position[row] = to;
            agents.velocity[row] = velocity(from, to, self.step.wishes[row], seconds);
            let before = agents.heading[row];
            let facing = faces(agents.velocity[row], self.step.preferred[row], agents.max_turn_rate[row]);
            let heading = turn(before, facing, seconds, agents.max_turn_rate[row]);
            agents.heading[row] = heading;
            if agents.status[row] == Status::Walking {
                let trip = &mut agents.trip[row];
                let turned = f64::from((heading - before).abs());
                trip.turned += turned.min(std::f64::consts::TAU - turned);
                trip.on_way += f64::from(seconds);
                trip.walked += f64::from(motion.length());
            }
        }
        self.measure();
        self.arrive(seconds, now);
    }

    /// The velocity that the guard leaves to an agent that has yet to move.
    pub(super) fn certain_velocity(&self, row: usize, seconds: f32) -> Vec2 {
        velocity(self.agents.position[row], self.step.targets[row], self.step.wishes[row], seconds)
    }

    /// Notes how close bodies came to each other and to walls.
    pub(super) fn measure(&mut self) {
        let Self { agents, step, walls, tally, .. } = self;
        for row in 0..agents.len() {
            let at = agents.position[row].as_dvec2();
            let radius = f64::from(agents.radius[row]);
            let separation = |other: u32| {
                let radii = radius + f64::from(agents.radius[other as usize]);
                at.distance(agents.position[other as usize].as_dvec2()) / radii
            };
            for &other in step.contacts.of(row) {
                if agents.number[other as usize] > agents.number[row] {
                    let separation = separation(other);
                    tally.least_separation = tally.least_separation.min(separation);
                    tally.overlaps += u64::from(separation < 1.0 - 1e-4);
                }
            }
            // those who can't touch yet: the nearest that was perceived
            if let Some(near) = step.neighbours.get(row * step.most_neighbours)
                && near.row as usize != row
            {
                tally.least_separation = tally.least_separation.min(separation(near.row));
            }
            let edges = step.contacts.edges_of(row).iter().map(|&i| walls.edges()[i as usize].nearest(at).distance(at));
            let discs = step.contacts.discs_of(row).iter().map(|&i| {
                let disc = walls.discs()[i as usize];
                disc.center.distance(at) - disc.radius
            });
            if let Some(distance) = edges.chain(discs).min_by(f64::total_cmp) {
                let separation = distance / radius;
                tally.least_wall_separation = tally.least_wall_separation.min(separation);
                tally.overlaps += u64::from(separation < 1.0 - 1e-4);
            }
        }
    }
}

/// The velocity of a motion. What was certified as it was wished is the wish: the motion may be far below what
/// positions resolve.
fn velocity(from: Vec2, to: Vec2, wish: Vec2, seconds: f32) -> Vec2 {
    let unchanged = to.distance(from + wish * seconds) <= to.abs().max_element() * f32::EPSILON;
    if unchanged { wish } else { (to - from) / seconds }
}

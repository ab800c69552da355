//! 2. What would I like: the preferred velocity of everybody.

use super::{Way, World};
use crate::agent::Status;
use crate::navigate::{Goal, Keyframe, Travel, Turn, turned_right};
use crate::parallel;
use glam::{Vec2, Vec3};

/// Seconds in which an agent that was pushed off its goal comes back.
const RETURN_TIME: f32 = 0.5;

impl World {
    /// 2. What would I like: the preferred velocity of everybody in the sub-step that ends at `now`.
    pub(super) fn intend(&mut self, seconds: f32, now: f64) {
        self.plan();
        self.show_ways();
        self.follow_others();
        self.resolve(seconds);
        self.step.preferred.clear();
        self.step.preferred.resize(self.agents.len(), Vec3::ZERO);
        let mut travels = std::mem::take(&mut self.agents.travel);
        let mut preferred = std::mem::take(&mut self.step.preferred);
        let mut out: Vec<(&mut Travel, &mut Vec3)> = travels.iter_mut().zip(&mut preferred).collect();
        let world = &*self;
        parallel::rows(
            &mut out,
            1,
            || (),
            |(), row, out| {
                let (travel, preferred) = &mut out[0];
                **preferred = match world.scripted(row, now) {
                    Some(there) => ((there.at - world.world_position(row)).as_vec2() / seconds).extend(0.0),
                    None => world.preferred_velocity(row, travel, seconds),
                };
            },
        );
        self.agents.travel = travels;
        self.step.preferred = preferred;
    }

    /// Where the script of an agent is at a time, if it has one.
    pub(super) fn scripted(&self, row: usize, time: f64) -> Option<Keyframe> {
        Some(self.scripts[self.agents.script[row]?.index()].at(time))
    }

    /// Notes where everybody wants to go, for others to see.
    fn show_ways(&mut self) {
        let mut ways = std::mem::take(&mut self.step.ways);
        ways.clear();
        ways.extend(self.agents.travel.iter().enumerate().map(|(row, travel)| {
            let status = self.agents.status[row];
            let direction = match (status, travel.turn) {
                (Status::Walking, Turn::Aside) if travel.remaining < self.agents.radius[row] => Vec2::ZERO,
                (Status::Walking, _) => self.towards(row, travel).normalize_or_zero(),
                _ => Vec2::ZERO,
            };
            Way::new(status, self.goal_of(row), direction, travel.distance())
        }));
        self.step.ways = ways;
    }

    fn preferred_velocity(&self, row: usize, travel: &mut Travel, seconds: f32) -> Vec3 {
        let agents = &self.agents;
        if agents.status[row] == Status::Arrived {
            return self.back_to_goal(row, travel);
        }
        if agents.status[row] != Status::Walking {
            return Vec3::ZERO;
        }
        let Some(goal) = self.stop(row, travel.leg).map(|stop| &self.goals[stop.goal.index()]) else {
            return Vec3::ZERO;
        };
        let towards = self.towards(row, travel);
        let (distance, remaining, slope) = (towards.length(), travel.distance(), travel.slope());
        let direction = towards.normalize_or_zero();
        let speed = agents.preferred_speed[row];
        let group = &self.groups[agents.group[row].index()];
        let onwards = agents.velocity[row].dot(direction) * slope.x + agents.climb[row] * slope.y;
        let made = if speed > 0.0 { onwards / speed } else { 1.0 };
        let dice = self.dice(row);
        travel.stall(agents.radius[row], seconds * speed / agents.radius[row]);
        let detours = group.detour && travel.turn == Turn::Free;
        let detour = if detours { travel.detour(made, seconds, dice, || self.queues(row, direction)) } else { 0.0 };
        // coming to a point: as slow as stopping there takes, half of the acceleration left to turn with, and never
        // past it
        let stops = match (travel.turn, goal) {
            (Turn::Aside, _) => true,
            (_, goal) => goal.corners().is_none() && self.is_last(row, travel.leg),
        };
        let arriving = if stops {
            (agents.max_acceleration[row] * remaining).sqrt().min(remaining / seconds)
        } else {
            f32::INFINITY
        };
        let bias = if distance > 2.0 * agents.radius[row] { group.keep_right } else { 0.0 };
        let following = if detour == 0.0 { self.step.following[row].speed } else { f32::INFINITY };
        let speed = speed.min(arriving).min(following);
        (turned_right(direction, bias + detour) * (speed * slope.x)).extend(speed * slope.y)
    }

    /// From an agent to what it heads for.
    pub(super) fn towards(&self, row: usize, travel: &Travel) -> Vec2 {
        let aim = travel.aim().or_else(|| self.goal_middle(row, travel.leg)).unwrap_or_default();
        (aim - self.world_position(row)).as_vec2()
    }

    /// What an agent would like that has arrived: to rest, or to come gently back to its point if it was pushed away
    /// and nobody else has taken it.
    fn back_to_goal(&self, row: usize, travel: &Travel) -> Vec3 {
        let goal = self.stop(row, travel.leg).map(|stop| &self.goals[stop.goal.index()]);
        match goal.and_then(|goal| Some((goal, goal.offset(self.world_place(row))?))) {
            Some((goal, (offset, tolerance))) if travel.at_point && !self.is_taken(row, goal) => {
                let offset = offset.as_vec3();
                let beyond = offset.length() - tolerance;
                let speed = (beyond / RETURN_TIME).min(0.5 * self.agents.preferred_speed[row]);
                offset.normalize_or_zero() * speed.max(0.0)
            }
            _ => Vec3::ZERO,
        }
    }

    /// Whether somebody who has arrived at the same goal is nearer to it.
    fn is_taken(&self, row: usize, point: &Goal) -> bool {
        let agents = &self.agents;
        let ways = &self.step.ways;
        let distance = |row: usize| point.offset(self.world_place(row)).map(|(offset, _)| offset.length_squared());
        self.neighbours(row).iter().map(|&other| other as usize).any(|other| {
            agents.status[other] == Status::Arrived
                && ways[other].same_goal(&ways[row])
                && distance(other) < distance(row)
        })
    }
}

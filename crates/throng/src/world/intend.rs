//! 2. Intention: the preferred velocities of all agents.

use super::{State, World};
use super::fill::RETURN_TIME;
use super::velocities::set;
use crate::agent::{Group, Status};
use crate::navigate::{Goal, Keyframe, RouteProgress, Turn};
use crate::parallel;
use glam::{Vec2, Vec3};

/// The rules that the agents of a group share.
#[derive(Clone, Debug)]
pub(super) struct InteractionRules {
    pub resolve: bool,
    /// Whether a field governs the group.
    pub governed: bool,
}

impl InteractionRules {
    fn of(group: &Group) -> Self {
        let governed = group.field.is_some();
        // an agent that a field leads elsewhere is not blocked
        Self { resolve: group.resolve && !governed, governed }
    }
}

impl World {
    /// 2. Intention: computes the preferred velocities of all agents in the sub-step that ends at `now`.
    ///
    /// In the first sub-step of a step the agents look ahead, and the agents that are due choose among goals.
    pub(super) fn intend(&mut self, first: bool, seconds: f32, now: f64) {
        self.plan(seconds, now);
        if first {
            self.choose(seconds);
            self.look_ahead();
        }
        self.resolve(seconds);
        self.note_sources();
        let mut travels = std::mem::take(&mut self.state.agents.travel);
        let mut preferred = std::mem::take(&mut self.step.preferred);
        let mut interaction = std::mem::take(&mut self.step.interaction);
        interaction.clear();
        interaction.extend(self.state.local_groups.iter().map(InteractionRules::of));
        preferred.resize(self.state.agents.len(), self.state.in_space_now());
        let world = &*self;
        let level = self.state.lanes_to_intend();
        let one = |row: usize, travel: &mut RouteProgress| match world.state.scripted(row, now) {
            Some(there) => ((there.at - world.state.world_position(row)).as_vec2() / seconds).extend(0.0),
            None => {
                let own = world.preferred_velocity(row, travel, &interaction[world.state.agents.group[row].index()], seconds);
                world.governed(row, own, now)
            }
        };
        // steering behaviours follow below
        let steers = self.state.all_steer();
        parallel::ranges((&mut travels[..], preferred.rows()), |rows, both| {
            if steers {
                return;
            }
            world.step.rest.each(rows, both, |rows, (travels, mut preferred)| match level {
                Some(level) => world.intend_many(level, rows, travels, preferred.0, (&interaction, seconds), one),
                None => (rows.zip(travels).zip(0..))
                    .for_each(|((row, travel), at)| set(&mut preferred, at, one(row, travel))),
            });
        });
        self.state.agents.travel = travels;
        (self.step.preferred, self.step.interaction) = (preferred, interaction);
        // behaviours change their memory, and traces need it as it was before
        let memory = self.state.traced.any().then(|| self.state.agents.memory.clone());
        self.steer(seconds, now);
        self.command();
        self.account(memory, seconds, now);
    }

    /// Returns the greatest speed with which an agent approaches the end of its path: it can stop there with half of
    /// its acceleration, which leaves half for turning, and never overshoots. Infinite if it does not stop there.
    pub(super) fn arriving(&self, row: usize, travel: &RouteProgress, seconds: f32) -> f32 {
        let way = &self.step.shown[row].way;
        if way.stops() || travel.turn == Turn::Aside {
            (self.state.agents.max_acceleration[row] * way.remaining).sqrt().min(way.remaining / seconds)
        } else {
            f32::INFINITY
        }
    }

    fn preferred_velocity(
        &self,
        row: usize,
        travel: &mut RouteProgress,
        interaction: &InteractionRules,
        seconds: f32,
    ) -> Vec3 {
        let agents = &self.state.agents;
        let way = &self.step.shown[row].way;
        if !way.walks() {
            return if agents.status[row] == Status::Arrived {
                self.back_to_goal(row, travel, seconds)
            } else {
                Vec3::ZERO
            };
        }
        if !way.has_goal() || travel.waits_for_room() {
            return Vec3::ZERO;
        }
        // an agent that waits aside shows no direction to its neighbours
        let waits = travel.turn == Turn::Aside;
        let shown = !waits && way.direction != Vec2::ZERO;
        let mut direction = if shown { way.direction } else { self.state.towards(row, travel).normalize_or_zero() };
        let mut slope = travel.slope();
        if direction == Vec2::ZERO && slope.y != 0.0 && self.state.without_progress(row) > 0.0 {
            // a path straight up or down prefers no side
            (direction, slope) = (self.state.any_side(row), Vec2::new(0.5, slope.y));
        }
        let radius = agents.radius[row];
        let speed = agents.preferred_speed[row];
        if interaction.resolve {
            travel.stall(way.remaining, radius, seconds * speed / radius);
        }
        let ahead = self.ahead(row);
        let speed = speed.min(self.arriving(row, travel, seconds)).min(ahead.speed);
        let turned = ahead.turned(direction);
        (turned * (speed * slope.x)).extend(speed * slope.y)
    }

    /// Returns the preferred velocity of an agent that has arrived. In an area it goes to its place and stays there. At
    /// a point it stands, and returns slowly if it was pushed away and no other agent has taken the point.
    fn back_to_goal(&self, row: usize, travel: &mut RouteProgress, seconds: f32) -> Vec3 {
        if travel.standing().is_some() {
            let towards = self.state.towards(row, travel);
            let left = travel.standing().map_or(towards, |standing| (standing.at - self.state.world_position(row)).as_vec2());
            let speed = travel.standing_mut().map_or(0.0, |to| self.state.speed_to_place(row, to, left.length(), seconds));
            return (towards.normalize_or_zero() * speed).extend(0.0);
        }
        let goal = self.state.stop(row, travel.leg).map(|stop| &self.state.goals[stop.goal.index()]);
        match goal.and_then(|goal| Some((goal, goal.offset(self.state.world_place(row))?))) {
            Some((goal, (offset, tolerance))) if travel.at_point && !self.is_taken(row, goal) => {
                let offset = offset.as_vec3();
                let beyond = offset.length() - tolerance;
                let speed = (beyond / RETURN_TIME).min(0.5 * self.state.agents.preferred_speed[row]);
                offset.normalize_or_zero() * speed.max(0.0)
            }
            _ => Vec3::ZERO,
        }
    }

    /// Whether an agent that has arrived at the same goal is nearer to it.
    fn is_taken(&self, row: usize, point: &Goal) -> bool {
        let agents = &self.state.agents;
        let shown = &self.step.shown;
        let distance = |row: usize| point.offset(self.state.world_place(row)).map(|(offset, _)| offset.length_squared());
        self.neighbours(row).iter().map(|&other| other as usize).any(|other| {
            agents.status[other] == Status::Arrived
                && shown[other].way.same_goal(&shown[row].way)
                && distance(other) < distance(row)
        })
    }
}

impl State {
    /// Returns the keyframe of an agent's script at a time; `None` without a script.
    pub(crate) fn scripted(&self, row: usize, time: f64) -> Option<Keyframe> {
        Some(self.scripts[self.agents.script[row]?.index()].at(time))
    }

    /// Returns the offset from an agent to the point it heads for.
    pub(crate) fn towards(&self, row: usize, travel: &RouteProgress) -> Vec2 {
        let aim = travel.aim().or_else(|| self.goal_middle(row, travel.leg)).unwrap_or_default();
        (aim - self.world_position(row)).as_vec2()
    }
}

//! Stage 2b, intention: the preferred velocities of all agents.

use super::facing::Facing;
use super::govern::Sources;
use super::look_ahead::LooksAhead;
use super::standoff::Standoffs;
use super::steering::{Behaving, Planned, Steer};
use super::trace::Trace;
use super::velocities::{Velocities, set};
use crate::agent::{Group, Status};
use crate::halo::Link;
use crate::navigate::{Goal, Keyframe, NeighbourData, RETURN_TIME, RouteProgress, Surroundings, Turn};
use crate::parallel;
use crate::perceive::{Perceived, SubStep};
use crate::sleep::SleepBlocks;
use crate::world::State;
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
        let governed = group.guidance.field.is_some();
        // an agent that a field or a behaviour leads elsewhere is not blocked
        let follows_path = !governed && group.guidance.behaviour.is_none();
        Self { resolve: group.resolve && follows_path, governed }
    }
}

/// 2. Intention: computes the preferred velocities of all agents.
#[derive(Clone, Debug, Default)]
pub(crate) struct Intend {
    ahead: LooksAhead,
    standoffs: Standoffs,
    sources: Sources,
    interaction: Vec<InteractionRules>,
    preferred: Velocities,
    steer: Steer,
    traces: Vec<Trace>,
}

/// The result of intention.
pub(crate) struct Intended<'a> {
    /// The preferred velocity of each agent.
    pub preferred: &'a mut Velocities,
    /// The planned motion of each agent with a behaviour or a vehicle; empty if there is none. Motion uses its memory.
    pub planned: &'a mut Planned,
    /// The direction that each agent is to face, by fields; zero for none. Empty if no field says so.
    pub looks: &'a [Vec2],
    /// Pairs of agents of flocks that may be close enough to be measured after motion, each pair once.
    pub close_pairs: &'a [(u32, u32)],
}

impl Intended<'_> {
    /// Returns what determines the directions that agents face.
    pub fn facing(&self) -> Facing<'_> {
        Facing { preferred: self.preferred, planned: self.planned }
    }
}

impl Intend {
    /// Computes the preferred velocities of all agents in the sub-step that ends at `now`. In the first sub-step of a step
    /// the agents look ahead.
    pub fn run(
        &mut self,
        state: &mut State,
        (seen, shown): (Perceived<'_>, &[NeighbourData]),
        sleep: &SleepBlocks,
        SubStep { first, seconds, now, .. }: SubStep,
        link: &mut Link<'_>,
    ) -> Intended<'_> {
        let near = seen.near;
        if first {
            self.ahead.run(Surroundings { state, near, shown });
        } else if let Some(cycles) = seen.sorted {
            self.ahead.permute(cycles);
        }
        self.standoffs.run(state, seen, shown, sleep, seconds, link);
        self.sources.find(state);
        self.sources.find_looks(state, now);
        let Self { ahead, sources, interaction, preferred, .. } = self;
        interaction.clear();
        interaction.extend(state.local_groups.iter().map(InteractionRules::of));
        preferred.resize(state.agents.len(), state.in_space_now());
        // behaviours follow below
        if !state.all_behave() {
            state.with_travel(|state, travels| {
                let around = Surroundings { state, near, shown };
                Intending { state, around, ahead, sources, interaction }.run(sleep, travels, preferred, seconds, now);
            });
        }
        self.command(state);
        // behaviours change their memory, and traces need it as it was before
        let memory = state.traced.any().then(|| state.agents.memory.clone());
        self.steer.run(state, (seen, shown), &self.sources, &mut self.preferred, (seconds, now), &mut *link.halo);
        if let Some(memory) = memory {
            let after = std::mem::replace(&mut state.agents.memory, memory);
            self.traces = self.steer.view(state, seen).traces(&self.preferred, seconds, now);
            state.agents.memory = after;
        }
        Intended {
            preferred: &mut self.preferred,
            planned: &mut self.steer.planned,
            looks: &self.sources.looks,
            close_pairs: self.steer.flocks.close_pairs(),
        }
    }

    /// Returns the preferred velocities of the last sub-step.
    pub fn preferred(&self) -> &Velocities {
        &self.preferred
    }

    /// Records that the agent of a row is removed. The agent of the last row takes its row.
    pub fn remove(&mut self, row: usize) {
        self.ahead.remove(row);
    }

    /// Returns what the behaviours read in the last sub-step.
    pub fn steering<'a>(&'a self, state: &'a State, seen: Perceived<'a>) -> Behaving<'a> {
        self.steer.view(state, seen)
    }

    /// Returns the traces of the last sub-step.
    pub fn traces(&self) -> &[Trace] {
        &self.traces
    }

    /// Forgets the traces.
    pub fn forget_traces(&mut self) {
        self.traces.clear();
    }

    /// Replaces the preferred velocities of the agents that the program commands.
    fn command(&mut self, state: &State) {
        if state.agents.commanded.uniform() == Some(None) {
            return;
        }
        let mut rows = self.preferred.rows();
        for row in 0..state.agents.len() {
            if let Some(velocity) = state.agents.commanded[row] {
                set(&mut rows, row, velocity.clamp_length_max(state.agents.max_speed[row]));
            }
        }
    }
}

/// What the preferred velocity of an agent on a journey depends on.
#[derive(Clone, Copy)]
pub(super) struct Intending<'a> {
    pub state: &'a State,
    pub around: Surroundings<'a>,
    pub ahead: &'a LooksAhead,
    pub sources: &'a Sources,
    pub interaction: &'a [InteractionRules],
}

impl Intending<'_> {
    /// Computes the preferred velocities of all agents that do not sleep.
    fn run(
        &self,
        sleep: &SleepBlocks,
        travels: &mut [RouteProgress],
        preferred: &mut Velocities,
        seconds: f32,
        now: f64,
    ) {
        let state = self.state;
        let level = state.lanes_to_intend();
        let one = |row: usize, travel: &mut RouteProgress| match state.scripted(row, now) {
            Some(there) => ((there.at - state.world_position(row)).as_vec2() / seconds).extend(0.0),
            None => {
                let interaction = &self.interaction[state.agents.group[row].index()];
                let own = self.preferred_velocity(row, travel, interaction, seconds);
                self.sources.governed(self.around, row, own, now)
            }
        };
        parallel::ranges((travels, preferred.rows()), |rows, both| {
            sleep.each(rows, both, |rows, (travels, mut preferred)| match level {
                Some(level) => self.intend_many(level, rows, travels, preferred.0, seconds, one),
                None => (rows.zip(travels).zip(0..))
                    .for_each(|((row, travel), at)| set(&mut preferred, at, one(row, travel))),
            });
        });
    }

    fn preferred_velocity(
        &self,
        row: usize,
        travel: &mut RouteProgress,
        interaction: &InteractionRules,
        seconds: f32,
    ) -> Vec3 {
        let agents = &self.state.agents;
        let way = self.around.way(row);
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
        let ahead = self.ahead.of(row);
        let speed = speed.min(self.around.arriving(row, travel.turn, seconds)).min(ahead.speed);
        let turned = ahead.turned(direction);
        (turned * (speed * slope.x)).extend(speed * slope.y)
    }

    /// Returns the preferred velocity of an agent that has arrived. In an area it goes to its place and stays there. At
    /// a point it stands, and returns slowly if it was pushed away and no other agent has taken the point.
    fn back_to_goal(&self, row: usize, travel: &mut RouteProgress, seconds: f32) -> Vec3 {
        if travel.standing().is_some() {
            let towards = self.state.towards(row, travel);
            let left =
                travel.standing().map_or(towards, |standing| (standing.at - self.state.world_position(row)).as_vec2());
            let speed =
                travel.standing_mut().map_or(0.0, |to| self.state.speed_to_place(row, to, left.length(), seconds));
            return (towards.normalize_or_zero() * speed).extend(0.0);
        }
        let goal = self.state.stop(row, travel.leg).map(|stop| &self.state.goals[stop.goal.index()]);
        match goal.and_then(|goal| Some((goal, goal.offset(self.state.world_place(row))?))) {
            Some((goal, (offset, tolerance))) if travel.at_point && !self.around.is_taken(row, goal) => {
                let offset = offset.as_vec3();
                let beyond = offset.length() - tolerance;
                let agents = &self.state.agents;
                let time = agents.approach_time(row, RETURN_TIME, seconds);
                let speed = (beyond / time).min(0.5 * agents.preferred_speed[row]);
                offset.normalize_or_zero() * speed.max(0.0)
            }
            _ => Vec3::ZERO,
        }
    }
}

impl Surroundings<'_> {
    /// Returns the greatest speed with which an agent approaches the end of its path: it can stop there with half of
    /// its acceleration, which leaves half for turning, and never overshoots. Infinite if it does not stop there.
    pub fn arriving(&self, row: usize, turn: Turn, seconds: f32) -> f32 {
        let way = self.way(row);
        if way.stops() || turn == Turn::Aside {
            let agents = &self.state.agents;
            agents.stopping_speed(row, way.remaining, agents.approach_time(row, seconds, seconds))
        } else {
            f32::INFINITY
        }
    }

    /// Whether an agent that has arrived at the same goal is nearer to it.
    fn is_taken(&self, row: usize, point: &Goal) -> bool {
        let agents = &self.state.agents;
        let shown = self.shown;
        let distance =
            |row: usize| point.offset(self.state.world_place(row)).map(|(offset, _)| offset.length_squared());
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

//! Choice of goal: an agent with alternative journeys walks to the goal that it expects to reach first.
//!
//! After Ehtamo, Heliövaara, Korhonen, Hostikka, Game theoretic best-response dynamics for evacuees' exit selection,
//! Advances in Complex Systems 13:113 (2010): each agent, in its turn, takes the best choice while the other agents
//! keep their choices. The expected time to a goal is the longer of two times: the time to walk there, and the time in
//! which the agents before it pass the narrowest place on its path. The latter is a point queue (Vickrey, Congestion
//! theory and transport investment, American Economic Review 59:251, 1969).

use super::planning::Planning;
use super::{Navigate, Path};
use crate::agent::{GoalId, JourneyId, ProgressMark, Status};
use crate::halo::Alone;
use crate::perceive::Neighbours;
use crate::world::State;
use std::collections::BTreeMap;
use std::ops::Range;

/// Flow through a narrow place, agents per second and metre of width. Measured for doors of 0.8 to 2.4 m: 1.6 to 2.0.
const FLOW: f64 = 1.8;
/// Length of the end of the path, metres, in which an agent looks for the narrowest place.
const BEFORE_GOAL: f64 = 10.0;
/// Seconds between two choices of an agent, and the number of parts of that interval: in each part another part of the
/// agents chooses.
const INTERVAL: f64 = 2.0;
const PARTS: u64 = 4;
/// An agent changes its goal if that saves at least this time, seconds, and this part of the expected time.
const WORTH_IT: f64 = 2.0;
const WORTH_PART: f64 = 0.1;

/// Remaining distances, metres, of the agents on their way to each goal, in ascending order.
#[derive(Debug, Default)]
struct Queues(BTreeMap<GoalId, Vec<f32>>);

impl Queues {
    fn sort(&mut self) {
        self.0.values_mut().for_each(|queue| queue.sort_unstable_by(f32::total_cmp));
    }

    /// Returns the number of agents that are nearer to the goal.
    fn before(&self, goal: GoalId, remaining: f32) -> usize {
        self.0.get(&goal).map_or(0, |queue| queue.partition_point(|&other| other < remaining))
    }

    /// Moves an agent from the queue of one goal to the queue of another.
    fn change(&mut self, from: (GoalId, f32), to: (GoalId, f32)) {
        if let Some(queue) = self.0.get_mut(&from.0) {
            let at = queue.partition_point(|&other| other < from.1);
            queue.remove(at.min(queue.len() - 1));
        }
        let queue = self.0.entry(to.0).or_default();
        queue.insert(queue.partition_point(|&other| other < to.1), to.1);
    }
}

impl Navigate {
    /// Lets the agents that are due choose, one after the other. Their paths are up to date before and after.
    pub(super) fn choose(&mut self, state: &mut State, near: &Neighbours, seconds: f32) {
        let parts = state.parts_that_choose();
        if state.choices.is_empty() || parts.is_empty() {
            return;
        }
        let choices = state.choices_by_journey();
        let is_due = |&row: &usize| {
            let part = u64::from(state.agents.number[row]) % PARTS;
            parts.clone().any(|due| due % PARTS == part)
                && choices.contains_key(&state.agents.journey[row])
                && state.may_choose(row)
        };
        let mut rows: Vec<usize> = (0..state.agents.len()).filter(is_due).collect();
        rows.sort_unstable_by_key(|&row| state.agents.number[row]);
        let mut queues = self.queues(state);
        let mut asked = Vec::new();
        // rows, their goals, and their alternative journeys and goals
        let mut choosers = Vec::new();
        for row in rows {
            let (way, leg) = (self.shown[row].way, state.agents.travel[row].leg);
            let Some(goal) = state.stop(row, leg).map(|stop| stop.goal) else { continue };
            // a path is at least as wide as one body: if walking takes as long as waiting at that flow, no other goal
            // is better
            let least = FLOW * 2.0 * f64::from(state.agents.radius[row]);
            let walk = f64::from(way.remaining / state.agents.preferred_speed[row]);
            if !way.has_goal() || queues.before(goal, way.remaining) as f64 / least <= walk + WORTH_IT {
                continue;
            }
            let alternatives = state.alternatives(state.agents.journey[row], leg, &choices);
            let goals = std::iter::once(goal).chain(alternatives.iter().map(|&(_, goal)| goal));
            asked.extend(goals.map(|goal| state.ask_way_to(row, goal)));
            choosers.push((row, goal, alternatives));
        }
        state.prepare_meshes(&asked, &mut Alone);
        state.meshes.find(&state.goals, &mut asked);
        let mut found: BTreeMap<(usize, GoalId), (Path, f64)> = BTreeMap::new();
        for one in asked {
            if let Some(Ok(path)) = one.found {
                found.insert((one.row, one.goal), path);
            }
        }
        for (row, goal, alternatives) in choosers {
            let expected = |goal| {
                let (path, _) = found.get(&(row, goal))?;
                let length = path.length as f32;
                Some((state.expected_time(row, path, queues.before(goal, length)), length))
            };
            let Some((time, remaining)) = expected(goal) else { continue };
            let bound = (time - WORTH_IT).min(time * (1.0 - WORTH_PART));
            let best = (alternatives.into_iter())
                .filter_map(|(journey, goal)| expected(goal).map(|(time, length)| (time, journey, goal, length)))
                .filter(|&(time, ..)| time < bound)
                .min_by(|one, other| one.0.total_cmp(&other.0));
            let Some((_, journey, to, length)) = best else { continue };
            queues.change((goal, remaining), (to, length));
            if let Some((path, gap)) = found.remove(&(row, to)) {
                state.agents.journey.set(row, journey);
                state.agents.travel[row].set_out_again();
                // progress counts towards the new goal
                state.agents.progress_mark[row] = ProgressMark::default();
                self.shown[row].way = state.with_travel(|state, travels| {
                    let planning = Planning::new(state, near, &self.arrivals);
                    planning.take_way(row, &mut travels[row], (to, &path, gap), seconds)
                });
            }
        }
    }

    /// Returns the remaining distances of all agents on their way to goals of choices.
    fn queues(&self, state: &State) -> Queues {
        let stops = state.choices.iter().flatten().flat_map(|journey| &state.journeys[journey.index()].stops);
        let mut queues = Queues(stops.map(|stop| (stop.goal, Vec::new())).collect());
        for row in 0..state.agents.len() {
            let way = &self.shown[row].way;
            if way.walks()
                && let Some(stop) = state.stop(row, state.agents.travel[row].leg)
                && let Some(queue) = queues.0.get_mut(&stop.goal)
            {
                queue.push(way.remaining);
            }
        }
        queues.sort();
        queues
    }
}

impl State {
    /// Returns the parts that choose in this step: an agent belongs to the part that is the remainder of its number.
    fn parts_that_choose(&self) -> Range<u64> {
        let part = |steps: u64| self.ticks(steps, INTERVAL / PARTS as f64) + 1;
        let before = self.steps.checked_sub(1).map_or(0, part);
        before..part(self.steps).min(before + PARTS)
    }

    /// Whether an agent walks to a goal by looking ahead, without a script, field or steering behaviour.
    fn may_choose(&self, row: usize) -> bool {
        let (agents, group) = (&self.agents, &self.local_groups[self.agents.group[row].index()]);
        let by_itself = group.look_ahead && group.guidance.is_journey();
        by_itself
            && agents.status[row] == Status::Walking
            && agents.script[row].is_none()
            && agents.preferred_speed[row] > 0.0
    }

    fn choices_by_journey(&self) -> BTreeMap<JourneyId, usize> {
        (0..)
            .zip(&self.choices)
            .flat_map(|(index, choice)| choice.iter().map(move |&journey| (journey, index)))
            .collect()
    }

    /// Returns the journeys that an agent may change to at a leg, with the goal of that leg there. They differ in
    /// nothing else.
    fn alternatives(&self, own: JourneyId, leg: u32, choices: &BTreeMap<JourneyId, usize>) -> Vec<(JourneyId, GoalId)> {
        let Some(&choice) = choices.get(&own) else { return Vec::new() };
        let (stops, leg) = (&self.journeys[own.index()].stops, leg as usize);
        let goal_there = |&journey: &JourneyId| {
            let others = &self.journeys[journey.index()].stops;
            let alike = (0..).zip(stops.iter().zip(others)).all(|(at, (stop, other))| at == leg || stop == other);
            let goal = others.get(leg)?.goal;
            (alike && goal != stops[leg].goal).then_some((journey, goal))
        };
        self.choices[choice].iter().filter_map(goal_there).collect()
    }

    /// Returns the seconds until an agent reaches the end of a path that `before` agents reach earlier.
    fn expected_time(&self, row: usize, path: &Path, before: usize) -> f64 {
        let walk = path.length / f64::from(self.agents.preferred_speed[row]);
        let wait = |width: f64| before as f64 / (FLOW * width);
        match self.meshes.mesh(self.agents.body(row).clearance_radius()) {
            // no place on the mesh is narrower than a body
            Some(mesh) if wait(2.0 * mesh.radius()) > walk => walk.max(wait(mesh.narrowest(path, BEFORE_GOAL))),
            _ => walk,
        }
    }
}

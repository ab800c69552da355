//! Choice of goal: an agent whose journey has alternatives goes to the goal that it expects to reach first.
//!
//! After Ehtamo, Heliövaara, Korhonen, Hostikka, Game theoretic best-response dynamics for evacuees' exit selection,
//! Advances in Complex Systems 13:113 (2010): each agent, in its turn, takes what is best while the others keep to what they
//! have. The time to a goal is that of the walk there, or that of those before it to pass the narrowest place on its way,
//! whichever is longer: a point queue (Vickrey, Congestion theory and transport investment, American Economic Review 59:251,
//! 1969).

use super::World;
use crate::agent::{GoalId, JourneyId, Status};
use crate::navigate::{Asked, Path, Route};
use std::collections::BTreeMap;

/// Agents that pass a narrow place in a second, for each metre of its width: doors of 0.8 to 2.4 m pass 1.6 to 2.0.
const FLOW: f64 = 1.8;
/// Metres of its way before the goal in which an agent looks for the narrowest place.
const BEFORE_GOAL: f64 = 10.0;
/// Seconds between two choices of an agent, and into how many parts they are divided: in each another part of them chooses.
const INTERVAL: f64 = 2.0;
const PARTS: u64 = 4;
/// An agent goes elsewhere if that saves so many seconds, and so large a part of the time that is left.
const WORTH_IT: f64 = 2.0;
const WORTH_PART: f64 = 0.1;

/// Metres that are ahead of the agents on their way to each of some goals, in rising order.
#[derive(Debug, Default)]
struct Queues(BTreeMap<GoalId, Vec<f32>>);

impl Queues {
    fn sort(&mut self) {
        self.0.values_mut().for_each(|queue| queue.sort_unstable_by(f32::total_cmp));
    }

    /// Agents that are nearer to the goal.
    fn before(&self, goal: GoalId, remaining: f32) -> usize {
        self.0.get(&goal).map_or(0, |queue| queue.partition_point(|&other| other < remaining))
    }

    /// Lets one agent leave the way to a goal, and take that to another.
    fn change(&mut self, from: (GoalId, f32), to: (GoalId, f32)) {
        if let Some(queue) = self.0.get_mut(&from.0) {
            let at = queue.partition_point(|&other| other < from.1);
            queue.remove(at.min(queue.len() - 1));
        }
        let queue = self.0.entry(to.0).or_default();
        queue.insert(queue.partition_point(|&other| other < to.1), to.1);
    }
}

impl World {
    /// Lets the agents choose whose turn it is. Their ways are up to date, before and after.
    pub(super) fn choose(&mut self, seconds: f32) {
        if self.choices.is_empty() {
            return;
        }
        let due = self.due_to_choose();
        let mut rows: Vec<usize> = (0..self.agents.len()).filter(|&row| due(self.agents.number[row])).collect();
        let choices = self.choices_by_journey();
        rows.retain(|&row| choices.contains_key(&self.agents.journey[row]) && self.may_choose(row));
        if rows.is_empty() {
            return;
        }
        rows.sort_unstable_by_key(|&row| self.agents.number[row]);
        let mut queues = self.queues();
        let mut asked = Vec::new();
        for &row in &rows {
            let travel = &self.agents.travel[row];
            let (own, remaining) = (self.step.shown[row].way, self.step.shown[row].way.remaining);
            let Some(goal) = self.stop(row, travel.leg).map(|stop| stop.goal) else { continue };
            // with room for one body at least, it walks as long as it waits: nothing is gained elsewhere
            let least = FLOW * 2.0 * f64::from(self.agents.radius[row]);
            let walk = f64::from(remaining / self.agents.preferred_speed[row]);
            if !own.has_goal() || queues.before(goal, remaining) as f64 / least <= walk + WORTH_IT {
                continue;
            }
            let journeys = self.alternatives(self.agents.journey[row], travel.leg, &choices);
            asked.extend(std::iter::once(goal).chain(journeys.iter().map(|&(_, goal)| goal)).map(|goal| Asked {
                row,
                radius: self.agents.body(row).girth(),
                from: self.world_position(row),
                goal,
                found: None,
            }));
        }
        self.prepare_meshes(&asked);
        self.meshes.find(&self.goals, &mut asked);
        let mut found: BTreeMap<(usize, GoalId), (Path, f64)> = BTreeMap::new();
        for one in asked {
            if let Some(Ok(path)) = one.found {
                found.insert((one.row, one.goal), path);
            }
        }
        for row in rows {
            let (journey, leg) = (self.agents.journey[row], self.agents.travel[row].leg);
            let Some(goal) = self.stop(row, leg).map(|stop| stop.goal) else { continue };
            let expected = |goal| {
                let (path, _) = found.get(&(row, goal))?;
                Some((self.expected_time(row, path, queues.before(goal, path.length as f32)), path.length as f32))
            };
            let Some((time, remaining)) = expected(goal) else { continue };
            let bound = (time - WORTH_IT).min(time * (1.0 - WORTH_PART));
            let others = self.alternatives(journey, leg, &choices);
            let best = (others.into_iter())
                .filter_map(|(journey, goal)| expected(goal).map(|(time, length)| (time, journey, goal, length)))
                .filter(|&(time, ..)| time < bound)
                .min_by(|one, other| one.0.total_cmp(&other.0));
            let Some((_, journey, to, length)) = best else { continue };
            queues.change((goal, remaining), (to, length));
            if let Some((path, gap)) = found.remove(&(row, to)) {
                self.agents.journey.set(row, journey);
                let mut travel = std::mem::take(&mut self.agents.travel[row]);
                travel.set_out_again();
                travel.set_way((!self.is_straight(to, self.agents.body(row).girth())).then(|| Route::new(&path)));
                travel.set_gap(gap as f32);
                self.step.shown[row].way = self.look(row, &mut travel, seconds);
                self.agents.travel[row] = travel;
            }
        }
    }

    /// Whether it is an agent's turn to choose in this step, by its number.
    fn due_to_choose(&self) -> impl Fn(u32) -> bool + use<> {
        let part = |steps: u64| (steps as f64 * self.settings.step * PARTS as f64 / INTERVAL + 1e-9).floor() as u64;
        let now = part(self.steps) + 1;
        let before = self.steps.checked_sub(1).map_or(0, |steps| part(steps) + 1);
        // its turn is in each part whose number, taken by the number of parts, is that of its own
        move |number| (before..now.min(before + PARTS)).any(|part| part % PARTS == u64::from(number) % PARTS)
    }

    /// Whether an agent is on its way, by itself.
    fn may_choose(&self, row: usize) -> bool {
        let (agents, group) = (&self.agents, &self.groups[self.agents.group[row].index()]);
        let by_itself = group.look_ahead && group.steering.is_none() && group.field.is_none();
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

    /// Other journeys that an agent may take from a leg on, and where that leg goes: they differ in nothing else.
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

    /// How far all agents are that are on their way to goals of choices.
    fn queues(&self) -> Queues {
        let stops = self.choices.iter().flatten().flat_map(|journey| &self.journeys[journey.index()].stops);
        let mut queues = Queues(stops.map(|stop| (stop.goal, Vec::new())).collect());
        for row in 0..self.agents.len() {
            let way = &self.step.shown[row].way;
            if way.walks()
                && let Some(stop) = self.stop(row, self.agents.travel[row].leg)
                && let Some(queue) = queues.0.get_mut(&stop.goal)
            {
                queue.push(way.remaining);
            }
        }
        queues.sort();
        queues
    }

    /// Seconds until an agent is at the end of a path that so many others reach before it.
    fn expected_time(&self, row: usize, path: &Path, before: usize) -> f64 {
        let walk = path.length / f64::from(self.agents.preferred_speed[row]);
        let mesh = self.meshes.mesh(self.agents.body(row).girth());
        let wait = mesh.map_or(0.0, |mesh| before as f64 / (FLOW * mesh.narrowest(path, BEFORE_GOAL)));
        walk.max(wait)
    }
}

//! Paths through the states, as journeys.

use super::super::notes::Notes;
use super::machine::{Aim, Machine, MengeRegion, Selector, State, TransitionWhen, Velocity, Way};
use crate::geometry::DVec2;
use crate::registry::Goal;
use crate::scene::{
    AreaGoal, ChoiceGoal, CycleGoal, JourneyGoal, NearestGoal, Number, PointGoal, PointsGoal, Stop, Weighted,
};

/// The maximum number of paths that are followed from a state. Others are left out.
const MOST: usize = 64;
/// The maximum number of states of a path.
const LONGEST: usize = 256;
/// The maximum number of goals that are listed for single agents along a path.
const LISTED: usize = 200_000;
/// The least distance that counts as arrival, metres: an agent does not reach a point to the millimetre.
const NEAR: f64 = 0.1;

/// What the agents of a state do.
#[derive(Debug, Default)]
pub(super) struct MengeRoutes {
    pub goal: Option<Goal>,
    /// Seconds that they stand before they set off.
    pub wait: Option<Number>,
    /// The file of the field that guides them.
    pub field: Option<String>,
}

/// A path through the states.
#[derive(Clone, Debug, Default)]
struct Route {
    stops: Vec<Stop>,
    /// The states of the path so far.
    states: Vec<String>,
    wait: Option<Number>,
    weight: f64,
    repeat: bool,
    field: Option<String>,
}

/// Follows the paths from a state, for agents with the given start positions.
pub(super) fn follow(machine: &Machine, state: &str, at: &[DVec2], notes: &mut Notes) -> MengeRoutes {
    let mut todo = vec![(state.to_owned(), Route { weight: 1.0, ..Route::default() })];
    let mut done: Vec<Route> = vec![];
    while let Some((name, mut route)) = todo.pop() {
        let Some(state) = machine.states.get(&name) else {
            done.push(route);
            continue;
        };
        if route.states.contains(&name) {
            if route.states.first() != Some(&name) {
                notes
                    .about(&format!("state {name}"), "people come back to it: the journey begins again from its start");
            }
            route.repeat = true;
            done.push(route);
            continue;
        }
        route.states.push(name.clone());
        let way = chosen(&name, state, notes);
        route.step(machine, &name, state, way, at, notes);
        let to = way.map_or(&[][..], |way| &way.to);
        let room = route.states.len() < LONGEST && todo.len() + done.len() + to.len() <= MOST;
        if to.is_empty() || !room {
            if !room {
                notes.about(&format!("state {name}"), "too many ways lead on from here: they are left out");
            }
            done.push(route);
            continue;
        }
        let whole: f64 = to.iter().map(|(_, weight)| weight).sum();
        for (next, weight) in to.iter().rev() {
            let weight = if whole > 0.0 { route.weight * weight / whole } else { route.weight };
            todo.push((next.clone(), Route { weight, ..route.clone() }));
        }
    }
    if done.len() > 1 && done.iter().any(|route| route.repeat) {
        notes.whole("where the next state is drawn by chance, it is drawn once, at the start, and repeated");
    }
    let wait = done.first().and_then(|route| route.wait);
    let field = done.iter().find_map(|route| route.field.clone());
    let goals = done.into_iter().filter_map(|route| {
        let weight = route.weight;
        Some(Weighted { goal: route.goal()?, weight })
    });
    let mut goals: Vec<Weighted> = goals.collect();
    let goal = if goals.len() > 1 { Some(ChoiceGoal(goals).into()) } else { goals.pop().map(|only| only.goal) };
    MengeRoutes { goal, wait, field }
}

/// Returns the transition out of a state that a journey represents best.
fn chosen<'m>(name: &str, state: &'m State, notes: &mut Notes) -> Option<&'m Way> {
    let rank = |way: &Way| match (&way.when, way.to.is_empty()) {
        (_, true) | (TransitionWhen::Other(_), _) => 4,
        (TransitionWhen::There(_), _) => 0,
        (TransitionWhen::Later(_), _) => 1,
        (TransitionWhen::Now, _) => 2,
        (TransitionWhen::In(_), _) => 3,
    };
    let best = state.ways.iter().enumerate().filter(|(_, way)| rank(way) < 4).min_by_key(|(i, way)| (rank(way), *i));
    for (i, way) in state.ways.iter().enumerate() {
        if best.is_none_or(|(k, _)| k != i) {
            let why = if let TransitionWhen::Other(kind) = &way.when {
                format!(" (condition `{kind}`)")
            } else {
                String::new()
            };
            notes.about(&format!("transition from {name} {}", way.name), format!("left out{why}"));
        }
    }
    best.map(|(_, way)| way)
}

impl Route {
    /// Adds what agents do in a state.
    fn step(
        &mut self,
        machine: &Machine,
        name: &str,
        state: &State,
        way: Option<&Way>,
        at: &[DVec2],
        notes: &mut Notes,
    ) {
        if let Velocity::Field(file) = &state.velocity {
            self.field.get_or_insert_with(|| file.clone());
        }
        let when = way.map(|way| &way.when);
        if let Some(TransitionWhen::In(region)) = when {
            self.stops.push(Goal::from(AreaGoal(region.grown(0.0))).into());
            return;
        }
        let near = if let Some(TransitionWhen::There(distance)) = when { distance.max(NEAR) } else { NEAR };
        let goal = if state.velocity == Velocity::Stand || when == Some(&TransitionWhen::Now) {
            None
        } else {
            self.goal_in(machine, name, &state.selector, near, at, notes)
        };
        let wait = if let Some(TransitionWhen::Later(time)) = when { Some(*time) } else { None };
        match (goal, wait, self.stops.last_mut()) {
            (Some(goal), wait, _) => self.stops.push(Stop { goal, wait }),
            (None, Some(wait), Some(last)) if last.wait.is_none() => last.wait = Some(wait),
            (None, Some(wait), None) if self.wait.is_none() => self.wait = Some(wait),
            (None, Some(_), _) => notes.about(&format!("state {name}"), "a second wait at the same place is left out"),
            (None, None, _) => {}
        }
    }

    /// Returns the goal of agents in a state; `None` if they stay.
    fn goal_in(
        &self,
        machine: &Machine,
        name: &str,
        selector: &Selector,
        near: f64,
        at: &[DVec2],
        notes: &mut Notes,
    ) -> Option<Goal> {
        let name = format!("state {name}");
        let first = self.stops.is_empty();
        let set = |id: &u64| machine.sets.get(id).filter(|set| !set.is_empty());
        let missing = |notes: &mut Notes| {
            notes.about(&name, "its goals are not there: people stay where they are");
            None::<Goal>
        };
        let to = |aim: &Aim| -> Goal {
            match &aim.shape {
                MengeRegion::Point(at) => PointGoal { at: at.to_array(), tolerance: near }.into(),
                shape => AreaGoal(shape.grown(near)).into(),
            }
        };
        let points = |at: Vec<DVec2>| -> Goal {
            PointsGoal { at: at.iter().map(DVec2::to_array).collect(), tolerance: near }.into()
        };
        match selector {
            Selector::Stay => None,
            Selector::Explicit(id, goal) => {
                let found = set(id).and_then(|set| set.iter().find(|aim| aim.id == *goal));
                found.map(to).or_else(|| missing(notes))
            }
            Selector::Mirror(..) | Selector::Offset(_) if !first => {
                notes.about(&name, "a goal relative to the agent's position must come first: left out");
                None
            }
            Selector::Mirror(x, y) => {
                let sign = DVec2::new(if *x { -1.0 } else { 1.0 }, if *y { -1.0 } else { 1.0 });
                Some(points(at.iter().map(|p| *p * sign).collect()))
            }
            Selector::Offset(by) => Some(points(at.iter().map(|p| *p + *by).collect())),
            Selector::Random(id) | Selector::Weighted(id) => {
                let Some(set) = set(id) else { return missing(notes) };
                let weight = |aim: &Aim| if matches!(selector, Selector::Weighted(_)) { aim.weight } else { 1.0 };
                let weighted = set.iter().map(|aim| Weighted { goal: to(aim), weight: weight(aim) });
                Some(ChoiceGoal(weighted.collect()).into())
            }
            Selector::Nearest(id) | Selector::Farthest(id) => {
                let Some(set) = set(id) else { return missing(notes) };
                let farthest = matches!(selector, Selector::Farthest(_));
                let last: Option<PointGoal> = self.stops.last().and_then(|stop| stop.goal.read());
                let from = last.map_or_else(|| at.to_vec(), |point| vec![DVec2::from_array(point.at); at.len()]);
                let few = set.iter().map(|aim| aim.capacity).sum::<f64>() < 1e6
                    || set.iter().any(|aim| aim.capacity < at.len() as f64);
                let all_points = set.iter().all(|aim| matches!(aim.shape, MengeRegion::Point(_)));
                let listed = at.len() * (self.stops.len() + 1) <= LISTED;
                if all_points && (few || farthest) && listed {
                    notes.about(&name, "each agent's goal is chosen at the start");
                    return Some(points(shared_out(set, &from, farthest)));
                }
                Some(NearestGoal(set.iter().map(to).collect()).into())
            }
        }
    }

    fn goal(mut self) -> Option<Goal> {
        match (self.stops.len(), self.repeat) {
            (0, _) => None,
            (1, false) if self.stops[0].wait.is_none() => self.stops.pop().map(|stop| stop.goal),
            (_, false) => Some(JourneyGoal(self.stops).into()),
            (_, true) => Some(CycleGoal(self.stops).into()),
        }
    }
}

/// Returns the goal of each agent: in order, each agent takes the nearest, or the farthest, goal with free capacity.
/// Once all goals are full, all have their capacity again.
fn shared_out(set: &[Aim], from: &[DVec2], farthest: bool) -> Vec<DVec2> {
    let mut room: Vec<f64> = set.iter().map(|aim| aim.capacity).collect();
    let mut out = Vec::with_capacity(from.len());
    for p in from {
        if room.iter().all(|room| *room < 1.0) {
            room = set.iter().map(|aim| aim.capacity).collect();
        }
        let far = |i: &usize| {
            let distance = set[*i].shape.middle().distance_squared(*p);
            if farthest { -distance } else { distance }
        };
        let free = (0..set.len()).filter(|i| room[*i] >= 1.0);
        let Some(best) = free.min_by(|i, k| far(i).total_cmp(&far(k))) else { break };
        room[best] -= 1.0;
        out.push(set[best].shape.middle());
    }
    out
}

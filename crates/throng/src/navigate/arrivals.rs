//! Arrivals, waits, next legs and exits.

use super::{Goal, Navigate, RouteProgress, nearest_on_ring};
use crate::agent::{GoalId, ProgressMark, Status};
use crate::parallel::WORD;
use crate::perceive::{Nearby, Perceived, SubStep};
use crate::sleep::SleepBlocks;
use crate::world::{EventKind, State};
use glam::DVec2;

/// Seconds without progress after which an agent accepts twice the distance to a point that other agents have taken.
const CONTENT_TIME: f32 = 3.0;
/// Tolerance beyond the gap before an area that lies in a wall, metres.
pub(super) const GAP_TOLERANCE: f64 = 0.05;

/// The number of agents that have arrived at each goal.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arrivals {
    counts: Vec<u32>,
    /// The goals with a count above zero.
    taken: Vec<GoalId>,
}

impl Arrivals {
    /// Counts the agents that have arrived at each goal.
    pub fn count(&mut self, state: &State) {
        // goals may be as many as agents, and few of them taken
        self.taken.drain(..).for_each(|goal| self.counts[goal.index()] = 0);
        self.counts.resize(state.goals.len(), 0);
        for (first, all) in (0..).step_by(WORD).zip(state.agents.status[state.own()].chunks(WORD)) {
            // few have arrived: no early end, so that compilers use SIMD
            if !all.iter().fold(false, |any, &status| any | (status == Status::Arrived)) {
                continue;
            }
            for (row, _) in (first..).zip(all).filter(|&(_, &status)| status == Status::Arrived) {
                if let Some(goal) = state.goal_of(row) {
                    let count = &mut self.counts[goal.index()];
                    if *count == 0 {
                        self.taken.push(goal);
                    }
                    *count += 1;
                }
            }
        }
    }

    /// Returns the goals at which agents have arrived, with their numbers.
    pub fn all(&self) -> impl Iterator<Item = (GoalId, u32)> + '_ {
        self.taken.iter().map(|&goal| (goal, self.at(goal)))
    }

    /// Replaces the numbers of agents by others.
    pub fn replace(&mut self, all: impl Iterator<Item = (GoalId, u32)>) {
        self.taken.drain(..).for_each(|goal| self.counts[goal.index()] = 0);
        for (goal, count) in all {
            self.taken.push(goal);
            self.counts[goal.index()] = count;
        }
    }

    /// Whether any agent has arrived at a goal.
    #[inline]
    pub fn any(&self) -> bool {
        !self.taken.is_empty()
    }

    /// Returns the number of agents that have arrived at a goal.
    #[inline]
    pub fn at(&self, goal: GoalId) -> u32 {
        self.counts[goal.index()]
    }
}

impl Navigate {
    /// Counts the agents of this world that have arrived at each goal.
    pub fn count_arrivals(&mut self, state: &State) -> &mut Arrivals {
        self.arrivals.count(state);
        &mut self.arrivals
    }

    /// Updates arrivals, waits and exits. Returns the rows of the agents that leave at exits, the last one first.
    pub fn arrive(&mut self, state: &mut State, seen: Perceived<'_>, sleep: &SleepBlocks, of: SubStep) -> &[usize] {
        let (near, SubStep { seconds, now, .. }) = (seen.near, of);
        self.gone.clear();
        if !self.any_may_change {
            return &self.gone;
        }
        let Self { shown, arrivals, changes, gone, .. } = self;
        changes.clear();
        let rows = sleep.awake(state.own()).flatten().filter(|&row| shown[row].way.may_change());
        let nearby = Nearby { state, near };
        changes.extend(rows.map(|row| (row, nearby.next_status(row, arrivals, seconds))));
        for &(row, status) in &*changes {
            let before = state.agents.status[row];
            if before == Status::Waiting {
                let travel = &mut state.agents.travel[row];
                travel.set_wait(travel.wait() - seconds);
            }
            if status == Status::Arrived && before == Status::Walking {
                state.agents.travel[row].at_point = state.is_at_point(row);
            }
            let status = match status {
                // at its stop: the next leg begins, the journey ends, or the agent leaves
                Status::Arrived if before == Status::Walking => {
                    let wait = state.stop(row, state.agents.travel[row].leg).map_or(0.0, |stop| stop.wait);
                    let exits =
                        state.goal_of(row).is_some_and(|goal| matches!(state.goals[goal.index()], Goal::Exit { .. }));
                    if exits {
                        gone.push(row);
                        state.happened(row, EventKind::Left, now);
                        Status::Arrived
                    } else if wait > 0.0 {
                        state.agents.travel[row].set_wait(wait);
                        Status::Waiting
                    } else {
                        state.next_leg(row)
                    }
                }
                Status::Walking if before == Status::Waiting => state.next_leg(row),
                // pushed out of its place
                Status::Walking if before == Status::Arrived => {
                    state.agents.travel[row].set_out_again();
                    state.agents.progress_mark[row] = ProgressMark::default();
                    Status::Walking
                }
                status => status,
            };
            if status == Status::Arrived && before != Status::Arrived {
                let distance = state.distance_to_point(row);
                let travel = &mut state.agents.travel[row];
                travel.set_waits_for_room(false);
                travel.arrived_at = distance.unwrap_or(0.0);
            }
            if status == Status::Arrived && state.agents.arrived[row].is_infinite() {
                state.agents.arrived.set(row, now);
                // an agent that arrives by contact does not walk the rest of its path
                state.agents.shortest[row] -= f64::from(shown[row].way.remaining);
                state.happened(row, EventKind::Arrived, now);
            }
            state.agents.status[row] = status;
        }
        self.fill_areas(state, near, seconds);
        self.gone.reverse();
        &self.gone
    }
}

impl Nearby<'_> {
    fn next_status(&self, row: usize, arrivals: &Arrivals, seconds: f32) -> Status {
        let agents = &self.state.agents;
        match agents.status[row] {
            Status::Waiting if agents.travel[row].wait() <= seconds => Status::Walking,
            Status::Walking => {
                let Some(stop) = self.state.stop(row, agents.travel[row].leg) else {
                    return self.state.status_without_stop(row);
                };
                let (place, goal) = (self.state.world_place(row), &self.state.goals[stop.goal.index()]);
                let near = || match goal.offset(place) {
                    Some((offset, _)) => {
                        self.arrives_by_contact(row, stop.goal, offset.length(), arrivals.at(stop.goal))
                    }
                    None => self.state.is_at_area(row, &agents.travel[row], goal),
                };
                if goal.holds(place) || near() { Status::Arrived } else { Status::Walking }
            }
            Status::Arrived if self.is_out_of_place(row, &agents.travel[row]) => Status::Walking,
            status => status,
        }
    }

    /// Whether an agent arrives by contact: it is near enough to a point that other agents have taken, and touches an
    /// agent that has arrived there. The `n + 1`-th agent is near enough within 1.25 r sqrt(n + 1) + 2 r. Both limits
    /// grow while the agent makes no progress, because crowds gather in uneven discs and some local models keep a
    /// distance.
    fn arrives_by_contact(&self, row: usize, goal: GoalId, distance: f64, arrived: u32) -> bool {
        let agents = &self.state.agents;
        let radius = f64::from(agents.radius[row]);
        let enough = 1.25 * radius * f64::from(arrived + 1).sqrt() + 2.0 * radius;
        let patience = self.state.without_progress(row) / CONTENT_TIME;
        if arrived == 0 || distance > enough * f64::from(1.0 + patience) {
            return false;
        }
        let near = (1.1 + 0.1 * patience).min(1.5);
        self.neighbours(row).iter().any(|&other| {
            let other = other as usize;
            let touch = (agents.radius[row] + agents.radius[other]) * near;
            agents.status[other] == Status::Arrived
                && self.state.goal_of(other) == Some(goal)
                && agents.offset_in_space(row, other).length() <= touch
        })
    }
}

impl State {
    /// Records the trip of an agent that leaves.
    pub(crate) fn end_trip(&mut self, row: usize) {
        self.tally.removed += 1;
        self.tally.trips.add(&self.agents.trip(row), self.agents.preferred_speed[row]);
    }

    pub(crate) fn stop(&self, row: usize, leg: u32) -> Option<crate::Stop> {
        self.journeys[self.agents.journey[row].index()].stops.get(leg as usize).copied()
    }

    /// Returns the middle of the goal of a leg.
    pub(crate) fn goal_middle(&self, row: usize, leg: u32) -> Option<DVec2> {
        self.legs.of(self.agents.journey[row], leg).map(|leg| leg.middle)
    }

    /// Returns the status of an agent at the start of its journey.
    pub(crate) fn first_status(&self, row: usize) -> Status {
        let goes_somewhere = !self.journeys[self.agents.journey[row].index()].stops.is_empty();
        if goes_somewhere { Status::Walking } else { self.status_without_stop(row) }
    }

    /// Returns the status of an agent that has no stop to go to. It walks on if it steers, or if its journey has no stops
    /// at all and a field or the program moves it; otherwise it has arrived.
    fn status_without_stop(&self, row: usize) -> Status {
        let group = &self.local_groups[self.agents.group[row].index()];
        let goes_nowhere = self.journeys[self.agents.journey[row].index()].stops.is_empty();
        let is_moved = group.guidance.field.is_some() || self.agents.commanded[row].is_some();
        let goes_on = group.guidance.behaviour.is_some() || is_moved && goes_nowhere;
        if goes_on { Status::Walking } else { Status::Arrived }
    }

    /// Updates the status of an agent without stops after what moves it has changed.
    pub(crate) fn update_status_without_stops(&mut self, row: usize) {
        if self.journeys[self.agents.journey[row].index()].stops.is_empty() {
            let status = self.status_without_stop(row);
            self.agents.status[row] = status;
            if status == Status::Arrived && self.agents.arrived[row].is_infinite() {
                self.agents.arrived.set(row, self.time());
            }
        }
    }

    fn next_leg(&mut self, row: usize) -> Status {
        let journey = &self.journeys[self.agents.journey[row].index()];
        let leg = self.agents.travel[row].leg + 1;
        self.agents.progress_mark[row] = ProgressMark::default();
        let travel = &mut self.agents.travel[row];
        if (leg as usize) < journey.stops.len() {
            travel.begin(leg);
            Status::Walking
        } else if journey.repeat {
            travel.begin(0);
            Status::Walking
        } else {
            Status::Arrived
        }
    }

    /// Whether an agent is in an area, or as near as it can get to an area that lies in a wall.
    pub(crate) fn is_at_area(&self, row: usize, travel: &RouteProgress, goal: &Goal) -> bool {
        let (place, gap) = (self.world_place(row), f64::from(travel.gap()));
        let beside = |corners| {
            let at = place.truncate();
            gap > 0.0 && nearest_on_ring(corners, at).distance(at) <= gap + GAP_TOLERANCE
        };
        goal.holds(place) || goal.corners().is_some_and(beside)
    }

    /// Returns the distance to the point of the stop, metres; `None` if the goal is an area.
    fn distance_to_point(&self, row: usize) -> Option<f32> {
        let goal = &self.goals[self.goal_of(row)?.index()];
        goal.offset(self.world_place(row)).map(|(offset, _)| offset.length() as f32)
    }

    /// Whether an agent is at the point of its stop, rather than near agents that have gathered there.
    fn is_at_point(&self, row: usize) -> bool {
        let goal = self.goal_of(row).map(|goal| &self.goals[goal.index()]);
        goal.is_some_and(|goal| goal.corners().is_none() && goal.holds(self.world_place(row)))
    }
}

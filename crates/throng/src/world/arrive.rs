//! Arrivals, waits, next legs and exits.

use super::{EventKind, World, State};
use crate::agent::{ProgressMark, Status};
use crate::navigate::{Goal, RouteProgress, nearest_on_ring};
use crate::summary::Ended;
use glam::DVec2;

/// Seconds without progress after which an agent accepts twice the distance to a point that other agents have taken.
const CONTENT_TIME: f32 = 3.0;
/// Tolerance beyond the gap before an area that lies in a wall, metres.
pub(super) const GAP_TOLERANCE: f64 = 0.05;

impl World {
    /// Counts the agents that have arrived at each goal.
    pub(super) fn count_arrivals(&mut self) {
        let mut arrivals = std::mem::take(&mut self.step.arrivals);
        arrivals.clear();
        arrivals.resize(self.state.goals.len(), 0);
        for (row, _) in self.state.agents.status.iter().enumerate().filter(|&(_, &status)| status == Status::Arrived) {
            if let Some(goal) = self.state.goal_of(row) {
                arrivals[goal.index()] += 1;
            }
        }
        self.step.any_arrived = arrivals.iter().any(|&arrivals| arrivals > 0);
        self.step.arrivals = arrivals;
    }

    /// Updates arrivals, waits and exits.
    pub(super) fn arrive(&mut self, seconds: f32, now: f64) {
        if !self.step.any_may_change {
            return;
        }
        let mut changes = std::mem::take(&mut self.step.changes);
        changes.clear();
        let Self { state: State { agents, .. }, step } = &*self;
        let rows = step.rest.awake(0..agents.len()).flatten().filter(|&row| step.shown[row].way.may_change());
        changes.extend(rows.map(|row| (row, self.next_status(row, seconds))));
        let mut gone = Vec::new();
        for &(row, status) in &changes {
            let before = self.state.agents.status[row];
            if before == Status::Waiting {
                let travel = &mut self.state.agents.travel[row];
                travel.set_wait(travel.wait() - seconds);
            }
            if status == Status::Arrived && before == Status::Walking {
                self.state.agents.travel[row].at_point = self.state.is_at_point(row);
            }
            let status = match status {
                // at its stop: the next leg begins, the journey ends, or the agent leaves
                Status::Arrived if before == Status::Walking => {
                    let wait = self.state.stop(row, self.state.agents.travel[row].leg).map_or(0.0, |stop| stop.wait);
                    let exits =
                        self.state.goal_of(row).is_some_and(|goal| matches!(self.state.goals[goal.index()], Goal::Exit { .. }));
                    if exits {
                        gone.push(row);
                        self.state.happened(row, EventKind::Left, now);
                        Status::Arrived
                    } else if wait > 0.0 {
                        self.state.agents.travel[row].set_wait(wait);
                        Status::Waiting
                    } else {
                        self.state.next_leg(row)
                    }
                }
                Status::Walking if before == Status::Waiting => self.state.next_leg(row),
                // pushed out of its place
                Status::Walking if before == Status::Arrived => {
                    self.state.agents.travel[row].set_out_again();
                    self.state.agents.progress_mark[row] = ProgressMark::default();
                    Status::Walking
                }
                status => status,
            };
            if status == Status::Arrived && before != Status::Arrived {
                let distance = self.state.distance_to_point(row);
                let travel = &mut self.state.agents.travel[row];
                travel.set_waits_for_room(false);
                travel.arrived_at = distance.unwrap_or(0.0);
            }
            if status == Status::Arrived && self.state.agents.arrived[row].is_infinite() {
                self.state.agents.arrived.set(row, now);
                // an agent that arrives by contact does not walk the rest of its path
                self.state.agents.shortest[row] -= f64::from(self.step.shown[row].way.remaining);
                self.state.happened(row, EventKind::Arrived, now);
            }
            self.state.agents.status[row] = status;
        }
        self.fill_areas(&changes, seconds);
        self.step.changes = changes;
        for &row in gone.iter().rev() {
            let ended = Ended { trip: self.state.agents.trip(row), preferred_speed: self.state.agents.preferred_speed[row] };
            self.state.tally.removed.push((self.state.agents.number[row], ended));
            self.remove_row(row);
        }
    }

    fn next_status(&self, row: usize, seconds: f32) -> Status {
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
                        self.arrives_by_contact(row, stop.goal, offset.length(), self.step.arrivals[stop.goal.index()])
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
    fn arrives_by_contact(&self, row: usize, goal: crate::GoalId, distance: f64, arrived: u32) -> bool {
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
        let is_moved = group.field.is_some() || self.agents.commanded[row].is_some();
        let goes_on = group.steering.is_some() || is_moved && goes_nowhere;
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

//! Filling of goal areas. An agent that enters the area at the end of its journey walks on to a free place in it, the
//! deepest first, and so makes room for the agents behind it. An agent for which no place is free waits outside.

use super::{Goal, Navigate, Path, PathSearch, Route, RouteProgress, Standing, StandingPlaces, Surroundings};
use crate::agent::{GoalId, Status};
use crate::perceive::{Nearby, Neighbours};
use crate::world::State;
use glam::DVec2;
use std::collections::BTreeMap;

/// Seconds in which an agent returns to its place.
pub(crate) const RETURN_TIME: f32 = 0.5;
/// Distances in radii: an agent this near to its place stands there, and stands until it is this far away.
const AT_PLACE: f32 = 0.25;
const OFF_PLACE: f32 = 0.45;
/// Seconds in which an agent must get a radius nearer to its place. Otherwise it chooses another place, within this
/// number of radii.
const BLOCKED: f32 = 2.0;
const CLOSE: f64 = 4.0;
/// Number of places that an agent tries to reach before it stands where it is.
const TRIES: u8 = 3;
/// Seconds between two checks for a free place.
const LOOK: f32 = 1.0;
/// Distance, in sums of radii, within which a walking agent presses a standing one to make room.
const PRESSES: f32 = 1.3;
/// Distance, in sums of radii, within which agents belong to a gathering at a point: a little more than what counts as
/// contact for arrival.
const GATHERS: f32 = 1.6;
/// Distance from which on two places are free of each other, in sums of radii.
const APART: f64 = 1.05;
/// Remaining distance, in radii, below which an agent waits for room. An agent also waits within `BEHIND` sums of radii
/// of an agent that waits.
const NEAR: f32 = 6.0;
const BEHIND: f32 = 3.0;
/// Least number of places in a lattice, if the area has room for them.
const PLACES: usize = 4096;

/// Standing places, by goal, class of radius, and greatest number of places.
pub(super) type Lattices = BTreeMap<(GoalId, u32, usize), StandingPlaces>;

/// Returns the class of a radius as its upper and lower bound. An octave has 16 classes.
fn class_of(radius: f32) -> (f32, f32) {
    const BELOW: u32 = (1 << 19) - 1;
    let up = (radius.to_bits() + BELOW) & !BELOW;
    (f32::from_bits(up), f32::from_bits(up - BELOW - 1))
}

/// Ground that an agent has taken: its row, position and radius.
type TakenDisc = (usize, DVec2, f64);

/// The places that agents have taken in one area, by square.
#[derive(Default)]
struct Taken {
    width: f64,
    squares: BTreeMap<(i64, i64), Vec<TakenDisc>>,
}

impl Taken {
    fn square(&self, at: DVec2) -> (i64, i64) {
        ((at.x / self.width).floor() as i64, (at.y / self.width).floor() as i64)
    }

    fn put(&mut self, row: usize, at: DVec2, radius: f64) {
        self.squares.entry(self.square(at)).or_default().push((row, at, radius));
    }

    fn remove(&mut self, row: usize, at: DVec2) {
        if let Some(taken) = self.squares.get_mut(&self.square(at)) {
            taken.retain(|&(other, ..)| other != row);
        }
    }

    /// Whether no agent except `row` has taken ground within a radius of a point.
    fn is_free(&self, row: usize, at: DVec2, radius: f64) -> bool {
        let (x, y) = self.square(at);
        let near = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (x + dx, y + dy)));
        let mut taken = near.filter_map(|square| self.squares.get(&square)).flatten();
        taken.all(|&(other, there, theirs)| other == row || there.distance(at) >= APART * (radius + theirs))
    }
}

impl Nearby<'_> {
    /// Whether an agent that has arrived is no longer in place: it was pushed out of its area, or off its point and the
    /// agents that have gathered there.
    pub fn is_out_of_place(&self, row: usize, travel: &RouteProgress) -> bool {
        let Some((_, goal)) = self.state.last_goal(row, travel.leg) else { return false };
        let (place, radius) = (self.state.world_place(row), self.state.agents.radius[row]);
        let Some((offset, tolerance)) = goal.offset(place) else {
            return goal.corners().is_some() && !self.state.is_at_area(row, travel, goal);
        };
        let distance = offset.length() as f32;
        distance > tolerance.max(travel.arrived_at) + 2.0 * radius
            || distance > tolerance + 2.0 * radius && !self.is_in_gathering(row, goal, distance)
    }

    /// Whether an agent touches, or nearly touches, an agent that has arrived at the same goal, or an agent that has
    /// arrived elsewhere and is nearer to the point than `distance`: that agent occupies the point.
    fn is_in_gathering(&self, row: usize, point: &Goal, distance: f32) -> bool {
        let agents = &self.state.agents;
        let holds = |other: usize| {
            let offset = point.offset(self.state.world_place(other));
            offset.is_some_and(|(offset, _)| (offset.length() as f32) < distance)
        };
        self.neighbours(row).iter().map(|&other| other as usize).any(|other| {
            let touch = GATHERS * (agents.radius[row] + agents.radius[other]);
            agents.status[other] == Status::Arrived
                && agents.offset_in_space(row, other).length() <= touch
                && (self.state.end_of_journey(other) == self.state.end_of_journey(row) || holds(other))
        })
    }

    /// Whether an agent that has arrived in an area must choose a place: it has none, cannot reach its place, or is
    /// pressed by another agent.
    pub fn wants_place(&self, row: usize, travel: &RouteProgress, seconds: f32) -> bool {
        if self.state.filled_area(row, travel.leg).is_none() {
            return false;
        }
        travel.standing().is_none_or(|standing| !travel.has_way() || standing.idle > BLOCKED)
            || self.state.looks_for_room(row, seconds) && self.is_pressed(row)
    }

    /// Whether an agent with the same goal stands close by and makes no progress.
    fn is_pressed(&self, row: usize) -> bool {
        let agents = &self.state.agents;
        self.neighbours(row).iter().map(|&other| other as usize).any(|other| {
            let touch = PRESSES * (agents.radius[row] + agents.radius[other]);
            agents.status[other] == Status::Walking
                && self.state.end_of_journey(other) == self.state.end_of_journey(row)
                && agents.speed(other) < 0.3 * agents.preferred_speed[other]
                && agents.offset(row, other).length() <= touch
        })
    }
}

impl Navigate {
    /// Lets the agents that may have changed and have arrived in an area choose places, and decides whether agents on their
    /// way there must wait for room.
    pub(super) fn fill_areas(&mut self, state: &mut State, near: &Neighbours, seconds: f32) {
        let chooses = |&row: &usize| {
            let travel = &state.agents.travel[row];
            match state.agents.status[row] {
                Status::Arrived => Nearby { state, near }.wants_place(row, travel, seconds),
                Status::Walking => state.looks_for_room(row, seconds) && state.filled_area(row, travel.leg).is_some(),
                Status::Waiting | Status::Stranded => false,
            }
        };
        let rows = self.changes.iter().map(|&(row, _)| row).filter(chooses);
        let mut rows: Vec<(GoalId, u32, usize)> =
            rows.filter_map(|row| Some((state.goal_of(row)?, state.agents.number[row], row))).collect();
        rows.sort_unstable();
        for rows in rows.chunk_by(|a, b| a.0 == b.0) {
            self.fill_area(state, near, rows[0].0, rows.iter().map(|&(.., row)| row));
        }
    }

    /// As [`fill_areas`](Self::fill_areas), for the agents of one area, in the order of their numbers.
    fn fill_area(&mut self, state: &mut State, near: &Neighbours, goal: GoalId, rows: impl Iterator<Item = usize>) {
        let (mut taken, demand) = state.taken(goal);
        for row in rows {
            let bound = state.agents.body(row).bounding_radius();
            let key = (goal, class_of(bound).0.to_bits(), PLACES.max(2 * demand.next_power_of_two()));
            let lattice = self.lattices.entry(key).or_insert_with(|| state.new_lattice(goal, bound, key.2));
            if lattice.is_empty() {
                // the area is in a wall, or too small: agents stand where they arrive
                if state.agents.status[row] == Status::Arrived {
                    state.stand_here(row, 0.0);
                }
                continue;
            }
            let (from, radius) = (state.world_position(row), f64::from(bound));
            let is_free = |at: DVec2| taken.is_free(row, at, radius);
            if state.agents.status[row] == Status::Walking {
                let waits = Surroundings { state, near, shown: &self.shown }.is_near_area(row)
                    && lattice.choose(from, f64::MIN, 1, is_free).is_none();
                state.agents.travel[row].set_waits_for_room(waits);
                continue;
            }
            let before = state.agents.travel[row].standing().copied();
            let never_walked = state.agents.walked[row] == 0.0;
            let mut tries = 0;
            let found = match before {
                None if never_walked && is_free(from) => None,
                None => lattice.choose(from, f64::MIN, demand, is_free),
                // the nearest place instead of a place that it cannot reach
                Some(before) if before.idle > BLOCKED => {
                    let place = lattice.choose(from, f64::MIN, 1, is_free);
                    tries = before.tries.saturating_add(1);
                    let is_close = |at: DVec2| at != before.at && at.distance(from) <= CLOSE * radius;
                    place.filter(|place| is_close(place.at) && tries < TRIES)
                }
                Some(before) if !state.agents.travel[row].has_way() => {
                    lattice.choose(from, f64::MIN, demand, is_free).filter(|_| before.nearest > 0.0)
                }
                // a deeper place makes room
                Some(before) => match lattice.choose(from, before.depth + 0.5 * radius, demand, is_free) {
                    Some(place) => Some(place),
                    None => continue,
                },
            };
            let depth_here = lattice.depth_near(from);
            if let Some(before) = before {
                taken.remove(row, before.at);
            }
            match found {
                Some(place) => {
                    let route = state.route_to(row, place.at);
                    state.agents.travel[row].stand_at(place.at, place.depth, route, tries);
                    taken.put(row, place.at, radius);
                }
                None => {
                    state.stand_here(row, depth_here);
                    taken.put(row, from, radius);
                }
            }
        }
    }
}

impl Surroundings<'_> {
    /// Whether an agent on its way is so near to its area, or to agents that wait in front of it, that it waits too.
    fn is_near_area(&self, row: usize) -> bool {
        let (agents, shown) = (&self.state.agents, self.shown);
        shown[row].way.remaining <= NEAR * agents.radius[row]
            || self.neighbours(row).iter().map(|&other| other as usize).any(|other| {
                let close = BEHIND * (agents.radius[row] + agents.radius[other]);
                agents.travel[other].waits_for_room()
                    && shown[other].way.same_goal(&shown[row].way)
                    && agents.offset(row, other).length() <= close
            })
    }
}

impl State {
    /// Returns the goal at which an agent stays once it has arrived: the goal of the last stop of its journey.
    fn last_goal(&self, row: usize, leg: u32) -> Option<(GoalId, &Goal)> {
        let agents = &self.agents;
        let leg = self.legs.of(agents.journey[row], leg).filter(|leg| leg.is_last)?;
        let stays = agents.script[row].is_none() && self.behaviour(row).is_none();
        stays.then(|| (leg.goal, &self.goals[leg.goal.index()]))
    }

    /// Returns the area that an agent fills. Agents in the air fill none.
    fn filled_area(&self, row: usize, leg: u32) -> Option<(GoalId, &[DVec2])> {
        match self.last_goal(row, leg)? {
            (id, Goal::Area { corners }) if self.agents.altitude[row] == 0.0 => Some((id, corners)),
            _ => None,
        }
    }

    /// Returns the goal where the journey of an agent ends.
    fn end_of_journey(&self, row: usize) -> Option<GoalId> {
        self.journeys[self.agents.journey[row].index()].stops.last().map(|stop| stop.goal)
    }

    /// Whether it is this agent's turn to check for a free place.
    fn looks_for_room(&self, row: usize, seconds: f32) -> bool {
        let every = (LOOK / seconds).round().max(1.0) as u64;
        (self.tally.sub_steps + u64::from(self.agents.number[row])).is_multiple_of(every)
    }

    /// Makes an agent's present position its place.
    fn stand_here(&mut self, row: usize, depth: f64) {
        let at = self.world_position(row);
        let route = Route::new(&Path { start: at, corners: vec![at], length: 0.0 });
        self.agents.travel[row].stand_at(at, depth, route, 0);
    }

    /// Returns the places taken in an area, and the number of agents that stand in it or are on their way to stay in
    /// it.
    fn taken(&self, goal: GoalId) -> (Taken, usize) {
        let agents = &self.agents;
        let largest = agents.bodies().map(|body| body.bounding_radius()).fold(0.0, f32::max);
        let mut taken = Taken { width: 2.0 * APART * f64::from(largest), ..Taken::default() };
        let mut demand = 0;
        for row in 0..agents.len() {
            let travel = &agents.travel[row];
            if self.filled_area(row, travel.leg).is_none_or(|(id, _)| id != goal) {
                continue;
            }
            demand += usize::from(agents.status[row] != Status::Stranded);
            if let Some(standing) = travel.standing().filter(|_| agents.status[row] == Status::Arrived) {
                taken.put(row, standing.at, f64::from(agents.body(row).bounding_radius()));
            }
        }
        (taken, demand)
    }

    fn new_lattice(&self, goal: GoalId, bound: f32, most: usize) -> StandingPlaces {
        let (radius, body) = class_of(bound);
        let corners = self.goals[goal.index()].corners().unwrap_or_default();
        StandingPlaces::new(corners, f64::from(radius), most, |at| self.no_room(at, body).is_none())
    }

    /// Returns the route of an agent to a place.
    fn route_to(&self, row: usize, to: DVec2) -> Route {
        let from = self.world_position(row);
        let mesh = self.meshes.mesh(self.agents.body(row).clearance_radius());
        let path = mesh.and_then(|mesh| mesh.path(&mut PathSearch::default(), from, to).ok());
        Route::new(&path.unwrap_or_else(|| Path { start: from, corners: vec![to], length: from.distance(to) }))
    }

    /// Returns the speed of an agent towards its place in an area, `distance` metres away.
    pub(crate) fn speed_to_place(&self, row: usize, standing: &mut Standing, distance: f32, seconds: f32) -> f32 {
        let agents = &self.agents;
        let radius = agents.radius[row];
        // `nearest` is 0 while it stands at its place
        let near = if standing.nearest == 0.0 { OFF_PLACE } else { AT_PLACE };
        if distance <= near * radius {
            (standing.nearest, standing.idle) = (0.0, 0.0);
            return 0.0;
        }
        if standing.nearest == 0.0 || distance < standing.nearest - radius {
            (standing.nearest, standing.idle) = (distance, 0.0);
        } else {
            standing.idle += seconds;
        }
        let time = agents.approach_time(row, RETURN_TIME.max(seconds), seconds);
        agents.preferred_speed[row].min(agents.stopping_speed(row, distance, time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_holds_its_radii_and_is_narrow() {
        for radius in [0.001f32, 0.15, 0.2, 0.25, 0.3, 1.0, 1000.0] {
            let (up, down) = class_of(radius);
            assert!(down < radius && radius <= up && up <= 1.07 * radius, "{down} {radius} {up}");
        }
    }
}

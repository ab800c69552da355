//! Path planning for agents without a path, or with a path that is no longer valid. All other agents keep their paths.

use super::arrivals::{Arrivals, GAP_TOLERANCE};
use super::{
    Goal, Heading, Leg, Meshes, NavFlags, Navigate, NeighbourData, Path, PathRequest, Route, RouteProgress, Turn,
};
use crate::agent::{GoalId, Status};
use crate::halo::{Agreement, Halo};
use crate::parallel;
use crate::perceive::{Nearby, Neighbours, SubStep};
use crate::sleep::SleepBlocks;
use crate::world::{EventKind, State};
use glam::{DVec2, DVec3, Vec2};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// What planning reads.
#[derive(Clone, Copy)]
pub(super) struct Planning<'a> {
    pub state: &'a State,
    pub nearby: Nearby<'a>,
    pub arrivals: &'a Arrivals,
}

impl Navigate {
    /// Updates the paths of all agents: the point to head for and the remaining distance. Publishes them for their
    /// neighbours.
    pub(super) fn plan(
        &mut self,
        state: &mut State,
        near: &Neighbours,
        sleep: &SleepBlocks,
        halo: &mut dyn Halo,
        SubStep { seconds, now, .. }: SubStep,
    ) {
        let Self { shown, arrivals, .. } = self;
        shown.resize(state.agents.len(), NeighbourData::default());
        let (any_lost, changes) = state.with_travel(|state, travels| {
            let planning = Planning::new(state, near, arrivals);
            planning.plan(sleep, travels, shown, seconds)
        });
        // an agent that plans may find that it has arrived
        self.any_may_change = changes || any_lost;
        if any_lost || state.others.are_there && state.is_open_with_walls() {
            self.find_lost(state, near, halo, (seconds, now));
        }
    }

    /// Finds paths for the agents that have none.
    fn find_lost(&mut self, state: &mut State, near: &Neighbours, halo: &mut dyn Halo, (seconds, now): (f32, f64)) {
        let Self { shown, arrivals, .. } = self;
        let agents = &state.agents;
        let is_lost =
            |&row: &usize| shown[row].way.walks() && shown[row].way.has_goal() && !agents.travel[row].has_way();
        let lost = state.own().filter(is_lost);
        let mut lost: Vec<PathRequest> = lost.filter_map(|row| state.ask_way(row, agents.travel[row].leg)).collect();
        state.prepare_meshes(&lost, halo);
        if lost.is_empty() {
            return;
        }
        state.meshes.find(&state.goals, &mut lost);
        for asked in lost {
            let row = asked.row;
            let found = match asked.found {
                Some(Ok((path, gap))) => {
                    shown[row].way = state.with_travel(|state, travels| {
                        let planning = Planning::new(state, near, arrivals);
                        planning.take_way(row, &mut travels[row], (asked.goal, &path, gap), seconds)
                    });
                    Ok(path.length)
                }
                Some(Err(why)) => Err(why),
                None => continue,
            };
            match found {
                Ok(_) if state.agents.travel[row].measured => state.happened(row, EventKind::Replanned, now),
                Ok(length) => {
                    let travel = &mut state.agents.travel[row];
                    travel.measured = true;
                    state.agents.shortest[row] += DVec2::new(length, travel.rise().into()).length();
                }
                Err(why) => {
                    state.agents.status[row] = Status::Stranded;
                    state.happened(row, EventKind::Stranded, now);
                    if row < state.own().end {
                        state.stranded.push((state.agents.number[row], why));
                    }
                    shown[row].way = state.with_travel(|state, travels| {
                        let planning = Planning::new(state, near, arrivals);
                        planning.look(row, &mut travels[row], seconds)
                    });
                }
            }
        }
        state.stranded.sort_by_key(|&(number, _)| number);
    }
}

impl<'a> Planning<'a> {
    pub fn new(state: &'a State, near: &'a Neighbours, arrivals: &'a Arrivals) -> Self {
        Self { state, nearby: Nearby { state, near }, arrivals }
    }

    /// Updates the paths of all agents that do not sleep. Returns whether any agent has lost its path, and whether the
    /// status of any agent may change.
    fn plan(
        &self,
        sleep: &SleepBlocks,
        travels: &mut [RouteProgress],
        shown: &mut [NeighbourData],
        seconds: f32,
    ) -> (bool, bool) {
        let level = self.state.instructions.level();
        let (any_lost, changes) = (AtomicBool::new(false), AtomicBool::new(false));
        parallel::ranges((travels, shown), |rows, both| {
            let (mut lost, mut change) = (false, false);
            let mut look = |row: usize, travel: &mut RouteProgress| {
                let way = self.look(row, travel, seconds);
                lost |= way.walks() && way.has_goal() && !travel.has_way();
                change |= way.may_change();
                way
            };
            let mut near = false;
            sleep.each(rows, both, |rows, (travels, shown)| match level {
                Some(level) => near |= self.look_many(level, rows, travels, shown, seconds, &mut look),
                None => rows.zip(travels).zip(shown).for_each(|((row, travel), shown)| {
                    let agents = &self.state.agents;
                    *shown = NeighbourData::new(agents.position[row], agents.velocity[row], look(row, travel));
                }),
            });
            if lost {
                any_lost.store(true, Ordering::Relaxed);
            }
            if change || near {
                changes.store(true, Ordering::Relaxed);
            }
        });
        (any_lost.into_inner(), changes.into_inner())
    }

    /// Updates an agent's position on its path, and returns what its neighbours know of it. A path that is no longer
    /// valid is given up.
    fn look(&self, row: usize, travel: &mut RouteProgress, seconds: f32) -> NavFlags {
        let leg = self.state.legs.of(self.state.agents.journey[row], travel.leg);
        if leg.is_none() && self.state.agents.status[row] == Status::Walking {
            // a steered agent needs no path
            return NavFlags::walking(None, self.state.agents.velocity[row].normalize_or_zero(), 0.0);
        }
        let at = self.state.world_position(row);
        let straight = travel.is_straight();
        let mut towards = leg.map_or(-at, |leg| leg.middle - at).as_vec2();
        let distance = towards.length();
        let mut along = distance;
        if !straight {
            along = self.state.follow(row, travel, at).unwrap_or(along);
            towards = travel.aim().map_or(towards, |aim| (aim - at).as_vec2());
        }
        if straight || travel.has_way() {
            let altitude = leg.filter(|_| travel.turn != Turn::Aside).and_then(|leg| leg.altitude);
            travel.set_rise(altitude.map_or(0.0, |altitude| (altitude - self.state.world_place(row).z) as f32), along);
        }
        let (id, remaining) = (leg.map(|leg| leg.goal), travel.distance(along));
        let status = self.state.agents.status[row];
        if status != Status::Walking {
            let comes = status == Status::Arrived && self.state.agents.arrived[row].is_infinite();
            let moves = || self.nearby.is_out_of_place(row, travel) || self.nearby.wants_place(row, travel, seconds);
            let changes = comes || status == Status::Waiting || status == Status::Arrived && moves();
            return NavFlags::at_rest(id, remaining).changing(changes);
        }
        let waits = travel.turn == Turn::Aside && along < self.state.agents.radius[row];
        let direction = if waits { Vec2::ZERO } else { towards.normalize_or_zero() };
        let tolerance = leg.and_then(|leg| leg.tolerance);
        let stops = tolerance.is_some() && leg.is_some_and(|leg| leg.is_last);
        // no agent has arrived there yet, and the goal is farther than the agent can get in this sub-step
        let counts = |leg: &Leg| leg.reach + travel.gap() + GAP_TOLERANCE as f32;
        let is_far = |leg: &Leg| distance * 0.9999 > counts(leg) + self.state.agents.max_speed[row] * seconds * 1.01;
        let taken = id.is_some_and(|id| self.arrivals.at(id) > 0);
        let may_arrive = taken || travel.waits_for_room() || !leg.is_some_and(is_far);
        let is_plain = travel.is_plain() && tolerance.is_some();
        NavFlags::walking(id, direction, remaining).stopping(stops).changing(may_arrive).plain(is_plain)
    }

    /// Gives an agent a path to a goal, with the gap within which it counts as arrived, and updates its position on the
    /// path.
    pub fn take_way(
        &self,
        row: usize,
        travel: &mut RouteProgress,
        (goal, path, gap): (GoalId, &Path, f64),
        seconds: f32,
    ) -> NavFlags {
        travel.set_way((!self.state.is_straight(row, goal)).then(|| Route::new(path)));
        travel.set_gap(gap as f32);
        self.look(row, travel, seconds)
    }
}

impl State {
    /// Advances an agent along its route. Returns the remaining length of the route, metres; `None` if the route is
    /// lost.
    fn follow(&self, row: usize, travel: &mut RouteProgress, at: DVec2) -> Option<f32> {
        let leg = travel.leg;
        let route = travel.route_mut()?;
        let clearance_radius = self.agents.body(row).clearance_radius();
        let heading = match self.meshes.mesh(clearance_radius) {
            Some(mesh) if self.local_groups[self.agents.group[row].index()].look_ahead => {
                let area = || self.passed_area(row, leg);
                let off = |across| self.off_walls(row, across) - f64::from(clearance_radius);
                route.advance_in_place(mesh, at, area, off)
            }
            Some(mesh) => route.advance(mesh, at),
            None => route.end().map_or(Heading::Lost, Heading::End),
        };
        let remaining = route.remaining(at) as f32;
        if let Heading::Corner(aim) | Heading::End(aim) = heading {
            travel.set_aim(aim);
            Some(remaining)
        } else {
            travel.lose_way();
            // an agent that goes first keeps the right of way
            if travel.turn != Turn::First {
                travel.give_up_turn();
            }
            None
        }
    }

    /// Returns the area of a stop that an agent only enters: it leaves the world there or walks on. Where it stays, its
    /// path leads to its place instead.
    fn passed_area(&self, row: usize, leg: u32) -> Option<&[DVec2]> {
        let goal = |leg: &Leg| &self.goals[leg.goal.index()];
        let leg = self.legs.of(self.agents.journey[row], leg)?;
        let passes = !leg.is_last || matches!(goal(leg), Goal::Exit { .. });
        goal(leg).corners().filter(|_| passes)
    }

    /// Returns the distance of an agent from the walls on one side of its path, metres: the side opposite to `across`.
    fn off_walls(&self, row: usize, across: DVec2) -> f64 {
        let at = self.agents.position[row].as_dvec2();
        let mut nearest = f64::INFINITY;
        self.walls.visit(at, 2.0, |wall| {
            if let (distance, Some(off)) = wall.off(at)
                && off.dot(across) > 0.0
            {
                nearest = nearest.min(distance);
            }
        });
        nearest
    }

    /// Returns the request of a path to a stop; `None` if there is no such stop.
    pub(crate) fn ask_way(&self, row: usize, leg: u32) -> Option<PathRequest> {
        Some(self.ask_way_to(row, self.stop(row, leg)?.goal))
    }

    /// Returns the request of a path to a goal.
    pub(crate) fn ask_way_to(&self, row: usize, goal: GoalId) -> PathRequest {
        let (radius, from) = (self.agents.body(row).clearance_radius(), self.world_position(row));
        PathRequest { row, radius, from, goal, found: None }
    }

    /// Whether nothing can block the straight line to a goal: it is a point, and there are no walls.
    fn is_straight(&self, row: usize, goal: GoalId) -> bool {
        self.goals[goal.index()].corners().is_none()
            && self.meshes.mesh(self.agents.body(row).clearance_radius()).is_none()
    }

    /// Builds the meshes for requested paths, on ground that contains their starts and ends. Worlds of a division without a
    /// walkable area call it together, because the ground depends on all agents.
    pub(crate) fn prepare_meshes(&mut self, asked: &[PathRequest], halo: &mut dyn Halo) {
        let is_open = self.others.are_there && self.is_open_with_walls();
        if self.walls.is_empty() || asked.is_empty() && !is_open {
            return;
        }
        let holds = |(low, high): (DVec2, DVec2), p: DVec2| p.cmpge(low).all() && p.cmple(high).all();
        let on_ground = |p: DVec2| self.extent.is_some_and(|extent| holds(extent, p));
        let held =
            asked.iter().all(|asked| on_ground(asked.from) && on_ground(self.goals[asked.goal.index()].middle()));
        let mut all = Agreement { any: !held, ..Agreement::default() };
        if !held || is_open {
            (all.low, all.high) = self.box_of_agents();
        }
        if is_open {
            all = halo.agree(all);
        }
        if all.any {
            self.extent = Some(self.new_extent((all.low.into(), all.high.into())));
            self.meshes = Meshes::default();
            self.prepare_all_meshes();
        }
        self.prepare_meshes_for(asked.iter().map(|asked| (asked.radius, asked.goal)));
    }

    /// Builds the meshes of all agents that have a path or need one.
    pub(crate) fn prepare_all_meshes(&mut self) {
        let needs: Vec<_> = self.own().filter_map(|row| self.mesh_need(row)).collect();
        self.prepare_meshes_for(needs.into_iter());
    }

    /// Builds the meshes that these rows need, which have come from other worlds with their routes.
    pub(crate) fn prepare_meshes_of(&mut self, rows: Range<usize>) {
        if self.walls.is_empty() || rows.is_empty() {
            return;
        }
        if self.extent.is_none() && !self.is_open_with_walls() {
            // where a walkable area bounds the ground, any box will do
            self.extent = Some((DVec2::ZERO, DVec2::ZERO));
        }
        self.prepare_meshes_for(rows.filter_map(|row| self.mesh_need(row)).collect::<Vec<_>>().into_iter());
    }

    /// Returns the radius and the goal of an agent that has a path or needs one.
    fn mesh_need(&self, row: usize) -> Option<(f32, GoalId)> {
        let needs = self.agents.status[row] == Status::Walking || self.agents.travel[row].has_way();
        let stop = self.stop(row, self.agents.travel[row].leg).filter(|_| needs)?;
        Some((self.agents.body(row).clearance_radius(), stop.goal))
    }

    /// Builds the meshes for bodies of these radii on their way to these goals.
    fn prepare_meshes_for(&mut self, needs: impl Iterator<Item = (f32, GoalId)>) {
        if let Some(extent) = self.extent {
            self.meshes.prepare(needs, &self.place, &self.goals, extent);
        }
    }

    /// Returns the lower and upper ends of a box around the agents of this world.
    fn box_of_agents(&self) -> ([f64; 2], [f64; 2]) {
        let ends = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = self.own().map(|row| self.world_position(row)).fold(ends, |(l, h), p| (l.min(p), h.max(p)));
        (low.into(), high.into())
    }

    /// Returns a box around a box of all agents, all goals and the previous box, with a margin for detours and pushed
    /// agents.
    fn new_extent(&self, agents: (DVec2, DVec2)) -> (DVec2, DVec2) {
        let (low, high) = self.goals.iter().map(Goal::middle).fold(agents, |(l, h), p| (l.min(p), h.max(p)));
        let around = DVec2::splat(10.0 + (high - low).max_element() * 0.5);
        let (low, high) = (low - around, high + around);
        self.extent.map_or((low, high), |(l, h)| (l.min(low), h.max(high)))
    }

    pub(crate) fn world_position(&self, row: usize) -> DVec2 {
        self.agents.position[row].as_dvec2() + self.settings.origin
    }

    /// Returns the centre of an agent in space, world coordinates.
    pub(crate) fn world_place(&self, row: usize) -> DVec3 {
        self.agents.center(row) + self.settings.origin.extend(0.0)
    }
}

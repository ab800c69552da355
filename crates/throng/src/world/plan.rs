//! Planning ways: for those who have none, and for those whose way no longer holds. Everybody else keeps theirs.

use super::World;
use super::arrive::GAP_TOLERANCE;
use super::build::direction;
use super::way::{Shown, Way};
use crate::agent::{AgentId, GoalId, Status};
use crate::navigate::{Asked, Goal, Heading, Leg, Meshes, Path, Route, Travel, Turn};
use crate::parallel;
use glam::{DVec2, DVec3, Vec2};
use std::sync::atomic::{AtomicBool, Ordering};

impl World {
    /// Brings everybody's way up to date: what to head for, and how far it still is; and notes it for others to see.
    pub(super) fn plan(&mut self, seconds: f32) {
        self.count_arrivals();
        let mut travels = std::mem::take(&mut self.agents.travel);
        let mut shown = std::mem::take(&mut self.step.shown);
        shown.resize(travels.len(), Shown::default());
        let world = &*self;
        let level = self.instructions.level();
        let (anybody, changes) = (AtomicBool::new(false), AtomicBool::new(false));
        parallel::ranges((&mut travels[..], &mut shown[..]), |rows, both| {
            let (mut lost, mut change) = (false, false);
            let mut look = |row: usize, travel: &mut Travel| {
                let way = world.look(row, travel, seconds);
                lost |= way.walks() && way.has_goal() && !travel.has_way();
                change |= way.may_change();
                way
            };
            let mut near = false;
            world.step.rest.each(rows, both, |rows, (travels, shown)| match level {
                Some(level) => near |= world.look_many(level, rows, travels, shown, seconds, &mut look),
                None => rows.zip(travels).zip(shown).for_each(|((row, travel), shown)| {
                    let agents = &world.agents;
                    *shown = Shown::new(agents.position[row], agents.velocity[row], look(row, travel));
                }),
            });
            if lost {
                anybody.store(true, Ordering::Relaxed);
            }
            if change || near {
                changes.store(true, Ordering::Relaxed);
            }
        });
        let anybody = anybody.into_inner();
        // who plans may find itself there
        self.step.anybody_may_change = changes.into_inner() || anybody;
        let rows = if anybody { 0..travels.len() } else { 0..0 };
        let mut lost: Vec<Asked> = rows
            .filter(|&row| shown[row].way.walks() && shown[row].way.has_goal() && !travels[row].has_way())
            .filter_map(|row| self.ask_way(row, travels[row].leg))
            .collect();
        if !lost.is_empty() {
            self.agents.travel = travels;
            self.prepare_meshes(&lost);
            travels = std::mem::take(&mut self.agents.travel);
            self.meshes.find(&self.goals, &mut lost);
            for asked in lost {
                let row = asked.row;
                let travel = &mut travels[row];
                match asked.found {
                    Some(Ok((path, gap))) => {
                        let length = path.length;
                        shown[row].way = self.take_way(row, travel, (asked.goal, &path, gap), seconds);
                        if !travel.measured {
                            travel.measured = true;
                            self.agents.shortest[row] += DVec2::new(length, travel.rise().into()).length();
                        }
                    }
                    Some(Err(why)) => {
                        self.agents.status[row] = Status::Stranded;
                        self.stranded.push((self.agents.number[row], why));
                        shown[row].way = self.look(row, travel, seconds);
                    }
                    None => {}
                }
            }
            self.stranded.sort_by_key(|&(number, _)| number);
        }
        self.agents.travel = travels;
        self.step.shown = shown;
    }

    /// Turns agents to where their ways begin: round walls to the first corner, else straight to the goal. Those who
    /// are gone, have nowhere to go, or cannot get there, keep their headings, and so do bodies that are no discs: turned
    /// they might not fit. Meant for the start: agents that were added without a heading face their goals, even through
    /// walls.
    pub fn face_ways(&mut self, agents: &[AgentId]) {
        let leg = |row: usize| self.first_leg(self.agents.journey[row], self.world_place(row));
        let rows = agents.iter().filter_map(|&id| self.row(id)).filter(|&row| self.agents.is_disc(row));
        let mut ways: Vec<Asked> = rows.filter_map(|row| self.ask_way(row, leg(row)?)).collect();
        self.prepare_meshes(&ways);
        self.meshes.find(&self.goals, &mut ways);
        for way in ways {
            let Some(Ok((path, _))) = way.found else { continue };
            if let Some(heading) = path.corners.iter().find_map(|&corner| direction(corner - way.from)) {
                self.agents.heading[way.row] = heading;
            }
        }
    }

    /// Lets an agent look where it is on its way, and tells what others see of it; a way that no longer holds is given
    /// up.
    fn look(&self, row: usize, travel: &mut Travel, seconds: f32) -> Way {
        let leg = self.legs.of(self.agents.journey[row], travel.leg);
        if leg.is_none() && self.agents.status[row] == Status::Walking {
            // who steers needs no way
            return Way::walking(None, self.agents.velocity[row].normalize_or_zero(), 0.0);
        }
        let at = self.world_position(row);
        let straight = travel.is_straight();
        let mut towards = leg.map_or(-at, |leg| leg.middle - at).as_vec2();
        let distance = towards.length();
        let mut along = distance;
        if !straight {
            along = self.follow(row, travel, at).unwrap_or(along);
            towards = travel.aim().map_or(towards, |aim| (aim - at).as_vec2());
        }
        if straight || travel.has_way() {
            let altitude = leg.filter(|_| travel.turn != Turn::Aside).and_then(|leg| leg.altitude);
            travel.set_rise(altitude.map_or(0.0, |altitude| (altitude - self.world_place(row).z) as f32), along);
        }
        let (id, remaining) = (leg.map(|leg| leg.goal), travel.distance(along));
        let status = self.agents.status[row];
        if status != Status::Walking {
            let comes = status == Status::Arrived && self.agents.arrived[row].is_infinite();
            let moves = || self.is_out_of_place(row, travel) || self.wants_place(row, travel, seconds);
            let changes = comes || status == Status::Waiting || status == Status::Arrived && moves();
            return Way::at_rest(id, remaining).changing(changes);
        }
        let waits = travel.turn == Turn::Aside && along < self.agents.radius[row];
        let direction = if waits { Vec2::ZERO } else { towards.normalize_or_zero() };
        let tolerance = leg.and_then(|leg| leg.tolerance);
        let stops = tolerance.is_some() && leg.is_some_and(|leg| leg.is_last);
        // with nobody there yet, who is farther than it can get
        let counts = |leg: &Leg| leg.reach + travel.gap() + GAP_TOLERANCE as f32;
        let is_far = |leg: &Leg| distance * 0.9999 > counts(leg) + self.agents.max_speed[row] * seconds * 1.01;
        let taken = id.is_some_and(|id| self.step.arrivals[id.index()] > 0);
        let may_arrive = taken || travel.waits_for_room() || !leg.is_some_and(is_far);
        let is_plain = travel.is_plain() && tolerance.is_some();
        Way::walking(id, direction, remaining).stopping(stops).changing(may_arrive).plain(is_plain)
    }

    /// Lets an agent take a path that was found to a goal, and how near counts as there, and look where it is on it.
    pub(super) fn take_way(
        &self,
        row: usize,
        travel: &mut Travel,
        (goal, path, gap): (GoalId, &Path, f64),
        seconds: f32,
    ) -> Way {
        travel.set_way((!self.is_straight(row, goal)).then(|| Route::new(path)));
        travel.set_gap(gap as f32);
        self.look(row, travel, seconds)
    }

    /// Moves on along a route; tells how many metres of it are ahead.
    fn follow(&self, row: usize, travel: &mut Travel, at: DVec2) -> Option<f32> {
        let leg = travel.leg;
        let route = travel.route_mut()?;
        let girth = self.agents.body(row).girth();
        let heading = match self.meshes.mesh(girth) {
            Some(mesh) if self.groups[self.agents.group[row].index()].look_ahead => {
                let area = self.passed_area(row, leg);
                route.advance_in_place(mesh, at, area, |across| self.off_walls(row, across) - f64::from(girth))
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
            // whoever goes first goes on doing so
            if travel.turn != Turn::First {
                travel.give_up_turn();
            }
            None
        }
    }

    /// The area of a stop that an agent only enters: it leaves there, or goes on. Where it stays, its way leads to its place.
    fn passed_area(&self, row: usize, leg: u32) -> Option<&[DVec2]> {
        let goal = |leg: &Leg| &self.goals[leg.goal.index()];
        let leg = self.legs.of(self.agents.journey[row], leg)?;
        let passes = !leg.is_last || matches!(goal(leg), Goal::Exit { .. });
        goal(leg).corners().filter(|_| passes)
    }

    /// How far the walls are from an agent that lie on one side of its way, metres: on the other side than `across`.
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

    /// Asks for a way to a stop; `None` if there is none.
    fn ask_way(&self, row: usize, leg: u32) -> Option<Asked> {
        Some(self.ask_way_to(row, self.stop(row, leg)?.goal))
    }

    /// Asks for a way to a goal.
    pub(super) fn ask_way_to(&self, row: usize, goal: GoalId) -> Asked {
        let (radius, from) = (self.agents.body(row).girth(), self.world_position(row));
        Asked { row, radius, from, goal, found: None }
    }

    /// Whether nothing can be in the way: in the open, to a point.
    fn is_straight(&self, row: usize, goal: GoalId) -> bool {
        self.goals[goal.index()].corners().is_none() && self.meshes.mesh(self.agents.body(row).girth()).is_none()
    }

    /// Makes the meshes for paths that are asked for, on ground that holds where they begin and end.
    pub(super) fn prepare_meshes(&mut self, asked: &[Asked]) {
        if self.walls.is_empty() {
            return;
        }
        let holds = |(low, high): (DVec2, DVec2), p: DVec2| p.cmpge(low).all() && p.cmple(high).all();
        let on_ground = |p: DVec2| self.extent.is_some_and(|extent| holds(extent, p));
        let held =
            asked.iter().all(|asked| on_ground(asked.from) && on_ground(self.goals[asked.goal.index()].middle()));
        if !held {
            self.extent = Some(self.new_extent());
            self.meshes = Meshes::default();
            self.prepare_all_meshes();
        }
        self.prepare_meshes_for(asked.iter().map(|asked| (asked.radius, asked.goal)));
    }

    /// Makes the meshes of everybody who has a way, or needs one.
    pub(super) fn prepare_all_meshes(&mut self) {
        let needs = |&row: &usize| self.agents.status[row] == Status::Walking || self.agents.travel[row].has_way();
        let need = |row: usize| {
            let stop = self.stop(row, self.agents.travel[row].leg)?;
            Some((self.agents.body(row).girth(), stop.goal))
        };
        let needs: Vec<_> = (0..self.agents.len()).filter(needs).filter_map(need).collect();
        self.prepare_meshes_for(needs.into_iter());
    }

    /// Makes the meshes for bodies of these radii on their way to these goals.
    fn prepare_meshes_for(&mut self, needs: impl Iterator<Item = (f32, GoalId)>) {
        if let Some(extent) = self.extent {
            self.meshes.prepare(needs, &self.place, &self.goals, extent);
        }
    }

    /// A box round everybody, all goals and what there was before, with room to go round, and to be pushed about.
    fn new_extent(&self) -> (DVec2, DVec2) {
        let points =
            self.goals.iter().map(Goal::middle).chain((0..self.agents.len()).map(|row| self.world_position(row)));
        let (low, high) = points.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
        let around = DVec2::splat(10.0 + (high - low).max_element() * 0.5);
        let (low, high) = (low - around, high + around);
        self.extent.map_or((low, high), |(l, h)| (l.min(low), h.max(high)))
    }

    pub(super) fn world_position(&self, row: usize) -> DVec2 {
        self.agents.position[row].as_dvec2() + self.settings.origin
    }

    /// Where an agent is, and how high.
    pub(super) fn world_place(&self, row: usize) -> DVec3 {
        self.agents.center(row) + self.settings.origin.extend(0.0)
    }
}

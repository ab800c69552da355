//! Agreement on the right of way: of two sides, the side that costs the other side the shorter retreat goes first.

use crate::agent::Status;
use crate::navigate::{Path, Refuge, Route, Turn};
use crate::perceive::Grid;
use crate::space::{Disc, nearest_on_segment};
use crate::world::State;
use glam::DVec2;
use std::cmp::Ordering;

/// Greatest number of agents in an agreement. More agents in each other's way are a crowd.
const MOST: usize = 10;
/// Distance, in radii, from one agent of an agreement to the next.
const REACH: f32 = 15.0;
/// Distance, in greatest radii, from an agent that looks for a partner, or from its partner, within which an agreement
/// reads other agents: from one member to the next. It is more than the distance up to which standing agents are
/// considered.
pub(crate) const STANDOFF_REACH: f32 = MOST as f32 * REACH;
/// Length of path that an agent looks ahead, in radii.
const AHEAD: f64 = 50.0;
/// Distance, in radii, up to which standing agents are considered.
const AROUND: f32 = 80.0;
/// Distance that a waiting agent keeps from the paths of the other agents, in sums of radii.
const CLEAR: f64 = 1.15;

/// Free width that an agent needs beside its own body to pass another agent, divided by the width of the other agent;
/// and the number of parts in which the width is measured.
const NARROW: f64 = 1.05;
const PARTS: f64 = 8.0;
/// Cosine of the angle within which two agents go the same way.
const SAME_WAY: f64 = 0.3;

/// An agreement. `first`: the agents that go first, with the distance left to the goal once they have passed the agents
/// that stepped aside. `aside`: the agents that step aside, with their paths to where they wait.
pub(crate) struct StandoffAgreement {
    pub first: Vec<(usize, f32)>,
    pub aside: Vec<(usize, Path)>,
}

/// A path, and the radius of the agent that follows it.
type StandoffLane = (Vec<DVec2>, f64);

/// What agents that agree know of each other.
#[derive(Clone, Copy)]
pub(crate) struct StandoffView<'a> {
    pub state: &'a State,
    /// The agents, or those of `rows`.
    pub grid: &'a Grid,
    /// The rows that the points of the grid have, if they are not all rows.
    pub rows: Option<&'a [u32]>,
    /// Returns the distance to the goal, metres, that an agent has left.
    pub remaining: &'a dyn Fn(usize) -> f32,
}

impl StandoffView<'_> {
    /// Returns the agreement of two stuck agents and the agents around them; `None` if no agent can step aside.
    pub fn agree(&self, row: usize, other: usize) -> Option<StandoffAgreement> {
        let agents = &self.state.agents;
        let (one, two) = match (self.proposal(row, other), self.proposal(other, row)) {
            (Some(one), Some(two)) => (one, two),
            (one, two) => return one.or(two),
        };
        let priority = |side: &StandoffAgreement| {
            side.first.iter().map(|&(row, _)| agents.priority[row]).fold(f32::NEG_INFINITY, f32::max)
        };
        let cost = |side: &StandoffAgreement| side.aside.iter().map(|(_, path)| path.length).sum::<f64>();
        let saved = cost(&two) - cost(&one);
        let remaining = self.remaining;
        // equal retreats differ by rounding
        let saved = if saved.abs() > f64::from(agents.radius[row]) { saved } else { 0.0 };
        let order = priority(&two)
            .total_cmp(&priority(&one))
            .then(0.0_f64.partial_cmp(&saved).unwrap_or(Ordering::Equal))
            .then(remaining(row).total_cmp(&remaining(other)))
            .then(agents.number[row].cmp(&agents.number[other]));
        Some(if order.is_lt() { one } else { two })
    }

    /// Returns the agreement in which `leader` and the agents on its side go first.
    fn proposal(&self, leader: usize, other: usize) -> Option<StandoffAgreement> {
        let (first, mut aside) = self.sides(leader, other)?;
        let mut ground = StandoffGround::new(*self, &first, &[]);
        self.state.nearest_first(&mut aside, &first);
        let aside: Option<Vec<_>> = aside.iter().map(|&row| Some((row, ground.retreat(row)?))).collect();
        let aside = aside?;
        let first = first.iter().map(|&row| (row, ground.past(row, &aside))).collect();
        Some(StandoffAgreement { first, aside })
    }

    /// Returns the agents that come towards the agents of `first`, with their paths to where they wait. `aside` are the
    /// agents that have already stepped aside.
    pub fn newcomers(&self, first: &[usize], aside: &[usize]) -> Vec<(usize, Path)> {
        let mut near = self.near(first);
        near.retain(|&row| first.iter().any(|&other| self.state.opposed(row, other)));
        if near.is_empty() {
            return Vec::new();
        }
        let mut ground = StandoffGround::new(*self, first, aside);
        near.iter().filter_map(|&row| Some((row, ground.retreat(row)?))).collect()
    }

    /// Returns the two sides. Agents in the way of the first side step aside; agents in the way of the second side go
    /// first. `None` if more than [`MOST`] agents are involved.
    fn sides(&self, leader: usize, other: usize) -> Option<(Vec<usize>, Vec<usize>)> {
        let (mut first, mut aside) = (vec![leader], vec![other]);
        loop {
            let mut members = first.clone();
            members.extend(&aside);
            let mut near = self.near(&members);
            near.retain(|row| !members.contains(row));
            let blocks = |side: &[usize], row: usize| side.iter().any(|&other| self.state.opposed(row, other));
            let next = near.into_iter().find_map(|row| {
                let steps_aside = blocks(&first, row);
                (steps_aside || blocks(&aside, row)).then_some((row, steps_aside))
            });
            match next {
                None => return Some((first, aside)),
                Some(_) if members.len() == MOST => return None,
                Some((row, true)) => aside.push(row),
                Some((row, false)) => first.push(row),
            }
        }
    }

    /// Returns the agents that could agree with any of `rows`, nearest first.
    fn near(&self, rows: &[usize]) -> Vec<usize> {
        let mut near = Vec::new();
        for &row in rows {
            let reach = REACH * self.state.agents.radius[row];
            self.within(row, reach, |other| near.push(other));
        }
        near.sort_unstable();
        near.dedup();
        near.retain(|&row| self.state.may_resolve(row));
        self.state.nearest_first(&mut near, rows);
        near
    }

    /// Calls `found` for all agents within a distance of an agent, metres.
    fn within(&self, row: usize, distance: f32, mut found: impl FnMut(usize)) {
        self.grid.within(self.state.agents.position[row], distance, |near| {
            found(self.rows.map_or(near.row, |rows| rows[near.row as usize]) as usize);
        });
    }
}

impl State {
    /// Whether each of two agents blocks the path of the other and follows a different path.
    pub(crate) fn opposed(&self, row: usize, other: usize) -> bool {
        let touch = f64::from(self.agents.radius[row]) + f64::from(self.agents.radius[other]);
        let (mine, theirs) = (self.lane(row).0, self.lane(other).0);
        // beyond the other agent, the path leads another way than the path of the other agent
        let blocks = |way: &[DVec2], by: &[DVec2]| {
            let (distance, along) = nearest(way, by[0]);
            let next = |way: &[DVec2], from: f64| (at(way, from + 2.0 * touch) - at(way, from)).normalize_or_zero();
            distance < touch && next(way, along).dot(next(by, 0.0)) < SAME_WAY
        };
        self.goal_of(row) != self.goal_of(other) && blocks(&mine, &theirs) && blocks(&theirs, &mine)
    }

    /// Whether the path of an agent is too narrow, somewhere before the other agent, for the two side by side.
    pub(crate) fn is_narrow(&self, row: usize, other: usize) -> bool {
        let Some(mesh) = self.meshes.mesh(self.agents.body(row).clearance_radius()) else { return false };
        let (lane, radius) = self.lane(row);
        let need = 2.0 * f64::from(self.agents.radius[other]) * NARROW;
        let mut left = self.world_position(other).distance(lane[0]);
        for leg in lane.windows(2) {
            let length = leg[0].distance(leg[1]);
            let across = (leg[1] - leg[0]).perp() / length.max(1e-9);
            let parts = (length.min(left) / radius).ceil() as usize;
            for part in 0..=parts {
                let at = mesh.nearest(leg[0].lerp(leg[1], (part as f64 * radius / length).min(1.0)));
                let seen = |k: f64| mesh.visible(at, at + across * (need * k / PARTS));
                let free = |side: f64| (1..PARTS as usize).take_while(|&k| seen(side * k as f64)).count();
                if !seen(PARTS) && !seen(-PARTS) && free(1.0) + free(-1.0) < PARTS as usize {
                    return true;
                }
            }
            left -= length;
            if left <= 0.0 {
                break;
            }
        }
        false
    }

    /// Sorts rows by the distance to the nearest of `others`, ties by number.
    fn nearest_first(&self, rows: &mut [usize], others: &[usize]) {
        let agents = &self.agents;
        let distance = |row: usize| {
            let all = others.iter().map(|&other| agents.position[row].distance(agents.position[other]));
            all.fold(f32::INFINITY, f32::min)
        };
        rows.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(agents.number[a].cmp(&agents.number[b])));
    }

    /// Returns the path of an agent, as far as it looks ahead.
    fn lane(&self, row: usize) -> StandoffLane {
        let radius = f64::from(self.agents.radius[row]);
        let travel = &self.agents.travel[row];
        let straight = self.goal_middle(row, travel.leg).filter(|_| travel.is_straight());
        let mut points = vec![self.world_position(row)];
        let mut left = AHEAD * radius;
        for corner in travel.route().into_iter().flat_map(Route::corners).chain(straight) {
            let last = points[points.len() - 1];
            let length = last.distance(corner);
            points.push(if length > left { last.lerp(corner, left / length) } else { corner });
            left -= length;
            if left <= 0.0 {
                break;
            }
        }
        (points, radius)
    }
}

/// What agents that step aside keep clear of.
struct StandoffGround<'a> {
    view: StandoffView<'a>,
    middle: DVec2,
    /// One refuge search for each mesh, and so for each size of body.
    refuges: Vec<Refuge<'a>>,
    lanes: Vec<StandoffLane>,
    /// Bodies that no retreating agent can pass: standing agents, and the agents that go first.
    bodies: Vec<(DVec2, f64)>,
    /// Points where agents that go first will stay.
    ends: Vec<(DVec2, f64)>,
}

impl<'a> StandoffGround<'a> {
    fn new(view: StandoffView<'a>, first: &[usize], aside: &[usize]) -> Self {
        let state = view.state;
        let agents = &state.agents;
        let radius = |row: usize| f64::from(agents.radius[row]);
        let mut bodies: Vec<_> = first.iter().map(|&row| (state.world_position(row), radius(row))).collect();
        let around = AROUND * agents.radius[first[0]];
        view.within(first[0], around, |row| {
            let rests = agents.status[row] != Status::Walking || agents.travel[row].turn == Turn::Aside;
            if rests && agents.avoids(first[0], row) && !agents.passes_clear(first[0], row) && !aside.contains(&row) {
                bodies.push((state.world_position(row), radius(row)));
            }
        });
        let stays = |&&row: &&usize| {
            let point = state.goal_of(row).is_some_and(|goal| state.goals[goal.index()].corners().is_none());
            point && state.legs.of(agents.journey[row], agents.travel[row].leg).is_some_and(|leg| leg.is_last)
        };
        let end = |row: usize| agents.travel[row].route_to_stop().and_then(Route::end);
        let ends = first.iter().filter(stays).filter_map(|&row| Some((end(row)?, radius(row)))).collect();
        let lanes = first.iter().chain(aside).map(|&row| state.lane(row)).collect();
        let middle = state.world_position(first[0]);
        Self { view, middle, refuges: Vec::new(), lanes, bodies, ends }
    }

    /// Returns the path of an agent to where it waits, a place from which it can continue when the other agents have
    /// passed.
    fn retreat(&mut self, row: usize) -> Option<Path> {
        let state = self.view.state;
        let radius = f64::from(state.agents.radius[row]);
        let mesh = state.meshes.mesh(state.agents.body(row).clearance_radius())?;
        let known = self.refuges.iter().position(|refuge| std::ptr::eq(refuge.mesh(), mesh));
        let at = known.unwrap_or_else(|| {
            self.refuges.push(Refuge::new(mesh, self.middle));
            self.refuges.len() - 1
        });
        let refuge = &mut self.refuges[at];
        let discs = |bodies: &[(DVec2, f64)]| -> Vec<Disc> {
            bodies.iter().map(|&(center, size)| Disc { center, radius: size + radius }).collect()
        };
        let blocked = discs(&self.bodies);
        let path = refuge.nearest(state.world_position(row), &blocked, |p| {
            self.lanes.iter().all(|(lane, size)| apart(lane, p) >= CLEAR * (size + radius))
                && blocked.iter().all(|disc| p.distance(disc.center) >= disc.radius)
        })?;
        let (lane, _) = state.lane(row);
        let (spot, end) = (*path.corners.last()?, *lane.last()?);
        if !self.ends.is_empty() {
            let near = 2.0 * radius;
            refuge.nearest(spot, &discs(&self.ends), |p| p.distance(end) <= near)?;
        }
        self.lanes.push((std::iter::once(path.start).chain(path.corners.iter().copied()).collect(), radius));
        Some(path)
    }

    /// Returns the distance to the goal, metres, that an agent has left once it is past the agents that step aside and
    /// off their paths.
    fn past(&self, row: usize, aside: &[(usize, Path)]) -> f32 {
        let (view, state) = (self.view, self.view.state);
        let (lane, radius) = state.lane(row);
        let retreats = &self.lanes[self.lanes.len() - aside.len()..];
        let step = 0.5 * radius;
        let last = retreats.iter().map(|(retreat, size)| {
            let passed = nearest(&lane, retreat[retreat.len() - 1]).1;
            let near = |&k: &usize| apart(retreat, at(&lane, step * k as f64)) < radius + size;
            let clear = (0..=(AHEAD * radius / step) as usize).rev().find(near);
            clear.map_or(passed, |k| passed.max(step * k as f64))
        });
        let last = last.fold(0.0, f64::max);
        (view.remaining)(row) - last as f32
    }
}

/// Returns the distance from a path to a point.
fn apart(way: &[DVec2], p: DVec2) -> f64 {
    nearest(way, p).0
}

/// Returns the distance from a path to a point, and the length of the path up to the nearest point.
fn nearest(way: &[DVec2], p: DVec2) -> (f64, f64) {
    let (mut best, mut walked) = ((way[0].distance(p), 0.0), 0.0);
    for leg in way.windows(2) {
        let nearest = nearest_on_segment(leg[0], leg[1], p);
        if nearest.distance(p) < best.0 {
            best = (nearest.distance(p), walked + nearest.distance(leg[0]));
        }
        walked += leg[0].distance(leg[1]);
    }
    best
}

/// Returns the point at a distance along a path; the end of the path if it is shorter.
fn at(way: &[DVec2], mut along: f64) -> DVec2 {
    for leg in way.windows(2) {
        let length = leg[0].distance(leg[1]);
        if along < length {
            return leg[0].lerp(leg[1], along / length);
        }
        along -= length;
    }
    way[way.len() - 1]
}

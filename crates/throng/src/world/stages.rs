//! The five stages of a step, over all agents.

use super::{Way, World};
use crate::agent::{JourneyId, Status};
use crate::avoid::{MARGIN, MARGIN_LONG_STEP, NearDisc, NearEdge, Neighbour, View, Workspace};
use crate::guard::Bodies;
use crate::motion::{Limits, faces, limit, turn};
use crate::navigate::{Dice, Goal, Travel, nearest_on_ring, turned_right};
use crate::perceive::Near;
use crate::random::{Purpose, unit};
use crate::space::{Disc, Edge, NearWalls, is_inside};
use crate::summary::Ended;
use crate::{SubSteps, parallel};
use glam::{DVec2, Vec2};

/// How much of the avoiding, beyond its half, falls on who has more way to go to the same goal, and on who rests.
const YIELD_TO_FIRST: f32 = 0.15;
const YIELD_AT_REST: f32 = 0.3;
/// How much of the change of velocity that somebody with the right of way would like is granted in advance, over
/// the share that falls on who yields.
const GRANT: f32 = 2.0;
/// Cosine of the angle within which two go the same way; beyond its negative they go opposite ways.
const SAME_WAY: f32 = 0.3;
/// Part of the sum of radii that who is followed may be aside.
const FOLLOW_WIDTH: f32 = 0.8;
/// Seconds in which who follows closes up.
const FOLLOW_TIME: f32 = 0.05;
/// Cosine of the angle within which somebody is ahead: on the way to the same goal, and to another.
const AHEAD: f32 = 0.3;
const RIGHT_AHEAD: f32 = 0.7;
/// Seconds without progress after which twice the distance to a point that others have taken is near enough.
const CONTENT_TIME: f32 = 3.0;
/// Seconds in which an agent that was pushed off its goal comes back.
const RETURN_TIME: f32 = 0.5;
/// Part of the smallest radius that anybody moves in a sub-step at most, where nobody is near, and in a crowd.
const FREE_MOVE: f32 = 0.25;
const CROWD_MOVE: f32 = 0.125;

/// Metres beyond the gap before an area in a wall that count as there.
const GAP_TOLERANCE: f64 = 0.05;

/// What a thread keeps while it goes through agents.
#[derive(Default)]
struct Scratch {
    near: NearWalls,
    found: Vec<Near>,
    neighbours: Vec<Neighbour>,
    edges: Vec<NearEdge>,
    discs: Vec<NearDisc>,
    workspace: Workspace,
}

impl World {
    /// Into how many sub-steps the next step is divided.
    pub(super) fn sub_steps(&mut self) -> u32 {
        let parts = match self.settings.sub_steps {
            SubSteps::Fixed(parts) => return parts,
            SubSteps::Auto => {
                let agents = &self.agents;
                let smallest = agents.radius.iter().copied().fold(f32::INFINITY, f32::min);
                let fastest = agents.max_speed.iter().copied().fold(0.0, f32::max);
                let part = if self.is_crowded() { CROWD_MOVE } else { FREE_MOVE };
                // an empty or motionless world: 0 / inf or 0 / x
                (self.settings.step as f32 * fastest / (part * smallest) - 1e-3).ceil()
            }
        };
        (parts as u32).clamp(1, 10_000)
    }

    /// Whether any two bodies are within a body's width of each other.
    fn is_crowded(&mut self) -> bool {
        let agents = &self.agents;
        let widest = agents.radius.iter().copied().fold(0.0, f32::max) * 2.0;
        self.step.grid.rebuild(&agents.position, &agents.number, widest.max(0.1) * 2.0);
        let grid = &self.step.grid;
        (0..agents.len()).any(|row| {
            let mut near = 0;
            grid.within(agents.position[row], widest * 2.0, |_| near += 1);
            near > 1
        })
    }

    /// 1. Who is near: the nearest neighbours of everybody.
    pub(super) fn perceive(&mut self) {
        let Self { agents, groups, step, .. } = self;
        let widest = agents.radius.iter().copied().fold(0.1, f32::max);
        step.grid.rebuild(&agents.position, &agents.number, widest * 5.0);
        step.most_neighbours = groups.iter().map(|group| group.neighbours).max().unwrap_or(1);
        step.neighbours.resize(agents.len() * step.most_neighbours, Near::default());
        let grid = &step.grid;
        parallel::rows(&mut step.neighbours, step.most_neighbours, Scratch::default, |scratch, row, places| {
            let group = &groups[agents.group[row].index()];
            let accept = |near: &Near| near.row as usize != row && agents.avoids(row, near.row as usize);
            let at = agents.position[row];
            grid.nearest(at, group.neighbours, group.neighbour_distance, accept, &mut scratch.found);
            places[..scratch.found.len()].copy_from_slice(&scratch.found);
            if let Some(end) = places.get_mut(scratch.found.len()) {
                // marks the end: nobody is their own neighbour
                *end = Near { row: row as u32, ..Near::default() };
            }
        });
    }

    /// 2. What would I like: the preferred velocity of everybody.
    pub(super) fn intend(&mut self, seconds: f32) {
        self.plan();
        self.show_ways();
        self.step.preferred.clear();
        self.step.preferred.resize(self.agents.len(), Vec2::ZERO);
        let mut travels = std::mem::take(&mut self.agents.travel);
        let mut preferred = std::mem::take(&mut self.step.preferred);
        let mut out: Vec<(&mut Travel, &mut Vec2)> = travels.iter_mut().zip(&mut preferred).collect();
        let world = &*self;
        parallel::rows(
            &mut out,
            1,
            || (),
            |(), row, out| {
                let (travel, preferred) = &mut out[0];
                **preferred = world.preferred_velocity(row, travel, seconds);
            },
        );
        self.agents.travel = travels;
        self.step.preferred = preferred;
    }

    /// Notes where everybody wants to go, for others to see.
    fn show_ways(&mut self) {
        let mut ways = std::mem::take(&mut self.step.ways);
        ways.clear();
        ways.extend(self.agents.travel.iter().enumerate().map(|(row, travel)| Way {
            goal: self.goal_of(row),
            direction: match self.agents.status[row] {
                Status::Walking => self.towards(row, travel).normalize_or_zero(),
                _ => Vec2::ZERO,
            },
            remaining: travel.remaining,
        }));
        self.step.ways = ways;
    }

    fn preferred_velocity(&self, row: usize, travel: &mut Travel, seconds: f32) -> Vec2 {
        let agents = &self.agents;
        if agents.status[row] == Status::Arrived {
            return self.back_to_goal(row, travel);
        }
        if agents.status[row] != Status::Walking {
            return Vec2::ZERO;
        }
        let Some(goal) = self.stop(row, travel.leg).map(|stop| &self.goals[stop.goal.index()]) else {
            return Vec2::ZERO;
        };
        let towards = self.towards(row, travel);
        let (distance, remaining) = (towards.length(), travel.remaining);
        let direction = towards.normalize_or_zero();
        let speed = agents.preferred_speed[row];
        let group = &self.groups[agents.group[row].index()];
        let made = if speed > 0.0 { agents.velocity[row].dot(direction) / speed } else { 1.0 };
        let dice = Dice { seed: self.settings.seed, number: agents.number[row], step: self.tally.sub_steps };
        let detour =
            if group.detour { travel.detour(made, seconds, dice, || self.queues(row, direction)) } else { 0.0 };
        // coming to a point: as slow as stopping there takes, half of the acceleration left to turn with, and never
        // past it
        let arriving = match goal {
            Goal::Point { .. } if self.is_last(row, travel.leg) => {
                (agents.max_acceleration[row] * remaining).sqrt().min(remaining / seconds)
            }
            _ => f32::INFINITY,
        };
        let bias = if distance > 2.0 * agents.radius[row] { group.keep_right } else { 0.0 };
        let following = if detour == 0.0 { self.following_speed(row, direction) } else { f32::INFINITY };
        turned_right(direction, bias + detour) * speed.min(arriving).min(following)
    }

    /// The speed at which an agent follows those right ahead who go the same way: theirs, once it has closed up. Who
    /// queues does not push, nor mill about. In counterflow nobody queues: there one squeezes by.
    fn following_speed(&self, row: usize, direction: Vec2) -> f32 {
        let agents = &self.agents;
        let others = || self.neighbours(row).iter().map(|near| near.row as usize);
        if others().any(|other| self.step.ways[other].direction.dot(direction) < -SAME_WAY) {
            return f32::INFINITY;
        }
        let speeds = others().filter_map(|other| {
            let radii = agents.radius[row] + agents.radius[other];
            let offset = agents.position[other] - agents.position[row];
            let aside = offset.perp_dot(direction).abs();
            (aside < FOLLOW_WIDTH * radii && self.leads(other, offset, direction)).then(|| {
                let gap = (offset.length() - radii * (1.0 + MARGIN)).max(0.0);
                agents.velocity[other].dot(direction).max(0.0) + gap / FOLLOW_TIME
            })
        });
        speeds.fold(f32::INFINITY, f32::min)
    }

    /// From an agent to what it heads for.
    fn towards(&self, row: usize, travel: &Travel) -> Vec2 {
        (travel.aim - self.world_position(row)).as_vec2()
    }

    /// What an agent would like that has arrived: to rest, or to come gently back to its point if it was pushed away
    /// and nobody else has taken it.
    fn back_to_goal(&self, row: usize, travel: &Travel) -> Vec2 {
        match self.stop(row, travel.leg).map(|stop| &self.goals[stop.goal.index()]) {
            Some(Goal::Point { at, tolerance }) if travel.at_point && !self.is_taken(row, *at) => {
                let offset = (*at - self.world_position(row)).as_vec2();
                let beyond = offset.length() - tolerance;
                let speed = (beyond / RETURN_TIME).min(0.5 * self.agents.preferred_speed[row]);
                offset.normalize_or_zero() * speed.max(0.0)
            }
            _ => Vec2::ZERO,
        }
    }

    /// Whether somebody who has arrived at the same goal is nearer to it.
    fn is_taken(&self, row: usize, point: DVec2) -> bool {
        let agents = &self.agents;
        let goal = |row: usize| self.step.ways[row].goal;
        let distance = |row: usize| self.world_position(row).distance_squared(point);
        self.neighbours(row).iter().map(|near| near.row as usize).any(|other| {
            agents.status[other] == Status::Arrived && goal(other) == goal(row) && distance(other) < distance(row)
        })
    }

    /// Whether somebody close ahead is on the way to the same goal, or goes the same way. Of two with the same goal at
    /// most one queues, so that never each waits for the other.
    fn queues(&self, row: usize, direction: Vec2) -> bool {
        let agents = &self.agents;
        let way = &self.step.ways[row];
        self.neighbours(row).iter().any(|near| {
            let other = near.row as usize;
            let theirs = &self.step.ways[other];
            let offset = agents.position[other] - agents.position[row];
            let distance = offset.length();
            let close = distance - agents.radius[row] - agents.radius[other] < 2.0 * agents.radius[row];
            let ahead = offset.dot(direction) / distance;
            if !close || agents.status[other] != Status::Walking {
                false
            } else if theirs.goal == way.goal {
                ahead > AHEAD && theirs.remaining < way.remaining
            } else {
                ahead > RIGHT_AHEAD && self.leads(other, offset, direction)
            }
        })
    }

    /// Whether the one at `offset` goes ahead of who wants to go in `direction`: the same way, and away. Of two, at
    /// most one goes ahead of the other, so that never each waits for the other.
    fn leads(&self, other: usize, offset: Vec2, direction: Vec2) -> bool {
        let theirs = self.step.ways[other].direction;
        theirs.dot(direction) > SAME_WAY && offset.dot(theirs) > 0.0 && offset.dot(direction) > 0.0
    }

    fn neighbours(&self, row: usize) -> &[Near] {
        let most = self.step.most_neighbours;
        let places = &self.step.neighbours[row * most..(row + 1) * most];
        let count = places.iter().position(|near| near.row as usize == row).unwrap_or(most);
        &places[..count]
    }

    /// 3. What is safe: the local models choose velocities, bodies limit them.
    pub(super) fn avoid(&mut self, seconds: f32) {
        let mut wishes = std::mem::take(&mut self.step.wishes);
        wishes.clear();
        wishes.resize(self.agents.len(), Vec2::ZERO);
        let world = &*self;
        parallel::rows(&mut wishes, 1, Scratch::default, |scratch, row, wish| {
            wish[0] = world.chosen_velocity(row, seconds, scratch);
        });
        self.step.wishes = wishes;
    }

    fn chosen_velocity(&self, row: usize, seconds: f32, scratch: &mut Scratch) -> Vec2 {
        let agents = &self.agents;
        let group = &self.groups[agents.group[row].index()];
        let Scratch { near, neighbours, edges, discs, workspace, .. } = scratch;
        let at = agents.position[row].as_dvec2();
        let range = group.model.wall_range(agents.radius[row], agents.max_speed[row]);
        self.walls.near(at, f64::from(range), near);
        let to_local = |p: DVec2| (p - at).as_vec2();
        edges.clear();
        edges.extend(near.edges.iter().map(|&(_, index)| {
            let edge: Edge = self.walls.edges()[index as usize];
            NearEdge { start: to_local(edge.start), end: to_local(edge.end), edge }
        }));
        discs.clear();
        discs.extend(near.discs.iter().map(|&(_, index)| {
            let disc: Disc = self.walls.discs()[index as usize];
            NearDisc { offset: to_local(disc.center), disc }
        }));
        neighbours.clear();
        let margin = 1.0 + if seconds >= 0.1 { MARGIN_LONG_STEP } else { MARGIN };
        for near in self.neighbours(row) {
            let neighbour = self.neighbour(row, near.row as usize, margin);
            if !edges.iter().any(|edge| hides(edge, neighbour.offset)) {
                neighbours.push(neighbour);
            }
        }
        let wish = group.model.velocity(
            &View {
                velocity: agents.velocity[row],
                preferred: self.step.preferred[row],
                radius: agents.radius[row],
                max_speed: agents.max_speed[row],
                step: seconds,
                neighbours,
                edges,
                discs,
            },
            workspace,
        );
        let limits = Limits {
            speed: agents.max_speed[row],
            change: agents.max_acceleration[row] * seconds,
            turn: agents.max_turn_rate[row] * seconds,
        };
        limit(wish, agents.velocity[row], agents.heading[row], limits)
    }

    fn neighbour(&self, row: usize, other: usize, margin: f32) -> Neighbour {
        let agents = &self.agents;
        let yields = self.yields(row, other);
        let (share, room) = if agents.avoids(other, row) {
            let priority = 0.5 * (agents.priority[other] - agents.priority[row]);
            let share = (0.5 + priority + yields).clamp(0.0, 1.0);
            (share, 1.0 - share)
        } else {
            (1.0, 1.0)
        };
        let offset = agents.position[other] - agents.position[row];
        let velocity = agents.velocity[other];
        let wanted = self.step.preferred[other] - velocity;
        let granted = if wanted.dot(offset) < 0.0 { wanted * (GRANT * yields.max(0.0)) } else { Vec2::ZERO };
        Neighbour {
            offset,
            velocity: velocity + granted,
            radii: (agents.radius[row] + agents.radius[other]) * margin,
            share,
            room,
            aside: if offset == Vec2::ZERO { self.aside(row, other) } else { Vec2::X },
        }
    }

    /// How much more than its half of the avoiding falls on an agent; the opposite for the other. Who walks goes
    /// before who rests, unless it is at the goal of both; of two on their way to the same goal, who has less way to
    /// go: at doors somebody goes first, instead of an arch that nobody breaks.
    fn yields(&self, row: usize, other: usize) -> f32 {
        let agents = &self.agents;
        let (mine, theirs) = (&self.step.ways[row], &self.step.ways[other]);
        let walks = |row: usize| agents.status[row] == Status::Walking;
        match (walks(row), walks(other), mine.goal == theirs.goal) {
            (true, true, true) => {
                let lead = mine.remaining - theirs.remaining;
                YIELD_TO_FIRST * (lead / (agents.radius[row] + agents.radius[other])).clamp(-1.0, 1.0)
            }
            (false, true, false) => YIELD_AT_REST,
            (true, false, false) => -YIELD_AT_REST,
            _ => 0.0,
        }
    }

    /// A direction for two agents in one place to part along, drawn for the pair; opposite for the other.
    fn aside(&self, row: usize, other: usize) -> Vec2 {
        let (a, b) = (self.agents.number[row], self.agents.number[other]);
        let draw = unit(self.settings.seed, a.min(b), u64::from(a.max(b)), Purpose::Coincident);
        let (sin, cos) = libm::sincosf(draw * std::f32::consts::TAU);
        if a < b { Vec2::new(cos, sin) } else { -Vec2::new(cos, sin) }
    }

    /// 4. What is certain: nobody overlaps.
    pub(super) fn guard(&mut self, seconds: f32) {
        let Self { agents, step, walls, tally, .. } = self;
        step.reach.clear();
        step.reach.extend(agents.max_speed.iter().map(|speed| speed * seconds));
        step.targets.clear();
        step.targets.extend(agents.position.iter().zip(&step.wishes).map(|(&at, &v)| at + v * seconds));
        let bodies = Bodies { positions: &agents.position, radii: &agents.radius, reach: &step.reach };
        step.contacts.collect(&bodies, &agents.number, &step.grid, walls, |row, other| {
            agents.avoids(row, other) || agents.avoids(other, row)
        });
        let report = step.guard.certify(&bodies, &step.contacts, walls, &mut step.targets);
        tally.guard_changed += report.changed as u64;
        tally.agent_steps += agents.len() as u64;
        tally.sub_steps += 1;
    }

    /// 5. Move: to where the guard said, then headings, arrivals, exits.
    pub(super) fn advance(&mut self, seconds: f32, now: f64) {
        let agents = &mut self.agents;
        for row in 0..agents.len() {
            let (from, to, wish) = (agents.position[row], self.step.targets[row], self.step.wishes[row]);
            let motion = to - from;
            agents.position[row] = to;
            // what was certified as it was wished is the wish: the motion may be far below what positions resolve
            let unchanged = to.distance(from + wish * seconds) <= to.abs().max_element() * f32::EPSILON;
            agents.velocity[row] = if unchanged { wish } else { motion / seconds };
            let before = agents.heading[row];
            let facing = faces(agents.velocity[row], self.step.preferred[row], agents.max_turn_rate[row]);
            let heading = turn(before, facing, seconds, agents.max_turn_rate[row]);
            agents.heading[row] = heading;
            if agents.status[row] == Status::Walking {
                let trip = &mut agents.trip[row];
                let turned = f64::from((heading - before).abs());
                trip.turned += turned.min(std::f64::consts::TAU - turned);
                trip.on_way += f64::from(seconds);
                trip.walked += f64::from(motion.length());
            }
        }
        self.measure();
        self.arrive(seconds, now);
    }

    /// Notes how close bodies came to each other and to walls.
    fn measure(&mut self) {
        let Self { agents, step, walls, tally, .. } = self;
        for row in 0..agents.len() {
            let at = agents.position[row].as_dvec2();
            let radius = f64::from(agents.radius[row]);
            let separation = |other: u32| {
                let radii = radius + f64::from(agents.radius[other as usize]);
                at.distance(agents.position[other as usize].as_dvec2()) / radii
            };
            for &other in step.contacts.of(row) {
                if agents.number[other as usize] > agents.number[row] {
                    let separation = separation(other);
                    tally.least_separation = tally.least_separation.min(separation);
                    tally.overlaps += u64::from(separation < 1.0 - 1e-4);
                }
            }
            // those who can't touch yet: the nearest that was perceived
            if let Some(near) = step.neighbours.get(row * step.most_neighbours)
                && near.row as usize != row
            {
                tally.least_separation = tally.least_separation.min(separation(near.row));
            }
            let edges = step.contacts.edges_of(row).iter().map(|&i| walls.edges()[i as usize].nearest(at).distance(at));
            let discs = step.contacts.discs_of(row).iter().map(|&i| {
                let disc = walls.discs()[i as usize];
                disc.center.distance(at) - disc.radius
            });
            if let Some(distance) = edges.chain(discs).min_by(f64::total_cmp) {
                let separation = distance / radius;
                tally.least_wall_separation = tally.least_wall_separation.min(separation);
                tally.overlaps += u64::from(separation < 1.0 - 1e-4);
            }
        }
    }

    pub(super) fn stop(&self, row: usize, leg: u32) -> Option<crate::Stop> {
        self.journeys[self.agents.journey[row].index()].stops.get(leg as usize).copied()
    }

    fn is_last(&self, row: usize, leg: u32) -> bool {
        let journey = &self.journeys[self.agents.journey[row].index()];
        !journey.repeat && leg as usize + 1 == journey.stops.len()
    }

    pub(super) fn first_status(&self, journey: JourneyId) -> Status {
        if self.journeys[journey.index()].stops.is_empty() { Status::Arrived } else { Status::Walking }
    }

    /// Arrivals, waits, exits.
    fn arrive(&mut self, seconds: f32, now: f64) {
        let mut arrived = std::mem::take(&mut self.step.arrivals);
        arrived.clear();
        arrived.resize(self.goals.len(), 0);
        for row in 0..self.agents.len() {
            if self.agents.status[row] == Status::Arrived
                && let Some(goal) = self.goal_of(row)
            {
                arrived[goal.index()] += 1;
            }
        }
        let mut next = Vec::with_capacity(self.agents.len());
        for row in 0..self.agents.len() {
            next.push(self.next_status(row, seconds, &arrived));
        }
        self.step.arrivals = arrived;
        let mut gone = Vec::new();
        for (row, status) in next.into_iter().enumerate() {
            let before = self.agents.status[row];
            if before == Status::Waiting {
                self.agents.travel[row].wait -= seconds;
            }
            if status == Status::Arrived && before == Status::Walking {
                self.agents.travel[row].at_point = self.is_at_point(row);
            }
            let status = match status {
                // there: the next leg, the end, or the way out
                Status::Arrived if before == Status::Walking => {
                    let wait = self.stop(row, self.agents.travel[row].leg).map_or(0.0, |stop| stop.wait);
                    let exits =
                        self.goal_of(row).is_some_and(|goal| matches!(self.goals[goal.index()], Goal::Exit { .. }));
                    if exits {
                        gone.push(row);
                        Status::Arrived
                    } else if wait > 0.0 {
                        self.agents.travel[row].wait = wait;
                        Status::Waiting
                    } else {
                        self.next_leg(row)
                    }
                }
                Status::Walking if before == Status::Waiting => self.next_leg(row),
                status => status,
            };
            if status == Status::Arrived && self.agents.trip[row].arrived.is_none() {
                let trip = &mut self.agents.trip[row];
                trip.arrived = Some(now);
                // whoever arrives by contact has not the whole way to go
                trip.shortest -= f64::from(self.agents.travel[row].remaining);
            }
            self.agents.status[row] = status;
        }
        for &row in gone.iter().rev() {
            let ended = Ended { trip: self.agents.trip[row], preferred_speed: self.agents.preferred_speed[row] };
            self.tally.removed.push((self.agents.number[row], ended));
            self.remove_row(row);
        }
    }

    fn next_leg(&mut self, row: usize) -> Status {
        let journey = &self.journeys[self.agents.journey[row].index()];
        let leg = self.agents.travel[row].leg + 1;
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

    fn next_status(&self, row: usize, seconds: f32, arrived: &[u32]) -> Status {
        let agents = &self.agents;
        match agents.status[row] {
            Status::Waiting if agents.travel[row].wait <= seconds => Status::Walking,
            Status::Walking => {
                let Some(stop) = self.stop(row, agents.travel[row].leg) else { return Status::Arrived };
                let at = agents.position[row].as_dvec2() + self.settings.origin;
                let there = match &self.goals[stop.goal.index()] {
                    Goal::Point { at: goal, tolerance } => {
                        let distance = at.distance(*goal);
                        distance <= f64::from(*tolerance)
                            || self.arrives_by_contact(row, stop.goal, distance, arrived[stop.goal.index()])
                    }
                    Goal::Area { corners } | Goal::Exit { corners } => {
                        let gap = f64::from(agents.travel[row].gap);
                        is_inside(corners, at)
                            || gap > 0.0 && nearest_on_ring(corners, at).distance(at) <= gap + GAP_TOLERANCE
                    }
                };
                if there { Status::Arrived } else { Status::Walking }
            }
            status => status,
        }
    }

    /// Whether an agent is at the very point it was on its way to.
    fn is_at_point(&self, row: usize) -> bool {
        match self.goal_of(row).map(|goal| &self.goals[goal.index()]) {
            Some(Goal::Point { at, tolerance }) => at.distance(self.world_position(row)) <= f64::from(*tolerance),
            _ => false,
        }
    }

    /// Arrival by contact (MODELS 1.9): near enough to a point that others have taken, and touching one of them. Who
    /// gets no nearer for a while is content with less: crowds gather in uneven discs.
    fn arrives_by_contact(&self, row: usize, goal: crate::GoalId, distance: f64, arrived: u32) -> bool {
        let agents = &self.agents;
        let radius = f64::from(agents.radius[row]);
        let enough = 1.25 * radius * f64::from(arrived + 1).sqrt() + 2.0 * radius;
        let content = 1.0 + f64::from(agents.travel[row].without_progress / CONTENT_TIME);
        if arrived == 0 || distance > enough * content {
            return false;
        }
        self.step.contacts.of(row).iter().any(|&other| {
            let other = other as usize;
            let touch = (agents.radius[row] + agents.radius[other]) * 1.1;
            agents.status[other] == Status::Arrived
                && self.goal_of(other) == Some(goal)
                && agents.position[row].distance(agents.position[other]) <= touch
        })
    }
}

/// Whether an edge lies between the agent and what is at `offset`.
fn hides(edge: &NearEdge, offset: Vec2) -> bool {
    let along = edge.end - edge.start;
    offset.perp_dot(edge.start) * offset.perp_dot(edge.end) < 0.0
        && along.perp_dot(-edge.start) * along.perp_dot(offset - edge.start) < 0.0
}

//! 3. What is safe: the local models choose velocities, bodies limit them.

use super::avoid_lanes::LaneScratch;
use super::velocities::{Rows, set};
use super::{StepMemory, World};
use crate::avoid::{LocalModel, NearDisc, NearEdge, Neighbour, Outline, View, Workspace, margin};
use crate::motion::{Limits, follow, limit};
use crate::parallel;
use crate::random::{Dice, Purpose, unit};
use crate::space::{Core, Disc, Edge, NearWalls};
use glam::{DVec2, Vec2, Vec3};
use std::ops::Range;

/// How much of the avoiding, beyond its half, falls on who has more way to go to the same goal, and on who rests or
/// steps aside.
const YIELD_TO_FIRST: f32 = 0.15;
const YIELD_AT_REST: f32 = 0.3;
/// How much of the change of velocity that an agent with the right of way would like is granted in advance, over the
/// share that falls on the one that yields.
const GRANT: f32 = 2.0;
/// It is the change that an agent in the same queue makes within so many seconds; more would drive those behind it back.
const GRANTED: f32 = 0.04;

/// What a thread keeps while it goes through agents.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    sight: Sight,
    workspace: Workspace,
    lanes: LaneScratch,
}

/// What an agent sees.
#[derive(Clone, Debug, Default)]
pub(super) struct Sight {
    near: NearWalls,
    /// Rows of the neighbours.
    pub rows: Vec<u32>,
    pub neighbours: Vec<Neighbour>,
    pub edges: Vec<NearEdge>,
    pub discs: Vec<NearDisc>,
}

impl Sight {
    /// Whether it has no walls.
    pub fn is_open(&self) -> bool {
        self.edges.is_empty() && self.discs.is_empty()
    }

    /// Whether a wall lies between the agent and what is at `offset`.
    pub fn hides(&self, offset: Vec2) -> bool {
        // walls come nearest first, and none that is farther hides anybody
        let reach = f64::from(offset.length()) * 1.001 + 0.001;
        let mut between = self.edges.iter().zip(&self.near.edges).take_while(|(_, wall)| wall.0 <= reach);
        between.any(|(edge, _)| is_between(edge.start, edge.end, offset))
    }
}

impl World {
    /// 3. What is safe: the local models choose velocities, bodies limit them.
    pub(super) fn avoid(&mut self, seconds: f32) {
        if self.step.rest.is_everybodys() {
            return;
        }
        let mut wishes = std::mem::take(&mut self.step.wishes);
        let mut scratch = std::mem::take(&mut self.step.avoiding);
        let mut by_place = std::mem::take(&mut self.step.by_place);
        wishes.resize(self.agents.len(), self.in_space_now());
        let world = &*self;
        if world.vehicles_limit_all() {
            parallel::ranges(wishes.rows(), |rows, wishes| world.wish_as_preferred(rows, wishes));
        } else if let Some(common) = world.common(seconds) {
            let Self { step: StepMemory { rest, grid, near, .. }, .. } = world;
            by_place.resize(self.agents.len(), Vec2::ZERO);
            // everybody's list of neighbours lies at its place
            parallel::ranges_with(&mut by_place[..], &mut scratch, |scratch, places, wishes| {
                let Scratch { sight, workspace, lanes } = scratch;
                let mut one = |row: usize| world.wish(row, seconds, sight, workspace);
                rest.each_place(grid.order(), places, wishes, |places, wishes| {
                    world.avoid_many(&common, places, lanes, wishes, &mut one);
                });
            });
            parallel::ranges(&mut wishes.ground[..], |rows, wishes| {
                rest.each(rows, wishes, |rows, wishes| {
                    let places = &near.places()[rows];
                    wishes.iter_mut().zip(places).for_each(|(wish, &place)| *wish = by_place[place as usize]);
                });
            });
        } else {
            parallel::ranges_with(wishes.rows(), &mut scratch, |Scratch { sight, workspace, .. }, rows, wishes| {
                world.step.rest.each(rows, wishes, |rows, mut wishes| {
                    rows.zip(0..)
                        .for_each(|(row, at)| set(&mut wishes, at, world.wish(row, seconds, sight, workspace)));
                });
            });
        }
        (self.step.wishes, self.step.avoiding, self.step.by_place) = (wishes, scratch, by_place);
    }

    /// Whether everybody steers and nobody avoids others: vehicles have limited all.
    fn vehicles_limit_all(&self) -> bool {
        self.all_steer() && self.groups_in_use().all(|group| !group.model.avoids())
    }

    /// As [`wish`](Self::wish), where that is what is preferred.
    fn wish_as_preferred(&self, rows: Range<usize>, (ground, climb): Rows<'_>) {
        ground.copy_from_slice(&self.step.preferred.ground[rows.clone()]);
        for (row, climb) in rows.zip(climb.all) {
            *climb = self.stays_down(row, self.step.preferred.at(row)).z;
        }
    }

    /// The velocity that an agent will have but for the guard.
    fn wish(&self, row: usize, seconds: f32, sight: &mut Sight, workspace: &mut Workspace) -> Vec3 {
        if self.agents.script[row].is_some() {
            return self.step.preferred.at(row).clamp_length_max(self.agents.max_speed[row]);
        }
        if self.steering(row).is_some() && !self.model(row).avoids() {
            // its vehicle has limited it
            return self.stays_down(row, self.step.preferred.at(row));
        }
        let view = self.view(row, seconds, sight);
        let chosen = self.chosen_velocity(row, &view, workspace);
        self.limited_velocity(row, chosen, seconds)
    }

    pub(super) fn model(&self, row: usize) -> &dyn LocalModel {
        &*self.groups[self.agents.group[row].index()].model
    }

    /// What the model of an agent chooses.
    pub(super) fn chosen_velocity(&self, row: usize, view: &View<'_>, workspace: &mut Workspace) -> Vec3 {
        self.stays_down(row, self.model(row).velocity_in_space(view, workspace))
    }

    /// Who is on the ground and does not want to leave it stays there.
    fn stays_down(&self, row: usize, chosen: Vec3) -> Vec3 {
        let stays = self.agents.altitude[row] == 0.0 && self.step.preferred.climb(row) <= 0.0;
        if stays { chosen.with_z(0.0) } else { chosen }
    }

    /// What the model of an agent sees.
    pub(super) fn view<'a>(&self, row: usize, seconds: f32, sight: &'a mut Sight) -> View<'a> {
        let agents = &self.agents;
        self.see_walls(row, sight);
        let margin = margin(seconds);
        for &near in self.neighbours(row) {
            let other = near as usize;
            if !sight.hides(agents.offset(row, other)) && !self.squeezes_past(row, other) {
                sight.rows.push(near);
                sight.neighbours.push(self.neighbour(row, other, margin));
            }
        }
        if !agents.is_disc(row) {
            see_with_core(&agents.core_of(row), &mut sight.edges, &mut sight.discs);
        }
        self.view_of(row, seconds, sight)
    }

    /// Lets an agent see the walls near it, and nobody yet.
    pub(super) fn see_walls(&self, row: usize, sight: &mut Sight) {
        let agents = &self.agents;
        let Sight { near: walls, rows, neighbours, edges, discs } = sight;
        let at = agents.position[row].as_dvec2();
        let bound = agents.body(row).bound() + agents.tracking_error[row];
        let range = self.model(row).wall_range(bound, agents.max_speed[row]);
        self.walls.near(at, f64::from(range), walls);
        let to_local = |p: DVec2| (p - at).as_vec2();
        edges.clear();
        edges.extend(walls.edges.iter().map(|&(_, index)| {
            let edge: Edge = self.walls.edges()[index as usize];
            NearEdge { start: to_local(edge.start), end: to_local(edge.end), edge }
        }));
        discs.clear();
        discs.extend(walls.discs.iter().map(|&(_, index)| {
            let disc: Disc = self.walls.discs()[index as usize];
            NearDisc { offset: to_local(disc.center), disc, outline: Outline::POINT }
        }));
        rows.clear();
        neighbours.clear();
    }

    /// What the model of an agent is to know that sees this.
    pub(super) fn view_of<'a>(&self, row: usize, seconds: f32, sight: &'a Sight) -> View<'a> {
        let agents = &self.agents;
        let Sight { neighbours, edges, discs, .. } = sight;
        View {
            velocity: agents.velocity[row],
            heading: agents.heading[row],
            preferred: self.relaxed(row, seconds),
            climb: agents.climb[row],
            preferred_climb: self.step.preferred.climb(row),
            radius: agents.radius[row] + agents.tracking_error[row],
            max_speed: agents.max_speed[row],
            max_acceleration: agents.max_acceleration[row],
            tracking_error: agents.tracking_error[row],
            max_turn_rate: agents.max_turn_rate[row],
            margin: margin(seconds),
            step: seconds,
            neighbours,
            edges,
            discs,
            dice: self.dice(row),
        }
    }

    /// What of a chosen velocity the body can do.
    fn limited_velocity(&self, row: usize, chosen: Vec3, seconds: f32) -> Vec3 {
        let agents = &self.agents;
        let limits = Limits {
            speed: agents.max_speed[row],
            change: agents.max_acceleration[row] * seconds,
            turn: agents.max_turn_rate[row] * seconds,
        };
        let heading = agents.heading[row];
        let drives = agents.tracking_error[row] > 0.0;
        let wish = if drives {
            follow(chosen.truncate(), heading, agents.max_turn_rate[row], seconds).extend(chosen.z)
        } else {
            chosen
        };
        limit(wish, agents.velocity[row].extend(agents.climb[row]), heading, limits)
    }

    /// What the random numbers of an agent depend on in this sub-step.
    pub(super) fn dice(&self, row: usize) -> Dice {
        Dice { seed: self.settings.seed, number: self.agents.number[row], step: self.tally.sub_steps }
    }

    fn neighbour(&self, row: usize, other: usize, margin: f32) -> Neighbour {
        let agents = &self.agents;
        let yields = self.yields(row, other);
        let (share, room) = if agents.avoids(other, row) {
            let share = self.share(row, other, yields);
            (share, 1.0 - share)
        } else {
            (1.0, 1.0)
        };
        let offset = agents.position[other] - agents.position[row];
        let velocity = agents.velocity_near(other, agents.position[row].as_dvec2());
        let own_turn = agents.velocity_near(row, agents.position[other].as_dvec2()) - agents.velocity[row];
        let outline = if agents.is_disc(row) && agents.is_disc(other) {
            Outline::POINT
        } else {
            Outline::between(&agents.core_of(row), &agents.core_of(other))
        };
        Neighbour {
            offset,
            above: agents.above(row, other),
            climb: agents.climb[other],
            velocity: velocity - own_turn + self.granted(row, other, yields),
            preferred: self.step.preferred.ground[other],
            radii: (agents.radius[row] + agents.radius[other]) * margin
                + (agents.tracking_error[row] + agents.tracking_error[other]),
            outline,
            share,
            room,
            aside: if offset == Vec2::ZERO { self.aside(row, other) } else { Vec2::X },
        }
    }

    /// The share of the avoiding that falls on an agent, with one who avoids too.
    pub(super) fn share(&self, row: usize, other: usize, yields: f32) -> f32 {
        let priority = 0.5 * (self.agents.priority[other] - self.agents.priority[row]);
        (0.5 + priority + yields).clamp(0.0, 1.0)
    }

    /// What is granted in advance to one who has the right of way: part of the change of velocity that it would like, if
    /// that brings it nearer.
    pub(super) fn granted(&self, row: usize, other: usize, yields: f32) -> Vec2 {
        let agents = &self.agents;
        if yields <= 0.0 {
            return Vec2::ZERO;
        }
        let velocity = agents.velocity_near(other, agents.position[row].as_dvec2());
        let queues = yields < YIELD_AT_REST;
        let wanted = if queues { self.relaxed(other, GRANTED) } else { self.step.preferred.ground[other] } - velocity;
        let nearer = wanted.dot(agents.position[other] - agents.position[row]) < 0.0;
        if nearer { wanted * (GRANT * yields) } else { Vec2::ZERO }
    }

    /// How much more than its half of the avoiding falls on an agent; the opposite for the other. Who walks goes
    /// before who rests, unless it is at the goal of both; of two on their way to the same goal, who has less way to
    /// go: at doors somebody goes first, instead of an arch that nobody breaks.
    pub(super) fn yields(&self, row: usize, other: usize) -> f32 {
        let agents = &self.agents;
        let (mine, theirs) = (&self.step.shown[row].way, &self.step.shown[other].way);
        let turn = |row: usize| agents.travel[row].turn.rank();
        match (mine.walks(), theirs.walks(), mine.same_goal(theirs)) {
            (true, true, _) if turn(row) * turn(other) < 0 => YIELD_AT_REST * turn(other) as f32,
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
}

/// Makes what an agent that is no disc sees of walls: they touch its core, not only its centre.
fn see_with_core(own: &Core, edges: &mut Vec<NearEdge>, discs: &mut Vec<NearDisc>) {
    for near in &mut *discs {
        near.outline = Outline::between(own, &Core::point(near.disc.center));
    }
    discs.extend(edges.drain(..).map(|NearEdge { start, end, edge }| NearDisc {
        offset: start.midpoint(end),
        disc: Disc { center: edge.start.midpoint(edge.end), radius: 0.0 },
        outline: Outline::between(own, &Core::segment(edge.start, edge.end)),
    }));
}

/// Whether an edge lies between the agent and what is at `offset`; all are seen from the agent.
pub(super) fn is_between(start: Vec2, end: Vec2, offset: Vec2) -> bool {
    let along = end - start;
    offset.perp_dot(start) * offset.perp_dot(end) < 0.0 && along.perp_dot(-start) * along.perp_dot(offset - start) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::Settings;
    use crate::world::way::{Shown, Way};
    use crate::{Agent, GoalId};
    use proptest::prelude::*;

    type One = (f32, Option<u32>, f32, f32, f32, usize);

    fn one() -> impl Strategy<Value = One> {
        (
            0.05f32..3.0,
            prop::option::of(0u32..2),
            prop_oneof![Just(0.0f32), 0.0f32..3.0],
            -1.0f32..1.0,
            -2.0f32..2.0,
            0usize..4,
        )
    }

    fn pair(both: [One; 2]) -> World {
        let mut world = World::new(Settings::default()).unwrap();
        for (radius, _, _, priority, x, _) in both {
            let position = DVec2::new(x.into(), 0.0);
            world.add_agent(Agent { radius, priority, position, ..Agent::default() }).unwrap();
        }
        world.step.shown = both
            .iter()
            .map(|&(_, goal, remaining, _, x, status)| {
                let goal = goal.map(GoalId);
                let way =
                    if status == 0 { Way::walking(goal, Vec2::X, remaining) } else { Way::at_rest(goal, remaining) };
                Shown::new(Vec2::new(x, 0.0), Vec2::ZERO, way)
            })
            .collect();
        world.step.preferred.resize(2, false);
        world
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn what_one_yields_the_other_gains(a in one(), b in one()) {
            let world = pair([a, b]);
            prop_assert_eq!(world.yields(0, 1), -world.yields(1, 0));
            let [of_a, of_b] = [(0, 1), (1, 0)].map(|(row, other)| world.neighbour(row, other, 1.0));
            // what the pair's freedom rests on: all of the avoiding is done, no more than all of the room is used
            prop_assert!((of_a.share + of_b.share - 1.0).abs() < 1e-6);
            prop_assert!((of_a.room + of_b.room - 1.0).abs() < 1e-6);
        }
    }

    /// What falls on the first of two, beyond its half.
    fn yields(status: [usize; 2], goals: [u32; 2], remaining: [f32; 2]) -> f32 {
        let one = |k: usize| (0.2, Some(goals[k]), remaining[k], 0.0, k as f32, status[k]);
        pair([one(0), one(1)]).yields(0, 1)
    }

    #[test]
    fn the_nearer_goes_first_and_who_walks_goes_before_who_rests() {
        const WALKS: usize = 0;
        const RESTS: usize = 2;
        assert!(yields([WALKS; 2], [0, 0], [3.0, 2.0]) > 0.0, "who has farther to go yields");
        assert!(yields([WALKS; 2], [0, 0], [2.0, 2.1]) < 0.0, "who is nearer goes first");
        assert_eq!(yields([WALKS; 2], [0, 0], [2.0, 2.0]), 0.0, "equals share");
        assert_eq!(yields([WALKS; 2], [0, 1], [3.0, 2.0]), 0.0, "who is bound elsewhere is not ahead");
        assert!(yields([RESTS, WALKS], [0, 1], [0.0, 2.0]) > 0.0, "who rests makes way");
        assert_eq!(yields([RESTS, WALKS], [0, 0], [0.0, 2.0]), 0.0, "not at the goal of both");
        assert_eq!(yields([RESTS; 2], [0, 1], [0.0, 0.0]), 0.0);
    }
}

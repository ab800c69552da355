//! 3. Avoidance: local models choose velocities, and the limits of the bodies apply.

use super::avoid_simd::LaneScratch;
use super::velocities::{Rows, set};
use super::{StepMemory, World, State};
use crate::avoid::{AvoidanceInput, AvoidanceNeighbour, LocalModel, NearDisc, NearEdge, Outline, Workspace, margin};
use crate::motion::{Limits, follow, limit};
use crate::parallel;
use crate::random::{Purpose, Rng, unit};
use crate::space::{Core, Disc, Edge, NearWalls};
use glam::{DVec2, Vec2, Vec3};
use std::ops::Range;

/// Extra avoidance share, beyond 0.5, of the agent farther from the common goal, and of an agent that stands or steps
/// aside.
pub(super) const YIELD_TO_FIRST: f32 = 0.15;
pub(super) const YIELD_AT_REST: f32 = 0.3;
/// Part of the preferred change of velocity of an agent with the right of way that the yielding agent anticipates,
/// divided by the extra share of the yielding agent.
const GRANT: f32 = 2.0;
/// The change anticipated of an agent in the same queue is its relaxed change in this time, seconds. A longer time
/// would drive the agents behind it back.
const GRANTED: f32 = 0.04;

/// Scratch memory of a thread.
#[derive(Clone, Debug, Default)]
pub(super) struct AvoidScratch {
    sight: Visibility,
    workspace: Workspace,
    lanes: LaneScratch,
}

/// The walls and neighbours that an agent takes into account.
#[derive(Clone, Debug, Default)]
pub(super) struct Visibility {
    near: NearWalls,
    /// Rows of the neighbours.
    pub rows: Vec<u32>,
    pub neighbours: Vec<AvoidanceNeighbour>,
    pub edges: Vec<NearEdge>,
    pub discs: Vec<NearDisc>,
}

impl Visibility {
    /// Whether no wall is near.
    pub fn is_open(&self) -> bool {
        self.edges.is_empty() && self.discs.is_empty()
    }

    /// Whether a wall lies between the agent and the point at `offset`.
    pub fn hides(&self, offset: Vec2) -> bool {
        // walls are sorted by distance; a wall beyond `offset` hides nothing
        let reach = f64::from(offset.length()) * 1.001 + 0.001;
        let mut between = self.edges.iter().zip(&self.near.edges).take_while(|(_, wall)| wall.0 <= reach);
        between.any(|(edge, _)| is_between(edge.start, edge.end, offset))
    }
}

impl World {
    /// 3. Avoidance: local models choose velocities, and the limits of the bodies apply.
    pub(super) fn avoid(&mut self, seconds: f32) {
        if self.step.rest.all_asleep() {
            return;
        }
        let mut chosen_velocities = std::mem::take(&mut self.step.chosen_velocities);
        let mut scratch = std::mem::take(&mut self.step.avoiding);
        let mut by_place = std::mem::take(&mut self.step.by_place);
        chosen_velocities.resize(self.state.agents.len(), self.state.in_space_now());
        self.relax_queues();
        let limited = self.state.vehicles_limit_all();
        let common = if limited { None } else { self.common(seconds) };
        let world = &*self;
        if limited {
            parallel::ranges(chosen_velocities.rows(), |rows, chosen_velocities| {
                world.choose_preferred(rows, chosen_velocities)
            });
        } else if let Some(common) = common {
            let Self { step: StepMemory { rest, grid, near, .. }, .. } = world;
            by_place.resize(self.state.agents.len(), Vec2::ZERO);
            // neighbour lists are in the order of the grid
            parallel::ranges_with(&mut by_place[..], &mut scratch, |scratch, places, chosen_velocities| {
                let AvoidScratch { sight, workspace, lanes } = scratch;
                let mut one = |row: usize| world.choose_velocity(row, seconds, sight, workspace);
                rest.each_place(grid.order(), places, chosen_velocities, |places, chosen_velocities| {
                    world.avoid_many(&common, places, lanes, chosen_velocities, &mut one);
                });
            });
            parallel::ranges(&mut chosen_velocities.ground[..], |rows, chosen_velocities| {
                rest.each(rows, chosen_velocities, |rows, chosen_velocities| {
                    let places = &near.places()[rows];
                    chosen_velocities
                        .iter_mut()
                        .zip(places)
                        .for_each(|(chosen_velocity, &place)| *chosen_velocity = by_place[place as usize]);
                });
            });
        } else {
            parallel::ranges_with(
                chosen_velocities.rows(),
                &mut scratch,
                |AvoidScratch { sight, workspace, .. }, rows, chosen_velocities| {
                    world.step.rest.each(rows, chosen_velocities, |rows, mut chosen_velocities| {
                        rows.zip(0..).for_each(|(row, at)| {
                            set(&mut chosen_velocities, at, world.choose_velocity(row, seconds, sight, workspace))
                        });
                    });
                },
            );
        }
        (self.step.chosen_velocities, self.step.avoiding, self.step.by_place) = (chosen_velocities, scratch, by_place);
    }

    /// Computes the relaxed velocities of all agents, if many agents queued in the last sub-step: each has several others
    /// in its queue behind it.
    fn relax_queues(&mut self) {
        let queues =
            self.step.avoiding.iter_mut().map(|scratch| std::mem::take(&mut scratch.lanes.queues)).sum::<usize>();
        let mut relaxed = std::mem::take(&mut self.step.relaxed);
        relaxed.clear();
        if queues > self.state.agents.len() {
            relaxed.resize(self.state.agents.len(), Vec2::ZERO);
            let world = &*self;
            parallel::ranges(&mut relaxed[..], |rows, all| {
                rows.zip(all).for_each(|(row, relaxed)| *relaxed = world.relaxed(row, GRANTED));
            });
        }
        self.step.relaxed = relaxed;
    }

    /// As [`choose_velocity`](Self::choose_velocity), where the chosen velocity is the preferred velocity.
    fn choose_preferred(&self, rows: Range<usize>, (ground, vertical_velocity): Rows<'_>) {
        ground.copy_from_slice(&self.step.preferred.ground[rows.clone()]);
        for (row, vertical_velocity) in rows.zip(vertical_velocity.all) {
            *vertical_velocity = self.stays_down(row, self.step.preferred.at(row)).z;
        }
    }

    /// Returns the chosen velocity of an agent: the velocity that it will have unless the guard changes it.
    fn choose_velocity(&self, row: usize, seconds: f32, sight: &mut Visibility, workspace: &mut Workspace) -> Vec3 {
        if self.state.agents.script[row].is_some() {
            return self.step.preferred.at(row).clamp_length_max(self.state.agents.max_speed[row]);
        }
        if self.state.steering(row).is_some() && !self.state.model(row).avoids() {
            // its vehicle has already limited the velocity
            return self.stays_down(row, self.step.preferred.at(row));
        }
        let view = self.view(row, seconds, sight);
        let chosen = self.chosen_velocity(row, &view, workspace);
        self.state.limited_velocity(row, chosen, seconds)
    }

    /// Returns the velocity that the local model of an agent chooses.
    pub(super) fn chosen_velocity(&self, row: usize, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec3 {
        self.stays_down(row, self.state.model(row).velocity_in_space(view, workspace))
    }

    /// Removes the vertical velocity of an agent that is on the ground and does not prefer to rise.
    fn stays_down(&self, row: usize, chosen: Vec3) -> Vec3 {
        let stays = self.state.agents.altitude[row] == 0.0 && self.step.preferred.vertical_velocity(row) <= 0.0;
        if stays { chosen.with_z(0.0) } else { chosen }
    }

    /// Returns the input of the local model of an agent.
    pub(super) fn view<'a>(&self, row: usize, seconds: f32, sight: &'a mut Visibility) -> AvoidanceInput<'a> {
        let agents = &self.state.agents;
        self.state.see_walls(row, sight);
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

    /// Returns the input of the local model of an agent, with these walls and neighbours.
    pub(super) fn view_of<'a>(&self, row: usize, seconds: f32, sight: &'a Visibility) -> AvoidanceInput<'a> {
        let agents = &self.state.agents;
        let Visibility { neighbours, edges, discs, .. } = sight;
        AvoidanceInput {
            velocity: agents.velocity[row],
            heading: agents.heading[row],
            preferred: self.relaxed(row, seconds),
            vertical_velocity: agents.vertical_velocity[row],
            preferred_vertical_velocity: self.step.preferred.vertical_velocity(row),
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
            rng: self.state.rng(row),
        }
    }

    fn neighbour(&self, row: usize, other: usize, margin: f32) -> AvoidanceNeighbour {
        let agents = &self.state.agents;
        let yields = self.yields(row, other);
        let (share, room) = if agents.avoids(other, row) {
            let share = self.state.share(row, other, yields);
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
        AvoidanceNeighbour {
            offset,
            above: agents.above(row, other),
            vertical_velocity: agents.vertical_velocity[other],
            velocity: velocity - own_turn + self.granted(row, other, yields),
            preferred: self.step.preferred.ground[other],
            radii: (agents.radius[row] + agents.radius[other]) * margin
                + (agents.tracking_error[row] + agents.tracking_error[other]),
            outline,
            share,
            room,
            aside: if offset == Vec2::ZERO { self.state.aside(row, other) } else { Vec2::X },
        }
    }

    /// Returns the change of velocity that a yielding agent anticipates of an agent with the right of way: part of the
    /// change to its preferred velocity, if that brings it nearer.
    pub(super) fn granted(&self, row: usize, other: usize, yields: f32) -> Vec2 {
        let agents = &self.state.agents;
        if yields <= 0.0 {
            return Vec2::ZERO;
        }
        let velocity = agents.velocity_near(other, agents.position[row].as_dvec2());
        let queues = yields < YIELD_AT_REST;
        let relaxed = || self.step.relaxed.get(other).copied().unwrap_or_else(|| self.relaxed(other, GRANTED));
        let wanted = if queues { relaxed() } else { self.step.preferred.ground[other] } - velocity;
        let nearer = wanted.dot(agents.position[other] - agents.position[row]) < 0.0;
        if nearer { wanted * (GRANT * yields) } else { Vec2::ZERO }
    }

    /// Returns the extra avoidance share of an agent, beyond 0.5; the other agent has the negative of it. A walking
    /// agent goes before a standing one, unless the standing agent is at the goal of both. In a standoff, an agent that
    /// steps aside yields to an agent that goes first. Of two agents with the same goal, the agent with the shorter
    /// remaining distance goes first: this prevents stable arches at doors.
    pub(super) fn yields(&self, row: usize, other: usize) -> f32 {
        let agents = &self.state.agents;
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
}

impl State {
    /// Whether all agents steer and no local model avoids. Then the vehicles have already limited the velocities.
    fn vehicles_limit_all(&self) -> bool {
        self.all_steer() && self.groups_in_use().all(|group| !group.model.avoids())
    }

    pub(crate) fn model(&self, row: usize) -> &dyn LocalModel {
        &*self.local_groups[self.agents.group[row].index()].model
    }

    /// Finds the walls near an agent, and clears its neighbours.
    pub(crate) fn see_walls(&self, row: usize, sight: &mut Visibility) {
        let agents = &self.agents;
        let Visibility { near: walls, rows, neighbours, edges, discs } = sight;
        let at = agents.position[row].as_dvec2();
        let bound = agents.body(row).bounding_radius() + agents.tracking_error[row];
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

    /// Limits a chosen velocity to what the body can do.
    fn limited_velocity(&self, row: usize, chosen: Vec3, seconds: f32) -> Vec3 {
        let agents = &self.agents;
        let limits = Limits {
            speed: agents.max_speed[row],
            change: agents.max_acceleration[row] * seconds,
            turn: agents.max_turn_rate[row] * seconds,
        };
        let heading = agents.heading[row];
        let drives = agents.tracking_error[row] > 0.0;
        let chosen_velocity = if drives {
            follow(chosen.truncate(), heading, agents.max_turn_rate[row], seconds).extend(chosen.z)
        } else {
            chosen
        };
        limit(chosen_velocity, agents.velocity_in_space(row), heading, limits)
    }

    /// Returns the random number generator of an agent in this sub-step.
    pub(crate) fn rng(&self, row: usize) -> Rng {
        Rng { seed: self.settings.seed, number: self.agents.number[row], step: self.tally.sub_steps }
    }

    /// Returns the avoidance share of an agent towards another agent that avoids it too.
    pub(crate) fn share(&self, row: usize, other: usize, yields: f32) -> f32 {
        let priority = 0.5 * (self.agents.priority[other] - self.agents.priority[row]);
        (0.5 + priority + yields).clamp(0.0, 1.0)
    }

    /// Returns the direction in which two agents at the same position part. It is drawn for the pair; the other agent
    /// gets the opposite direction.
    fn aside(&self, row: usize, other: usize) -> Vec2 {
        let (a, b) = (self.agents.number[row], self.agents.number[other]);
        let draw = unit(self.settings.seed, a.min(b), u64::from(a.max(b)), Purpose::Coincident);
        let (sin, cos) = libm::sincosf(draw * std::f32::consts::TAU);
        if a < b { Vec2::new(cos, sin) } else { -Vec2::new(cos, sin) }
    }
}

/// Replaces the walls that an agent sees by their outlines relative to its core, for an agent that is not a disc: the
/// core touches walls, not only the centre.
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

/// Whether an edge lies between the agent and the point at `offset`; both are relative to the agent.
pub(super) fn is_between(start: Vec2, end: Vec2, offset: Vec2) -> bool {
    let along = end - start;
    offset.perp_dot(start) * offset.perp_dot(end) < 0.0 && along.perp_dot(-start) * along.perp_dot(offset - start) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::Settings;
    use crate::world::neighbour_data::{NavFlags, NeighbourData};
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
            world.add_agent(Agent { radius, priority, position: position.extend(0.0), ..Agent::default() }).unwrap();
        }
        world.step.shown = both
            .iter()
            .map(|&(_, goal, remaining, _, x, status)| {
                let goal = goal.map(GoalId);
                let way = if status == 0 {
                    NavFlags::walking(goal, Vec2::X, remaining)
                } else {
                    NavFlags::at_rest(goal, remaining)
                };
                NeighbourData::new(Vec2::new(x, 0.0), Vec2::ZERO, way)
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
            // the pair is free of collisions because the shares sum to 1 and the room is divided once
            prop_assert!((of_a.share + of_b.share - 1.0).abs() < 1e-6);
            prop_assert!((of_a.room + of_b.room - 1.0).abs() < 1e-6);
        }
    }

    /// Returns the extra share of the first of two agents.
    fn yields(status: [usize; 2], goals: [u32; 2], remaining: [f32; 2]) -> f32 {
        let one = |k: usize| (0.2, Some(goals[k]), remaining[k], 0.0, k as f32, status[k]);
        pair([one(0), one(1)]).yields(0, 1)
    }

    #[test]
    fn the_nearer_goes_first_and_walking_agents_before_standing_ones() {
        const WALKS: usize = 0;
        const RESTS: usize = 2;
        assert!(yields([WALKS; 2], [0, 0], [3.0, 2.0]) > 0.0, "the farther agent yields");
        assert!(yields([WALKS; 2], [0, 0], [2.0, 2.1]) < 0.0, "the nearer agent goes first");
        assert_eq!(yields([WALKS; 2], [0, 0], [2.0, 2.0]), 0.0, "equal agents share");
        assert_eq!(yields([WALKS; 2], [0, 1], [3.0, 2.0]), 0.0, "an agent with another goal is not ahead");
        assert!(yields([RESTS, WALKS], [0, 1], [0.0, 2.0]) > 0.0, "a standing agent makes way");
        assert_eq!(yields([RESTS, WALKS], [0, 0], [0.0, 2.0]), 0.0, "but not at the goal of both");
        assert_eq!(yields([RESTS; 2], [0, 1], [0.0, 0.0]), 0.0);
    }
}

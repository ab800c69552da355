//! Stage 3, avoidance: local models choose velocities, and the limits of the bodies apply.

use super::batch::AvoidanceShared;
use super::crowd::CrowdScratch;
use super::{
    AvoidanceInput, AvoidanceNeighbour, LocalModel, NearDisc, NearEdge, Outline, SimdInput, Workspace, margin,
};
use crate::intend::{Rows, Velocities, YIELD_AT_REST};
use crate::motion::{Limits, follow, limit};
use crate::navigate::{NeighbourData, Surroundings};
use crate::parallel;
use crate::perceive::{Grid, Perceived, SubStep};
use crate::random::{Purpose, unit};
use crate::sleep::SleepBlocks;
use crate::space::{Core, Disc, Edge, NearWalls, is_between};
use crate::world::State;
use glam::{DVec2, Vec2, Vec3};
use std::ops::Range;

/// Part of the preferred change of velocity of an agent with the right of way that the yielding agent anticipates,
/// divided by the extra share of the yielding agent.
const GRANT: f32 = 2.0;
/// The change anticipated of an agent in the same queue is its relaxed change in this time, seconds. A longer time
/// would drive the agents behind it back.
const GRANTED: f32 = 0.04;

/// Scratch memory of a thread.
#[derive(Clone, Debug, Default)]
pub(super) struct AvoidScratch {
    pub sight: Visibility,
    pub workspace: Workspace,
    pub input: SimdInput,
    /// Pairs of which one queues behind the other.
    pub queues: usize,
}

/// The walls and neighbours that an agent takes into account.
#[derive(Clone, Debug, Default)]
pub(crate) struct Visibility {
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

/// 3. Avoidance: local models choose velocities, and the limits of the bodies apply.
#[derive(Clone, Debug, Default)]
pub(crate) struct Avoid {
    scratch: Vec<AvoidScratch>,
    shared: AvoidanceShared,
    /// Velocities that queueing agents expect of the agents ahead, by row; empty if few agents queue.
    relaxed: Vec<Vec2>,
    chosen: Velocities,
    /// Chosen velocities in the order of the grid.
    by_place: Velocities,
    crowd: CrowdScratch,
}

/// What the chosen velocity of an agent depends on.
#[derive(Clone, Copy)]
pub(crate) struct Avoiding<'a> {
    pub state: &'a State,
    pub grid: &'a Grid,
    pub around: Surroundings<'a>,
    pub preferred: &'a Velocities,
    pub shared: &'a AvoidanceShared,
    pub relaxed: &'a [Vec2],
}

impl Avoid {
    /// Chooses the velocities of all agents that do not sleep.
    pub fn run(
        &mut self,
        state: &State,
        (seen, shown): (Perceived<'_>, &[NeighbourData]),
        preferred: &Velocities,
        sleep: &SleepBlocks,
        SubStep { seconds, .. }: SubStep,
    ) -> &mut Velocities {
        if sleep.all_asleep() {
            return &mut self.chosen;
        }
        self.chosen.resize(state.agents.len(), state.in_space_now());
        self.relax_queues(state, (seen, shown), preferred);
        let limited = !state.any_needs_model();
        if !limited {
            self.shared.find(state, preferred, seconds);
        }
        let Self { scratch, shared, relaxed, chosen, by_place, crowd } = self;
        let around = Surroundings { state, near: seen.near, shown };
        let avoiding = Avoiding { state, grid: seen.grid, around, preferred, shared, relaxed };
        if limited {
            parallel::ranges(chosen.rows(), |rows, chosen| avoiding.choose_preferred(rows, chosen));
            return &mut self.chosen;
        }
        by_place.resize(state.agents.len(), state.in_space_now());
        // neighbour lists are in the order of the grid
        parallel::costly_ranges_with(by_place.rows(), scratch, |scratch, places, chosen| {
            sleep.each_place(seen.grid.order(), places, chosen, |places, chosen| {
                avoiding.choose_many(places, scratch, chosen);
            });
        });
        parallel::ranges(chosen.rows(), |rows, chosen| {
            sleep.each(rows, chosen, |rows, chosen| by_place.copy(&seen.near.places()[rows], chosen));
        });
        avoiding.choose_together(crowd, chosen);
        &mut self.chosen
    }

    /// Returns the chosen velocities of the last sub-step.
    pub fn chosen(&self) -> &Velocities {
        &self.chosen
    }

    /// Computes the relaxed velocities of all agents, if many agents queued in the last sub-step: each has several others
    /// in its queue behind it.
    fn relax_queues(
        &mut self,
        state: &State,
        (seen, shown): (Perceived<'_>, &[NeighbourData]),
        preferred: &Velocities,
    ) {
        let queues = self.scratch.iter_mut().map(|scratch| std::mem::take(&mut scratch.queues)).sum::<usize>();
        let Self { shared, relaxed, .. } = self;
        relaxed.clear();
        if queues > state.agents.len() {
            relaxed.resize(state.agents.len(), Vec2::ZERO);
            let around = Surroundings { state, near: seen.near, shown };
            let avoiding = Avoiding { state, grid: seen.grid, around, preferred, shared, relaxed: &[] };
            parallel::ranges(&mut relaxed[..], |rows, all| {
                rows.zip(all).for_each(|(row, relaxed)| *relaxed = avoiding.relaxed_velocity(row, GRANTED));
            });
        }
    }

    /// Returns what the choices of the last sub-step depended on.
    pub fn avoiding<'a>(&'a self, around: Surroundings<'a>, grid: &'a Grid, preferred: &'a Velocities) -> Avoiding<'a> {
        let Self { shared, relaxed, .. } = self;
        Avoiding { state: around.state, grid, around, preferred, shared, relaxed }
    }
}

impl Avoiding<'_> {
    /// As [`choose_velocity`](Self::choose_velocity), where the chosen velocity is the preferred velocity.
    fn choose_preferred(&self, rows: Range<usize>, (ground, vertical_velocity): Rows<'_>) {
        ground.copy_from_slice(&self.preferred.ground[rows.clone()]);
        for (row, vertical_velocity) in rows.zip(vertical_velocity.all) {
            *vertical_velocity = self.stays_down(row, self.preferred.at(row)).z;
        }
    }

    /// Returns the chosen velocity of an agent: the velocity that it will have unless the guard changes it.
    pub(super) fn choose_velocity(
        &self,
        row: usize,
        seconds: f32,
        sight: &mut Visibility,
        workspace: &mut Workspace,
    ) -> Vec3 {
        if self.state.agents.script[row].is_some() {
            return self.preferred.at(row).clamp_length_max(self.state.agents.max_speed[row]);
        }
        if !self.state.needs_model(row) {
            // its vehicle has already limited the velocity
            return self.stays_down(row, self.preferred.at(row));
        }
        let view = self.view(row, seconds, sight);
        let chosen = self.chosen_velocity(row, &view, workspace);
        self.state.limited_velocity(row, chosen, seconds)
    }

    /// Returns the velocity that the local model of an agent chooses.
    pub fn chosen_velocity(&self, row: usize, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec3 {
        self.stays_down(row, self.state.model(row).velocity_in_space(view, workspace))
    }

    /// Removes the vertical velocity of an agent that is on the ground and does not prefer to rise.
    pub(super) fn stays_down(&self, row: usize, chosen: Vec3) -> Vec3 {
        let stays = self.state.agents.altitude[row] == 0.0 && self.preferred.vertical_velocity(row) <= 0.0;
        if stays { chosen.with_z(0.0) } else { chosen }
    }

    /// Returns the input of the local model of an agent.
    pub fn view<'a>(&self, row: usize, seconds: f32, sight: &'a mut Visibility) -> AvoidanceInput<'a> {
        self.see(row, seconds, sight);
        self.view_of(row, seconds, sight)
    }

    /// Finds the walls and neighbours that an agent takes into account.
    pub(super) fn see(&self, row: usize, seconds: f32, sight: &mut Visibility) {
        let agents = &self.state.agents;
        self.state.see_walls(row, sight);
        let margin = margin(seconds);
        for &near in self.around.neighbours(row) {
            let other = near as usize;
            if !sight.hides(agents.offset(row, other)) && !self.around.squeezes_past(row, other) {
                sight.rows.push(near);
                sight.neighbours.push(self.neighbour(row, other, margin));
            }
        }
        if !agents.is_disc(row) {
            see_with_core(&agents.core_of(row), &mut sight.edges, &mut sight.discs);
        }
    }

    /// Returns the input of the local model of an agent, with these walls and neighbours.
    pub fn view_of<'a>(&self, row: usize, seconds: f32, sight: &'a Visibility) -> AvoidanceInput<'a> {
        let agents = &self.state.agents;
        let Visibility { neighbours, edges, discs, .. } = sight;
        AvoidanceInput {
            velocity: agents.velocity[row],
            heading: agents.heading[row],
            preferred: self.relaxed_velocity(row, seconds),
            vertical_velocity: agents.vertical_velocity[row],
            preferred_vertical_velocity: self.preferred.vertical_velocity(row),
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
        let yields = self.around.yields(row, other);
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
            preferred: self.preferred.ground[other],
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
    pub fn granted(&self, row: usize, other: usize, yields: f32) -> Vec2 {
        let agents = &self.state.agents;
        if yields <= 0.0 {
            return Vec2::ZERO;
        }
        let velocity = agents.velocity_near(other, agents.position[row].as_dvec2());
        let queues = yields < YIELD_AT_REST;
        let relaxed = || self.relaxed.get(other).copied().unwrap_or_else(|| self.relaxed_velocity(other, GRANTED));
        let wanted = if queues { relaxed() } else { self.preferred.ground[other] } - velocity;
        let nearer = wanted.dot(agents.position[other] - agents.position[row]) < 0.0;
        if nearer { wanted * (GRANT * yields) } else { Vec2::ZERO }
    }
}

impl State {
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
    pub(super) fn limited_velocity(&self, row: usize, chosen: Vec3, seconds: f32) -> Vec3 {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigate::NavFlags;
    use crate::perceive::Neighbours;
    use crate::{Agent, GoalId, Settings, World};
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

    /// Calls `work` with two agents.
    fn with_pair<R>(both: [One; 2], work: impl FnOnce(Avoiding<'_>) -> R) -> R {
        let mut world = World::new(Settings::default()).unwrap();
        for (radius, _, _, priority, x, _) in both {
            let position = DVec2::new(x.into(), 0.0);
            world.add_agent(Agent { radius, priority, position: position.extend(0.0), ..Agent::default() }).unwrap();
        }
        let shown: Vec<NeighbourData> = both
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
        let mut preferred = Velocities::default();
        preferred.resize(2, false);
        let (state, near, grid) = (&world.state, &Neighbours::default(), &Grid::default());
        let around = Surroundings { state, near, shown: &shown };
        let shared = &AvoidanceShared::default();
        work(Avoiding { state, grid, around, preferred: &preferred, shared, relaxed: &[] })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn what_one_yields_the_other_gains(a in one(), b in one()) {
            let [(yields_a, of_a), (yields_b, of_b)] = with_pair([a, b], |pair| {
                [(0, 1), (1, 0)].map(|(row, other)| (pair.around.yields(row, other), pair.neighbour(row, other, 1.0)))
            });
            prop_assert_eq!(yields_a, -yields_b);
            // the pair is free of collisions because the shares sum to 1 and the room is divided once
            prop_assert!((of_a.share + of_b.share - 1.0).abs() < 1e-6);
            prop_assert!((of_a.room + of_b.room - 1.0).abs() < 1e-6);
        }
    }

    /// Returns the extra share of the first of two agents.
    fn yields(status: [usize; 2], goals: [u32; 2], remaining: [f32; 2]) -> f32 {
        let one = |k: usize| (0.2, Some(goals[k]), remaining[k], 0.0, k as f32, status[k]);
        with_pair([one(0), one(1)], |pair| pair.around.yields(0, 1))
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

//! Builds a world from a plan.

use super::intervene::Interventions;
use super::plan::{Plan, PlannedField};
use crate::error::{Error, Kind};
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::scene::{Colour, Scene};
use std::ops::Range;
use std::sync::Arc;
use throng::space::Pathway;
use throng::space::surface::{Barrier, Surface};
use throng::{GoalId, GroupId, Journey, JourneyId, ScriptId, Stop, World};

/// A built scene: the ids of its parts, for programs that draw or measure it.
#[derive(Clone, Debug)]
pub struct Built {
    /// The scene's groups, in its order, then one for each mover.
    pub groups: Vec<BuiltGroup>,
    /// The number of agents, present and future, without movers.
    pub agents: usize,
    /// The number of agents that enter later.
    pub entering: usize,
    /// Every goal and its id.
    pub goals: Vec<(GoalId, throng::Goal)>,
    /// The walkable ground; none: everywhere.
    pub walkable: Vec<throng::Walkable>,
    /// The obstacles, in the scene's order.
    pub obstacles: Vec<throng::Obstacle>,
    /// Surfaces that behaviours steer by and their names, in the scene's order, relative to the world's origin.
    pub surfaces: Vec<(String, Barrier<Arc<dyn Surface>>)>,
    /// Paths that behaviours steer by and their names, in the scene's order, relative to the world's origin.
    pub paths: Vec<(String, Arc<Pathway>)>,
    /// Fields, in the scene's order, relative to the world's origin.
    pub fields: Vec<PlannedField>,
    /// Notes about things that are valid but may not be intended, a sentence each.
    pub notes: Vec<String>,
    /// The interventions of the scene.
    pub interventions: Interventions,
    /// Lower left and upper right corner of everything except surfaces and paths, metres.
    pub bounds: [DVec2; 2],
}

/// A group that was built.
#[derive(Clone, Debug, PartialEq)]
pub struct BuiltGroup {
    /// Its name.
    pub name: String,
    /// Its id.
    pub id: GroupId,
    /// Its agents' numbers ([`throng::Agent::number`]).
    pub numbers: Range<u32>,
    /// Its colour, if the scene sets one.
    pub colour: Option<Colour>,
}

impl Scene {
    /// Builds the world that this scene describes. The same scene gives the same world on every machine.
    ///
    /// # Errors
    /// Those of [`Scene::plan`], and errors of the world.
    pub fn build(&self) -> Result<(World, Built), Error> {
        self.build_from(self.plan()?)
    }

    /// Builds the world of this scene without the agents of its groups, and without their goals. A program adds agents of its
    /// own: [`agent_of`](Self::agent_of).
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn build_without_agents(&self) -> Result<(World, Built), Error> {
        self.build_from(self.plan_without_agents()?)
    }

    fn build_from(&self, plan: Plan) -> Result<(World, Built), Error> {
        let mut world = World::new(plan.settings).map_err(|error| self.refused("time", None, &error))?;
        if !plan.walkable.is_empty() {
            world.set_walkable(plan.walkable.clone()).map_err(|error| self.refused("walkable", None, &error))?;
        }
        let added = world.add_obstacles(plan.obstacles.iter().cloned());
        added.map_err(|(index, error)| self.refused("obstacle", Some(index), &error))?;
        let groups: Vec<GroupId> = self.each(&plan.groups, |group| world.add_group(group.clone()))?;
        let goals: Vec<GoalId> = self.each(&plan.goals, |goal| world.add_goal(goal.clone()))?;
        let journeys: Vec<JourneyId> = self.each(&plan.journeys, |journey| {
            let stops = journey.stops.iter().map(|(goal, wait)| Stop { goal: goals[*goal], wait: *wait });
            world.add_journey(Journey { stops: stops.collect(), repeat: journey.repeat })
        })?;
        self.each(&plan.choices, |choice| {
            world.add_choice(&choice.iter().map(|&journey| journeys[journey]).collect::<Vec<_>>())
        })?;
        let scripts: Vec<ScriptId> = plan
            .scripts
            .iter()
            .enumerate()
            .map(|(i, script)| world.add_script(script.clone()).map_err(|error| self.refused("mover", Some(i), &error)))
            .collect::<Result<_, Error>>()?;
        let mut built = self.built(&plan, &groups, &goals);
        let mut unturned = vec![];
        world.reserve(plan.agents.len());
        for planned in &plan.agents {
            let mut agent = planned.agent.clone();
            agent.group = groups[planned.group];
            agent.script = planned.script.map(|script| scripts[script]);
            agent.journey = planned.journey.map_or(JourneyId::STAY, |journey| journeys[journey]);
            let given = agent.heading.is_some();
            let added = match planned.enters {
                Some(time) => world.schedule_agent(time, agent),
                None => world.add_agent(agent).map(|id| {
                    if !given {
                        unturned.push(id)
                    }
                }),
            };
            added.map_err(|error| match planned.script {
                Some(mover) => self.refused("mover", Some(mover), &error),
                None => self.refused("group", Some(planned.group), &error),
            })?;
        }
        self.check_long_bodies(&world, &built)?;
        world.face_ways(&unturned);
        let wrong = |problem| self.explain(problem);
        built.interventions = self.interventions_of(&plan, &groups, &journeys).map_err(wrong)?;
        super::rules::begin(self, plan.rules, &built.interventions, &mut world).map_err(wrong)?;
        Ok((world, built))
    }

    /// Returns the interventions of the scene, for the groups and journeys of its world.
    fn interventions_of(
        &self,
        plan: &Plan,
        groups: &[GroupId],
        journeys: &[JourneyId],
    ) -> Result<Interventions, Problem> {
        let of = |k: usize| {
            let agents = plan.agents.iter().filter(|planned| planned.group == k);
            let agents = agents.map(|planned| throng::Agent {
                group: groups[k],
                journey: planned.journey.map_or(JourneyId::STAY, |journey| journeys[journey]),
                velocity: glam::Vec2::ZERO,
                ..planned.agent.clone()
            });
            (plan.groups[k].name.clone(), agents.collect())
        };
        Interventions::new(self, (0..self.groups.len()).map(of).collect(), &plan.obstacles)
    }

    fn built(&self, plan: &Plan, ids: &[GroupId], goals: &[GoalId]) -> Built {
        let mut first = 0;
        let mut groups = vec![];
        let colours = self.groups.iter().map(|group| group.colour);
        let colours = colours.chain(self.movers.iter().map(|mover| mover.colour));
        for (i, (colour, id)) in colours.zip(ids).enumerate() {
            let count = plan.agents[first as usize..].iter().take_while(|agent| agent.group == i).count() as u32;
            let name = plan.groups[i].name.clone();
            groups.push(BuiltGroup { name, id: *id, numbers: first..first + count, colour });
            first += count;
        }
        Built {
            groups,
            agents: plan.agents.len() - plan.scripts.len(),
            entering: plan.agents.iter().filter(|agent| agent.enters.is_some()).count(),
            goals: goals.iter().copied().zip(plan.goals.iter().cloned()).collect(),
            walkable: plan.walkable.clone(),
            obstacles: plan.obstacles.clone(),
            surfaces: self.surfaces.iter().map(|said| said.name.clone()).zip(plan.surfaces.iter().cloned()).collect(),
            paths: self.paths.iter().map(|said| said.name.clone()).zip(plan.paths.iter().cloned()).collect(),
            fields: plan.fields.clone(),
            notes: plan.notes.clone(),
            interventions: Interventions::default(),
            bounds: plan.bounds,
        }
    }

    /// Checks that bodies that are not discs do not overlap, now that they have headings: they were placed by their
    /// clearance radii. Guarded agents must not overlap.
    fn check_long_bodies(&self, world: &World, built: &Built) -> Result<(), Error> {
        if world.relative_columns().all_discs() {
            return Ok(());
        }
        let group_of = |number: u32| built.groups.iter().position(|group| group.numbers.contains(&number));
        let guarded = |group: usize| world.group(built.groups[group].id).guard;
        for (a, b, _) in world.overlapping() {
            let (Some(first), Some(second)) = (group_of(a), group_of(b)) else { continue };
            if guarded(first) || guarded(second) {
                let name = |group: usize, number: u32| {
                    let BuiltGroup { name, numbers, .. } = &built.groups[group];
                    format!("agent {} of `{name}`", number - numbers.start)
                };
                let message = format!("{} and {} overlap at the start", name(first, a), name(second, b));
                let path = match second.checked_sub(self.groups.len()) {
                    Some(mover) => Path::of("mover").index(mover),
                    None => Path::of("group").index(second).key("place"),
                };
                let problem = Problem::new(&path, Kind::Overlap, message);
                return Err(self.explain(problem.hint("move them apart, or turn them")));
            }
        }
        Ok(())
    }

    /// Adds each item of a list to the world.
    fn each<T, I>(&self, list: &[T], mut add: impl FnMut(&T) -> Result<I, throng::Error>) -> Result<Vec<I>, Error> {
        list.iter().map(|item| add(item).map_err(|error| self.refused("group", None, &error))).collect()
    }

    /// Returns an error of the world, with the position of the rejected part in the scene.
    pub(super) fn refused(&self, key: &str, index: Option<usize>, error: &throng::Error) -> Error {
        let path = index.map_or_else(|| Path::of(key), |index| Path::of(key).index(index));
        self.explain(Problem::new(&path, Kind::World, error.to_string()))
    }
}

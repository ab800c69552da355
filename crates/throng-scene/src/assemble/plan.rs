//! A plan: everything that a scene puts into a world, before the world exists.

use super::agents::{AgentDraw, shared};
use super::check::{check_altitude, check_scene, in_group};
use super::count::{Count, counts};
use super::flow::Flows;
use super::goals::GoalPlanner;
use super::ground::{self, GroundError};
use super::movers;
use super::place::{Middle, PlacementGround};
use super::rules;
use super::size::Size;
use super::steer::{Around, BehaviourContext, in_world};
use super::surface;
use crate::error::Error;
use crate::file::{Path, Problem};
use crate::geometry::{DVec2, Solid, bounds};
use crate::registry::{ChosenPlacement, GoalContext, GoalTree};
use crate::scene::{Group, Mover, Scene, SceneNames, Walkable};
use std::cell::{Cell, OnceCell, RefCell};
use std::fmt;
use std::sync::Arc;
use throng::agent::Guidance;
use throng::field::Field;
use throng::space::surface::{Barrier, Surface};
use throng::space::{Pathway, Place};
use throng_field::Anchor;

/// Everything that a scene puts into a world: [`Scene::build`] adds it in this order.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The settings of the world.
    pub settings: throng::Settings,
    /// The walkable ground; none: everywhere.
    pub walkable: Vec<throng::Walkable>,
    /// The obstacles, in the scene's order.
    pub obstacles: Vec<throng::Obstacle>,
    /// Surfaces that behaviours steer by, in the scene's order, relative to the settings' origin.
    pub surfaces: Vec<Barrier<Arc<dyn Surface>>>,
    /// Paths that behaviours steer by, in the scene's order, relative to the settings' origin.
    pub paths: Vec<Arc<Pathway>>,
    /// Fields, in the scene's order, relative to the settings' origin.
    pub fields: Vec<PlannedField>,
    /// Notes about things that are valid but may not be intended.
    pub notes: Vec<String>,
    /// The groups, in the scene's order, then one for each mover.
    pub groups: Vec<throng::Group>,
    /// The rules of the scene's game, if it has rules.
    pub rules: Option<Arc<dyn throng::Rules>>,
    /// All goals.
    pub goals: Vec<throng::Goal>,
    /// All journeys.
    pub journeys: Vec<PlannedJourney>,
    /// Indices of journeys that are alternatives to each other: agents change to the shorter queue.
    pub choices: Vec<Vec<usize>>,
    /// All scripts.
    pub scripts: Vec<throng::Script>,
    /// All agents, group by group, then the movers; their index is their number.
    pub agents: Vec<PlannedAgent>,
    /// Lower left and upper right corner of everything except surfaces and paths, metres.
    pub bounds: [DVec2; 2],
}

/// A field of a [`Plan`].
#[derive(Clone)]
pub struct PlannedField {
    /// Its name.
    pub name: String,
    /// The velocities of the field.
    pub field: Arc<dyn Field>,
    /// The anchors of a sketch; empty for other fields.
    pub anchors: Vec<Anchor>,
}

impl fmt::Debug for PlannedField {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("PlannedField").field("name", &self.name).field("anchors", &self.anchors).finish_non_exhaustive()
    }
}

/// A journey of a [`Plan`].
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedJourney {
    /// The stops: index in [`Plan::goals`], and seconds to wait there.
    pub stops: Vec<(usize, f32)>,
    /// Whether the journey starts again after the last stop.
    pub repeat: bool,
}

/// An agent of a [`Plan`].
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedAgent {
    /// The agent; its group and journey are filled in when the world is built.
    pub agent: throng::Agent,
    /// Index in [`Plan::groups`].
    pub group: usize,
    /// Index in [`Plan::journeys`]; `None`: it stays.
    pub journey: Option<usize>,
    /// Index in [`Plan::scripts`]; `None`: it follows no script.
    pub script: Option<usize>,
    /// When it enters, seconds; `None`: it is there from the start.
    pub enters: Option<f64>,
}

impl Scene {
    /// Checks the scene and lays it out: the start position and the journey of every agent.
    ///
    /// # Errors
    /// A number is out of its limits, a polygon crosses itself, agents overlap each other or a wall, agents do not fit,
    /// goals are in walls, or there are no or too many agents. The error has file, line, column and a hint.
    pub fn plan(&self) -> Result<Plan, Error> {
        self.lay_out(counts).map_err(|wrong| self.error_of(wrong))
    }

    /// Checks and lays out everything but the agents of the groups, and their goals.
    pub(super) fn plan_without_agents(&self) -> Result<Plan, Error> {
        let none = |scene: &Self, _: &[ChosenPlacement]| {
            Ok(scene.groups.iter().map(|_| Count { agents: 0, enters: None }).collect())
        };
        self.lay_out(none).map_err(|wrong| self.error_of(wrong))
    }

    /// Returns the `k`-th agent that a group draws, with its body and its speeds, but without a place, a goal, a number
    /// and its ids, for programs that place the agents themselves.
    ///
    /// ```
    /// let scene = throng_scene::gallery::scene("circle")?;
    /// assert_eq!(scene.agent_of(0, 5).preferred_speed, scene.plan()?.agents[5].agent.preferred_speed);
    /// # Ok::<(), throng_scene::Error>(())
    /// ```
    ///
    /// # Panics
    /// If there is no such group.
    pub fn agent_of(&self, group: usize, k: usize) -> throng::Agent {
        let draw = AgentDraw::new(self, group);
        draw.agent(k).with_body(draw.size(k).body)
    }

    /// Returns the walkable ground (none: everywhere) and the obstacles. The scene needs no agents: it may be a map.
    ///
    /// # Errors
    /// A number is out of its limits, a polygon crosses itself, or a floor plan cannot be read. The error has file,
    /// line, column and a hint.
    pub fn ground(&self) -> Result<(Vec<throng::Walkable>, Vec<throng::Obstacle>), Error> {
        let both = || -> Result<_, GroundError> {
            check_scene(self)?;
            Ok((ground::areas(self, &mut vec![])?, ground::obstacles(self)?))
        };
        both().map_err(|wrong| self.error_of(wrong))
    }

    fn error_of(&self, wrong: GroundError) -> Error {
        match wrong {
            GroundError::Problem(problem) => self.explain(problem),
            GroundError::Error(error) => *error,
        }
    }

    /// Converts a problem to an error with its position in the file.
    pub(crate) fn explain(&self, problem: Problem) -> Error {
        match &self.origin.document {
            Some(document) => document.explain(problem),
            None => {
                let mut error = Error::new(problem.kind, problem.message);
                error.hint = problem.hint;
                error
            }
        }
    }

    /// Lays out the scene with as many agents as `counts` returns.
    fn lay_out(
        &self,
        counts: impl Fn(&Self, &[ChosenPlacement]) -> Result<Vec<Count>, Problem>,
    ) -> Result<Plan, GroundError> {
        check_scene(self)?;
        let mut notes = vec![];
        let walkable = ground::areas(self, &mut notes)?;
        let places = self.places(&walkable)?;
        let counts = counts(self, &places)?;
        let chosen = self.goals(&counts)?;
        let obstacles = ground::obstacles(self)?;
        let draws: Vec<AgentDraw> = (0..self.groups.len()).map(|group| AgentDraw::new(self, group)).collect();
        let sizes: Vec<Vec<Size>> =
            draws.iter().zip(&counts).map(|(draw, count)| (0..count.agents).map(|k| draw.size(k)).collect()).collect();
        let altitudes: Vec<Vec<f64>> = draws
            .iter()
            .zip(&counts)
            .map(|(draw, count)| (0..count.agents).map(|k| draw.altitude(k)).collect())
            .collect();
        let largest = sizes.iter().flatten().fold(0.0_f64, |most, size| most.max(size.bound));
        let solid = Solid::new(&walkable, &obstacles, largest);
        let enters: Vec<bool> = counts.iter().map(|count| count.enters.is_some()).collect();
        let (sizes, altitudes) = (&sizes, &altitudes);
        let ground = PlacementGround { scene: self, solid: &solid, places: &places, sizes, altitudes, enters: &enters };
        let starts = ground.place()?;

        let mut goals = GoalPlanner::new(self, &solid, (&walkable, &obstacles));
        let mut agents = Vec::with_capacity(sizes.iter().map(Vec::len).sum());
        for (i, (count, goal)) in counts.iter().zip(chosen).enumerate() {
            let middle = Middle::of(&places[i], &starts[i]);
            let journeys = goals.journeys_of(i, goal, &starts[i], &sizes[i], middle)?;
            for (k, journey) in journeys.into_iter().enumerate() {
                let (position, number) = (starts[i][k], Some(agents.len() as u32));
                let agent = throng::Agent { position, number, ..draws[i].agent(k) }.with_body(sizes[i][k].body);
                let enters = count.enters.as_ref().map(|times| times[k]);
                agents.push(PlannedAgent { agent, group: i, journey, script: None, enters });
            }
        }
        let GoalPlanner { goals, journeys, choices, .. } = goals;
        let scripts = movers::add(self, &mut agents);
        let bounds = all_bounds(&walkable, &obstacles, &goals, &agents);
        let settings = throng::Settings {
            step: self.time.step,
            sub_steps: self.time.sub_steps.into(),
            seed: self.seed,
            // whole metres: coordinates with few decimals keep them in f32
            origin: ((bounds[0] + bounds[1]) * 0.5).round(),
        };
        let surfaces = surface::surfaces(self, settings.origin)?;
        let paths = surface::paths(self, settings.origin)?;
        let around = Around::new(self, settings.origin, (&surfaces, &paths), (&walkable, &obstacles))?;
        let first = |group| agents.partition_point(|agent| agent.group < group) as u32;
        let names: Vec<String> = self.names().collect();
        let named = names.iter().enumerate().map(|(i, name)| (name.as_str(), first(i)..first(i + 1)));
        let named: Vec<_> = named.collect();
        let cast = SceneNames { origin: settings.origin, obstacles: &obstacles, named: &named, paths: &around.paths };
        let rules = rules::make(self, &cast)?;
        let figures = rules.as_ref().map_or_else(Vec::new, |rules| rules.figures());
        let notes = RefCell::new(notes);
        let place = Place { areas: walkable.clone(), obstacles: obstacles.iter().cloned().map(Some).collect() };
        let (origin, place) = (settings.origin, &place);
        let made = OnceCell::new();
        let flows = Flows { scene: self, origin, bounds, place, around: &around, notes: &notes, made };
        let made = flows.all()?;
        let named = self.fields.iter().zip(made);
        let fields = named.map(|(said, made)| PlannedField {
            name: said.name.clone(),
            field: made.field.clone(),
            anchors: made.anchors.clone(),
        });
        let fields = fields.collect();
        let groups = self.shared(&cast, &figures, &around, &flows)?;
        super::flow::note_silence(&groups, &agents, settings.origin, &notes);
        let plan = Plan {
            settings,
            walkable,
            obstacles,
            surfaces,
            paths,
            fields,
            notes: notes.into_inner(),
            groups,
            rules,
            goals,
            journeys,
            choices,
            scripts,
            agents,
            bounds,
        };
        Ok(plan)
    }

    /// Returns the placement of each group.
    fn places(&self, walkable: &[throng::Walkable]) -> Result<Vec<ChosenPlacement>, Problem> {
        let one = |(i, group): (usize, &Group)| {
            let at = Path::of("group").index(i);
            let place = self.plugins.placements.make(&group.place, walkable, &at.key("place"));
            place.and_then(|place| check_altitude(&at, group, place)).map_err(|problem| in_group(i, group, problem))
        };
        self.groups.iter().enumerate().map(one).collect()
    }

    /// Returns the goals of each group; `None`: its agents stay.
    fn goals(&self, counts: &[Count]) -> Result<Vec<Option<GoalTree>>, Problem> {
        let ring = match self.walkable {
            Some(Walkable::Ring(ring)) => Some(ring),
            _ => None,
        };
        let one = |(i, (group, count)): (usize, (&Group, &Count))| {
            let Some(goal) = &group.goal else { return Ok(None) };
            let path = Path::of("group").index(i).key("goal");
            let (goals, n, rules) = (&self.plugins.goals, count.agents, &Cell::new(0));
            let made = goals.make(goal, &GoalContext { goals, ring, n, rules, is_stop: false, path });
            made.map(Some).map_err(|problem| in_group(i, group, problem))
        };
        self.groups.iter().zip(counts).enumerate().map(one).collect()
    }

    /// Returns the names of the groups, then of the movers.
    fn names(&self) -> impl Iterator<Item = String> {
        let groups = self.groups.iter().enumerate().map(|(i, group)| Group::name_at(&group.name, i));
        groups.chain(self.movers.iter().enumerate().map(|(i, mover)| Mover::name_at(&mover.name, i)))
    }

    /// Returns the groups of the world, with the shared properties of their agents, then those of the movers.
    fn shared(
        &self,
        cast: &SceneNames,
        figures: &[String],
        around: &Around,
        flows: &Flows,
    ) -> Result<Vec<throng::Group>, GroundError> {
        let one = |(i, group): (usize, &Group)| {
            let making = BehaviourContext { scene: self, cast, figures, around, flows, group: i };
            let field = flows.governed(i, |name| cast.find(name).ok().map(|(position, _)| in_world(position)))?;
            let (behaviour, solid) = (making.steering()?, making.solid()?);
            let name = cast.named[i].0.to_owned();
            let chosen = self.plugins.models.make(&group.local_model(), &Path::of("group").index(i).key("avoid"))?;
            Ok(throng::Group { solid, ..shared(group, name, chosen, Guidance { behaviour, field }, cast.origin) })
        };
        let groups: Vec<throng::Group> = self.groups.iter().enumerate().map(one).collect::<Result<_, GroundError>>()?;
        Ok(groups.into_iter().chain(movers::groups(self)).collect())
    }
}

/// Returns the lower left and upper right corner of everything.
fn all_bounds(
    walkable: &[throng::Walkable],
    obstacles: &[throng::Obstacle],
    goals: &[throng::Goal],
    agents: &[PlannedAgent],
) -> [DVec2; 2] {
    let ground = walkable.iter().flat_map(|area| area.outer.iter().copied());
    let solid = obstacles.iter().flat_map(|obstacle| match obstacle {
        throng::Obstacle::Circle { center, radius } => vec![*center - *radius, *center + *radius],
        throng::Obstacle::Polygon { corners } => corners.clone(),
        throng::Obstacle::Wall { points } => points.clone(),
    });
    let goals = goals.iter().flat_map(|goal| goal.corners().map_or_else(|| vec![goal.middle()], <[DVec2]>::to_vec));
    let bodies = agents.iter().flat_map(|planned| {
        let radius = f64::from(planned.agent.body().bounding_radius());
        [planned.agent.position - radius, planned.agent.position + radius].map(|corner| corner.truncate())
    });
    bounds(ground.chain(solid).chain(goals).chain(bodies)).unwrap_or_default()
}

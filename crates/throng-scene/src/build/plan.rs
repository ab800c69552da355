//! A plan: everything a scene puts into a world, before there is a world.

use super::agents::{Draw, shared};
use super::check::check_scene;
use super::count::counts;
use super::flow::Flows;
use super::goals::Goals;
use super::ground::{self, Wrong};
use super::movers;
use super::place::{Ground, middle};
use super::rules;
use super::size::Size;
use super::steer::{Around, Making, in_world};
use super::surface;
use crate::error::Error;
use crate::file::Problem;
use crate::geometry::{DVec2, Solid, bounds};
use crate::scene::{Cast, Group, Mover, Scene};
use std::cell::{OnceCell, RefCell};
use std::fmt;
use std::sync::Arc;
use throng::field::{Anchor, Field};
use throng::space::surface::{Barrier, Surface};
use throng::space::{Pathway, Place};

/// Everything a scene puts into a world: what [`Scene::build`] adds, in this order.
#[derive(Clone, Debug)]
pub struct Plan {
    /// What the world is made with.
    pub settings: throng::Settings,
    /// Ground that can be walked on; none: everywhere.
    pub walkable: Vec<throng::Walkable>,
    /// What is solid, in the scene's order.
    pub obstacles: Vec<throng::Obstacle>,
    /// Surfaces that behaviours steer by, in the scene's order, relative to the settings' origin.
    pub surfaces: Vec<Barrier<Arc<dyn Surface>>>,
    /// Paths that behaviours steer by, in the scene's order, relative to the settings' origin.
    pub paths: Vec<Arc<Pathway>>,
    /// Fields, in the scene's order, relative to the settings' origin.
    pub fields: Vec<PlannedField>,
    /// What is worth knowing: nothing is wrong, but it may not be what was meant.
    pub notes: Vec<String>,
    /// The groups, in the scene's order, then one for everything that moves by itself.
    pub groups: Vec<throng::Group>,
    /// The rules of the scene's game, if it is one.
    pub rules: Option<Arc<dyn throng::Rules>>,
    /// All goals.
    pub goals: Vec<throng::Goal>,
    /// All journeys.
    pub journeys: Vec<PlannedJourney>,
    /// Positions of journeys that are alternatives to each other: where fewer wait, agents go.
    pub choices: Vec<Vec<usize>>,
    /// All scripts.
    pub scripts: Vec<throng::Script>,
    /// All agents, group by group, then what moves by itself; their position is their number.
    pub agents: Vec<PlannedAgent>,
    /// Lower left and upper right corner of all of it but surfaces and paths, metres.
    pub bounds: [DVec2; 2],
}

/// A field of a [`Plan`].
#[derive(Clone)]
pub struct PlannedField {
    /// Its name.
    pub name: String,
    /// What it says.
    pub field: Arc<dyn Field>,
    /// What it was sketched with, if it was.
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
    /// The stops: position in [`Plan::goals`], and seconds to wait there.
    pub stops: Vec<(usize, f32)>,
    /// After the last stop begin again.
    pub repeat: bool,
}

/// An agent of a [`Plan`].
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedAgent {
    /// The agent; its group and journey are filled in when the world is built.
    pub agent: throng::Agent,
    /// Position in [`Plan::groups`].
    pub group: usize,
    /// Position in [`Plan::journeys`]; `None`: it stays.
    pub journey: Option<usize>,
    /// Position in [`Plan::scripts`]; `None`: it follows none.
    pub script: Option<usize>,
    /// When it enters, seconds; `None`: it is there from the start.
    pub enters: Option<f64>,
}

impl Scene {
    /// Checks the scene and lays it out: who stands where, who goes where.
    ///
    /// # Errors
    /// With file, line, column and a hint: a number out of its limits, a polygon that crosses itself, agents that
    /// overlap each other or a wall, agents that do not fit, goals in walls, no or too many agents.
    pub fn plan(&self) -> Result<Plan, Error> {
        self.lay_out().map_err(|wrong| self.told(wrong))
    }

    /// The ground that can be walked on (none: everywhere) and what is solid, of a scene in which nobody need be: a map.
    ///
    /// # Errors
    /// With file, line, column and a hint: a number out of its limits, a polygon that crosses itself, a floor plan that cannot be read.
    pub fn ground(&self) -> Result<(Vec<throng::Walkable>, Vec<throng::Obstacle>), Error> {
        let both = || -> Result<_, Wrong> {
            check_scene(self)?;
            Ok((ground::areas(self, &mut vec![])?, ground::obstacles(self)?))
        };
        both().map_err(|wrong| self.told(wrong))
    }

    fn told(&self, wrong: Wrong) -> Error {
        match wrong {
            Wrong::Problem(problem) => self.explain(problem),
            Wrong::Error(error) => *error,
        }
    }

    /// Gives a problem its place in the file.
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

    fn lay_out(&self) -> Result<Plan, Wrong> {
        check_scene(self)?;
        let counts = counts(self)?;
        let mut notes = vec![];
        let walkable = ground::areas(self, &mut notes)?;
        let obstacles = ground::obstacles(self)?;
        let draws: Vec<Draw> = (0..self.groups.len()).map(|group| Draw { scene: self, group }).collect();
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
        let ground = Ground { scene: self, solid: &solid, areas: &walkable, sizes, altitudes, enters: &enters };
        let starts = ground.place()?;

        let mut goals = Goals::new(self, &solid, (&walkable, &obstacles));
        let mut agents = Vec::with_capacity(sizes.iter().map(Vec::len).sum());
        for (i, count) in counts.iter().enumerate() {
            let middle = middle(&self.groups[i].place, &starts[i]);
            let journeys = goals.journeys_of(i, &starts[i], &sizes[i], middle)?;
            for (k, journey) in journeys.into_iter().enumerate() {
                let (position, altitude) = (starts[i][k].truncate(), starts[i][k].z as f32);
                let number = Some(agents.len() as u32);
                let agent =
                    throng::Agent { position, altitude, number, ..draws[i].agent(k) }.with_body(sizes[i][k].body);
                let enters = count.enters.as_ref().map(|times| times[k]);
                agents.push(PlannedAgent { agent, group: i, journey, script: None, enters });
            }
        }
        let Goals { goals, journeys, choices, .. } = goals;
        let scripts = movers::add(self, &mut agents);
        let bounds = all_bounds(&walkable, &obstacles, &goals, &agents);
        let settings = throng::Settings {
            step: self.time.step,
            sub_steps: self.time.sub_steps.into(),
            seed: self.seed,
            // Whole metres: simple coordinates stay simple in f32.
            origin: ((bounds[0] + bounds[1]) * 0.5).round(),
        };
        let surfaces = surface::surfaces(self, settings.origin)?;
        let paths = surface::paths(self, settings.origin)?;
        let around = Around::new(self, settings.origin, (&surfaces, &paths), (&walkable, &obstacles))?;
        let first = |group| agents.partition_point(|agent| agent.group < group) as u32;
        let names: Vec<String> = self.names().collect();
        let named = names.iter().enumerate().map(|(i, name)| (name.as_str(), first(i)..first(i + 1)));
        let named: Vec<_> = named.collect();
        let cast = Cast { origin: settings.origin, obstacles: &obstacles, named: &named, paths: &around.paths };
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

    /// The names of the groups, then of the movers.
    fn names(&self) -> impl Iterator<Item = String> {
        let groups = self.groups.iter().enumerate().map(|(i, group)| Group::name_at(&group.name, i));
        groups.chain(self.movers.iter().enumerate().map(|(i, mover)| Mover::name_at(&mover.name, i)))
    }

    /// What the agents of each group share, and those of everything that moves by itself.
    fn shared(
        &self,
        cast: &Cast,
        figures: &[String],
        around: &Around,
        flows: &Flows,
    ) -> Result<Vec<throng::Group>, Wrong> {
        let one = |(i, group): (usize, &Group)| {
            let making = Making { scene: self, cast, figures, around, flows, group: i };
            let field = flows.governed(i, |name| cast.find(name).ok().map(|(position, _)| in_world(position)))?;
            let (steering, solid) = (making.steering()?, making.solid()?);
            let name = cast.named[i].0.to_owned();
            Ok(throng::Group { solid, ..shared(group, name, (steering, field), cast.origin) })
        };
        let groups: Vec<throng::Group> = self.groups.iter().enumerate().map(one).collect::<Result<_, Wrong>>()?;
        Ok(groups.into_iter().chain(movers::groups(self)).collect())
    }
}

/// Lower left and upper right corner of everything.
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
        let radius = f64::from(planned.agent.body().bound());
        [planned.agent.position - radius, planned.agent.position + radius]
    });
    bounds(ground.chain(solid).chain(goals).chain(bodies)).unwrap_or_default()
}

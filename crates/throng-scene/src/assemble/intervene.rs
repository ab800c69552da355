//! Interventions: their checks, and what they do to a running world.

use super::check::check_obstacle;
use super::ground::{obstacle, obstacle_name, solid};
use super::limits::{Limit, check, check_point, check_some};
use crate::error::{Error, Kind};
use crate::file::{Path, Problem};
use crate::geometry::{DVec2, DVec3, contains, distance_to_segment};
use crate::scene::{AddAgents, Change, Intervention, Led, Point, Push, Scene};
use glam::Vec3;
use std::collections::BTreeMap;
use std::sync::Arc;
use throng::{Agent, AgentId, Error as WorldError, Obstacle, Rules, World};

/// The most agents that an intervention adds.
const MOST: u32 = 10_000;
/// The time in which an agent that is led wants to be where it is led, seconds: nearer points slow it down.
const REACTION: f64 = 0.25;
/// Distance beyond the radius of a push within which agents may have come that were pushed one step before, metres.
const MARGIN: f64 = 1.0;
/// Distance between agents that are added, relative to their diameter.
const SPACING: f64 = 1.1;

/// Interventions, ready to be made in the world of their scene. [`Scene::build`] makes those of the scene a part of the
/// world's rules; a program that intervenes in a running world makes further ones of its own.
///
/// ```
/// use throng_scene::{Change, Intervention, Led, gallery};
///
/// let scene = gallery::scene("circle")?;
/// let (mut world, built) = scene.build()?;
/// world.step();
/// let grab = Change::Grab(Led { agent: 3, path: vec![[0.0, 0.0]] });
/// let made = Intervention { time: world.time(), change: grab };
/// built.interventions.with(&scene, vec![made])?.act(&mut world)?;
/// let agent = world.agents().find(|agent| agent.number() == 3);
/// assert!(agent.is_some_and(|agent| agent.position().length() < 1e-3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Interventions {
    made: Arc<[Intervention]>,
    /// Duration of a step, seconds.
    step: f64,
    /// The names of the groups and their agents at the start, which agents that are added copy.
    groups: Arc<[(String, Vec<Agent>)]>,
    /// The obstacles of the scene, then those that its interventions add.
    obstacles: Vec<Obstacle>,
}

impl Interventions {
    /// Returns the interventions of a scene that has these groups and obstacles.
    pub(super) fn new(
        scene: &Scene,
        groups: Vec<(String, Vec<Agent>)>,
        obstacles: &[Obstacle],
    ) -> Result<Self, Problem> {
        let bare =
            Self { made: Arc::default(), step: scene.time.step, groups: groups.into(), obstacles: obstacles.to_vec() };
        bare.making(scene.interventions.clone())
    }

    /// Returns other interventions for the same world. Obstacles that they add are numbered after those of the scene and
    /// of its own interventions.
    ///
    /// # Errors
    /// A number is out of its limits, or a group or an obstacle does not exist.
    pub fn with(&self, scene: &Scene, made: Vec<Intervention>) -> Result<Self, Error> {
        self.clone().making(made).map_err(|problem| scene.explain(problem))
    }

    /// Returns the interventions themselves.
    pub fn made(&self) -> &Arc<[Intervention]> {
        &self.made
    }

    /// Makes the interventions that are due after the current step of the world.
    ///
    /// # Errors
    /// The first that the world refuses, such as a wall through an agent. The others are made.
    pub fn act(&self, world: &mut World) -> Result<(), WorldError> {
        let mut first = Ok(());
        for made in self.made.iter() {
            let now = self.make_due(world, made);
            first = first.and(now);
        }
        first
    }

    /// Makes the last intervention alone, if it is due after the current step of the world.
    ///
    /// # Errors
    /// The world refuses it.
    pub fn act_last(&self, world: &mut World) -> Result<(), WorldError> {
        self.made.last().map_or(Ok(()), |made| self.make_due(world, made))
    }

    /// Returns the change that opens the nearest obstacle within `reach` of a point, or closes it if it is open.
    pub fn door(&self, world: &World, at: Point, reach: f64) -> Option<Change> {
        let distance = |solid: &Obstacle| distance_to(solid, DVec2::from_array(at));
        let nearest = (0..self.obstacles.len())
            .min_by(|&a, &b| distance(&self.obstacles[a]).total_cmp(&distance(&self.obstacles[b])));
        let k = nearest.filter(|&k| distance(&self.obstacles[k]) <= reach)?;
        let stands = world.find_obstacle(&self.obstacles[k]).is_some();
        Some(if stands { Change::Open(k as u32) } else { Change::Close(k as u32) })
    }

    /// Returns the interventions as text for a scene file.
    ///
    /// # Errors
    /// None that is known: every intervention can be written.
    pub fn text(made: &[Intervention]) -> Result<String, Error> {
        let table = toml::to_string(&BTreeMap::from([("intervention", made)]));
        table.map_err(|error| Error::new(Kind::Syntax, error.to_string()))
    }

    /// Makes an intervention if it is due after the current step.
    fn make_due(&self, world: &mut World, made: &Intervention) -> Result<(), WorldError> {
        let passed = world.steps().checked_sub(made.begins(self.step));
        passed.map_or(Ok(()), |passed| self.make(world, &made.change, passed as usize))
    }

    /// Makes a change `passed` steps after its time.
    fn make(&self, world: &mut World, change: &Change, passed: usize) -> Result<(), WorldError> {
        match change {
            Change::Grab(led) => led.path.get(passed).map_or(Ok(()), |&to| grab(world, led.agent, to)),
            Change::Lead(led) => lead(world, led, passed),
            Change::Push(push) => drive_away(world, push, passed),
            _ if passed > 0 => Ok(()),
            Change::Add(add) => self.add(world, add),
            Change::Remove(number) => {
                find(world, *number).into_iter().for_each(|id| _ = world.remove_agent(id));
                Ok(())
            }
            Change::Goal(goal) => {
                let members = world.members(world.group_named(&goal.group)?);
                members.into_iter().try_for_each(|id| world.set_goal(id, goal.point))
            }
            Change::Obstacle(said) => close(world, &solid(said)),
            Change::Close(k) => self.obstacles.get(*k as usize).map_or(Ok(()), |solid| close(world, solid)),
            Change::Open(k) => {
                let id = self.obstacles.get(*k as usize).and_then(|solid| world.find_obstacle(solid));
                id.into_iter().for_each(|id| _ = world.remove_obstacle(id));
                Ok(())
            }
        }
    }

    /// Adds as many agents as have room, from the middle of the disc outwards.
    fn add(&self, world: &mut World, add: &AddAgents) -> Result<(), WorldError> {
        let Some((_, templates)) = self.groups.iter().find(|(name, _)| *name == add.group) else { return Ok(()) };
        let widest = templates.iter().map(|agent| f64::from(agent.body().bounding_radius())).fold(0.0, f64::max);
        let spacing = 2.0 * SPACING * widest;
        let most = add.radius.unwrap_or(spacing * 4.0 * f64::from(add.count).sqrt() + spacing);
        let (before, middle) = (world.agents().len(), DVec2::from_array(add.at));
        let mut copies = (0..add.count as usize).filter_map(|k| templates.get(k % templates.len().max(1)));
        let mut next = copies.next();
        for place in (0..).map(|k| middle + sunflower(k) * spacing).take_while(|place| place.distance(middle) <= most) {
            let Some(agent) = next else { break };
            let place: DVec3 = place.extend(agent.position.z);
            if world.is_free(place, agent.body().bounding_radius()) {
                world.add_agent(Agent { position: place, number: None, ..agent.clone() })?;
                next = copies.next();
            }
        }
        match next {
            Some(agent) if world.agents().len() == before => {
                Err(WorldError::NoRoom { at: middle, radius: agent.radius, why: "no agent has room there" })
            }
            _ => Ok(()),
        }
    }

    /// Checks interventions, and takes them in place of its own.
    fn making(mut self, made: Vec<Intervention>) -> Result<Self, Problem> {
        for (k, said) in made.iter().enumerate() {
            let path = Path::of("intervention").index(k);
            check(&path.key("time"), said.time, Limit::NotNegative)?;
            self.check(&said.change, &path.key("change"))?;
        }
        self.made = made.into();
        Ok(self)
    }

    /// Checks a change. Remembers an obstacle that it adds.
    fn check(&mut self, change: &Change, path: &Path) -> Result<(), Problem> {
        let line = |path: &Path, points: &[Point]| {
            if points.is_empty() {
                return Err(Problem::new(&path.key("path"), Kind::Count, "the path has no point"));
            }
            points.iter().enumerate().try_for_each(|(i, point)| check_point(&path.key("path").index(i), point))
        };
        match change {
            Change::Add(add) => {
                let path = path.key("add");
                self.check_group(&add.group, &path)?;
                check(&path.key("count"), f64::from(add.count), Limit::Between(1.0, f64::from(MOST)))?;
                check_point(&path.key("at"), &add.at)?;
                check_some(&path.key("radius"), add.radius, Limit::Positive)
            }
            Change::Remove(_) => Ok(()),
            Change::Grab(led) => line(&path.key("grab"), &led.path),
            Change::Lead(led) => line(&path.key("lead"), &led.path),
            Change::Push(push) => {
                check(&path.key("push").key("radius"), push.radius, Limit::Positive)?;
                line(&path.key("push"), &push.path)
            }
            Change::Goal(goal) => {
                self.check_group(&goal.group, &path.key("goal"))?;
                check_point(&path.key("goal").key("point"), &goal.point)
            }
            Change::Obstacle(said) => {
                let (path, name) = (path.key("obstacle"), obstacle_name(&said.name, self.obstacles.len()));
                check_obstacle(&path, said)?;
                self.obstacles.push(obstacle(said, &path, &name)?);
                Ok(())
            }
            Change::Open(k) => self.check_number(*k, &path.key("open")),
            Change::Close(k) => self.check_number(*k, &path.key("close")),
        }
    }

    fn check_group(&self, name: &str, path: &Path) -> Result<(), Problem> {
        if self.groups.iter().any(|(known, _)| known == name) {
            return Ok(());
        }
        let known: Vec<&str> = self.groups.iter().map(|(name, _)| name.as_str()).collect();
        let problem = Problem::new(&path.key("group"), Kind::UnknownKey, format!("there is no group `{name}`"));
        Err(problem.hint(format!("there are: {}", known.join(", "))))
    }

    fn check_number(&self, k: u32, path: &Path) -> Result<(), Problem> {
        let all = self.obstacles.len();
        if (k as usize) < all {
            return Ok(());
        }
        let problem = Problem::new(path, Kind::OutOfRange, format!("there is no obstacle {k}"));
        Err(problem.hint(format!("the scene and the interventions before this one have {all}, numbered from 0")))
    }
}

/// Rules that make the interventions of a scene after the rules of its game.
#[derive(Debug)]
pub(super) struct Intervening {
    pub game: Option<Arc<dyn Rules>>,
    pub interventions: Interventions,
}

impl Rules for Intervening {
    fn figures(&self) -> Vec<String> {
        self.game.as_ref().map_or_else(Vec::new, |game| game.figures())
    }

    fn begin(&self, world: &mut World, figures: &mut [f64]) -> Result<(), WorldError> {
        self.game.iter().try_for_each(|game| game.begin(world, figures))
    }

    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), WorldError> {
        let played = self.game.iter().try_for_each(|game| game.act(world, figures));
        played.and(self.interventions.act(world))
    }

    fn standing(&self, world: &World, figures: &[f64]) -> String {
        self.game.as_ref().map_or_else(String::new, |game| game.standing(world, figures))
    }
}

/// Returns the agent with a number; `None` if it has been removed, or has not entered yet.
fn find(world: &World, number: u32) -> Option<AgentId> {
    let columns = world.relative_columns();
    (0..columns.len()).find(|&row| columns.number[row] == number).map(|row| world.id(row))
}

/// Moves an agent. It stays where it is if its place is solid.
fn grab(world: &mut World, number: u32, [x, y]: Point) -> Result<(), WorldError> {
    let Some((id, place)) = find(world, number).and_then(|id| Some((id, world.position(id)?))) else { return Ok(()) };
    match world.set_position(id, DVec3::new(x, y, place.z)) {
        Err(WorldError::NoRoom { .. }) => Ok(()),
        other => other,
    }
}

/// Sends an agent towards the point of this step; after the last one it is free.
fn lead(world: &mut World, led: &Led, passed: usize) -> Result<(), WorldError> {
    let Some(id) = find(world, led.agent).filter(|_| passed <= led.path.len()) else { return Ok(()) };
    let velocity = led.path.get(passed).and_then(|&[x, y]| {
        let agent = world.agent(id)?;
        let place = agent.position();
        let away = DVec3::new(x, y, place.z) - place;
        let most = agent.to_agent().motor.max_speed();
        Some((away / REACTION).as_vec3().clamp_length_max(most))
    });
    world.set_preferred_velocity(id, velocity)
}

/// Sends the agents around the point of this step away from it, at their greatest speed. Frees those that it has left.
fn drive_away(world: &mut World, push: &Push, passed: usize) -> Result<(), WorldError> {
    let point = |k: usize| push.path.get(k).map(|&p| DVec2::from_array(p));
    let (now, before) = (point(passed), passed.checked_sub(1).and_then(point));
    if now.or(before).is_none() {
        return Ok(());
    }
    for id in world.agent_ids() {
        let Some(agent) = world.agent(id) else { continue };
        let at = agent.position().truncate();
        let within = |center: DVec2, radius: f64| center.distance(at) < radius;
        if let Some(center) = now.filter(|&center| within(center, push.radius)) {
            let away = (at - center).try_normalize().unwrap_or(DVec2::X).as_vec2();
            let most = agent.to_agent().motor.max_speed();
            world.set_preferred_velocity(id, (away * most).extend(0.0))?;
        } else if before.is_some_and(|center| within(center, push.radius + MARGIN)) {
            world.set_preferred_velocity(id, None::<Vec3>)?;
        }
    }
    Ok(())
}

/// Adds an obstacle unless the world has it.
fn close(world: &mut World, solid: &Obstacle) -> Result<(), WorldError> {
    match world.find_obstacle(solid) {
        Some(_) => Ok(()),
        None => world.add_obstacle(solid.clone()).map(drop),
    }
}

/// Returns the distance from a point to an obstacle, 0 inside of it.
fn distance_to(solid: &Obstacle, at: DVec2) -> f64 {
    let line = |points: &[DVec2]| {
        let parts = points.windows(2).map(|part| distance_to_segment(at, part[0], part[1]));
        parts.fold(f64::INFINITY, f64::min)
    };
    match solid {
        Obstacle::Circle { center, radius } => (center.distance(at) - radius).max(0.0),
        Obstacle::Polygon { corners } if contains(corners, at) => 0.0,
        Obstacle::Polygon { corners } => {
            let closing = corners.first().zip(corners.last()).map(|(&a, &b)| distance_to_segment(at, a, b));
            line(corners).min(closing.unwrap_or(f64::INFINITY))
        }
        Obstacle::Wall { points } => line(points),
    }
}

/// Returns the `k`-th point of a spiral that covers the plane evenly, with a distance of about 1 between neighbours
/// (Vogel 1979).
fn sunflower(k: u32) -> DVec2 {
    const GOLDEN: f64 = 2.399_963_229_728_653;
    let k = f64::from(k);
    DVec2::from_angle(k * GOLDEN) * (0.6 * k.sqrt())
}

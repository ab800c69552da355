//! Converts the editor's JSON to a scene.

use super::super::notes::Notes;
use super::super::{Imported, roomy};
use super::distribution::{Distribution, number_of};
use crate::error::{Error, Kind};
use crate::geometry::{DVec2, Solid, points};
use crate::registry::Goal;
use crate::scene::{
    About, Area, AreaGoal, Arrived, ChoiceGoal, ExitGoal, Expect, Group, JourneyGoal, NearestGoal, Number, Point,
    PolygonPlace, Region, Scene, Stop, Time, Until, Walkable, Weighted,
};
use serde_json::{Map, Value};

pub(super) fn convert(config: &Value, mut areas: Vec<Area>) -> Result<Imported, Error> {
    let mut notes = Notes::default();
    let settings = &config["config"]["simulation_settings"];
    let parameters = &settings["simulationParams"];
    let model = parameters["model_type"].as_str().or(config["model_type"].as_str()).unwrap_or("unnamed");
    notes.whole(format!("the model {model} and its parameters are left out: agents avoid each other by ORCA"));

    let mut distributions = vec![];
    for (id, value) in table(&config["distributions"]) {
        distributions.push((Distribution::read(id, value, &mut notes), corners_of(id, value)?));
    }
    let walkable = areas.iter().map(|area| throng::Walkable {
        outer: points(&area.outer),
        holes: area.holes.iter().map(|hole| points(hole)).collect(),
    });
    let largest = distributions.iter().map(|(d, _)| d.radius.bounds()[1]).fold(0.1, f64::max);
    let solid = Solid::new(&walkable.collect::<Vec<_>>(), &[], largest);
    let mut routes = JupedsimRoutes::read(config, &solid, largest, &mut notes)?;

    let mut groups = vec![];
    for (distribution, corners) in distributions {
        let goal = routes.goal(config, &distribution.id, &mut notes);
        if distribution.count == 0 {
            notes.about(&distribution.id, "no agents in this distribution: left out");
            continue;
        }
        groups.push(Group {
            name: distribution.id,
            count: Some(distribution.count),
            place: PolygonPlace { corners, gap: 0.0 }.into(),
            goal,
            source: distribution.source.into_iter().collect(),
            wait: distribution.wait,
            body: crate::scene::Body::Radius(distribution.radius),
            speed: crate::scene::Speed { preferred: distribution.speed, max: None },
            ..Group::default()
        });
    }
    left_out(config, &mut notes);
    let limit = parameters["max_simulation_time"].as_f64().filter(|limit| *limit > 0.0).unwrap_or(300.0);
    let seed = settings["baseSeed"].as_u64().or(config["seed"].as_u64()).unwrap_or(1);
    let expected = &config["_expectations"];
    let all = expected["all_agents_evacuated"].as_bool() == Some(true);
    let scene = Scene {
        about: About::imported(config["_description"].as_str().unwrap_or_default()),
        seed: seed.min(i64::MAX as u64),
        time: Time { until: Until::Arrived, limit, ..Time::default() },
        walkable: Some(if areas.len() == 1 { Walkable::Polygon(areas.remove(0)) } else { Walkable::Polygons(areas) }),
        groups,
        expect: Expect {
            arrived: all.then_some(Arrived::All),
            within: expected["evacuation_time_range"][1].as_f64().filter(|_| all),
            ..Expect::default()
        },
        ..Scene::default()
    };
    Ok(Imported { scene, notes: notes.lines() })
}

/// Adds notes about what a scene cannot represent.
fn left_out(config: &Value, notes: &mut Notes) {
    for (id, zone) in table(&config["zones"]) {
        let factor = zone["speed_factor"].as_f64().unwrap_or(1.0);
        if factor != 1.0 {
            notes.about(id, format!("zone with {factor} times the speed: left out"));
        }
    }
    for kind in ["exits", "checkpoints"] {
        for (id, value) in table(&config[kind]) {
            if value["enable_throughput_throttling"].as_bool() == Some(true) {
                notes.about(id, format!("at most {} people a second may pass: left out", value["max_throughput"]));
            }
            let factor = value["speed_factor"].as_f64().unwrap_or(1.0);
            if factor != 1.0 {
                notes.about(id, format!("{factor} times the speed there: left out"));
            }
        }
    }
    if config["transitions"].as_array().is_some_and(|list| !list.is_empty()) {
        notes.whole("`transitions` are left out: journeys follow their lists of stages");
    }
}

/// The goals of agents: exits, checkpoints, and sequences of them.
struct JupedsimRoutes {
    exits: Vec<(String, Goal)>,
    checkpoints: Vec<(String, Goal, Option<Number>)>,
    /// Ids and stages.
    journeys: Vec<(String, Vec<String>)>,
}

impl JupedsimRoutes {
    fn read(config: &Value, solid: &Solid, radius: f64, notes: &mut Notes) -> Result<Self, Error> {
        let mut region = |id: &str, value: &Value| -> Result<Region, Error> {
            Ok(roomy(solid, &points(&corners_of(id, value)?), radius, id, notes))
        };
        let mut exits = vec![];
        for (id, value) in table(&config["exits"]) {
            exits.push((id.clone(), ExitGoal(region(id, value)?).into()));
        }
        let mut checkpoints = vec![];
        for (id, value) in table(&config["checkpoints"]) {
            let region = region(id, value)?;
            checkpoints.push((id.clone(), AreaGoal(region).into(), value.clone()));
        }
        let checkpoints = checkpoints
            .into_iter()
            .map(|(id, goal, value)| {
                let wait = number_of(&value, "waiting_time", 0.0, 0.0, &id, notes);
                (id, goal, Some(wait).filter(|wait| wait.bounds()[1] > 0.0))
            })
            .collect();
        let strings = |list: &Value| -> Vec<String> {
            list.as_array().into_iter().flatten().filter_map(|s| s.as_str().map(str::to_owned)).collect()
        };
        let journeys = ["journeys_v2", "journeys"]
            .into_iter()
            .flat_map(|key| config[key].as_array().into_iter().flatten())
            .map(|journey| {
                let stages = if journey["sequence"].is_array() { &journey["sequence"] } else { &journey["stages"] };
                (journey["id"].as_str().unwrap_or_default().to_owned(), strings(stages))
            })
            .collect();
        Ok(Self { exits, checkpoints, journeys })
    }

    /// Returns the goal of the agents of a distribution.
    fn goal(&mut self, config: &Value, distribution: &str, notes: &mut Notes) -> Option<Goal> {
        let weights = config["distributions"][distribution]["journey_weights"].as_array();
        let weighted = weights.into_iter().flatten().filter_map(|entry| {
            let id = entry["journey_id"].as_str()?;
            let stages = self.journeys.iter().find(|(known, _)| known == id).map(|(_, stages)| stages);
            if stages.is_none() {
                notes.about(distribution, format!("there is no journey {id}: left out"));
            }
            Some((stages?.clone(), entry["weight"].as_f64().unwrap_or(1.0)))
        });
        let mut sequences: Vec<(Vec<String>, f64)> = weighted.filter(|(_, weight)| *weight > 0.0).collect();
        if sequences.is_empty() {
            // older scenarios: a journey starts with its distribution
            let mine = self.journeys.iter().filter(|(_, stages)| stages.first().is_some_and(|id| id == distribution));
            sequences = mine.map(|(_, stages)| (stages[1..].to_vec(), 1.0)).collect();
        }
        let mut goals: Vec<Weighted> = sequences
            .into_iter()
            .filter_map(|(stages, weight)| Some(Weighted { goal: self.sequence(&stages, notes)?, weight }))
            .collect();
        if goals.len() > 1 {
            return Some(ChoiceGoal(goals).into());
        }
        goals.pop().map(|only| only.goal).or_else(|| self.nearest(distribution, notes))
    }

    /// Returns the goal of agents without a journey: the nearest exit.
    fn nearest(&self, distribution: &str, notes: &mut Notes) -> Option<Goal> {
        match self.exits.len() {
            0 => {
                notes.about(distribution, "nowhere to go: people stay");
                None
            }
            1 => Some(self.exits[0].1.clone()),
            _ => {
                notes.about(distribution, "no journey: all agents leave by the nearest exit");
                Some(NearestGoal(self.exits.iter().map(|(_, goal)| goal.clone()).collect()).into())
            }
        }
    }

    fn sequence(&self, stages: &[String], notes: &mut Notes) -> Option<Goal> {
        let mut stops: Vec<Stop> = vec![];
        for id in stages {
            if let Some((_, goal)) = self.exits.iter().find(|(known, _)| known == id) {
                stops.push(goal.clone().into());
            } else if let Some((_, goal, wait)) = self.checkpoints.iter().find(|(known, ..)| known == id) {
                stops.push(Stop { goal: goal.clone(), wait: *wait });
            } else {
                notes.about(id, "stage that is neither an exit nor a checkpoint: left out");
            }
        }
        match stops.len() {
            0 => None,
            1 if stops[0].wait.is_none() => stops.pop().map(|stop| stop.goal),
            _ => Some(JourneyGoal(stops).into()),
        }
    }
}

/// Returns the entries of a JSON object; none for other values.
fn table(value: &Value) -> impl Iterator<Item = (&String, &Value)> {
    value.as_object().into_iter().flat_map(Map::iter)
}

/// Returns the corners of an editor's polygon.
fn corners_of(id: &str, value: &Value) -> Result<Vec<Point>, Error> {
    let wrong = || {
        Error::new(Kind::Geometry, format!("{id} has no polygon in `coordinates`"))
            .hint("it should be a list of at least three points [x, y]")
    };
    corners_or_none(value).ok_or_else(wrong)
}

pub(super) fn corners_or_none(value: &Value) -> Option<Vec<Point>> {
    let point = |value: &Value| Some([value[0].as_f64()?, value[1].as_f64()?]);
    let corners: Vec<Point> = value["coordinates"].as_array()?.iter().map(point).collect::<Option<_>>()?;
    let corners = points(&corners);
    (corners.len() >= 3).then(|| corners.iter().map(DVec2::to_array).collect())
}

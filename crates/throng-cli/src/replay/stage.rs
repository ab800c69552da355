//! The agents of a replay, and how they are drawn.

use super::args::ReplayArgs;
use crate::failure::Failure;
use crate::map::Map;
use glam::DVec2;
use throng_draw::{Style, WorldBox};
use throng_record::pedestrian::replay::{RecordedPeople, ReplayScene};
use throng_scene::{Group, Model, Scene};

/// Keys of a group that the recording determines.
const THEIR_OWN: [&str; 11] = [
    "count",
    "place",
    "goal",
    "source",
    "wait",
    "body",
    "speed.preferred",
    "altitude",
    "heading",
    "start_speed",
    "priority",
];
/// How far beyond the recorded positions pictures reach, metres.
const MARGIN: f64 = 1.0;

/// Returns the scene of a model, with one person at the origin that stands for all people.
///
/// # Errors
/// A key does not exist, or a value is not valid for its key.
pub fn scene(args: &ReplayArgs, model: &Model) -> Result<Scene, Failure> {
    let asked = &args.stage;
    let person = Group { name: "people".into(), ..Group::default() };
    let scene = Scene { groups: vec![person], ..Scene::default() };
    let mut scene = scene.with_model(model).map_err(|mut error| {
        error.file = Some(format!("--model {model}").into());
        error
    })?;
    for (key, value) in &asked.set {
        let own = key.strip_prefix("group.people.").or_else(|| key.strip_prefix("group.0.")).unwrap_or(key);
        let is = |name: &&&str| own.strip_prefix(**name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
        if let Some(name) = THEIR_OWN.iter().find(is) {
            let text = format!("--set {key}: each agent has its own `{name}`, from the recording");
            return Err(Failure::hint(text, "use --speed for preferred speeds and --radius for bodies"));
        }
        scene.set(key, value)?;
    }
    scene.seed = asked.seed.unwrap_or(scene.seed);
    scene.time.step = asked.step.unwrap_or(scene.time.step);
    Ok(scene)
}

/// Returns the ground and the settings of the agents.
///
/// # Errors
/// The scene cannot be built.
pub fn stage(args: &ReplayArgs, scene: &Scene, cast: &RecordedPeople, map: &Map) -> Result<ReplayScene, Failure> {
    let plan = scene.plan()?;
    let (Some(group), Some(planned)) = (plan.groups.first(), plan.agents.first()) else {
        return Err(Failure::Error("the scene has no agents".into()));
    };
    let [low, high] = bounds(cast);
    // Whole metres: simple coordinates stay simple in f32.
    let settings = throng::Settings { origin: ((low + high) * 0.5).round(), ..plan.settings };
    Ok(ReplayScene {
        settings,
        group: group.clone(),
        agent: planned.agent.clone(),
        walkable: map.walkable.clone(),
        obstacles: map.obstacles.clone(),
        near: args.stage.near,
        stay: args.stage.stay,
    })
}

/// Returns the style of one panel. Without a view, it shows the recorded positions.
///
/// # Errors
/// The camera's view is empty.
pub fn style(args: &ReplayArgs, scene: &Scene, cast: &RecordedPeople) -> Result<Style, Failure> {
    let [low, high] = bounds(cast);
    let shown = WorldBox { min: low - MARGIN, max: high + MARGIN };
    let style = args.film.style(scene, [shown.min, shown.max])?;
    Ok(Style { view: style.view.or(Some(shown)), ..style })
}

/// Returns the corners of the box of recorded positions.
pub fn bounds(cast: &RecordedPeople) -> [DVec2; 2] {
    let places = cast.people.walks.iter().flat_map(|walk| &walk.places);
    places.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], &at| [low.min(at), high.max(at)])
}

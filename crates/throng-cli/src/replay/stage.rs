//! As whom recorded people walk, and how they are drawn.

use super::args::ReplayArgs;
use crate::failure::Failure;
use crate::map::Map;
use glam::DVec2;
use throng_draw::{Style, WorldBox};
use throng_record::pedestrian::replay::{Cast, Stage};
use throng_scene::{Group, Model, Place, Scene};

/// Keys of a group that recorded people have from the recording.
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
/// How far beyond everybody pictures reach, metres.
const MARGIN: f64 = 1.0;

/// The scene with one person that they are like, by a model, who stands at the origin.
///
/// # Errors
/// There is no such key, or a value is none of its own.
pub fn scene(args: &ReplayArgs, model: &Model) -> Result<Scene, Failure> {
    let asked = &args.stage;
    let person = Group { name: "people".into(), place: Place::Point([0.0; 2]), ..Group::default() };
    let scene = Scene { groups: vec![person], ..Scene::default() };
    let mut scene = scene.with_model(model).map_err(|mut error| {
        error.file = Some(format!("--model {model}").into());
        error
    })?;
    for (key, value) in &asked.set {
        let own = key.strip_prefix("group.people.").or_else(|| key.strip_prefix("group.0.")).unwrap_or(key);
        let is = |name: &&&str| own.strip_prefix(**name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
        if let Some(name) = THEIR_OWN.iter().find(is) {
            let text = format!("--set {key}: everybody has their own `{name}`, from the recording");
            return Err(Failure::hint(text, "speeds and bodies are chosen by --speed and --radius"));
        }
        scene.set(key, value)?;
    }
    scene.seed = asked.seed.unwrap_or(scene.seed);
    scene.time.step = asked.step.unwrap_or(scene.time.step);
    Ok(scene)
}

/// Where they walk, and as whom.
///
/// # Errors
/// The scene cannot be built.
pub fn stage(args: &ReplayArgs, scene: &Scene, cast: &Cast, map: &Map) -> Result<Stage, Failure> {
    let plan = scene.plan()?;
    let (Some(group), Some(planned)) = (plan.groups.first(), plan.agents.first()) else {
        return Err(Failure::Error("the scene has no agents".into()));
    };
    let [low, high] = bounds(cast);
    // whole metres: simple coordinates stay simple in f32
    let settings = throng::Settings { origin: ((low + high) * 0.5).round(), ..plan.settings };
    Ok(Stage {
        settings,
        group: group.clone(),
        agent: planned.agent.clone(),
        walkable: map.walkable.clone(),
        obstacles: map.obstacles.clone(),
        near: args.stage.near,
        stay: args.stage.stay,
    })
}

/// How one panel of pictures looks: it shows where people were recorded, where nothing else is said.
///
/// # Errors
/// The camera sees nothing.
pub fn style(args: &ReplayArgs, scene: &Scene, cast: &Cast) -> Result<Style, Failure> {
    let [low, high] = bounds(cast);
    let shown = WorldBox { min: low - MARGIN, max: high + MARGIN };
    let style = args.film.look.style(scene, [shown.min, shown.max])?;
    Ok(Style { view: style.view.or(Some(shown)), ..style })
}

/// The corners of where people were recorded.
pub fn bounds(cast: &Cast) -> [DVec2; 2] {
    let places = cast.people.walks.iter().flat_map(|walk| &walk.places);
    places.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], &at| [low.min(at), high.max(at)])
}

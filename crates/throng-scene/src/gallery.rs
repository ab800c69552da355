//! The scenes that come with the project: the files of the folder `scenes`, embedded.

use crate::error::{Error, Kind};
use crate::scene::Scene;

/// The scenes of a group: the names, and the files' texts.
type Scenes = &'static [(&'static str, &'static str)];

/// Every group: its name, and its scenes.
macro_rules! groups {
    ($($group:literal: $($name:literal),* ;)*) => {
        &[$(($group, &[$(($name, include_str!(concat!("../../../scenes/", $name, ".toml")))),*])),*]
    };
}

const GROUPS: &[(&str, Scenes)] = groups! {
    // the seed labs' four, and their algorithm
    "labs": "columns", "circle", "box", "pillars", "circle-lab";
    "meetings": "headon", "ring", "ring-1000", "crossing", "overtaking", "gathering", "robots";
    "air": "sphere", "drones";
    "bodies": "mixed-sizes", "vehicle", "sliding-door";
    "walls": "corridor", "bottleneck", "doorway", "doorway-0.8", "doorway-0.6", "doorway-two-way", "narrow-corridor", "maze", "office";
    "steering": "seek-flee", "pursue-evade", "offset-pursuit", "arrival", "wander", "unaligned-avoidance", "queueing", "leader-following",
        "flocking", "boids", "interpose", "shadow", "docking", "explore", "formation", "noise", "multiple-pursuit", "low-speed-turn",
        "one-turning", "capture-the-flag", "soccer", "map-drive",
        "flock-pedestrians", "leader-pedestrians", "path-pedestrians", "context-steering", "obstacle-avoidance", "path-following", "wall-following", "containment", "flow-field", "crowd-path", "hide",
        "pedestrians", "walking-an-eight";
    // crowds that vector fields lead
    "fields": "field-anchors", "field-strokes", "field-paint", "field-vortex", "field-crossing-groups", "field-keyframes", "field-goal", "field-jam",
        "interaction-field";
    // insects, by noise
    "swarms": "swarm-aggregation", "swarm-phototaxis", "swarm-sedation", "swarm-attack", "swarm-migration", "swarm-escape";
    // the flocks of OpenSteer's demo, each with its own constraints
    "flocks": "boids-open", "boids-in-sphere", "boids-between-spheres", "boids-in-sphere-spheres", "boids-spheres",
        "boids-in-sphere-rectangle", "boids-rectangle", "boids-outside-box", "boids-in-box";
};

/// The groups of scenes: the name of each, and the names of its scenes.
pub fn groups() -> impl Iterator<Item = (&'static str, impl Iterator<Item = &'static str>)> {
    GROUPS.iter().map(|(group, scenes)| (*group, scenes.iter().map(|(name, _)| *name)))
}

/// Every scene: its name, and its file's text.
fn scenes() -> impl Iterator<Item = &'static (&'static str, &'static str)> {
    GROUPS.iter().flat_map(|(_, scenes)| scenes.iter())
}

/// The names of all scenes.
pub fn names() -> impl Iterator<Item = &'static str> {
    scenes().map(|(name, _)| *name)
}

/// The text of a scene's file.
pub fn text(name: &str) -> Option<&'static str> {
    scenes().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// The title of a scene.
pub fn title(name: &str) -> Option<&'static str> {
    title_in(text(name)?)
}

/// The title that the text of a scene's file says.
pub(crate) fn title_in(text: &str) -> Option<&str> {
    let line = text.lines().find_map(|line| line.strip_prefix("title = "))?;
    Some(line.trim().trim_matches('"'))
}

/// The scene of this name.
///
/// # Errors
/// There is no such scene; the hint lists those there are.
pub fn scene(name: &str) -> Result<Scene, Error> {
    let Some(text) = text(name) else {
        let names: Vec<String> = names().map(str::to_owned).collect();
        let all = names.join(", ");
        let error = Error::new(Kind::UnknownScene, format!("there is no scene `{name}`"));
        return Err(match crate::file::nearest(name, &names) {
            Some(near) => error.hint(format!("did you mean `{near}`? the gallery has: {all}; other scenes are files")),
            None => error.hint(format!("the gallery has: {all}; other scenes are files")),
        });
    };
    Scene::parse(&format!("scenes/{name}.toml"), text)
}

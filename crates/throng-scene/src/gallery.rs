//! The scenes that come with the project: the files of the folder `scenes`, embedded.

use crate::error::{Error, Kind};
use crate::scene::Scene;

/// Every scene: its name, and its file's text.
macro_rules! scenes {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../scenes/", $name, ".toml")))),*]
    };
}

const SCENES: &[(&str, &str)] = scenes![
    // The seed labs' four.
    "columns",
    "circle",
    "box",
    "pillars",
    "circle-lab",
    // Meetings.
    "headon",
    "ring",
    "ring-1000",
    "crossing",
    "overtaking",
    "gathering",
    "robots",
    // In the air.
    "sphere",
    "drones",
    // Bodies.
    "mixed-sizes",
    "vehicle",
    "sliding-door",
    // Walls.
    "corridor",
    "bottleneck",
    "doorway",
    "doorway-0.8",
    "doorway-0.6",
    "doorway-two-way",
    "narrow-corridor",
    "maze",
    "office",
];

/// The names of all scenes.
pub fn names() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|(name, _)| *name)
}

/// The text of a scene's file.
pub fn text(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// The title of a scene.
pub fn title(name: &str) -> Option<&'static str> {
    let line = text(name)?.lines().find_map(|line| line.strip_prefix("title = "))?;
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

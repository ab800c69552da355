//! The scenes of the project: the files of the folder `scenes`, packed into the library.

use crate::error::{Error, Kind};
use crate::scene::Scene;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Every group: its name and its scenes.
macro_rules! groups {
    ($($group:literal: $($name:literal),* ;)*) => { &[$(($group, &[$($name),*])),*] };
}

/// The texts of all files, each after its name, separated by zero bytes.
const PACKED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/scenes.deflate"));

/// The unpacked texts by name.
static TEXTS: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    // The build script packed this text: unpacking cannot fail.
    let all = miniz_oxide::inflate::decompress_to_vec(PACKED).unwrap_or_default();
    let all = String::from_utf8(all).unwrap_or_default();
    let mut parts = all.split('\0').map(str::to_owned);
    std::iter::from_fn(|| Some((parts.next()?, parts.next()?))).collect()
});

const GROUPS: &[(&str, &[&str])] = groups! {
    // the four scenes of the seed labs, and their algorithm
    "labs": "columns", "circle", "box", "pillars", "circle-lab", "barrier";
    "meetings": "headon", "ring", "ring-1000", "crossing", "overtaking", "gathering", "robots";
    "air": "sphere", "drones", "street";
    // the examples of RVO2 and RVO2-3D, with their numbers
    "rvo2": "rvo2-circle", "rvo2-blocks", "rvo2-roadmap", "rvo2-sphere";
    "bodies": "mixed-sizes", "vehicle", "sliding-door";
    "walls": "corridor", "bottleneck", "doorway", "doorway-0.8", "doorway-0.6", "doorway-two-way", "narrow-corridor", "maze", "office";
    "steering": "seek-flee", "pursue-evade", "pursuit-beside-seek", "offset-pursuit", "arrival", "wander", "unaligned-avoidance", "queueing", "queue-at-door", "leader-following", "leader-turns-back",
        "flocking", "boids", "boids-pillars", "interpose", "shadow", "docking", "explore", "formation", "noise", "remedy-hold", "remedy-stop-and-wait", "multiple-pursuit", "low-speed-turn",
        "one-turning", "capture-the-flag", "soccer", "map-drive",
        "flock-pedestrians", "leader-pedestrians", "path-pedestrians", "context-steering", "obstacle-avoidance", "path-following", "wall-following", "containment", "flow-field", "crowd-path", "hide",
        "pedestrians", "walking-an-eight";
    // crowds guided by vector fields
    "fields": "field-anchors", "field-strokes", "field-paint", "field-vortex", "field-ratio", "field-stretch", "field-crossing-groups", "field-keyframes", "field-goal", "field-jam",
        "interaction-field";
    // insects with noise
    "swarms": "swarm-aggregation", "swarm-phototaxis", "swarm-sedation", "swarm-attack", "swarm-migration", "swarm-blocks", "swarm-escape";
    // the flocks of OpenSteerDemo, each with its own constraint
    "flocks": "boids-open", "boids-in-sphere", "boids-between-spheres", "boids-in-sphere-spheres", "boids-spheres",
        "boids-in-sphere-rectangle", "boids-rectangle", "boids-outside-box", "boids-in-box";
};

/// Returns the groups of scenes: the name of each, and the names of its scenes.
pub fn groups() -> impl Iterator<Item = (&'static str, impl Iterator<Item = &'static str>)> {
    GROUPS.iter().map(|(group, scenes)| (*group, scenes.iter().copied()))
}

/// Returns the names of all scenes.
pub fn names() -> impl Iterator<Item = &'static str> {
    groups().flat_map(|(_, scenes)| scenes)
}

/// Returns the text of a scene's file.
pub fn text(name: &str) -> Option<&'static str> {
    TEXTS.get(name).map(String::as_str)
}

/// Returns the title of a scene.
pub fn title(name: &str) -> Option<&'static str> {
    title_in(text(name)?)
}

/// Returns the title in the text of a scene's file.
pub(crate) fn title_in(text: &str) -> Option<&str> {
    line_of(text, "title")
}

/// Returns the value of a key that has its own line in the text of a scene's file.
fn line_of<'t>(text: &'t str, key: &str) -> Option<&'t str> {
    let value = |line: &'t str| line.strip_prefix(key)?.trim_start().strip_prefix('=');
    Some(text.lines().find_map(value)?.trim().trim_matches('"'))
}

/// The name of the group of the scenes that show figures and demonstrations of papers. These scenes are in other groups
/// too.
pub const PAPERS: &str = "papers";

/// Returns the scenes that show figures and demonstrations of papers, each with its citation
/// ([`About::shows`](crate::About::shows)), in the order of the citations.
pub fn papers() -> &'static [(&'static str, &'static str)] {
    &CITED
}

/// The scenes with citations, in the order of [`papers`].
static CITED: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| {
    let cited = |name| Some((name, line_of(text(name)?, "shows")?));
    let mut all: Vec<(&str, &str)> = names().filter_map(cited).collect();
    // years first: the order in which the field grew
    let year =
        |citation: &str| citation.split(|c: char| !c.is_ascii_digit()).find(|word| word.len() == 4).map(str::to_owned);
    all.sort_by_key(|&(_, citation)| (year(citation), citation));
    all
});

/// Returns the scene with this name.
///
/// # Errors
/// The scene does not exist. The hint lists the scenes of the gallery.
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
    let scene = Scene::parse(&format!("scenes/{name}.toml"), text)?;
    scene.check_about()?;
    Ok(scene)
}

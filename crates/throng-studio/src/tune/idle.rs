//! Defaults and effects of keys of a group that depend on other keys of the group.

use serde_json::{Value, json};
use throng_scene::{Group, Preset};

/// Keys that act on agents that look ahead only.
const LOOKING_AHEAD: [&str; 4] = ["time_gap", "shoulders", "personal_space", "relaxation_time"];
/// The default of `keep_right` for agents of animation, degrees.
const ANIMATED_SIDE: f64 = 8.0;

/// Adds the defaults that depend on other keys to the values of a group. Returns its keys without effect.
pub(super) fn complete(said: &mut Value, group: &Group) -> Vec<&'static str> {
    let (walks, animated) = (group.steer.is_none(), group.preset == Preset::Animation);
    let looks = group.look_ahead.unwrap_or(walks && !animated);
    let guarded = walks && group.local_model().name != "rvo_lab";
    let defaults = [("look_ahead", json!(looks)), ("resolve", json!(walks)), ("guard", json!(guarded))];
    let usual = f64::from(throng::Group::default().keep_right.to_degrees()).round();
    let side = (looks || animated).then(|| ("keep_right", json!(if animated { ANIMATED_SIDE } else { usual })));
    if let Value::Object(said) = said {
        for (key, value) in defaults.into_iter().chain(side) {
            said.entry(key).or_insert(value);
        }
    }
    let mut idle = Vec::new();
    if !looks {
        idle.extend(LOOKING_AHEAD);
    }
    if !looks && !animated {
        idle.push("keep_right");
    }
    if !walks {
        idle.push("preset");
    }
    idle
}

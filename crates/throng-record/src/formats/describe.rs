//! Converts a setting to metadata texts ([`keys`](super::keys)) and back.

use super::{PROGRAM, keys, names::Names, place};
use crate::Setting;

/// Returns the metadata of a setting.
pub(super) fn pairs(setting: &Setting) -> [(&'static str, String); 7] {
    let walkable = if setting.walkable.is_empty() { String::new() } else { place::ground(&setting.walkable) };
    [
        (keys::TITLE, setting.title.clone()),
        (keys::PROGRAM, PROGRAM.to_owned()),
        (keys::UNITS, "seconds, metres, metres a second, radians".to_owned()),
        (keys::GROUPS, serde_json::to_string(&setting.groups).expect("texts are JSON")),
        (keys::WALKABLE, walkable),
        (keys::OBSTACLES, place::solid(&setting.obstacles)),
        (keys::IN_SPACE, setting.in_space.to_string()),
    ]
}

/// Returns the setting of a file without its groups, which are added to `names`. `value` returns the text of a key.
///
/// # Errors
/// A text does not have the form of its key.
pub(super) fn setting(value: impl Fn(&str) -> Option<String>, names: &mut Names) -> Result<Setting, String> {
    let value = |key: &str| value(key).filter(|text| !text.is_empty());
    if let Some(text) = value(keys::GROUPS) {
        let groups: Vec<String> =
            serde_json::from_str(&text).map_err(|_| format!("{} is no list of names", keys::GROUPS))?;
        for (k, name) in groups.iter().enumerate() {
            names.index(if name.is_empty() { k.to_string() } else { name.clone() }.as_str());
        }
    }
    Ok(Setting {
        title: value(keys::TITLE).unwrap_or_default(),
        in_space: value(keys::IN_SPACE).as_deref() == Some("true"),
        walkable: value(keys::WALKABLE).map_or(Ok(vec![]), |text| place::read(&text).map(|(areas, _)| areas))?,
        obstacles: value(keys::OBSTACLES).map_or(Ok(vec![]), |text| place::read_solid(&text))?,
        ..Setting::default()
    })
}

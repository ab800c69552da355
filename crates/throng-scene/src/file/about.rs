//! Descriptions of values from the schema, as hints for errors about their type or range.

use super::path::{Path, TomlStep};
use serde_json::Value;

/// Returns the description of the value at a path, or of the nearest enclosing value with a description: its meaning,
/// unit, limits and default. `None` for a path that the schema does not contain, such as into parameters of a plug-in.
pub(super) fn about(path: &Path) -> Option<String> {
    let root = crate::schema();
    let (mut schema, mut key, mut found) = (&root, "", None);
    for step in &path.steps {
        let (next, description) = child(&root, schema, step)?;
        if let TomlStep::Key(name) = step {
            key = name;
        }
        if let Some(description) = description {
            let words: Vec<&str> = description.split_whitespace().collect();
            let default = next["default"].as_f64().map_or_else(String::new, |value| format!(" Default: {value}."));
            found = Some(format!("`{key}`: {}{default}", words.join(" ")));
        }
        schema = next;
    }
    found
}

/// Whether the schema has a value at a path that is written as for `--set`.
pub(super) fn is_known(written: &str) -> bool {
    let keys: Vec<&str> = written.split('.').map(str::trim).collect();
    let (list, below) = match keys[..] {
        [list @ ("group" | "obstacle" | "mover"), _, ref below @ ..] => (list, below),
        [first, ..] if crate::schema()["properties"].get(first).is_none() => ("group", &keys[..]),
        _ => ("", &keys[..]),
    };
    let start = if list.is_empty() { Path::default() } else { Path::of(list).index(0) };
    let step = |path: Path, key: &&str| key.parse().map_or_else(|_| path.name(key), |index| path.index(index));
    about(&below.iter().fold(start, step)).is_some()
}

/// Returns the schema one step below a schema, and its description.
fn child<'s>(root: &'s Value, schema: &'s Value, step: &TomlStep) -> Option<(&'s Value, Option<&'s str>)> {
    if let Some(name) = schema["$ref"].as_str() {
        return child(root, &root["$defs"][name.rsplit('/').next()?], step);
    }
    let next = match step {
        TomlStep::Key(key) => {
            let named = || schema.get("additionalProperties").filter(|schema| schema.is_object());
            schema["properties"].get(key).or_else(named)
        }
        TomlStep::Index(_) => schema.get("items"),
    };
    let Some(next) = next else {
        let choices = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema[key].as_array()).flatten();
        return choices.filter(|choice| choice.is_object()).find_map(|choice| child(root, choice, step));
    };
    // a choice is a table with one key; the description belongs to the choice
    Some((next, next["description"].as_str().or_else(|| schema["required"].get(0).and(schema["description"].as_str()))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_schema_says_what_a_value_is() {
        let group = Path::of("group").index(0);
        for (path, expected) in [
            (
                Path::of("time.step"),
                "`step`: Seconds from one output to the next. Limit: 0.00001 to 10. Default: 0.04.",
            ),
            (group.key("body.radius"), "`radius`: A disc of this radius, metres. Limit: > 0, at most 1000."),
            (
                group.key("body.radius.uniform").index(1),
                "`uniform`: Uniformly distributed between two bounds, the lower first.",
            ),
            (group.key("place.ring.center").index(0), "`center`: Its centre."),
        ] {
            assert_eq!(about(&path).as_deref(), Some(expected));
        }
        for path in [Path::default(), Path::of("no.such.key"), group.key("steer.own.gain")] {
            assert_eq!(about(&path), None);
        }
    }

    #[test]
    fn paths_of_set_are_known_whether_a_file_has_them_or_not() {
        for path in [
            "time.step",
            "body.radius",
            "group.walkers.steer.weighted_sum.2.of.flocking.cohesion.distance",
            "steer.switch.states.forth.of.wander.rate",
            "obstacle.3.shape.circle.radius",
            "field.0.flow.sketch.anchors.1.velocity.0",
            "path.0.radius",
        ] {
            assert!(is_known(path), "{path}");
        }
        for path in ["", "radius", "group.walkers.raduis", "steer.wander.speed", "obstacle.3.body.radius", "time.0"] {
            assert!(!is_known(path), "{path}");
        }
    }
}

//! What the scenes of the gallery use of the registry, found by reading them along the schema.

use super::schema::{Schema, list, reference};
use std::collections::BTreeSet;
use throng_scene::{Scene, gallery};
use toml::Value;

/// The scenes and what they use, in the order of the gallery.
pub struct Uses(Vec<(&'static str, BTreeSet<(String, String)>)>);

impl Uses {
    pub fn of_gallery() -> Self {
        let schema = Schema::default();
        Self(gallery::names().map(|name| (name, of_scene(gallery::text(name).unwrap(), &schema))).collect())
    }

    /// Returns the scenes that use a name of a part of the registry: `Place`, `Goal`, `Steer`, `Avoid`, `Flow`, `rules`.
    pub fn scenes(&self, registry: &str, name: &str) -> Vec<&'static str> {
        let used = (registry.to_owned(), name.to_owned());
        self.0.iter().filter(|(_, uses)| uses.contains(&used)).map(|(scene, _)| *scene).collect()
    }
}

/// Returns what a scene uses: parts of the registry, and names. Groups that choose no local model use their default.
fn of_scene(text: &str, schema: &Schema) -> BTreeSet<(String, String)> {
    let mut uses = BTreeSet::new();
    find(&Value::Table(text.parse().unwrap()), schema.root(), schema, &mut uses);
    let scene: Scene = text.parse().unwrap();
    uses.extend(scene.groups.iter().map(|group| ("Avoid".to_owned(), group.local_model().name)));
    uses.extend(scene.rules.map(|rules| ("rules".to_owned(), rules)));
    uses
}

/// Adds the choices in a value of this schema.
fn find(value: &Value, at: &serde_json::Value, schema: &Schema, uses: &mut BTreeSet<(String, String)>) {
    if let Some(name) = reference(at) {
        if let ("Place" | "Goal" | "Steer" | "Avoid" | "Flow", Value::Table(choice)) = (name, value) {
            uses.extend(choice.keys().map(|chosen| (name.to_owned(), chosen.clone())));
        }
        find(value, schema.definition(name), schema, uses);
    }
    for form in ["anyOf", "oneOf"].into_iter().flat_map(|key| list(at, key)) {
        find(value, form, schema, uses);
    }
    match value {
        Value::Table(entries) => {
            for (key, value) in entries {
                let known = at["properties"].get(key).or_else(|| at.get("additionalProperties"));
                known.into_iter().for_each(|known| find(value, known, schema, uses));
            }
        }
        Value::Array(items) => items.iter().for_each(|item| find(item, &at["items"], schema, uses)),
        _ => {}
    }
}

#[test]
fn choices_are_found_wherever_they_are_and_keys_are_no_choices() {
    let schema = Schema::default();
    let scene = r#"
        rules = "soccer"
        [[field]]
        name = "gusts"
        flow.sum = [{ of.noise = { length = 1, speed = 1 } }, { of.around_walls = { of.whirl = { center = [0, 0], speed = 1 } } }]
        [[group]]
        place.point = [0, 0]
        steer.switch = { first = "a", states.a = { of.priority.of = [
            { amortised = { every = 1, of.flocking = { separation = { weight = 1 }, cohesion = {} } } },
            { priority = [{ weighted_sum = [{ of.follow_flow = { flow.named = "gusts" } }] }] },
        ] } }
        [[group]]
        place.point = [5, 0]
        goal.journey = [{ goal.nearest = [{ area.disc = { center = [0, 5], radius = 1 } }] }, { goal.point = [5, 5] }]
        avoid.rvo = {}
        [[group]]
        place.point = [9, 0]
    "#;
    let found = of_scene(scene, &schema);
    let of = |registry: &str| -> Vec<&str> {
        found.iter().filter(|(part, _)| part == registry).map(|(_, name)| name.as_str()).collect()
    };
    assert_eq!(of("Steer"), ["amortised", "flocking", "follow_flow", "priority", "switch", "weighted_sum"]);
    assert_eq!(of("Flow"), ["around_walls", "named", "noise", "sum", "whirl"]);
    assert_eq!(of("Avoid"), ["none", "orca", "rvo"]);
    assert_eq!(of("Place"), ["point"]);
    assert_eq!(of("Goal"), ["area", "journey", "nearest", "point"]);
    assert_eq!(of("rules"), ["soccer"]);
}

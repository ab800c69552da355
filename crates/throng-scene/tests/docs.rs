//! The pages on the scene format say what is so.

use throng_scene::{Scene, schema};

const PAGES: [&str; 5] = [
    include_str!("../../../docs/scenes.md"),
    include_str!("../../../docs/models.md"),
    include_str!("../../../docs/steering.md"),
    include_str!("../../../docs/fields.md"),
    include_str!("../../../docs/swarms.md"),
];

#[test]
fn every_example_builds() {
    let examples = PAGES.iter().flat_map(|page| page.split("```toml\n").skip(1));
    let examples: Vec<&str> = examples.filter_map(|rest| rest.split("```").next()).collect();
    assert!(examples.len() >= 5);
    for example in examples {
        let scene: Scene = example.parse().unwrap_or_else(|error| panic!("{error}"));
        if !scene.groups.is_empty() {
            scene.build().unwrap_or_else(|error| panic!("{error}"));
        }
    }
}

#[test]
fn every_key_is_on_a_page() {
    fn keys(value: &serde_json::Value, out: &mut Vec<String>) {
        if let Some(properties) = value["properties"].as_object() {
            out.extend(properties.keys().cloned());
        }
        match value {
            serde_json::Value::Object(map) => map.values().for_each(|value| keys(value, out)),
            serde_json::Value::Array(list) => list.iter().for_each(|value| keys(value, out)),
            _ => {}
        }
    }
    let mut all = vec![];
    keys(&schema(), &mut all);
    assert!(all.len() > 60);
    let words: Vec<&str> =
        PAGES.iter().flat_map(|page| page.split(|c: char| !(c.is_alphanumeric() || c == '_'))).collect();
    for key in all {
        assert!(words.contains(&key.as_str()), "the pages do not mention `{key}`");
    }
}

//! The vector fields, and the tables and choices that only fields have.

use super::schema::{Schema, list, reference, words};
use super::table;
use serde_json::Value;

/// The definitions that the page of fields describes: what a field is, and how it governs a group.
const DESCRIBED: [&str; 2] = ["Flow", "Governed"];

pub fn tables(schema: &Schema) -> Vec<(String, String)> {
    let choices = schema.choices("Flow");
    let own: Vec<&str> = choices.iter().filter_map(|choice| reference(choice.parameters)).collect();
    let parts = parts(schema, &own);
    let kinds = choices.iter().map(|choice| {
        vec![format!("`{}`", choice.name), choice.about.clone(), schema.all_keys(choice.parameters, &parts)]
    });
    let rows = parts.iter().map(|name| {
        let part = schema.definition(name);
        vec![format!("`{name}`"), words(part), schema.all_keys(part, &parts)]
    });
    let governed = schema.keys(schema.definition("Governed"));
    let governed = governed.iter().map(|key| {
        let text = schema.key(key, &parts);
        vec![format!("`{}`", key.name), text.split_once(": ").unwrap().1.to_owned()]
    });
    vec![
        ("fields".to_owned(), table(&["`flow.`", "what it is", "keys"], kinds)),
        ("parts of fields".to_owned(), table(&["table", "what it is", "keys"], rows)),
        ("keys of field".to_owned(), table(&["key of `field`", "meaning"], governed)),
    ]
}

/// Returns the definitions that a scene reaches only through fields, in the order of their first use, except those of the
/// kinds of fields and those without keys.
fn parts<'a>(schema: &'a Schema, own: &[&'a str]) -> Vec<&'a str> {
    let (mut elsewhere, mut inside) = ([&DESCRIBED[..], own].concat(), vec![]);
    reach(schema, schema.root(), &mut elsewhere);
    for name in DESCRIBED.iter().chain(own) {
        reach(schema, schema.definition(name), &mut inside);
    }
    inside.retain(|name| !elsewhere.contains(name) && !schema.keys(schema.definition(name)).is_empty());
    inside
}

/// Adds the definitions to which a value refers, and those to which they refer. It enters no definition that is known.
fn reach<'a>(schema: &'a Schema, value: &'a Value, known: &mut Vec<&'a str>) {
    if let Some(name) = reference(value)
        && !known.contains(&name)
    {
        known.push(name);
        reach(schema, schema.definition(name), known);
    }
    for part in value["properties"].as_object().into_iter().flat_map(|keys| keys.values()) {
        reach(schema, part, known);
    }
    for part in ["items", "additionalProperties"].into_iter().filter_map(|key| value.get(key)) {
        reach(schema, part, known);
    }
    for part in ["anyOf", "oneOf"].into_iter().flat_map(|key| list(value, key)) {
        reach(schema, part, known);
    }
}

#[test]
fn every_field_has_a_row_and_every_table_that_only_fields_have() {
    let tables = tables(&Schema::default());
    let names =
        |at: usize| -> Vec<&str> { tables[at].1.lines().skip(2).map(|row| row.split('`').nth(1).unwrap()).collect() };
    let fields = throng_scene::Plugins::new().fields;
    assert_eq!(names(0), fields.names().collect::<Vec<_>>());
    let parts = names(1);
    assert!(
        ["Stroke", "Jams", "MapStroke", "Interaction", "Wendland"].iter().all(|part| parts.contains(part)),
        "{parts:?}"
    );
    // regions and places are no part of fields alone; kinds have their own rows
    assert!(["Region", "Position", "Sketch", "Flow"].iter().all(|part| !parts.contains(part)), "{parts:?}");
}

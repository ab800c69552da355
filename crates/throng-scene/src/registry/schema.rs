//! The JSON schema of declared parameters.

use super::{Flow, Steer};
use crate::scene::Point;
use crate::scene::flow;
use crate::scene::steer::{GroupFilter, ObstacleNames, Position, Target};
use schemars::{Schema, SchemaGenerator};
use serde_json::{Map, Value as Json, json};
use throng::parameters::{Kind, Names, Parameter, Parameters, Table, Written};

/// Returns the schema of a type's parameters.
pub(super) fn of_parameters<P: Parameters>(generator: &mut SchemaGenerator) -> Schema {
    let mut json = of_kind(P::KIND, generator);
    // the schema of a value does not know what it is for
    if !matches!(P::KIND, Kind::Table(_) | Kind::ListOrTable(..)) {
        json["description"] = P::ABOUT.into();
    }
    schema_of(json)
}

/// Returns the name of a type with parameters.
pub(super) fn type_name<P: Parameters>() -> &'static str {
    match P::KIND {
        Kind::Table(table) | Kind::ListOrTable(_, table) => table().name,
        _ => P::NAME,
    }
}

/// Returns the schema of a table with these parameters.
pub(super) fn of_table<'p>(
    about: &str,
    parameters: impl Iterator<Item = &'p Parameter> + Clone,
    generator: &mut SchemaGenerator,
) -> Json {
    let required: Vec<&str> = parameters.clone().filter(|known| known.is_required).map(|known| known.name).collect();
    let properties: Map<String, Json> =
        parameters.map(|known| (known.name.to_owned(), of_parameter(known, generator))).collect();
    let mut table = json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !about.is_empty() {
        table["description"] = about.into();
    }
    if !required.is_empty() {
        table["required"] = required.into();
    }
    table
}

/// Returns the schema of a choice: a table with one of these keys.
pub(super) fn of_choice(name: &str, about: &str, parameters: Json) -> Json {
    json!({
        "description": about,
        "type": "object",
        "properties": { name: parameters },
        "required": [name],
        "additionalProperties": false
    })
}

/// Returns JSON as a schema.
pub(super) fn schema_of(json: Json) -> Schema {
    match json {
        Json::Object(map) => map.into(),
        _ => Schema::default(),
    }
}

/// Returns the schema of a parameter, with its doc line, default, unit and limit.
fn of_parameter(parameter: &Parameter, generator: &mut SchemaGenerator) -> Json {
    let default = (parameter.default)();
    let mut json = match (parameter.kind, &default) {
        // files give some of the parameters: the default has the other ones
        (Kind::Table(table), Some(_)) => of_table_with_default(&table(), generator),
        (kind, _) => of_kind(kind, generator),
    };
    json["description"] = parameter.about.into();
    if let Some(default) = default {
        json["default"] = written(default);
    }
    if !parameter.unit.is_empty() {
        json["unit"] = parameter.unit.into();
    }
    let limit = parameter.limit;
    for (key, bound) in [("exclusiveMinimum", limit.above), ("minimum", limit.least), ("maximum", limit.most)] {
        if let Some(bound) = bound {
            json[key] = if bound.fract() == 0.0 { (bound as i64).into() } else { bound.into() };
        }
    }
    json
}

/// Returns the schema of a table that need not give any of its parameters.
fn of_table_with_default(table: &Table, generator: &mut SchemaGenerator) -> Json {
    definition(table.name, table.about, generator, |generator| {
        let mut json = table_schema(table, generator);
        if let Some(map) = json.as_object_mut() {
            map.remove("required");
        }
        json
    })
}

fn of_kind(kind: Kind, generator: &mut SchemaGenerator) -> Json {
    match kind {
        Kind::Number => json!({ "type": "number", "format": "double" }),
        Kind::Whole => json!({ "type": "integer", "minimum": 0 }),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Text | Kind::Surface | Kind::Path | Kind::Figure => json!({ "type": "string" }),
        Kind::Name(names) => {
            let names = names();
            definition(names.name, names.about, generator, |_| of_names(&names))
        }
        Kind::Choice(table) => {
            let table = table();
            definition(table.name, table.about, generator, |generator| {
                let choice = |known: &Parameter| {
                    let value = of_parameter(&Parameter { about: "", ..*known }, generator);
                    of_choice(known.name, known.about, without_description(value))
                };
                json!({ "description": table.about, "oneOf": table.parameters.iter().map(choice).collect::<Vec<_>>() })
            })
        }
        Kind::Table(table) => {
            let table = table();
            definition(table.name, table.about, generator, |generator| table_schema(&table, generator))
        }
        Kind::List(kind) => json!({ "type": "array", "items": of_kind(*kind, generator) }),
        Kind::Several(kind, count) => {
            json!({ "type": "array", "items": of_kind(*kind, generator), "minItems": count, "maxItems": count })
        }
        Kind::Named(kind) => json!({ "type": "object", "additionalProperties": of_kind(*kind, generator) }),
        Kind::ListOrTable(list, table) => {
            json!({ "anyOf": [of_kind(*list, generator), of_kind(Kind::Table(table), generator)] })
        }
        Kind::Vector | Kind::SpacePlace => generator.subschema_for::<Position>().to_value(),
        Kind::GroundPlace => generator.subschema_for::<Point>().to_value(),
        Kind::Target => generator.subschema_for::<Target>().to_value(),
        Kind::Groups => generator.subschema_for::<GroupFilter>().to_value(),
        Kind::Obstacles => generator.subschema_for::<ObstacleNames>().to_value(),
        Kind::Field => generator.subschema_for::<Flow>().to_value(),
        Kind::Map => generator.subschema_for::<flow::Map>().to_value(),
        Kind::Behaviour => generator.subschema_for::<Steer>().to_value(),
    }
}

fn without_description(mut json: Json) -> Json {
    if let Some(map) = json.as_object_mut() {
        map.remove("description");
    }
    json
}

fn table_schema(table: &Table, generator: &mut SchemaGenerator) -> Json {
    of_table(table.about, table.parameters.iter(), generator)
}

fn of_names(names: &Names) -> Json {
    let choices = names.names.iter().map(|known| {
        let mut choice = json!({ "type": "string", "const": known.name });
        if !known.about.is_empty() {
            choice["description"] = known.about.into();
        }
        choice
    });
    let choices: Vec<Json> = choices.collect();
    let mut json = json!({ "oneOf": choices });
    if !names.about.is_empty() {
        json["description"] = names.about.into();
    }
    json
}

/// Returns a reference to the definition with this name, which it makes if there is none; or the definition itself, where
/// definitions stand inline. Another definition with the same name has another description: a number then follows the name.
pub(super) fn definition(
    name: &str,
    about: &str,
    generator: &mut SchemaGenerator,
    make: impl FnOnce(&mut SchemaGenerator) -> Json,
) -> Json {
    if generator.settings().inline_subschemas {
        return make(generator);
    }
    let is_other = |name: &str| generator.definitions().get(name).is_some_and(|known| known["description"] != about);
    let (mut name, mut number) = (name.to_owned(), 1);
    while is_other(&name) {
        number += 1;
        name = format!("{}{number}", name.trim_end_matches(|digit: char| digit.is_ascii_digit()));
    }
    if !generator.definitions().contains_key(&name) {
        // a definition may refer to itself
        generator.definitions_mut().insert(name.clone(), json!({ "description": about }));
        let made = make(generator);
        generator.definitions_mut().insert(name.clone(), made);
    }
    json!({ "$ref": format!("#/$defs/{name}") })
}

/// Returns a value as JSON.
pub(super) fn written(value: Written) -> Json {
    match value {
        Written::Number(number) => number.into(),
        Written::Whole(number) => number.into(),
        Written::Flag(flag) => flag.into(),
        Written::Text(text) => text.into_owned().into(),
        Written::List(items) => items.into_iter().map(written).collect(),
        Written::Table(entries) => entries.into_iter().map(|(key, value)| (key.into_owned(), written(value))).collect(),
    }
}

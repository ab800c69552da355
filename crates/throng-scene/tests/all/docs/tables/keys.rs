//! Tables of keys, and those of vehicles.

use super::schema::{Key, Schema, toml};
use super::table;

/// The columns of a table of keys.
pub const COLUMNS: [&str; 5] = ["key", "what it is", "unit", "default", "limits"];

/// Returns the tables of the keys of vehicles.
pub fn tables(schema: &Schema) -> Vec<(String, String)> {
    let of = |name: &str| {
        let keys = schema.keys(schema.definition(name));
        table(&COLUMNS, keys.iter().map(|key| row(schema, key).to_vec()))
    };
    vec![("keys of vehicle".to_owned(), of("Vehicle")), ("keys of vehicle.forces".to_owned(), of("Forces"))]
}

/// Returns the row of a key: its name, doc line, unit, default and limit.
pub fn row(schema: &Schema, key: &Key<'_>) -> [String; 5] {
    let (about, limit) = key.about.split_once(" Limit: ").unwrap_or((&key.about, ""));
    let names = schema.keys(key.value).into_iter().filter(|name| name.value.get("const").is_some());
    let names: String = names.map(|name| format!("<br>`{}`: {}", name.name, name.about)).collect();
    let default = match &key.value["default"] {
        _ if key.is_required => "required".into(),
        serde_json::Value::Null => String::new(),
        serde_json::Value::Object(table) if table.is_empty() => String::new(),
        default => format!("`{}`", toml(default)),
    };
    let unit = key.value["unit"].as_str().unwrap_or_default();
    [
        format!("`{}`", key.name),
        about.to_owned() + &names,
        unit.to_owned(),
        default,
        limit.trim_end_matches('.').to_owned(),
    ]
}

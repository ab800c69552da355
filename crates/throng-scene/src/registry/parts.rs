//! The fields that a scene gives as parameters of other fields.

use super::Flow;
use throng::parameters::{Kind, Parameter};
use toml::Value;

/// Returns the fields in a value of a kind, each with its path in the value: `.0.of`.
pub(super) fn parts(kind: Kind, value: &Value) -> Vec<(String, Flow)> {
    match (kind, value) {
        (Kind::Field, _) => value.clone().try_into().map(|flow| (String::new(), flow)).into_iter().collect(),
        (Kind::List(kind) | Kind::Several(kind, _) | Kind::ListOrTable(kind, _), Value::Array(items)) => {
            items.iter().enumerate().flat_map(|(i, item)| below(&i.to_string(), *kind, item)).collect()
        }
        (Kind::Named(kind), Value::Table(items)) => {
            items.iter().flat_map(|(name, item)| below(name, *kind, item)).collect()
        }
        (Kind::Table(table) | Kind::Choice(table) | Kind::ListOrTable(_, table), Value::Table(items)) => {
            let given = |known: &Parameter| items.get(known.name).map(|item| below(known.name, known.kind, item));
            table().parameters.iter().filter_map(given).flatten().collect()
        }
        _ => vec![],
    }
}

/// Returns the fields in the value of a key, each with its path.
fn below(key: &str, kind: Kind, value: &Value) -> Vec<(String, Flow)> {
    parts(kind, value).into_iter().map(|(path, flow)| (format!(".{key}{path}"), flow)).collect()
}

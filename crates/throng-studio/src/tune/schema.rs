//! Reading of the schema: types, names, defaults and ranges of properties.

use super::about::About;
use serde_json::Value;

/// Returns the default of a property. Lists are left out, because a place in a list that the text does not have cannot be
/// changed.
pub(super) fn default(property: &Value) -> Option<Value> {
    fn cleaned(value: &Value) -> Option<Value> {
        match value {
            Value::Null | Value::Array(_) => None,
            Value::Number(number) => {
                Some(number.as_f64().map_or_else(|| value.clone(), |number| written(number).into()))
            }
            Value::Object(all) => {
                Some(all.iter().filter_map(|(key, value)| Some((key.clone(), cleaned(value)?))).collect())
            }
            _ => Some(value.clone()),
        }
    }
    cleaned(&property["default"])
}

/// Returns the variants of a schema, with references and nested variants resolved.
pub(super) fn variants<'a>(root: &'a Value, schema: &'a Value) -> Vec<&'a Value> {
    if let Some(name) = schema["$ref"].as_str().and_then(|name| name.strip_prefix("#/$defs/")) {
        return variants(root, &root["$defs"][name]);
    }
    let of = |key: &str| schema[key].as_array().map(|all| all.iter().flat_map(|one| variants(root, one)).collect());
    of("anyOf").or_else(|| of("oneOf")).unwrap_or_else(|| vec![schema])
}

/// Whether a schema allows a type.
pub(super) fn is(schema: &Value, name: &str) -> bool {
    match &schema["type"] {
        Value::String(one) => one == name,
        Value::Array(several) => several.iter().any(|one| one == name),
        _ => false,
    }
}

/// Whether a schema describes colours.
pub(super) fn is_colour(schema: &Value) -> bool {
    schema["pattern"].as_str().is_some_and(|pattern| pattern.starts_with("^#"))
}

/// Whether a schema describes tables with this key only.
pub(super) fn is_only(schema: &Value, key: &str) -> bool {
    schema["properties"].as_object().is_some_and(|known| known.len() == 1 && known.contains_key(key))
}

/// Returns a number of a schema as written. An `f32` that was widened to `f64` has spurious digits.
pub(super) fn written(number: f64) -> f64 {
    let short = number as f32;
    if f64::from(short) == number { short.to_string().parse().unwrap_or(number) } else { number }
}

/// Returns the names that a schema allows, each with its doc line.
pub(super) fn names(schema: &Value) -> Vec<(String, String)> {
    let named = schema["const"].as_str().map(|name| (name.to_owned(), line(schema)));
    let listed = schema["enum"].as_array().into_iter().flatten().filter_map(Value::as_str);
    named.into_iter().chain(listed.map(|name| (name.to_owned(), line(schema)))).collect()
}

pub(super) fn line(schema: &Value) -> String {
    schema["description"].as_str().unwrap_or_default().to_owned()
}

/// Returns the range of a slider: the limits, or about five times the default where limits are far away or missing.
pub(super) fn range(about: &About, value: f64) -> (f64, f64) {
    let usual = about.without.filter(|usual| *usual != 0.0).unwrap_or(value).abs().max(0.2);
    let unit = 10.0_f64.powf((5.0 * usual).log10().floor());
    let wide = [1.0, 2.0, 5.0, 10.0].map(|times| times * unit).into_iter().find(|wide| *wide >= 4.0 * usual);
    let wide = wide.unwrap_or(10.0 * unit);
    let low = about.low.filter(|low| *low >= -wide * 10.0).unwrap_or(if value < 0.0 { -wide } else { 0.0 });
    let high = about.high.filter(|high| *high <= wide * 10.0).unwrap_or(wide);
    (low.min(value), high.max(value).max(low + 1e-3))
}

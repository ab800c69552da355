//! The schema of scene files as tables need it: choices, keys, and how files write values.

use serde_json::Value;
use throng_scene::Scene;

/// The schema of scene files.
pub struct Schema(Value);

/// What a scene can choose by name.
pub struct Choice<'a> {
    pub name: &'a str,
    pub about: String,
    /// The schema of its parameters.
    pub parameters: &'a Value,
}

/// A key of a table, or a choice of several.
pub struct Key<'a> {
    pub name: String,
    pub about: String,
    /// The schema of its value.
    pub value: &'a Value,
    pub is_required: bool,
}

impl Default for Schema {
    /// Returns the schema of the types.
    fn default() -> Self {
        Self(schemars::schema_for!(Scene).to_value())
    }
}

impl Schema {
    pub fn root(&self) -> &Value {
        &self.0
    }

    /// Returns the definition with this name.
    pub fn definition(&self, name: &str) -> &Value {
        &self.0["$defs"][name]
    }

    /// Returns the choices of a part of the registry: `Steer`, `Avoid`, `Flow`.
    pub fn choices(&self, registry: &str) -> Vec<Choice<'_>> {
        let choices = self.definition(registry)["oneOf"].as_array().unwrap();
        let choices = choices.iter().map(|choice| {
            let (name, parameters) = choice["properties"].as_object().unwrap().iter().next().unwrap();
            Choice { name, about: words(choice), parameters }
        });
        choices.collect()
    }

    /// Returns the definition that a value refers to, or the value itself; without the form `null`.
    pub fn resolved<'a>(&'a self, value: &'a Value) -> &'a Value {
        if let Some(name) = reference(value) {
            return self.resolved(self.definition(name));
        }
        only(forms(value)).map_or(value, |form| self.resolved(form))
    }

    /// Returns the keys of a table, or what a choice can be. A list that may stand for a table is left out.
    pub fn keys<'a>(&'a self, value: &'a Value) -> Vec<Key<'a>> {
        let value = self.resolved(value);
        let table = forms(value).map(|form| self.resolved(form)).find(|form| form["properties"].is_object());
        let value = table.unwrap_or(value);
        let is_required = |key: &str| list(value, "required").any(|known| known == key);
        let keys = value["properties"].as_object().into_iter().flatten();
        let keys = keys.map(|(name, value)| Key {
            name: name.clone(),
            about: words(value),
            value,
            is_required: is_required(name),
        });
        let choices = list(value, "oneOf").map(|choice| {
            let key = choice["properties"].as_object().and_then(|keys| keys.iter().next());
            let (name, value) = key.map_or((toml(&choice["const"]), choice), |(name, value)| (name.clone(), value));
            Key { name, about: words(choice), value, is_required: false }
        });
        keys.chain(choices).collect()
    }

    /// Returns how files write a value. Of the definitions in `named` it has only the names. Empty for what needs no
    /// explanation: a number, a name.
    pub fn shape(&self, value: &Value, named: &[&str]) -> String {
        match self.link(value) {
            Some(name) if named.contains(&name) => return format!("`{name}`"),
            Some("Steer") => return "behaviours".into(),
            _ => {}
        }
        let value = self.resolved(value);
        let is_number = value["items"]["type"] == "number";
        match (value["minItems"].as_u64(), value["maxItems"].as_u64()) {
            (Some(2), Some(2)) if is_number => return "`[x, y]`".into(),
            (Some(2), Some(3)) if is_number => return "`[x, y]` or `[x, y, z]`".into(),
            _ => {}
        }
        let part = |key: &str| value.get(key).filter(|part| part.is_object());
        if let Some(part) = part("items") {
            return format!("a list of {}", self.shape(part, named));
        }
        if let Some(part) = part("additionalProperties") {
            return format!("names, each with {}", self.shape(part, named));
        }
        let key = |(key, value): (&String, &Value)| match &value["default"] {
            Value::Null | Value::Object(_) | Value::Array(_) => key.clone(),
            default => format!("{key} = {}", toml(default)),
        };
        match value["properties"].as_object() {
            Some(keys) if !keys.is_empty() => {
                format!("`{{ {} }}`", keys.iter().map(key).collect::<Vec<_>>().join(", "))
            }
            _ => String::new(),
        }
    }

    /// Returns the text of a key: its doc line, how files write a table, and the default.
    pub fn key(&self, key: &Key<'_>, named: &[&str]) -> String {
        let mut text = format!("`{}`: {}", key.name, key.about);
        text += &match self.link(key.value).filter(|name| named.contains(name)) {
            Some(name) => format!(" See `{name}`."),
            None if self.holds_tables(key.value, named) => format!(" In files {}.", self.shape(key.value, named)),
            None => String::new(),
        };
        match &key.value["default"] {
            Value::Null | Value::Object(_) => {}
            Value::Array(items) if items.is_empty() => {}
            default => text += &format!(" Default: `{}`.", toml(default)),
        }
        text
    }

    /// Returns the text of all keys of a value; how files write it if it has none.
    pub fn all_keys(&self, value: &Value, named: &[&str]) -> String {
        match &self.keys(value)[..] {
            [] => self.shape(value, named),
            keys => keys.iter().map(|key| self.key(key, named)).collect::<Vec<_>>().join("<br>"),
        }
    }

    /// Whether a value, or each of its items, has keys or a named definition.
    fn holds_tables(&self, value: &Value, named: &[&str]) -> bool {
        let is_named = self.link(value).is_some_and(|name| named.contains(&name));
        let value = self.resolved(value);
        let part = |key: &str| value.get(key).filter(|part| part.is_object());
        is_named
            || value["properties"].as_object().is_some_and(|keys| !keys.is_empty())
            || part("items").or(part("additionalProperties")).is_some_and(|part| self.holds_tables(part, named))
    }

    /// Returns the name of the definition that a value refers to, if it may be null too.
    fn link<'a>(&self, value: &'a Value) -> Option<&'a str> {
        reference(value).or_else(|| only(forms(value)).and_then(reference))
    }
}

/// Returns the name of the definition that a value refers to.
pub fn reference(value: &Value) -> Option<&str> {
    value["$ref"].as_str()?.strip_prefix("#/$defs/")
}

/// Returns the forms that a value can have, except `null`.
fn forms(value: &Value) -> impl Iterator<Item = &Value> {
    list(value, "anyOf").filter(|form| form["type"] != "null")
}

/// Returns the only item; `None` if there are none or several.
fn only<T>(mut items: impl Iterator<Item = T>) -> Option<T> {
    items.next().filter(|_| items.next().is_none())
}

/// Returns the items of a list of a value; none if it has no such list.
pub fn list<'a>(value: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> {
    value[key].as_array().into_iter().flatten()
}

/// Returns the description of a value in one line.
pub fn words(value: &Value) -> String {
    value["description"].as_str().unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns a value as files write it.
pub fn toml(value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => number.as_f64().unwrap_or_default().to_string(),
        Value::Array(items) => format!("[{}]", items.iter().map(toml).collect::<Vec<_>>().join(", ")),
        Value::Object(entries) => {
            let entries: Vec<_> = entries.iter().map(|(key, value)| format!("{key} = {}", toml(value))).collect();
            format!("{{ {} }}", entries.join(", "))
        }
        value => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn keys_say_what_files_write() {
        let schema = Schema(json!({ "$defs": {
            "Kettle": {
                "description": "A kettle.",
                "properties": {
                    "litres": { "type": "number", "description": "Its volume,\n litres. Limit: > 0.", "default": 1.0 },
                    "spout": { "anyOf": [{ "$ref": "#/$defs/Spout" }, { "type": "null" }], "description": "Its spout." },
                    "cups": { "type": "array", "items": { "$ref": "#/$defs/Spout" }, "description": "Cups.", "default": [] },
                    "at": { "$ref": "#/$defs/At", "description": "Its place.", "default": [1.0, 2.5] },
                },
                "required": ["spout"],
            },
            "Spout": { "properties": { "width": { "type": "number", "default": 0.5 }, "lid": { "default": { "a": 1 } } } },
            "At": { "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 },
            "Heat": { "oneOf": [
                { "const": "low", "description": "Little." },
                { "properties": { "set": { "$ref": "#/$defs/Spout" } }, "description": "As given." },
            ] },
            "Several": { "anyOf": [{ "type": "array", "items": { "$ref": "#/$defs/At" } }, { "$ref": "#/$defs/Spout" }] },
        } }));
        let of = |name: &str| schema.definition(name);
        let litres = "`litres`: Its volume, litres. Limit: > 0. Default: `1`.";
        let at = "`at`: Its place. Default: `[1, 2.5]`.";
        let inline = "In files `{ width = 0.5, lid }`.";
        assert_eq!(
            schema.all_keys(of("Kettle"), &[]).split("<br>").collect::<Vec<_>>(),
            [
                litres,
                &format!("`spout`: Its spout. {inline}"),
                "`cups`: Cups. In files a list of `{ width = 0.5, lid }`.",
                at
            ]
        );
        assert_eq!(
            schema.all_keys(of("Kettle"), &["Spout"]).split("<br>").collect::<Vec<_>>(),
            [litres, "`spout`: Its spout. See `Spout`.", "`cups`: Cups. In files a list of `Spout`.", at]
        );
        assert!(schema.keys(of("Kettle")).iter().all(|key| key.is_required == (key.name == "spout")));
        assert_eq!(schema.all_keys(of("Heat"), &[]), format!("`\"low\"`: Little.<br>`set`: As given. {inline}"));
        assert_eq!(schema.all_keys(of("At"), &[]), "`[x, y]`");
        // the keys of a form as a table; as a value, such a choice of forms needs more words than a cell has
        assert_eq!(schema.keys(of("Several")).len(), 2);
        assert_eq!(schema.shape(of("Several"), &[]), "");
    }
}

//! The tree of tunable parameters, built from a schema and the values that fit it.

use super::about::About;
use serde_json::{Map, Value, json};

/// The parameters of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// The key, or the name of the group.
    pub name: String,
    /// The doc line.
    pub about: String,
    /// The parameters of the table.
    pub parameters: Vec<Parameter>,
    /// The tables inside.
    pub sections: Vec<Self>,
}

/// A tunable parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The path in the scene: `group.0.avoid.orca.time_horizon`.
    pub path: String,
    /// The key.
    pub name: String,
    /// The parsed doc line.
    pub about: About,
    /// Whether the scene states the value. Otherwise the default is shown.
    pub given: bool,
    /// The type and value.
    pub kind: ParameterKind,
}

/// The type of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterKind {
    /// A number in a range.
    Number {
        /// The value.
        value: f64,
        /// The minimum of the slider.
        low: f64,
        /// The maximum of the slider.
        high: f64,
        /// Whether the number is an integer.
        whole: bool,
    },
    /// A boolean.
    Switch {
        /// The value, `None` for the default.
        value: Option<bool>,
    },
    /// A choice of names, each with its doc line. The name of a table stands for the table without keys.
    Choice {
        /// The selected name.
        value: String,
        /// The available names.
        options: Vec<(String, String)>,
    },
}

impl Section {
    /// Removes keys of this table.
    pub fn leave_out(&mut self, names: &[&str]) {
        self.parameters.retain(|parameter| !names.contains(&parameter.name.as_str()));
        self.sections.retain(|section| !names.contains(&section.name.as_str()));
    }

    /// Marks the parameters that the scene states. `has` tells whether a path exists in its text.
    pub fn given(&mut self, has: &dyn Fn(&str) -> bool) {
        self.parameters.iter_mut().for_each(|parameter| parameter.given = has(&parameter.path));
        self.sections.iter_mut().for_each(|section| section.given(has));
    }

    /// Whether there is no parameter.
    pub fn is_empty(&self) -> bool {
        self.parameters.is_empty() && self.sections.iter().all(Self::is_empty)
    }
}

/// Returns the section of a table with this schema and the values `said`.
pub fn of(root: &Value, schema: &Value, said: &Value, path: &str, name: &str) -> Section {
    let mut section = Section { name: name.to_owned(), about: line(schema), ..Section::default() };
    if let Some(properties) = schema["properties"].as_object() {
        fill(&mut section, root, (properties, ""), said, path);
    }
    section
}

/// Adds the properties of a table. A property without a doc line gets the line of its table.
fn fill(
    section: &mut Section,
    root: &Value,
    (properties, line_of_all): (&Map<String, Value>, &str),
    said: &Value,
    path: &str,
) {
    for (key, property) in properties {
        let own = line(property);
        let about = About::new(if own.is_empty() { line_of_all } else { &own });
        let about = About {
            unit: property["unit"].as_str().map(str::to_owned).or(about.unit),
            low: about.low.or(property["minimum"].as_f64()).or(property["exclusiveMinimum"].as_f64()),
            high: about.high.or(property["maximum"].as_f64()),
            without: about.without.or(property["default"].as_f64().map(written)),
            ..about
        };
        let path = format!("{path}.{key}");
        add(section, root, property, said.get(key), Place { path, name: key, about });
    }
}

/// The path, name and doc line of a property.
struct Place<'a> {
    path: String,
    name: &'a str,
    about: About,
}

/// Adds a property as a parameter or as a section.
fn add(section: &mut Section, root: &Value, schema: &Value, said: Option<&Value>, place: Place) {
    let Place { path, name, about } = place;
    let given = said.is_some();
    let variants = variants(root, schema);
    // the name of a table stands for the table without keys
    let named = said.and_then(Value::as_str).filter(|name| variants.iter().any(|variant| is_only(variant, name)));
    let named = named.map(|name| json!({ name: {} }));
    let said = named.as_ref().or(said);
    let parameter = |kind: ParameterKind| Parameter {
        path: path.clone(),
        name: name.to_owned(),
        about: about.clone(),
        given,
        kind,
    };
    if let Some(value) = said.and_then(Value::as_f64).or(about.without.filter(|_| !given))
        && variants.iter().any(|variant| is(variant, "number") || is(variant, "integer"))
    {
        let whole = variants.iter().any(|variant| is(variant, "integer"));
        let (low, high) = range(&about, value);
        section.parameters.push(parameter(ParameterKind::Number { value, low, high, whole }));
    } else if variants.iter().any(|variant| is(variant, "boolean")) {
        section.parameters.push(parameter(ParameterKind::Switch { value: said.and_then(Value::as_bool) }));
    } else if let Some(Value::String(value)) = said {
        let options: Vec<(String, String)> = variants.iter().flat_map(|variant| names(variant)).collect();
        if options.iter().any(|(option, _)| option == value) {
            section.parameters.push(parameter(ParameterKind::Choice { value: value.clone(), options }));
        }
    } else if let Some(Value::Array(items)) = said {
        let inner = variants.iter().find_map(|variant| variant.get("items"));
        for (k, item) in items.iter().enumerate() {
            let Some(inner) = inner else { break };
            let own = line(inner);
            // an element without a doc line gets the line of its list
            let own = if own.is_empty() { about.clone() } else { About::new(&own) };
            let about = About { low: about.low, high: about.high, ..own };
            let path = format!("{path}.{k}");
            let mut holder =
                Section { name: format!("{name} {}", k + 1), about: about.text.clone(), ..Section::default() };
            let name = holder.name.clone();
            add(&mut holder, root, inner, Some(item), Place { path, name: &name, about });
            // a section that holds a single table becomes that table
            let only = holder.parameters.is_empty() && holder.sections.len() == 1;
            let holder = if only { holder.sections.remove(0) } else { holder };
            section.sections.extend(Some(holder).filter(|holder| !holder.is_empty()));
        }
    } else if let Some(table @ Value::Object(values)) = said {
        table_of(section, root, &variants, (table, values), parameter);
    }
}

/// Adds a table: the variant that has all its keys, and the choice of the variant where there is one.
fn table_of(
    section: &mut Section,
    root: &Value,
    variants: &[&Value],
    (table, values): (&Value, &Map<String, Value>),
    parameter: impl Fn(ParameterKind) -> Parameter,
) {
    let fits = |variant: &&&Value| {
        variant["properties"].as_object().is_some_and(|known| values.keys().all(|key| known.contains_key(key)))
    };
    let Some(variant) = variants.iter().find(fits) else { return };
    let shell = parameter(ParameterKind::Switch { value: None });
    let about = if shell.about.text.is_empty() { line(variant) } else { shell.about.text.clone() };
    let mut inner = Section { name: shell.name.clone(), about, ..Section::default() };
    // in a choice of tables, each variant has one key, which selects it
    let one_key = |variant: &&&Value| variant["properties"].as_object().is_some_and(|known| known.len() == 1);
    let options: Vec<(String, String)> = variants
        .iter()
        .filter(one_key)
        .flat_map(|variant| {
            variant["properties"].as_object().into_iter().flatten().map(|(key, _)| (key.clone(), line(variant)))
        })
        .collect();
    let chosen = values.keys().next().filter(|_| options.len() > 2 && values.len() == 1);
    if let Some(chosen) = chosen {
        inner.parameters.push(parameter(ParameterKind::Choice { value: chosen.clone(), options }));
    }
    if let Some(properties) = variant["properties"].as_object() {
        fill(&mut inner, root, (properties, &line(variant)), table, &shell.path);
    }
    // the content of the selected table is shown directly beside the choice
    if chosen.is_some() && inner.sections.len() == 1 {
        let only = inner.sections.remove(0);
        inner.parameters.extend(only.parameters);
        inner.sections.extend(only.sections);
    }
    if !inner.is_empty() {
        section.sections.push(inner);
    }
}

/// Returns the variants of a schema, with references and nested variants resolved.
fn variants<'a>(root: &'a Value, schema: &'a Value) -> Vec<&'a Value> {
    if let Some(name) = schema["$ref"].as_str().and_then(|name| name.strip_prefix("#/$defs/")) {
        return variants(root, &root["$defs"][name]);
    }
    let of = |key: &str| schema[key].as_array().map(|all| all.iter().flat_map(|one| variants(root, one)).collect());
    of("anyOf").or_else(|| of("oneOf")).unwrap_or_else(|| vec![schema])
}

/// Whether a schema allows a type.
fn is(schema: &Value, name: &str) -> bool {
    match &schema["type"] {
        Value::String(one) => one == name,
        Value::Array(several) => several.iter().any(|one| one == name),
        _ => false,
    }
}

/// Whether a schema describes tables with this key only.
fn is_only(schema: &Value, key: &str) -> bool {
    schema["properties"].as_object().is_some_and(|known| known.len() == 1 && known.contains_key(key))
}

/// Returns a number of a schema as written. An `f32` that was widened to `f64` has spurious digits.
fn written(number: f64) -> f64 {
    let short = number as f32;
    if f64::from(short) == number { short.to_string().parse().unwrap_or(number) } else { number }
}

/// Returns the names that a schema allows, each with its doc line.
fn names(schema: &Value) -> Vec<(String, String)> {
    let named = schema["const"].as_str().map(|name| (name.to_owned(), line(schema)));
    let listed = schema["enum"].as_array().into_iter().flatten().filter_map(Value::as_str);
    named.into_iter().chain(listed.map(|name| (name.to_owned(), line(schema)))).collect()
}

fn line(schema: &Value) -> String {
    schema["description"].as_str().unwrap_or_default().to_owned()
}

/// Returns the range of a slider: the limits, or about five times the default where limits are far away or missing.
fn range(about: &About, value: f64) -> (f64, f64) {
    let usual = about.without.filter(|usual| *usual != 0.0).unwrap_or(value).abs().max(0.2);
    let unit = 10.0_f64.powf((5.0 * usual).log10().floor());
    let wide = [1.0, 2.0, 5.0, 10.0].map(|times| times * unit).into_iter().find(|wide| *wide >= 4.0 * usual);
    let wide = wide.unwrap_or(10.0 * unit);
    let low = about.low.filter(|low| *low >= -wide * 10.0).unwrap_or(if value < 0.0 { -wide } else { 0.0 });
    let high = about.high.filter(|high| *high <= wide * 10.0).unwrap_or(wide);
    (low.min(value), high.max(value).max(low + 1e-3))
}

//! The tree of what can be tuned, from a schema and from values that fit it.

use super::about::About;
use serde_json::{Map, Value, json};

/// Parameters that belong together: those of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Its key, or the group's name.
    pub name: String,
    /// Its doc line.
    pub about: String,
    /// What it holds.
    pub parameters: Vec<Parameter>,
    /// The tables in it.
    pub sections: Vec<Self>,
}

/// Something that can be tuned.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Where it stands in the scene: `group.0.avoid.orca.time_horizon`.
    pub path: String,
    /// Its key.
    pub name: String,
    /// What its doc line says.
    pub about: About,
    /// Whether the scene says it; else what is shown is what holds without it.
    pub given: bool,
    /// What it can be, and is.
    pub kind: Kind,
}

/// What a parameter can be.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A number, usually between two others.
    Number {
        /// What it is.
        value: f64,
        /// The least that a slider shows.
        low: f64,
        /// The most.
        high: f64,
        /// Whether it counts something.
        whole: bool,
    },
    /// Yes or no.
    Switch {
        /// What it is; `None`: whatever holds without it.
        value: Option<bool>,
    },
    /// One of several names, each with its doc line. A name of a table stands for one with nothing in it.
    Choice {
        /// What it is.
        value: String,
        /// What it can be.
        options: Vec<(String, String)>,
    },
}

impl Section {
    /// Leaves out keys of this table.
    pub fn leave_out(&mut self, names: &[&str]) {
        self.parameters.retain(|parameter| !names.contains(&parameter.name.as_str()));
        self.sections.retain(|section| !names.contains(&section.name.as_str()));
    }

    /// Notes what the scene says itself: what it has at these paths.
    pub fn given(&mut self, has: &dyn Fn(&str) -> bool) {
        self.parameters.iter_mut().for_each(|parameter| parameter.given = has(&parameter.path));
        self.sections.iter_mut().for_each(|section| section.given(has));
    }

    /// Whether there is nothing to tune.
    pub fn is_empty(&self) -> bool {
        self.parameters.is_empty() && self.sections.iter().all(Self::is_empty)
    }
}

/// The section of a table that a schema describes and that says `said`.
pub fn of(root: &Value, schema: &Value, said: &Value, path: &str, name: &str) -> Section {
    let mut section = Section { name: name.to_owned(), about: line(schema), ..Section::default() };
    if let Some(properties) = schema["properties"].as_object() {
        fill(&mut section, root, (properties, ""), said, path);
    }
    section
}

/// Adds what properties describe; those without a doc line have that of their table.
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
            low: about.low.or(property["minimum"].as_f64()),
            high: about.high.or(property["maximum"].as_f64()),
            without: about.without.or(property["default"].as_f64().map(written)),
            ..about
        };
        let path = format!("{path}.{key}");
        add(section, root, property, said.get(key), Place { path, name: key, about });
    }
}

/// Where something stands, and what is said of it.
struct Place<'a> {
    path: String,
    name: &'a str,
    about: About,
}

/// Adds what a schema describes: a parameter, or a section of its own.
fn add(section: &mut Section, root: &Value, schema: &Value, said: Option<&Value>, place: Place) {
    let Place { path, name, about } = place;
    let given = said.is_some();
    let variants = variants(root, schema);
    // a name of a table stands for one with nothing in it
    let named = said.and_then(Value::as_str).filter(|name| variants.iter().any(|variant| is_only(variant, name)));
    let named = named.map(|name| json!({ name: {} }));
    let said = named.as_ref().or(said);
    let parameter =
        |kind: Kind| Parameter { path: path.clone(), name: name.to_owned(), about: about.clone(), given, kind };
    if let Some(value) = said.and_then(Value::as_f64).or(about.without.filter(|_| !given))
        && variants.iter().any(|variant| is(variant, "number") || is(variant, "integer"))
    {
        let whole = variants.iter().any(|variant| is(variant, "integer"));
        let (low, high) = range(&about, value);
        section.parameters.push(parameter(Kind::Number { value, low, high, whole }));
    } else if variants.iter().any(|variant| is(variant, "boolean")) {
        section.parameters.push(parameter(Kind::Switch { value: said.and_then(Value::as_bool) }));
    } else if let Some(Value::String(value)) = said {
        let options: Vec<(String, String)> = variants.iter().flat_map(|variant| names(variant)).collect();
        if options.iter().any(|(option, _)| option == value) {
            section.parameters.push(parameter(Kind::Choice { value: value.clone(), options }));
        }
    } else if let Some(Value::Array(items)) = said {
        let inner = variants.iter().find_map(|variant| variant.get("items"));
        for (k, item) in items.iter().enumerate() {
            let Some(inner) = inner else { break };
            let own = line(inner);
            // an element without a doc line has that of its list
            let own = if own.is_empty() { about.clone() } else { About::new(&own) };
            let about = About { low: about.low, high: about.high, ..own };
            let path = format!("{path}.{k}");
            let mut holder =
                Section { name: format!("{name} {}", k + 1), about: about.text.clone(), ..Section::default() };
            let name = holder.name.clone();
            add(&mut holder, root, inner, Some(item), Place { path, name: &name, about });
            // what holds one table is that table
            let only = holder.parameters.is_empty() && holder.sections.len() == 1;
            let holder = if only { holder.sections.remove(0) } else { holder };
            section.sections.extend(Some(holder).filter(|holder| !holder.is_empty()));
        }
    } else if let Some(table @ Value::Object(values)) = said {
        table_of(section, root, &variants, (table, values), parameter);
    }
}

/// Adds a table: of the variants the one whose keys it has, and which of them it is where that can be chosen.
fn table_of(
    section: &mut Section,
    root: &Value,
    variants: &[&Value],
    (table, values): (&Value, &Map<String, Value>),
    parameter: impl Fn(Kind) -> Parameter,
) {
    let fits = |variant: &&&Value| {
        variant["properties"].as_object().is_some_and(|known| values.keys().all(|key| known.contains_key(key)))
    };
    let Some(variant) = variants.iter().find(fits) else { return };
    let shell = parameter(Kind::Switch { value: None });
    let about = if shell.about.text.is_empty() { line(variant) } else { shell.about.text.clone() };
    let mut inner = Section { name: shell.name.clone(), about, ..Section::default() };
    // tables of one key each: the key says which
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
        inner.parameters.push(parameter(Kind::Choice { value: chosen.clone(), options }));
    }
    if let Some(properties) = variant["properties"].as_object() {
        fill(&mut inner, root, (properties, &line(variant)), table, &shell.path);
    }
    // a table that was chosen shows what it holds right there
    if chosen.is_some() && inner.sections.len() == 1 {
        let only = inner.sections.remove(0);
        inner.parameters.extend(only.parameters);
        inner.sections.extend(only.sections);
    }
    if !inner.is_empty() {
        section.sections.push(inner);
    }
}

/// What a schema can be: itself without references, or each of its variants, which may have some of their own.
fn variants<'a>(root: &'a Value, schema: &'a Value) -> Vec<&'a Value> {
    if let Some(name) = schema["$ref"].as_str().and_then(|name| name.strip_prefix("#/$defs/")) {
        return variants(root, &root["$defs"][name]);
    }
    let of = |key: &str| schema[key].as_array().map(|all| all.iter().flat_map(|one| variants(root, one)).collect());
    of("anyOf").or_else(|| of("oneOf")).unwrap_or_else(|| vec![schema])
}

/// Whether a schema is, among others, of a type.
fn is(schema: &Value, name: &str) -> bool {
    match &schema["type"] {
        Value::String(one) => one == name,
        Value::Array(several) => several.iter().any(|one| one == name),
        _ => false,
    }
}

/// Whether a schema is of tables with this key and no other.
fn is_only(schema: &Value, key: &str) -> bool {
    schema["properties"].as_object().is_some_and(|known| known.len() == 1 && known.contains_key(key))
}

/// A number of a schema as it was written: those that were `f32` have digits there that nobody wrote.
fn written(number: f64) -> f64 {
    let short = number as f32;
    if f64::from(short) == number { short.to_string().parse().unwrap_or(number) } else { number }
}

/// The names that a schema of names allows, each with its doc line.
fn names(schema: &Value) -> Vec<(String, String)> {
    let named = schema["const"].as_str().map(|name| (name.to_owned(), line(schema)));
    let listed = schema["enum"].as_array().into_iter().flatten().filter_map(Value::as_str);
    named.into_iter().chain(listed.map(|name| (name.to_owned(), line(schema)))).collect()
}

fn line(schema: &Value) -> String {
    schema["description"].as_str().unwrap_or_default().to_owned()
}

/// What a slider shows: the limits, or, where they are far or there are none, about five times what is usual.
fn range(about: &About, value: f64) -> (f64, f64) {
    let usual = about.without.filter(|usual| *usual != 0.0).unwrap_or(value).abs().max(0.2);
    let unit = 10.0_f64.powf((5.0 * usual).log10().floor());
    let wide = [1.0, 2.0, 5.0, 10.0].map(|times| times * unit).into_iter().find(|wide| *wide >= 4.0 * usual);
    let wide = wide.unwrap_or(10.0 * unit);
    let low = about.low.filter(|low| *low >= -wide * 10.0).unwrap_or(if value < 0.0 { -wide } else { 0.0 });
    let high = about.high.filter(|high| *high <= wide * 10.0).unwrap_or(wide);
    (low.min(value), high.max(value).max(low + 1e-3))
}

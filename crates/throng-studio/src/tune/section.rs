//! The tree of tunable parameters, built from a schema and the values that fit it.

use super::about::About;
use super::schema::{default, is, is_colour, is_only, line, names, range, variants, written};
use serde_json::{Map, Value, json};
use throng_scene::Colour;

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
    /// Whether it is what a combination consists of: the key `of`.
    pub(super) is_part: bool,
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
    /// Whether the value has an effect, with the other keys of the scene as they are.
    pub acts: bool,
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
    /// A number that the scene leaves out and that has no default value.
    Unset {
        /// What holds without it, such as `no limit`.
        says: String,
        /// The value to begin with.
        first: f64,
        /// Whether the number is an integer.
        whole: bool,
    },
    /// A boolean.
    Switch {
        /// The value, `None` for the default.
        value: Option<bool>,
    },
    /// A colour.
    Colour {
        /// Red, green, blue; `None` for the colour that the program chooses.
        value: Option<[u8; 3]>,
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

    /// Removes keys of this table that have no effect. Keys that the scene states stay, and are marked.
    pub fn without_effect(&mut self, names: &[&str]) {
        let is_idle = |parameter: &Parameter| names.contains(&parameter.name.as_str());
        self.parameters.retain(|parameter| parameter.given || !is_idle(parameter));
        self.parameters.iter_mut().for_each(|parameter| parameter.acts = !is_idle(parameter));
    }

    /// Returns the value of the number at a path of this table or of a table inside.
    pub fn number(&self, path: &str) -> Option<f64> {
        let here = self.parameters.iter().find(|parameter| parameter.path == path);
        let number = here.and_then(|parameter| match parameter.kind {
            ParameterKind::Number { value, .. } => Some(value),
            _ => None,
        });
        number.or_else(|| self.sections.iter().find_map(|section| section.number(path)))
    }

    /// Marks the parameters that the scene states. `has` tells whether a path exists in its text.
    pub fn given(&mut self, has: &dyn Fn(&str) -> bool) {
        self.parameters.iter_mut().for_each(|parameter| parameter.given = has(&parameter.path));
        self.sections.iter_mut().for_each(|section| section.given(has));
    }

    /// Returns the section of an element of a list at a path, named by what it chooses, `None` if it is empty. `before`
    /// are the sections of the elements before it.
    fn named_as_element(mut self, path: &str, before: &[Self]) -> Option<Self> {
        // a section that holds a single table becomes that table
        if self.parameters.is_empty() && self.sections.len() == 1 {
            self = self.sections.remove(0);
        }
        // what a part consists of stands beside its weight
        if let Some(at) = self.sections.iter().position(|section| section.is_part) {
            let part = self.sections.remove(at);
            self.parameters.extend(part.parameters);
            self.sections.extend(part.sections);
        }
        let chosen = self.parameters.iter_mut().find_map(|parameter| match &parameter.kind {
            ParameterKind::Choice { value, .. } if [path, &format!("{path}.of")].contains(&parameter.path.as_str()) => {
                parameter.name = "kind".into();
                Some(value.clone())
            }
            _ => None,
        });
        if let Some(name) = chosen {
            let again = before
                .iter()
                .filter(|other| other.name.trim_end_matches(|c: char| c == ' ' || c.is_ascii_digit()) == name);
            self.name = match again.count() {
                0 => name,
                more => format!("{name} {}", more + 1),
            };
        }
        Some(self).filter(|section| !section.is_empty())
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
        let default = default(property);
        add(section, root, property, said.get(key).or(default.as_ref()), Place { path, name: key, about });
    }
}

/// Whether a variant is a number.
fn is_number(variants: &[&Value]) -> bool {
    variants.iter().any(|variant| is(variant, "number") || is(variant, "integer"))
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
        acts: true,
        kind,
    };
    if let Some(value) = said.and_then(Value::as_f64).or(about.without.filter(|_| !given))
        && is_number(&variants)
    {
        let whole = variants.iter().any(|variant| is(variant, "integer"));
        let (low, high) = range(&about, value);
        section.parameters.push(parameter(ParameterKind::Number { value, low, high, whole }));
    } else if let (None, Some(says), true) = (said, about.otherwise(), is_number(&variants)) {
        let whole = variants.iter().any(|variant| is(variant, "integer"));
        section.parameters.push(parameter(ParameterKind::Unset { says, first: about.first(), whole }));
    } else if variants.iter().any(|variant| is_colour(variant)) {
        let value = said.and_then(|said| serde_json::from_value(said.clone()).ok()).map(|Colour(rgb)| rgb);
        section.parameters.push(parameter(ParameterKind::Colour { value }));
    } else if variants.iter().any(|variant| is(variant, "boolean")) {
        section.parameters.push(parameter(ParameterKind::Switch { value: said.and_then(Value::as_bool) }));
    } else if let Some(Value::String(value)) = said {
        let options: Vec<(String, String)> = variants.iter().flat_map(|variant| names(variant)).collect();
        if options.iter().any(|(option, _)| option == value) {
            section.parameters.push(parameter(ParameterKind::Choice { value: value.clone(), options }));
        }
    } else if let Some(Value::Array(items)) = said {
        let inner = variants.iter().find_map(|variant| variant.get("items"));
        let Some(inner) = inner else { return };
        let numbers = items.iter().all(Value::is_number);
        for (k, item) in items.iter().enumerate() {
            let own = line(inner);
            // an element without a doc line gets the line of its list
            let own = if own.is_empty() { about.clone() } else { About::new(&own) };
            let about = About { low: about.low, high: about.high, ..own };
            let path = format!("{path}.{k}");
            let label = element(name, k, items.len(), numbers);
            let place = |name| Place { path: path.clone(), name, about: about.clone() };
            if numbers {
                add(section, root, inner, Some(item), place(&label));
                continue;
            }
            let mut holder = Section { name: label.clone(), about: about.text.clone(), ..Section::default() };
            add(&mut holder, root, inner, Some(item), place(&label));
            section.sections.extend(holder.named_as_element(&path, &section.sections));
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
    let is_part = shell.name == "of";
    let mut inner = Section { name: shell.name.clone(), about, is_part, ..Section::default() };
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
    if let Some(chosen) = chosen.filter(|_| is_part) {
        inner.name = chosen.clone();
        inner.parameters[0].name = "kind".into();
    }
    if !inner.is_empty() {
        section.sections.push(inner);
    }
}

/// Returns the name of an element of a list: a coordinate, a bound, or its number.
fn element(list: &str, k: usize, count: usize, numbers: bool) -> String {
    let names = match (list, count) {
        ("uniform", 2) => ["least", "greatest", ""],
        (_, 2 | 3) if numbers => return format!("{list} {}", ["x", "y", "z"][k]),
        _ => return format!("{list} {}", k + 1),
    };
    names[k].to_owned()
}

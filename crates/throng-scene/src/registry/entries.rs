//! The entries of a part of the registry, by name: those of throng, then those that a program adds.

use super::given::placed;
use super::schema::of_choice;
use crate::file::{Path, Problem, unknown_variant};
use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::Value as Json;
use std::borrow::Cow;
use std::fmt;

/// The entries, each of which is made by an `M`.
#[derive(Clone)]
pub(super) struct Entries<M>(Vec<Entry<M>>);

/// An entry.
#[derive(Clone)]
pub(super) struct Entry<M> {
    pub name: Cow<'static, str>,
    pub about: &'static str,
    pub is_plugin: bool,
    /// The schema of its parameters.
    pub schema: fn(&mut SchemaGenerator) -> Schema,
    /// How it is made.
    pub make: M,
}

impl<M> Entries<M> {
    /// Adds an entry, or replaces the entry with the same name.
    pub fn add(&mut self, entry: Entry<M>) {
        self.0.retain(|known| known.name != entry.name);
        self.0.push(entry);
    }

    /// Adds the entries that another set has from programs.
    pub fn extend(&mut self, more: Self) {
        more.0.into_iter().filter(|entry| entry.is_plugin).for_each(|entry| self.add(entry));
    }

    /// Makes all entries those of throng.
    pub fn own(&mut self) {
        self.0.iter_mut().for_each(|entry| entry.is_plugin = false);
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|entry| &*entry.name)
    }

    /// Returns an entry by its name.
    pub fn get(&self, name: &str) -> Option<&Entry<M>> {
        self.0.iter().find(|entry| entry.name == name)
    }

    /// Returns an entry by its name, or the error at this path with the names that exist.
    pub fn find(&self, name: &str, at: &Path) -> Result<&Entry<M>, Problem> {
        self.get(name).ok_or_else(|| {
            let known: Vec<String> = self.names().map(str::to_owned).collect();
            Problem { is_key: true, ..placed(unknown_variant(name, &known), at) }
        })
    }

    /// Returns the schema of a choice of one of the entries.
    pub fn schema(&self, description: &str, generator: &mut SchemaGenerator) -> Schema {
        let choices: Vec<Json> = self.0.iter().map(|entry| entry.choice(generator)).collect();
        json_schema!({ "description": description, "oneOf": choices })
    }

    /// Returns the name of each entry of a program, and the schema of its choice.
    pub fn plugin_schemas(&self, generator: &mut SchemaGenerator) -> Vec<(&str, Json)> {
        let plugins = self.0.iter().filter(|entry| entry.is_plugin);
        plugins.map(|entry| (&*entry.name, entry.choice(generator))).collect()
    }
}

impl<M> Entry<M> {
    /// Returns the schema of the choice of this entry.
    fn choice(&self, generator: &mut SchemaGenerator) -> Json {
        of_choice(&self.name, self.about, (self.schema)(generator).to_value())
    }
}

impl<M> Default for Entries<M> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<M> fmt::Debug for Entries<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.names()).finish()
    }
}

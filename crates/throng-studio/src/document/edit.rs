//! Editing of the scene's TOML text by path. Values are replaced in place; comments and layout are preserved.
//!
//! A path consists of keys and list positions, separated by dots: `group.0.place.ring.radius`.

use super::Document;
use super::layout::{
    add_element, add_pair, drop_element, drop_pair, number, put, sort_elements, sort_tables, table_of, unplace,
};
use std::sync::Arc;
use throng_scene::{Error, Scene, caught};
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value};

impl Document {
    /// Changes the text in one step that can be undone.
    ///
    /// # Errors
    /// The change does not fit the text, or the result is a scene that cannot be built. The text is unchanged.
    pub fn change(&mut self, change: impl FnOnce(&mut Edit) -> Result<(), String>) -> Result<(), String> {
        let (text, scene) = self.changed_by(change)?;
        if text != self.text {
            self.buildable(&scene)?;
            self.history.push(std::mem::replace(&mut self.text, text));
            self.scene = Ok(scene);
        }
        Ok(())
    }

    /// Returns the scene that a change would produce, if it can be built.
    ///
    /// # Errors
    /// As [`Document::change`].
    pub fn tried(&self, change: impl FnOnce(&mut Edit) -> Result<(), String>) -> Result<Arc<Scene>, String> {
        let (_, scene) = self.changed_by(change)?;
        self.buildable(&scene).map(|()| scene)
    }

    /// Returns the scene that a change would produce. It is not built, which is fast enough for each frame.
    ///
    /// # Errors
    /// The change does not fit the text, or the result is no valid scene.
    pub fn preview(&self, change: impl FnOnce(&mut Edit) -> Result<(), String>) -> Result<Arc<Scene>, String> {
        self.changed_by(change).map(|(_, scene)| scene)
    }

    /// Checks that a scene can be built: its numbers fit each other, and its agents have room. Another look of the present
    /// scene needs no check.
    fn buildable(&self, scene: &Scene) -> Result<(), String> {
        if self.scene.as_ref().is_ok_and(|now| scene.has_the_world_of(now)) {
            return Ok(());
        }
        caught(|| scene.build())?.map(drop).map_err(|error| reason(&error))
    }

    fn changed_by(&self, change: impl FnOnce(&mut Edit) -> Result<(), String>) -> Result<(String, Arc<Scene>), String> {
        let mut edit = Edit::new(&self.text)?;
        change(&mut edit)?;
        let text = edit.text();
        let scene = self.read(&text).map_err(|error| reason(&error))?;
        Ok((text, scene))
    }

    /// Sets the value at a path ([`Edit::set`]), in one step that can be undone.
    ///
    /// # Errors
    /// As [`Document::change`].
    pub fn set(&mut self, path: &str, value: impl Into<Value>) -> Result<(), String> {
        self.change(|edit| edit.set(path, value))
    }

    /// Returns the value at a path: a number, a string, a list or an inline table.
    pub fn value(&self, path: &str) -> Option<Value> {
        Edit::new(&self.text).ok()?.value(path).cloned()
    }
}

/// Returns an error without its place, which is in a text that the user does not see.
fn reason(error: &Error) -> String {
    match &error.hint {
        Some(hint) => format!("{}: {hint}", error.message),
        None => error.message.clone(),
    }
}

/// The text of a scene while it is edited.
#[derive(Clone, Debug)]
pub struct Edit(DocumentMut);

impl Edit {
    /// Parses a text.
    ///
    /// # Errors
    /// The text is no valid TOML.
    pub fn new(text: &str) -> Result<Self, String> {
        text.parse().map(Self).map_err(|error| format!("the text is not valid TOML, fix it first: {error}"))
    }

    /// Returns the text.
    pub fn text(&self) -> String {
        self.0.to_string()
    }

    fn item(&self, path: &str) -> Option<&Item> {
        path.split('.').try_fold(self.0.as_item(), |item, step| match step.parse::<usize>() {
            Ok(position) => item.get(position),
            Err(_) => item.get(step),
        })
    }

    /// Whether there is an item at a path.
    pub fn has(&self, path: &str) -> bool {
        self.item(path).is_some()
    }

    /// Returns the value at a path.
    pub fn value(&self, path: &str) -> Option<&Value> {
        self.item(path).and_then(Item::as_value)
    }

    /// Returns the length of the list at a path, 0 if there is no list.
    pub fn len(&self, path: &str) -> usize {
        match self.item(path) {
            Some(Item::ArrayOfTables(tables)) => tables.len(),
            Some(item) => item.as_array().map_or(0, Array::len),
            None => 0,
        }
    }

    /// Sets the value at a path and creates the tables on the path. An existing value keeps its comments. An existing
    /// value that is equal keeps its exact spelling.
    ///
    /// # Errors
    /// The path does not fit the text.
    pub fn set(&mut self, path: &str, value: impl Into<Value>) -> Result<(), String> {
        let (parent, key) = self.parent(path, true)?;
        let value = value.into();
        match (parent.child(key), key.parse::<usize>()) {
            (Some(Item::Value(old)), _) => put(old, value),
            (Some(_), _) => return Err(format!("{path} is a table: it can be removed, but not replaced by a value")),
            (None, Ok(_)) => return Err(format!("there is nothing at {path}")),
            (None, Err(_)) => parent.insert(key, value)?,
        }
        Ok(())
    }

    /// Removes the item at a path. Returns whether there was an item. Dotted tables that become empty are removed too.
    ///
    /// # Errors
    /// The path does not fit the text.
    pub fn remove(&mut self, path: &str) -> Result<bool, String> {
        if !self.has(path) {
            return Ok(false);
        }
        let (parent, key) = self.parent(path, false)?;
        match (parent, key.parse::<usize>()) {
            (Item::ArrayOfTables(tables), Ok(position)) => drop(tables.remove(position)),
            (Item::Value(Value::Array(array)), Ok(position)) => drop_element(array, position),
            (Item::Table(table), _) => drop(table.remove(key)),
            (Item::Value(Value::InlineTable(table)), _) => drop_pair(table, key),
            _ => return Err(format!("{path} does not fit the text")),
        }
        let empty_above = path.rsplit_once('.').filter(|(above, _)| {
            let dotted = |table: &dyn TableLike| table.is_dotted() && table.is_empty();
            self.item(above).and_then(Item::as_table_like).is_some_and(dotted)
        });
        match empty_above {
            Some((above, _)) => self.remove(above),
            None => Ok(true),
        }
    }

    /// Appends an element to the list at a path and returns its position. A missing list is created: as `[[..]]` tables
    /// at the top level, in brackets elsewhere.
    ///
    /// # Errors
    /// The path does not fit the text, or the list holds tables and the value is none.
    pub fn push(&mut self, path: &str, value: impl Into<Value>) -> Result<usize, String> {
        let (value, position) = (value.into(), self.len(path));
        let no_list = || format!("{path} is no list");
        if !self.has(path) {
            if !path.contains('.') {
                let place = self.place_of(path);
                let mut table = table_of(value).ok_or_else(no_list)?;
                table.set_position(place);
                self.0.insert(path, Item::ArrayOfTables(ArrayOfTables::from_iter([table])));
                return Ok(0);
            }
            self.set(path, Array::new())?;
        }
        let (parent, key) = self.parent(path, false)?;
        match parent.child(key) {
            Some(Item::ArrayOfTables(tables)) => tables.push(table_of(value).ok_or_else(no_list)?),
            Some(Item::Value(Value::Array(array))) => add_element(array, value),
            _ => return Err(no_list()),
        }
        Ok(position)
    }

    /// Sorts the tables of the list at a path by the number of a key. Comments go with their tables.
    ///
    /// # Errors
    /// The path does not fit the text.
    pub fn sort(&mut self, path: &str, key: &str) -> Result<(), String> {
        let (parent, name) = self.parent(path, false)?;
        let of = |table: Option<&dyn TableLike>| {
            let value = table.and_then(|table| table.get(key)).and_then(Item::as_value);
            value.and_then(number).unwrap_or(f64::INFINITY)
        };
        match parent.child(name) {
            Some(Item::ArrayOfTables(tables)) => sort_tables(tables, |table| of(Some(table))),
            Some(Item::Value(Value::Array(array))) => {
                sort_elements(array, |value| of(value.as_inline_table().map(|table| table as &dyn TableLike)));
            }
            _ => return Err(format!("{path} is no list")),
        }
        Ok(())
    }

    /// Appends a copy of a table to its list, without the comments before it, and returns its position.
    ///
    /// # Errors
    /// There is no such table.
    pub fn copy(&mut self, path: &str, position: usize) -> Result<usize, String> {
        let tables = self.0.get_mut(path).and_then(Item::as_array_of_tables_mut);
        let tables = tables.ok_or_else(|| format!("{path} is no list of tables"))?;
        let mut table =
            tables.get(position).cloned().ok_or_else(|| format!("there is nothing at {path}.{position}"))?;
        unplace(&mut table);
        table.decor_mut().clear();
        tables.push(table);
        Ok(tables.len() - 1)
    }

    /// Returns the position of a new list of tables: before the groups, if there are any.
    fn place_of(&self, path: &str) -> Option<isize> {
        let first = self.item("group.0").and_then(Item::as_table).and_then(Table::position);
        first.filter(|_| path != "group").map(|first| first - 1)
    }

    /// Returns the parent of the last step of a path, and that step.
    fn parent<'a>(&mut self, path: &'a str, make: bool) -> Result<(&mut Item, &'a str), String> {
        let (above, key) = path.rsplit_once('.').unwrap_or(("", path));
        let mut item = self.0.as_item_mut();
        for step in above.split('.').filter(|step| !step.is_empty()) {
            if make && item.child(step).is_none() && step.parse::<usize>().is_err() {
                item.make(step)?;
            }
            item = item.child(step).ok_or_else(|| format!("there is nothing at `{step}` of {path}"))?;
        }
        Ok((item, key))
    }
}

/// The operations on items that a path needs.
trait Node {
    fn child(&mut self, step: &str) -> Option<&mut Item>;
    fn insert(&mut self, key: &str, value: Value) -> Result<(), String>;
    fn make(&mut self, key: &str) -> Result<(), String>;
}

impl Node for Item {
    fn child(&mut self, step: &str) -> Option<&mut Item> {
        match step.parse::<usize>() {
            Ok(position) => self.get_mut(position),
            // indexing an item by name would create a missing key
            Err(_) => self.as_table_like_mut()?.get_mut(step),
        }
    }

    fn insert(&mut self, key: &str, value: Value) -> Result<(), String> {
        match self {
            Self::Table(table) => drop(table.insert(key, Self::Value(value))),
            Self::Value(Value::InlineTable(table)) => add_pair(table, key, value),
            _ => return Err(format!("there is no table that `{key}` could be in")),
        }
        Ok(())
    }

    fn make(&mut self, key: &str) -> Result<(), String> {
        match self {
            Self::Table(table) => {
                let mut inner = Table::new();
                inner.set_dotted(true);
                table.insert(key, Self::Table(inner));
            }
            Self::Value(Value::InlineTable(table)) => {
                let mut inner = InlineTable::new();
                inner.set_dotted(true);
                add_pair(table, key, inner.into());
            }
            // a plain name is short for the table of that name without keys
            Self::Value(value) if value.as_str() == Some(key) => {
                let mut table = Value::from(InlineTable::from_iter([(key, InlineTable::new())]));
                *table.decor_mut() = value.decor().clone();
                *value = table;
            }
            _ => return Err(format!("there is no table that `{key}` could be in")),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;

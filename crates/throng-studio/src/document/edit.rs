//! Editing the scene's text by what it says: values are changed where they stand, and comments and layout stay.
//!
//! A path names keys and positions in lists, parted by dots: `group.0.place.ring.radius`.

use super::Document;
use super::layout::{add_element, add_pair, drop_element, drop_pair, put, table_of};
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value};

impl Document {
    /// Changes what the text says, in one step that can be undone.
    ///
    /// # Errors
    /// The change does not fit the text, or what it makes is no scene: the text stays as it was.
    pub fn change(&mut self, change: impl FnOnce(&mut Edit) -> Result<(), String>) -> Result<(), String> {
        let mut edit = Edit::new(&self.text)?;
        change(&mut edit)?;
        let text = edit.text();
        let scene = self.read(&text).map_err(|error| error.to_string())?;
        if text != self.text {
            self.history.push(std::mem::replace(&mut self.text, text));
            self.scene = Ok(scene);
        }
        Ok(())
    }

    /// Sets the value at a path ([`Edit::set`]), in one step that can be undone.
    ///
    /// # Errors
    /// As [`Document::change`].
    pub fn set(&mut self, path: &str, value: impl Into<Value>) -> Result<(), String> {
        self.change(|edit| edit.set(path, value))
    }

    /// The value at a path: a number, a text, a list or an inline table.
    pub fn value(&self, path: &str) -> Option<Value> {
        Edit::new(&self.text).ok()?.value(path).cloned()
    }
}

/// A scene's text while it is changed.
#[derive(Clone, Debug)]
pub struct Edit(DocumentMut);

impl Edit {
    /// Of a text.
    ///
    /// # Errors
    /// It is no TOML.
    pub fn new(text: &str) -> Result<Self, String> {
        text.parse().map(Self).map_err(|error| format!("the text cannot be edited before it is mended: {error}"))
    }

    /// The text.
    pub fn text(&self) -> String {
        self.0.to_string()
    }

    fn item(&self, path: &str) -> Option<&Item> {
        path.split('.').try_fold(self.0.as_item(), |item, step| match step.parse::<usize>() {
            Ok(position) => item.get(position),
            Err(_) => item.get(step),
        })
    }

    /// Whether there is something at a path.
    pub fn has(&self, path: &str) -> bool {
        self.item(path).is_some()
    }

    /// The value at a path.
    pub fn value(&self, path: &str) -> Option<&Value> {
        self.item(path).and_then(Item::as_value)
    }

    /// How many elements the list at a path has; 0 where there is none.
    pub fn len(&self, path: &str) -> usize {
        match self.item(path) {
            Some(Item::ArrayOfTables(tables)) => tables.len(),
            Some(item) => item.as_array().map_or(0, Array::len),
            None => 0,
        }
    }

    /// Sets the value at a path, and makes the tables on the way to it; one that is there keeps its comments, and where it says
    /// the same already, its very letters.
    ///
    /// # Errors
    /// The path does not fit what is there.
    pub fn set(&mut self, path: &str, value: impl Into<Value>) -> Result<(), String> {
        let (parent, key) = self.parent(path, true)?;
        let value = value.into();
        match (parent.child(key), key.parse::<usize>()) {
            (Some(Item::Value(old)), _) => put(old, value),
            (Some(_), _) => return Err(format!("{path} is a table: it can be taken out, but not be a value")),
            (None, Ok(_)) => return Err(format!("there is nothing at {path}")),
            (None, Err(_)) => parent.insert(key, value)?,
        }
        Ok(())
    }

    /// Takes out what is at a path; whether something was there. Tables that hold nothing any more go with it.
    ///
    /// # Errors
    /// The path does not fit what is there.
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

    /// Adds an element to the list at a path, which is made where there is none: a list of tables `[[..]]` on the top level, else
    /// one in brackets. Where it stands then.
    ///
    /// # Errors
    /// The path does not fit what is there, or a list of tables is given something else.
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

    /// Where the first of a list of tables stands: before the groups, if there are any.
    fn place_of(&self, path: &str) -> Option<isize> {
        let first = self.item("group.0").and_then(Item::as_table).and_then(Table::position);
        first.filter(|_| path != "group").map(|first| first - 1)
    }

    /// What holds the last step of a path, and that step.
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

/// What of an item the steps of paths need.
trait Node {
    fn child(&mut self, step: &str) -> Option<&mut Item>;
    fn insert(&mut self, key: &str, value: Value) -> Result<(), String>;
    fn make(&mut self, key: &str) -> Result<(), String>;
}

impl Node for Item {
    fn child(&mut self, step: &str) -> Option<&mut Item> {
        match step.parse::<usize>() {
            Ok(position) => self.get_mut(position),
            // asked for by its name an item makes what is not there
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
            _ => return Err(format!("there is no table that `{key}` could be in")),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::number;
    use super::*;
    use throng_scene::gallery;

    const SCENE: &str = "\
# Two of them.
title = \"Two\"   # so called

[[group]]       # the first
name = \"a\"
place.points = [[0, 0], [2, 0.50]]   # metres
body = { radius = 0.2 }

[expect]
within = 9.0 # s
";

    fn document() -> Document {
        Document::new("two", SCENE)
    }

    #[test]
    fn comments_and_layout_stay() {
        let mut document = document();
        document.set("group.0.place.points.1", Array::from_iter([2.0, 0.75])).unwrap();
        assert_eq!(document.text(), SCENE.replace("0.50", "0.75"), "the 2 is written as it was");
        document.set("expect.within", 12.5).unwrap();
        assert_eq!(document.text(), SCENE.replace("0.50", "0.75").replace("9.0", "12.5"));
        assert!(document.undo() && document.undo() && !document.undo());
        assert_eq!(document.text(), SCENE, "a change is a step");
    }

    #[test]
    fn tables_on_the_way_are_made() {
        let mut document = document();
        document.set("group.0.goal.point.at", Array::from_iter([9.0, 1.0])).unwrap();
        document.set("group.0.body.capsule", InlineTable::new()).unwrap_err();
        document.set("time.limit", 30.0).unwrap();
        document.set("group.0.speed.max", 2.0).unwrap();
        let text = document.text();
        assert!(text.contains("goal.point.at = [9.0, 1.0]\nspeed.max = 2.0\n"), "{text}");
        assert!(text.contains("so called\ntime.limit = 30.0\n"), "{text}");
        assert_eq!(document.scene().unwrap().time.limit, 30.0);
    }

    #[test]
    fn inline_tables_and_lists_grow_and_shrink() {
        let mut edit = Edit::new(SCENE).unwrap();
        edit.set("group.0.body.capsule.length", 1.0).unwrap();
        edit.remove("group.0.body.radius").unwrap();
        edit.push("group.0.place.points", Array::from_iter([4, 4])).unwrap();
        edit.remove("group.0.place.points.0").unwrap();
        let text = edit.text();
        assert!(text.contains("body = { capsule.length = 1.0 }\n"), "{text}");
        assert!(text.contains("place.points = [[2, 0.50], [4, 4]]   # metres\n"), "{text}");
        assert_eq!((edit.remove("group.0.place.points"), edit.has("group.0.place")), (Ok(true), false));
        assert_eq!(edit.remove("group.7.place"), Ok(false));
    }

    #[test]
    fn lists_of_tables_are_made_before_the_groups() {
        let mut document = document();
        let wall: Value = "{ name = \"w\", shape.wall = [[0, 5], [5, 5]] }".parse().unwrap();
        assert!(document.change(|edit| edit.push("obstacle", wall.clone()).map(drop)).is_ok());
        assert!(document.change(|edit| edit.push("obstacle", wall).map(drop)).is_ok());
        let (first, _) = document.text().split_once("[[group]]").unwrap();
        assert_eq!(
            first.matches("\n[[obstacle]]\nname = \"w\"\nshape.wall = [[0, 5], [5, 5]]\n").count(),
            2,
            "{first}"
        );
        assert_eq!(document.scene().unwrap().obstacles.len(), 2);
    }

    #[test]
    fn what_is_no_scene_is_refused_in_words() {
        let mut document = document();
        for (path, says) in [
            ("group.0.nmae", "nmae"),
            ("group.5.name", "nothing at `5`"),
            ("group.0.name.x", "no table"),
            ("group", "is a table"),
        ] {
            let refused = document.set(path, "x").unwrap_err();
            assert!(refused.contains(says), "{path}: {refused}");
        }
        assert!(document.change(|edit| edit.push("title", 3).map(drop)).unwrap_err().contains("no list"));
        assert!(document.text() == SCENE && !document.undo());
    }

    /// Every path of a text to a simple value.
    fn leaves(item: &Item, path: &str, found: &mut Vec<String>) {
        let further = |step: &str| if path.is_empty() { step.to_owned() } else { format!("{path}.{step}") };
        if let Some(table) = item.as_table_like() {
            table.iter().for_each(|(key, item)| leaves(item, &further(key), found));
        } else if let Item::ArrayOfTables(tables) = item {
            let tables = tables.iter().cloned().map(Item::Table).enumerate();
            tables.for_each(|(k, item)| leaves(&item, &further(&k.to_string()), found));
        } else if let Some(array) = item.as_array() {
            let values = array.iter().cloned().map(Item::Value).enumerate();
            values.for_each(|(k, item)| leaves(&item, &further(&k.to_string()), found));
        } else {
            found.push(path.to_owned());
        }
    }

    #[test]
    fn every_value_of_the_gallery_can_be_set_to_itself() {
        for name in gallery::names() {
            let text = gallery::text(name).unwrap();
            let mut edit = Edit::new(text).unwrap();
            let mut paths = Vec::new();
            leaves(edit.0.as_item(), "", &mut paths);
            assert!(paths.len() > 5, "{name}");
            for path in paths {
                let value = edit.value(&path).unwrap().clone();
                let plain = number(&value).map_or(value, Value::from);
                edit.set(&path, plain).unwrap();
            }
            assert_eq!(edit.text(), text, "{name}");
        }
    }
}

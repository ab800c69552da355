//! Changes single values of a scene, as the program's `--set group.walkers.body.radius=0.3` does.

use super::document::Document;
use super::serde_message::{self, keys_of};
use crate::error::{Error, Kind};
use crate::scene::{Group, Mover, Obstacle, Scene};
use std::borrow::Cow;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// Keys of tables that hold one choice: setting another choice replaces it.
const CHOICES: [&str; 12] =
    ["body", "walkable", "shape", "place", "goal", "avoid", "steer", "radius", "preferred", "max", "area", "exit"];

/// The maximum number of keys of a path: no value of a scene is that deep, and a much deeper tree overflows the stack.
const MOST_KEYS: usize = 50;

/// A changed value.
#[derive(Clone, Debug)]
pub(crate) struct Override {
    /// The path as it was written.
    pub written: String,
    /// The TOML text of the value.
    pub value: String,
}

impl Scene {
    /// Changes one value. `path` is the path to it, `value` its TOML text (the quotes of a text may be left out):
    ///
    /// | path | changes |
    /// |---|---|
    /// | `time.step` | a value of the scene |
    /// | `body.radius` | that value of every group |
    /// | `group.walkers.body.radius` | that value of one group, by name or by number from 0 |
    /// | `obstacle.pillar.shape.circle.radius` | that value of one obstacle |
    ///
    /// # Errors
    /// The key, group or obstacle does not exist, or the value has the wrong type. Building the scene checks whether
    /// the value is within its limits.
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), Error> {
        let document = self.document()?.with(Override::new(path, &quoted(value.trim())));
        let mut changed: Self = document.read()?;
        changed.origin.folder.clone_from(&self.origin.folder);
        changed.plugins.clone_from(&self.plugins);
        changed.origin.document = Some(Arc::new(document));
        changed.check_keys()?;
        *self = changed;
        Ok(())
    }

    /// Returns the file of the scene, or a new one if the scene has none or was changed in code.
    pub(super) fn document(&self) -> Result<Cow<'_, Document>, Error> {
        match &self.origin.document {
            Some(document) if document.read::<Self>().as_ref() == Ok(self) => Ok(Cow::Borrowed(document)),
            _ => Ok(Cow::Owned(Document::new(None, self.to_toml()?))),
        }
    }
}

impl Override {
    /// Returns the override of the value at a path by a TOML text.
    pub fn new(path: &str, value: &str) -> Self {
        Self { written: path.trim().to_owned(), value: value.to_owned() }
    }
}

/// Returns the text as a TOML value: as it is, or else in quotes.
pub(crate) fn quoted(value: &str) -> String {
    if DeValue::parse(value).is_ok() { value.to_owned() } else { toml::Value::String(value.to_owned()).to_string() }
}

/// Changes a tree. Positions in the value are counted from byte `start`.
pub(super) fn apply<'i>(tree: &mut DeTable<'i>, change: &'i Override, start: usize) -> Result<(), Error> {
    let here = |error: Error| error.file(format!("--set {}={}", change.written, change.value));
    let value = DeValue::parse(&change.value).map_err(|error| {
        here(Error::new(Kind::Syntax, format!("{} is not a TOML value: {}", change.value, error.message())))
    })?;
    let value = shifted(value, start);
    let (tables, path) = places(tree, &change.written).map_err(here)?;
    tables.into_iter().try_for_each(|table| insert(table, &path, value.clone()).map_err(here))
}

/// Returns the tables in which a path begins, and its keys from there on: the scene, one of its groups, obstacles or
/// movers, or all of its groups.
pub(super) fn places<'t, 'i, 'p>(
    tree: &'t mut DeTable<'i>,
    written: &'p str,
) -> Result<(Vec<&'t mut DeTable<'i>>, Vec<&'p str>), Error> {
    let mut path: Vec<&str> = written.split('.').map(str::trim).collect();
    if path.iter().any(|key| key.is_empty()) {
        let error = Error::new(Kind::UnknownKey, format!("`{written}` is not a path to a value"));
        return Err(error.hint("write the keys with dots between them, as in avoid.orca.time_horizon=3"));
    }
    if path.len() > MOST_KEYS {
        let message = format!("this path has {} keys, but may have at most {MOST_KEYS}", path.len());
        return Err(Error::new(Kind::UnknownKey, message));
    }
    match path[0] {
        "groups" => path[0] = "group",
        "obstacles" => path[0] = "obstacle",
        "movers" => path[0] = "mover",
        _ => {}
    }
    let scene_keys = keys_of::<Scene>();
    let group_keys = keys_of::<Group>();
    match path[..] {
        ["group" | "obstacle" | "mover"] => Err(Error::new(Kind::UnknownKey, format!("`{}` is a list", path[0]))
            .hint("name one of them and a key: group.walkers.body.radius")),
        [list @ ("group" | "obstacle" | "mover"), which, ref rest @ ..] => {
            let keys = match list {
                "group" => group_keys,
                "obstacle" => keys_of::<Obstacle>(),
                _ => keys_of::<Mover>(),
            };
            let entry = find(tree, list, which)?;
            match rest {
                [] => Err(Error::new(Kind::UnknownKey, format!("`{written}` names all of a {list}"))
                    .hint(format!("add one of its keys: {}", keys.join(", ")))),
                [first, ..] if !keys.contains(&(*first).to_owned()) => Err(serde_message::unknown_key(first, &keys)),
                rest => Ok((vec![entry], rest.to_vec())),
            }
        }
        [first, ..] if scene_keys.iter().any(|key| key == first) => Ok((vec![tree], path)),
        [first, ..] if group_keys.iter().any(|key| key == first) => Ok((entries(tree, "group"), path)),
        [first, ..] => {
            let all: Vec<String> = scene_keys.into_iter().chain(group_keys).collect();
            Err(serde_message::unknown_key(first, &all))
        }
        [] => Ok((vec![], path)),
    }
}

/// Returns the value at a path below a table.
pub(super) fn value_at<'t, 'i>(table: &'t DeTable<'i>, path: &[&str]) -> Option<&'t DeValue<'i>> {
    let (first, rest) = path.split_first()?;
    rest.iter().try_fold(table.get(*first)?.get_ref(), |value, key| match value {
        DeValue::Table(items) => items.get(*key).map(Spanned::get_ref),
        DeValue::Array(items) => <[Spanned<DeValue>]>::get(items, key.parse::<usize>().ok()?).map(Spanned::get_ref),
        _ => None,
    })
}

/// Returns the tables of a list.
fn entries<'t, 'i>(tree: &'t mut DeTable<'i>, list: &str) -> Vec<&'t mut DeTable<'i>> {
    let Some(DeValue::Array(items)) = tree.get_mut(list).map(Spanned::get_mut) else { return vec![] };
    let tables = items.iter_mut().filter_map(|item| match item.get_mut() {
        DeValue::Table(table) => Some(table),
        _ => None,
    });
    tables.collect()
}

/// Returns one table of a list, by name or number.
fn find<'t, 'i>(tree: &'t mut DeTable<'i>, list: &str, which: &str) -> Result<&'t mut DeTable<'i>, Error> {
    let mut all = entries(tree, list);
    let names: Vec<String> = all
        .iter()
        .enumerate()
        .map(|(i, entry)| match entry.get("name").and_then(|name| name.get_ref().as_str()) {
            Some(name) if !name.is_empty() => name.to_owned(),
            _ if list == "group" => Group::name_at("", i),
            _ if list == "mover" => Mover::name_at("", i),
            _ => i.to_string(),
        })
        .collect();
    let found = names.iter().position(|name| name == which);
    match found.or_else(|| which.parse().ok().filter(|i| *i < all.len())) {
        Some(i) => Ok(all.swap_remove(i)),
        None if names.is_empty() => Err(Error::new(Kind::UnknownKey, format!("the scene has no {list}"))),
        None => Err(Error::new(Kind::UnknownKey, format!("there is no {list} `{which}`"))
            .hint(format!("there is: {}", names.join(", ")))),
    }
}

/// Puts a value at a path, and creates missing tables.
fn insert<'i>(table: &mut DeTable<'i>, path: &[&'i str], value: Spanned<DeValue<'i>>) -> Result<(), Error> {
    let Some((first, rest)) = path.split_first() else { return Ok(()) };
    let span = value.span();
    if rest.is_empty() {
        table.insert(Spanned::new(span, Cow::Borrowed(*first)), value);
        return Ok(());
    }
    if !table.contains_key(*first) {
        table.insert(Spanned::new(span.clone(), Cow::Borrowed(*first)), empty(&span));
    }
    let Some(child) = table.get_mut(*first) else { return Ok(()) };
    if let DeValue::Array(items) = child.get_mut() {
        return insert_in_list(items, rest, value);
    }
    let other_choice = |table: &DeTable| CHOICES.contains(first) && !table.contains_key(rest[0]);
    let fits = matches!(child.get_ref(), DeValue::Table(table) if !other_choice(table));
    if !fits {
        *child = empty(&span);
    }
    match child.get_mut() {
        DeValue::Table(table) => insert(table, rest, value),
        _ => Ok(()),
    }
}

/// Puts a value at a path below an entry of a list.
fn insert_in_list<'i>(list: &mut DeArray<'i>, path: &[&'i str], value: Spanned<DeValue<'i>>) -> Result<(), Error> {
    let length = list.len();
    let Some((first, rest)) = path.split_first() else { return Ok(()) };
    let entry = first.parse::<usize>().ok().and_then(|index| <[Spanned<DeValue>]>::get_mut(list, index));
    let Some(entry) = entry else {
        let error = Error::new(Kind::UnknownKey, format!("`{first}` is no entry of the list here"));
        return Err(match length {
            0 => error.hint("the list is empty"),
            _ => error.hint(format!("its entries are 0 to {}", length - 1)),
        });
    };
    match (entry.get_mut(), rest) {
        (_, []) => *entry = value,
        (DeValue::Table(table), _) => return insert(table, rest, value),
        (DeValue::Array(list), _) => return insert_in_list(list, rest, value),
        _ => return Err(Error::new(Kind::UnknownKey, format!("the entry `{first}` of the list here has no keys"))),
    }
    Ok(())
}

fn empty<'i>(span: &std::ops::Range<usize>) -> Spanned<DeValue<'i>> {
    Spanned::new(span.clone(), DeValue::Table(DeTable::new()))
}

/// Returns the value with its positions moved by `shift` bytes.
fn shifted(value: Spanned<DeValue<'_>>, shift: usize) -> Spanned<DeValue<'_>> {
    let span = value.span().start + shift..value.span().end + shift;
    let value = match value.into_inner() {
        DeValue::Table(items) => DeValue::Table(
            items
                .into_iter()
                .map(|(key, value)| {
                    let span = key.span().start + shift..key.span().end + shift;
                    (Spanned::new(span, key.into_inner()), shifted(value, shift))
                })
                .collect(),
        ),
        DeValue::Array(items) => {
            let mut out = DeArray::new();
            items.into_iter().for_each(|item| out.push(shifted(item, shift)));
            DeValue::Array(out)
        }
        other => other,
    };
    Spanned::new(span, value)
}

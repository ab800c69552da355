//! Layout of TOML values: changes preserve the layout and comments of the existing text.

use toml_edit::{Array, ArrayOfTables, Decor, InlineTable, Item, Table, Value};

/// The prefix of the elements of a new list: each starts on its own line.
const LINE: &str = "\n    ";

/// Replaces a value in place and keeps its comments. Lists of equal length are replaced element by element.
pub(super) fn put(old: &mut Value, new: Value) {
    match new {
        Value::Array(new) if old.as_array().is_some_and(|old| old.len() == new.len()) => {
            let old = old.as_array_mut().into_iter().flat_map(Array::iter_mut);
            old.zip(new).for_each(|(old, new)| put(old, new));
        }
        new if !same(old, &new) => {
            let decor = old.decor().clone();
            *old = new;
            *old.decor_mut() = decor;
        }
        _ => {}
    }
}

/// Whether two simple values are equal, regardless of their spelling.
fn same(a: &Value, b: &Value) -> bool {
    match (number(a), number(b)) {
        (Some(a), Some(b)) => a == b,
        _ => a.as_str().is_some() && a.as_str() == b.as_str() || a.as_bool().is_some() && a.as_bool() == b.as_bool(),
    }
}

/// Returns the number of an integer or float value.
pub fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// Returns the top-level table of an inline table.
pub(super) fn table_of(value: Value) -> Option<Table> {
    let Value::InlineTable(mut table) = value else { return None };
    tidy(&mut table);
    Some(table.into_table())
}

/// Gives a table and its dotted subtables the default layout.
fn tidy(table: &mut InlineTable) {
    table.fmt();
    let inner = table.iter_mut().filter_map(|(_, value)| value.as_inline_table_mut());
    inner.filter(|inner| inner.is_dotted()).for_each(tidy);
}

/// Returns the value written last in a table.
fn last(table: &mut InlineTable) -> Option<&mut Value> {
    let value = table.iter_mut().last()?.1;
    let dotted = value.as_inline_table().is_some_and(InlineTable::is_dotted);
    if dotted { value.as_inline_table_mut().and_then(last) } else { Some(value) }
}

/// Adds a pair. The space and comments after the last value stay after the last value.
pub(super) fn add_pair(table: &mut InlineTable, key: &str, value: Value) {
    let behind = last(table).and_then(|last| {
        let behind = last.decor().suffix().cloned();
        last.decor_mut().set_suffix("");
        behind
    });
    let dotted = table.is_dotted();
    let value = table.entry(key).or_insert(value);
    match behind {
        Some(behind) if dotted => value.decor_mut().set_suffix(behind),
        Some(behind) if behind.as_str() != Some("") => table.set_trailing(behind),
        _ => {}
    }
}

/// Removes a pair. The space and comments after the last value stay after the last value.
pub(super) fn drop_pair(table: &mut InlineTable, key: &str) {
    let behind = last(table).and_then(|last| last.decor().suffix().cloned()).unwrap_or_default();
    table.remove(key);
    if let Some(last) = last(table) {
        last.decor_mut().set_suffix(behind);
    }
}

/// Appends an element with the layout of the element before it. Elements of a new list start on their own lines, unless
/// they are numbers.
pub(super) fn add_element(array: &mut Array, mut value: Value) {
    let plain = number(&value).is_some();
    match array.iter_mut().last() {
        Some(last) => {
            // a comment after the last element stays there
            let prefix = last.decor().prefix().and_then(|prefix| prefix.as_str()).unwrap_or("");
            let space = if prefix.contains('\n') { LINE } else { " " };
            let behind = last.decor().suffix().cloned().filter(|_| !array.trailing_comma()).unwrap_or_default();
            if let (false, Some(last)) = (array.trailing_comma(), array.iter_mut().last()) {
                last.decor_mut().set_suffix("");
            }
            *value.decor_mut() = Decor::new(space, behind);
        }
        None if plain => value.decor_mut().clear(),
        None => {
            *value.decor_mut() = Decor::new(LINE, "");
            array.set_trailing_comma(true);
            array.set_trailing("\n");
        }
    }
    array.push_formatted(value);
}

/// Removes an element. If it is the first, the next element gets its prefix.
pub(super) fn drop_element(array: &mut Array, position: usize) {
    let taken = array.remove(position);
    if let (0, Some(first)) = (position, array.get_mut(0)) {
        first.decor_mut().set_prefix(taken.decor().prefix().cloned().unwrap_or_default());
    }
    if array.is_empty() {
        array.set_trailing_comma(false);
    }
}

/// Sorts a list by numbers. Comments go with their elements, other space stays in its place.
pub(super) fn sort_elements(array: &mut Array, number: impl Fn(&Value) -> f64) {
    let spaces: Vec<Decor> = array.iter().map(|value| value.decor().clone()).collect();
    array.sort_by(|a, b| number(a).total_cmp(&number(b)));
    let has_comment = |decor: &Decor| {
        [decor.prefix(), decor.suffix()]
            .into_iter()
            .flatten()
            .any(|raw| raw.as_str().is_some_and(|raw| raw.contains('#')))
    };
    for (value, space) in array.iter_mut().zip(spaces) {
        if !has_comment(value.decor()) && !has_comment(&space) {
            *value.decor_mut() = space;
        }
    }
}

/// Sorts a list of tables by numbers. Comments go with their tables.
pub(super) fn sort_tables(tables: &mut ArrayOfTables, number: impl Fn(&Table) -> f64) {
    let mut all: Vec<Table> = tables.iter().cloned().collect();
    let places: Vec<Option<isize>> = all.iter().map(Table::position).collect();
    all.sort_by(|a, b| number(a).total_cmp(&number(b)));
    tables.clear();
    for (mut table, place) in all.into_iter().zip(places) {
        table.set_position(place);
        tables.push(table);
    }
}

/// Clears the stored position of a table.
pub(super) fn unplace(table: &mut Table) {
    table.set_position(None);
    for (_, item) in table.iter_mut() {
        match item {
            Item::Table(inner) => unplace(inner),
            Item::ArrayOfTables(tables) => tables.iter_mut().for_each(unplace),
            _ => {}
        }
    }
}

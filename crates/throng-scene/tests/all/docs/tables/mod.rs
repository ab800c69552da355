//! The tables of the pages that describe what throng has are made from the registry. A page marks the place of a table:
//!
//! ```text
//! <!-- table: NAME -->
//! the table
//! <!-- end of the table -->
//! ```

mod behaviours;
mod fields;
mod gallery;
mod has;
mod keys;
mod models;
mod schema;

pub use behaviours::registered;
pub use gallery::Uses;

use schema::Schema;
use std::path::{Path, PathBuf};

const END: &str = "\n<!-- end of the table -->";

/// Returns the name and the rows of each table, the header included.
fn tables() -> Vec<(String, String)> {
    let schema = Schema::default();
    let uses = Uses::of_gallery();
    let tables = [
        behaviours::tables(&schema),
        keys::tables(&schema),
        models::tables(&schema),
        fields::tables(&schema),
        has::tables(&schema, &uses),
    ];
    tables.into_iter().flatten().collect()
}

/// Returns the columns and rows of a table in Markdown. `|` is escaped in their cells.
fn table(columns: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let head = [format!("| {} |", columns.join(" | ")), "|---".repeat(columns.len()) + "|"];
    let rows = rows.into_iter().map(|cells| {
        assert_eq!(cells.len(), columns.len(), "{cells:?}");
        let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
        format!("| {} |", cells.join(" | ")).replace("|  |", "| |").replace("|  |", "| |")
    });
    head.into_iter().chain(rows).map(|line| line + "\n").collect()
}

/// Returns the page with its tables as they are now, and the names of these tables.
fn current(page: &str, tables: &[(String, String)]) -> Result<(String, Vec<String>), String> {
    let mut parts = page.split("<!-- table: ");
    let (mut now, mut shown) = (parts.next().unwrap_or_default().to_owned(), vec![]);
    for part in parts {
        let (name, rest) = part.split_once(" -->\n").ok_or("a marker of a table has no end")?;
        let (_, rest) = rest.split_once(END).ok_or_else(|| format!("the table `{name}` has no end"))?;
        let (_, table) = tables.iter().find(|(known, _)| known == name).ok_or_else(|| {
            let known: Vec<&str> = tables.iter().map(|(name, _)| name.as_str()).collect();
            format!("there is no table `{name}`: {known:?}")
        })?;
        now += &format!("<!-- table: {name} -->\n\n{table}{END}{rest}");
        shown.push(name.to_owned());
    }
    Ok((now, shown))
}

fn pages() -> Vec<PathBuf> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let files = std::fs::read_dir(docs).unwrap().map(|entry| entry.unwrap().path());
    files.filter(|path| path.extension().is_some_and(|ending| ending == "md")).collect()
}

/// `UPDATE=1 cargo test -p throng-scene docs::tables` writes the tables again.
#[test]
fn the_tables_of_the_pages_are_those_of_the_registry() {
    let tables = tables();
    let mut missing: Vec<&str> = tables.iter().map(|(name, _)| name.as_str()).collect();
    for path in pages() {
        let kept = std::fs::read_to_string(&path).unwrap();
        let (now, shown) = current(&kept, &tables).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        missing.retain(|name| !shown.iter().any(|shown| shown == name));
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(&path, &now).unwrap();
        } else {
            assert!(kept == now, "{} is not current: UPDATE=1 cargo test -p throng-scene docs::tables", path.display());
        }
    }
    assert!(missing.is_empty(), "no page has the tables {missing:?}");
}

#[test]
fn rows_are_short_enough_to_read() {
    for (name, table) in tables() {
        for row in table.lines() {
            assert!(row.chars().count() < 1500, "table `{name}`: {row}");
        }
    }
}

#[test]
fn a_page_without_the_end_of_a_table_and_a_table_that_is_not_known_are_errors() {
    let tables = [("a".to_owned(), "| b |\n".to_owned())];
    let page = "x\n<!-- table: a -->\nold\n<!-- end of the table -->\ny\n";
    let now = "x\n<!-- table: a -->\n\n| b |\n\n<!-- end of the table -->\ny\n";
    assert_eq!(current(page, &tables), Ok((now.to_owned(), vec!["a".to_owned()])));
    assert_eq!(current(now, &tables), Ok((now.to_owned(), vec!["a".to_owned()])));
    assert_eq!(current("y", &tables), Ok(("y".to_owned(), vec![])));
    assert!(current("<!-- table: a -->\nold", &tables).unwrap_err().contains("`a` has no end"));
    assert!(current(&page.replace(": a", ": c"), &tables).unwrap_err().contains("no table `c`"));
}

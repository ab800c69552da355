//! The tables of behaviours in docs/steering.md are those of the registered types.

use std::any::type_name;
use std::fmt::Write;
use std::path::Path;
use throng::Error;
use throng::parameters::{Kind, Parameter, Parameters, Written};
use throng::steer::BoxedBehaviour;
use throng_steer::{Behaviours, ForGroup};

/// The rows of each folder of throng-steer, in the order of registration.
#[derive(Default)]
struct Rows(Vec<(&'static str, String)>);

impl Rows {
    fn add_row<P: Parameters>(&mut self) {
        let folder = type_name::<P>().split("::").nth(1).unwrap();
        let keys = match P::PARAMETERS {
            [] => shape(P::KIND),
            parameters => parameters.iter().map(key).collect::<Vec<_>>().join("<br>"),
        };
        self.0.push((folder, format!("| `{}` | {} | {keys} |", P::NAME, P::ABOUT)));
    }
}

impl Behaviours for Rows {
    fn add<P: Parameters + TryInto<BoxedBehaviour, Error: Into<Error>> + 'static>(&mut self) {
        self.add_row::<P>();
    }

    fn add_for_group<P: ForGroup + 'static>(&mut self) {
        self.add_row::<P>();
    }
}

/// Returns a key with its doc line, its default and the keys of its table.
fn key(parameter: &Parameter) -> String {
    let mut text = format!("`{}`: {}", parameter.name, parameter.about);
    let keys = match parameter.kind {
        Kind::Table(_) | Kind::List(Kind::Table(_)) | Kind::Named(_) => shape(parameter.kind),
        _ => String::new(),
    };
    if !keys.is_empty() {
        write!(text, " In files {keys}.").unwrap();
    }
    match (parameter.default)() {
        Some(Written::Table(_)) | None => {}
        Some(Written::List(list)) if list.is_empty() => {}
        Some(default) => write!(text, " Default: `{}`.", toml(&default)).unwrap(),
    }
    text.replace('|', "\\|")
}

/// Returns how files write values of a kind.
fn shape(kind: Kind) -> String {
    match kind {
        Kind::List(part) => format!("a list of {}", shape(*part)),
        Kind::Named(part) => format!("names, each with {}", shape(*part)),
        Kind::Table(table) => {
            let key = |parameter: &Parameter| match (parameter.default)() {
                Some(default @ (Written::Number(_) | Written::Text(_) | Written::Flag(_) | Written::Whole(_))) => {
                    format!("{} = {}", parameter.name, toml(&default))
                }
                _ => parameter.name.to_owned(),
            };
            match table().parameters {
                [] => String::new(),
                parameters => format!("`{{ {} }}`", parameters.iter().map(key).collect::<Vec<_>>().join(", ")),
            }
        }
        Kind::Behaviour => "behaviours".into(),
        Kind::Vector => "`[x, y]` or `[x, y, z]`".into(),
        _ => String::new(),
    }
}

fn toml(value: &Written) -> String {
    match value {
        Written::Number(number) => number.to_string(),
        Written::Whole(number) => number.to_string(),
        Written::Flag(flag) => flag.to_string(),
        Written::Text(text) => format!("\"{text}\""),
        Written::List(items) => format!("[{}]", items.iter().map(toml).collect::<Vec<_>>().join(", ")),
        Written::Table(entries) => {
            let entries: Vec<_> = entries.iter().map(|(key, value)| format!("{key} = {}", toml(value))).collect();
            format!("{{ {} }}", entries.join(", "))
        }
    }
}

/// `UPDATE=1 cargo test -p throng-scene docs::tables` writes the tables again.
#[test]
fn the_tables_of_behaviours_are_those_of_the_types() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/steering.md");
    let kept = std::fs::read_to_string(&path).unwrap();
    let mut rows = Rows::default();
    throng_steer::register(&mut rows);
    let (mut now, mut shown) = (kept.clone(), 0);
    for folder in ["single", "group", "swarm", "place", "combine"] {
        let mut table = "\n\n| `steer.` | what it does | keys |\n|---|---|---|\n".to_owned();
        for (_, row) in rows.0.iter().filter(|(of, _)| *of == folder) {
            writeln!(table, "{row}").unwrap();
            shown += 1;
        }
        let (start, end) = (format!("<!-- behaviours: {folder} -->"), "\n<!-- end of the table -->");
        let from = now.find(&start).unwrap_or_else(|| panic!("{start} is missing")) + start.len();
        let to = from + now[from..].find(end).unwrap_or_else(|| panic!("{end} is missing after {start}"));
        now.replace_range(from..to, &table);
    }
    assert_eq!(shown, rows.0.len(), "a folder of behaviours has no table");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &now).unwrap();
    } else {
        assert!(kept == now, "{} is not current: UPDATE=1 cargo test -p throng-scene docs::tables", path.display());
    }
}

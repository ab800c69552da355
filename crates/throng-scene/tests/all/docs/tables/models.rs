//! The local models: their list, the keys of all, and the keys of each.

use super::keys::{COLUMNS, row};
use super::schema::{Key, Schema};
use super::table;

pub fn tables(schema: &Schema) -> Vec<(String, String)> {
    let models = schema.choices("Avoid");
    let keys: Vec<(&str, Vec<Key<'_>>)> =
        models.iter().map(|model| (model.name, schema.keys(model.parameters))).collect();
    let has = |keys: &[Key<'_>], name: &str| keys.iter().any(|key| key.name == name);
    let is_common = |key: &Key<'_>| keys.iter().all(|(_, other)| has(other, &key.name));
    let list = models.iter().map(|model| vec![format!("`{}`", model.name), model.about.clone()]);
    let common = keys[0].1.iter().filter(|key| is_common(key)).map(|key| {
        let of_models =
            keys.iter().map(|(model, keys)| (*model, keys.iter().find(|other| other.name == key.name).unwrap()));
        common_row(schema, &of_models.collect::<Vec<_>>())
    });
    let mut tables = vec![
        ("local models".to_owned(), table(&["`avoid.`", "what it is"], list)),
        ("keys of every model".to_owned(), table(&COLUMNS, common)),
    ];
    for (model, keys) in &keys {
        let own: Vec<Vec<String>> =
            keys.iter().filter(|key| !is_common(key)).map(|key| row(schema, key).to_vec()).collect();
        if !own.is_empty() {
            tables.push((format!("keys of {model}"), table(&COLUMNS, own)));
        }
    }
    tables
}

/// Returns the row of a key that every model has. A cell has what most models have, and then what differs.
fn common_row(schema: &Schema, of_models: &[(&str, &Key<'_>)]) -> Vec<String> {
    let rows: Vec<(&str, [String; 5])> = of_models.iter().map(|(model, key)| (*model, row(schema, key))).collect();
    let cell = |column: usize| {
        let count = |text: &str| rows.iter().filter(|(_, row)| row[column] == text).count();
        let most = rows.iter().map(|(_, row)| &row[column]).max_by_key(|text| count(text)).unwrap();
        let other = rows.iter().filter(|(_, row)| row[column] != *most && !row[column].is_empty());
        let other = other.map(|(model, row)| format!("<br>`{model}`: {}", row[column]));
        most.clone() + &other.collect::<String>()
    };
    (0..COLUMNS.len()).map(cell).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng::avoid::{LocalModel, Models};
    use throng::parameters::{Parameter, Parameters};

    /// The declared parameters of each model.
    #[derive(Default)]
    struct Declared(Vec<(&'static str, &'static str, &'static [Parameter])>);

    impl Models for Declared {
        fn add<M: LocalModel + Parameters + Default>(&mut self) {
            self.0.push((M::NAME, M::ABOUT, M::PARAMETERS));
        }
    }

    #[test]
    fn the_tables_have_the_declared_parameters() {
        let mut declared = Declared::default();
        throng::avoid::register(&mut declared);
        let tables = tables(&Schema::default());
        let find = |name: &str| tables.iter().find(|(known, _)| known == name).map(|(_, table)| table.as_str());
        let list: Vec<&str> = find("local models").unwrap().lines().skip(2).collect();
        assert_eq!(list.len(), declared.0.len());
        for ((name, about, parameters), row) in declared.0.iter().zip(list) {
            assert_eq!(row, format!("| `{name}` | {about} |"));
            let table = find(&format!("keys of {name}"));
            assert_eq!(table.is_some(), !parameters.is_empty(), "{name}");
            let rows: Vec<&str> = table.into_iter().flat_map(|table| table.lines().skip(2)).collect();
            assert_eq!(rows.len(), parameters.len(), "{name}");
            for (parameter, row) in parameters.iter().zip(rows) {
                let cells: Vec<&str> = row.split('|').map(str::trim).collect();
                assert_eq!((cells[1], cells[3]), (format!("`{}`", parameter.name).as_str(), parameter.unit), "{row}");
                let (about, limit) = parameter.about.split_once(" Limit: ").unwrap_or((parameter.about, ""));
                assert!(cells[2].starts_with(about) && cells[5] == limit.trim_end_matches('.'), "{row}");
            }
        }
    }

    #[test]
    fn a_key_of_all_models_has_what_most_have_and_then_the_others() {
        let value = |default: f64| serde_json::json!({ "default": default });
        let values = [value(8.0), value(10.5), value(8.0)];
        let keys = values.each_ref().map(|value| Key {
            name: "reach".into(),
            about: "Reach.".into(),
            value,
            is_required: false,
        });
        let schema = Schema::default();
        let row = common_row(&schema, &[("a", &keys[0]), ("b", &keys[1]), ("c", &keys[2])]);
        assert_eq!(row, ["`reach`", "Reach.", "", "`8`<br>`b`: `10.5`", ""]);
    }
}

//! The behaviours of throng-steer, in a table for each folder of the crate.

use super::schema::Schema;
use super::table;
use std::any::type_name;
use throng::Error;
use throng::parameters::Parameters;
use throng::steer::BoxedBehaviour;
use throng_steer::{Behaviours, ForGroup};

/// A registered behaviour of throng-steer.
pub struct Registered {
    /// The name in scene files.
    pub name: &'static str,
    /// The name of its type in Rust.
    pub type_name: &'static str,
    /// The folder of its file in the crate.
    pub folder: &'static str,
}

#[derive(Default)]
struct All(Vec<Registered>);

impl All {
    fn add_type<P: Parameters>(&mut self) {
        let mut path = type_name::<P>().split("::");
        let folder = path.nth(1).unwrap();
        self.0.push(Registered { name: P::NAME, type_name: path.last().unwrap(), folder });
    }
}

impl Behaviours for All {
    fn add<P: Parameters + TryInto<BoxedBehaviour, Error: Into<Error>> + 'static>(&mut self) {
        self.add_type::<P>();
    }

    fn add_for_group<P: ForGroup + 'static>(&mut self) {
        self.add_type::<P>();
    }
}

/// Returns the behaviours of throng-steer, in the order of registration.
pub fn registered() -> Vec<Registered> {
    let mut all = All::default();
    throng_steer::register(&mut all);
    all.0
}

pub fn tables(schema: &Schema) -> Vec<(String, String)> {
    let registered = registered();
    let mut folders: Vec<&str> = registered.iter().map(|known| known.folder).collect();
    folders.sort_unstable();
    folders.dedup();
    let choices = schema.choices("Steer");
    let tables = folders.into_iter().map(|folder| {
        let rows = registered.iter().filter(|known| known.folder == folder).map(|known| {
            let choice = choices.iter().find(|choice| choice.name == known.name).unwrap();
            vec![format!("`{}`", choice.name), choice.about.clone(), schema.all_keys(choice.parameters, &[])]
        });
        (format!("behaviours in {folder}"), table(&["`steer.`", "what it does", "keys"], rows))
    });
    tables.collect()
}

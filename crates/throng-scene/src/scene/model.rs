//! Local models by name, to run a scene with another model: `rvo`, `orca:time_horizon=4`.

use super::{Avoid, Group, Neighbours, Scene};
use crate::error::{Error, Kind};
use crate::file::{explain, keys_of, quoted, unknown_key, value_of};
use std::fmt;
use std::str::FromStr;
use toml::{Table, Value};

/// The keys that a model keeps from the model it replaces, if it has them: those of the neighbour search.
const KEPT: [&str; 2] = ["neighbours", "neighbour_distance"];

/// A local model for all groups of a scene: a name as in `avoid.NAME` (`-` stands for `_`), and values of its keys
/// after colons.
///
/// ```
/// use throng_scene::{Avoid, Model, gallery};
///
/// let model: Model = "rvo:weight=0.5:time_horizon=4".parse()?;
/// let scene = gallery::scene("circle")?.with_model(&model)?;
/// let Some(Avoid::Rvo(rvo)) = scene.groups[0].avoid else { panic!() };
/// assert_eq!((rvo.weight, rvo.time_horizon, rvo.neighbours), (0.5, 4.0, 10));
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    label: String,
    name: String,
    values: Table,
}

impl Model {
    /// Returns the names of all models, as scene files write them.
    pub fn names() -> Vec<String> {
        keys_of::<Avoid>()
    }

    /// Returns the text that was parsed.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Returns this model with the kept values of the model it replaces. If both are the same model, all values that
    /// are not written here are kept.
    fn instead_of(&self, other: &Avoid) -> Result<Avoid, Error> {
        let read = |values: Table| {
            let table = Table::from_iter([(self.name.clone(), Value::Table(values))]);
            value_of(&table.to_string()).map_err(|misread| explain(&misread.message).file(self.label.as_str()))
        };
        let mut values = match table_of(other).remove(&self.name) {
            Some(Value::Table(values)) => values,
            _ => {
                let (neighbours, distance) = other.sight();
                let mut values = values_of(&read(Table::new())?);
                let neighbours = match neighbours {
                    Neighbours::Nearest(count) => Value::Integer(count.into()),
                    // other models take only the nearest neighbours
                    Neighbours::All => values.get(KEPT[0]).cloned().unwrap_or(Value::Integer(10)),
                };
                let kept = [neighbours, Value::Float(distance)];
                for (key, value) in KEPT.into_iter().zip(kept) {
                    if let Some(place) = values.get_mut(key) {
                        *place = value;
                    }
                }
                values
            }
        };
        values.extend(self.values.clone());
        read(values)
    }
}

/// Returns a model as the table of a scene file.
fn table_of(avoid: &Avoid) -> Table {
    Table::try_from(avoid).unwrap_or_default()
}

/// Returns the keys of a model and their values.
fn values_of(avoid: &Avoid) -> Table {
    match table_of(avoid).into_iter().next() {
        Some((_, Value::Table(values))) => values,
        _ => Table::new(),
    }
}

impl Avoid {
    /// Returns the name of the model in scene files.
    ///
    /// ```
    /// assert_eq!(throng_scene::Group::default().local_model().name(), "orca");
    /// ```
    pub fn name(&self) -> String {
        table_of(self).into_iter().next().map_or_else(String::new, |(name, _)| name)
    }
}

impl Group {
    /// Returns the group as the table of a scene file, with its local model even if that is the default.
    ///
    /// ```
    /// let table = throng_scene::Group::default().table();
    /// assert!(table["avoid"]["orca"]["time_horizon"].is_float());
    /// ```
    pub fn table(&self) -> Table {
        let mut table = Table::try_from(self).unwrap_or_default();
        table.insert("avoid".into(), Value::Table(table_of(&self.local_model())));
        table
    }
}

impl Scene {
    /// Returns the scene with this model in every group. The new model keeps `neighbours` and `neighbour_distance` of a
    /// group's own model if it has these keys. A group that has this model already keeps all its values.
    ///
    /// # Errors
    /// The model has no such key, or a value has the wrong type. Building the scene checks the limits.
    pub fn with_model(&self, model: &Model) -> Result<Self, Error> {
        let mut scene = self.clone();
        for group in &mut scene.groups {
            group.avoid = Some(model.instead_of(&group.local_model())?);
        }
        Ok(scene)
    }
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.label)
    }
}

impl FromStr for Model {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let label = text.trim();
        let mut parts = label.split(':').map(str::trim);
        let (written, names) = (parts.next().unwrap_or_default(), Self::names());
        let name = written.replace('-', "_");
        if !names.contains(&name) {
            return Err(unknown_key(written, &names).message(format!("there is no model `{written}`")));
        }
        let mut values = Table::new();
        for part in parts {
            let value = part.split_once('=').and_then(|(key, value)| {
                let value = format!("value = {}", quoted(value.trim())).parse::<Table>().ok()?.remove("value")?;
                (!key.trim().is_empty()).then(|| (key.trim().replace('-', "_"), value))
            });
            let Some((key, value)) = value else {
                return Err(Error::new(Kind::Syntax, format!("`{part}` is not a value of the model `{name}`"))
                    .file(label)
                    .hint("write the model, then its values after colons: orca:time_horizon=4:neighbours=20"));
            };
            values.insert(key, value);
        }
        let model = Self { label: label.to_owned(), name, values };
        model.instead_of(&Avoid::default())?;
        Ok(model)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery;

    fn avoid(scene: &str, model: &str) -> Avoid {
        let scene: Scene = scene.parse().unwrap();
        scene.with_model(&model.parse().unwrap()).unwrap().groups.remove(0).local_model()
    }

    const ONE: &str = "[[group]]\nplace.point = [0.0, 0.0]\navoid.orca = { time_horizon = 3.0, neighbours = 20 }\n";

    #[test]
    fn every_model_can_stand_in_for_every_other_and_sees_the_same() {
        assert!(Model::names().len() >= 5, "{:?}", Model::names());
        for name in Model::names() {
            let other = avoid(ONE, &name);
            assert!(table_of(&other).contains_key(&name));
            if let Some(neighbours) = values_of(&other).get("neighbours") {
                assert_eq!(neighbours.as_integer(), Some(20), "{name}");
            }
            let scene = gallery::scene("headon").unwrap().with_model(&name.replace('_', "-").parse().unwrap()).unwrap();
            scene.build().unwrap();
        }
    }

    #[test]
    fn the_same_model_keeps_its_values_but_for_those_written() {
        let scene: Scene = ONE.parse().unwrap();
        assert_eq!(scene.with_model(&"orca".parse().unwrap()).unwrap(), scene);
        let Avoid::Orca(orca) = avoid(ONE, "orca:time_horizon=4") else { panic!() };
        assert_eq!((orca.time_horizon, orca.neighbours), (4.0, 20));
    }

    #[test]
    fn mistakes_are_reported_with_a_fix() {
        let error = |text: &str| text.parse::<Model>().unwrap_err().to_string();
        assert!(error("orcs").contains("there is no model `orcs`"), "{}", error("orcs"));
        assert!(
            error("orcs").contains("did you mean `orca`?") && error("orcs").contains("hrvo, "),
            "{}",
            error("orcs")
        );
        assert!(error("orca:horizon=2").contains("did you mean `time_horizon`?"), "{}", error("orca:horizon=2"));
        assert!(error("orca:time_horizon").contains("after colons"));
        assert!(error("orca:time_horizon=long").contains("the text \"long\""), "{}", error("orca:time_horizon=long"));
        assert!(error("orca:time_horizon=true").contains("a number"), "{}", error("orca:time_horizon=true"));
    }
}

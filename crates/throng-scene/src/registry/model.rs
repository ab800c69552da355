//! Local models by name, to run a scene with another model: `rvo`, `orca:time_horizon=4`.

use super::{Avoid, Models};
use crate::error::{Error, Kind};
use crate::file::{Path, quoted, unknown_key};
use crate::scene::{Group, Neighbours, Scene};
use std::fmt;
use std::str::FromStr;
use toml::{Table, Value};

/// A local model for all groups of a scene: a name as in `avoid.NAME` (`-` stands for `_`), and values of its keys
/// after colons.
///
/// ```
/// use throng_scene::{Model, gallery};
///
/// let model: Model = "rvo:weight=0.5:time_horizon=4".parse()?;
/// let scene = gallery::scene("circle")?.with_model(&model)?;
/// let avoid = scene.groups[0].local_model();
/// assert_eq!(avoid.name, "rvo");
/// assert_eq!(avoid.parameters["weight"].as_float(), Some(0.5));
/// assert_eq!(avoid.parameters["neighbours"].as_integer(), Some(10));
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    label: String,
    name: String,
    values: Table,
}

impl Model {
    /// Parses a model that is one of `models`.
    ///
    /// # Errors
    /// There is no such model, it has no such key, or a value has the wrong type or is outside its limit.
    pub fn parse(text: &str, models: &Models) -> Result<Self, Error> {
        let label = text.trim();
        let mut parts = label.split(':').map(str::trim);
        let written = parts.next().unwrap_or_default();
        let name = written.replace('-', "_");
        let names: Vec<String> = models.names().map(str::to_owned).collect();
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
        model.checked(Avoid::new(model.name.clone(), Value::Table(model.values.clone())), models)?;
        Ok(model)
    }

    /// Returns the text that was parsed.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Returns this model with the neighbour search of the model that it replaces. If both are the same model, all
    /// values that are not written here are kept.
    fn instead_of(&self, before: &Avoid, models: &Models) -> Result<Avoid, Error> {
        let mut values = match &before.parameters {
            Value::Table(given) if before.name == self.name => given.clone(),
            _ => sight_of(before, models),
        };
        values.extend(self.values.clone());
        self.checked(Avoid::new(self.name.clone(), Value::Table(values)), models)
    }

    /// Returns a choice that can be made.
    fn checked(&self, avoid: Avoid, models: &Models) -> Result<Avoid, Error> {
        match models.make(&avoid, &Path::default()) {
            Ok(_) => Ok(avoid),
            Err(problem) => {
                let error = Error::new(problem.kind, problem.message).file(self.label.as_str());
                Err(Error { hint: problem.hint, ..error })
            }
        }
    }
}

/// Returns the parameters of the neighbour search of a model. Other models than one that sees all neighbours take only
/// the nearest.
fn sight_of(avoid: &Avoid, models: &Models) -> Table {
    let mut sight = Table::new();
    if let Ok(chosen) = models.make(avoid, &Path::default()) {
        if let Neighbours::Nearest(count) = chosen.neighbours {
            sight.insert(super::models::SIGHT[0].into(), Value::Integer(count.into()));
        }
        sight.insert(super::models::SIGHT[1].into(), Value::Float(chosen.neighbour_distance));
    }
    sight
}

impl Scene {
    /// Returns the scene with this model in every group. The new model keeps `neighbours` and `neighbour_distance` of a
    /// group's own model. A group that has this model already keeps all its values.
    ///
    /// # Errors
    /// The scene does not know the model, or the model refuses a value.
    pub fn with_model(&self, model: &Model) -> Result<Self, Error> {
        let mut scene = self.clone();
        for group in &mut scene.groups {
            group.avoid = Some(model.instead_of(&group.local_model(), &self.plugins.models)?);
        }
        Ok(scene)
    }

    /// Returns a group as the table of a scene file, with its local model and all parameters of it, even those that
    /// have their defaults.
    ///
    /// ```
    /// let scene = throng_scene::Scene::default();
    /// let table = scene.table_of(&throng_scene::Group::default());
    /// assert!(table["avoid"]["orca"]["time_horizon"].is_float());
    /// ```
    pub fn table_of(&self, group: &Group) -> Table {
        let mut table = Table::try_from(group).unwrap_or_default();
        let avoid = self.plugins.models.complete(&group.local_model());
        table.insert("avoid".into(), Value::Table(Table::from_iter([(avoid.name, avoid.parameters)])));
        table
    }
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.label)
    }
}

impl FromStr for Model {
    type Err = Error;

    /// Parses a model of throng.
    fn from_str(text: &str) -> Result<Self, Error> {
        Self::parse(text, &Models::default())
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
        let models = Models::default();
        assert!(models.names().count() >= 5, "{models:?}");
        for name in models.names() {
            let other = avoid(ONE, name);
            assert_eq!(other.name, name);
            assert_eq!(other.parameters["neighbours"].as_integer(), Some(20), "{name}");
            let scene = gallery::scene("headon").unwrap().with_model(&name.replace('_', "-").parse().unwrap()).unwrap();
            scene.build().unwrap();
        }
    }

    #[test]
    fn the_same_model_keeps_its_values_but_for_those_written() {
        let scene: Scene = ONE.parse().unwrap();
        assert_eq!(scene.with_model(&"orca".parse().unwrap()).unwrap(), scene);
        let orca = avoid(ONE, "orca:time_horizon=4");
        assert_eq!(orca, Avoid::named("orca").with("time_horizon", 4.0).with("neighbours", 20));
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

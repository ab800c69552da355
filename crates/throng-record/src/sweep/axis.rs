//! Parameters that vary.

use super::value::{Key, PlanValue, is_range};
use crate::Cell;
use serde_json::{Map, Value};
use throng_scene::{Error, Kind, TomlFile, TomlStep};

/// Parameters that change together: one table `[[vary]]` of a plan. A plan makes the runs of all combinations of its
/// axes.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    pub parameters: Vec<AxisParameter>,
    /// The number of values of each parameter.
    pub length: usize,
}

/// A parameter and its values.
#[derive(Clone, Debug)]
pub(super) struct AxisParameter {
    pub key: Key,
    /// The name of the column.
    pub column: String,
    pub values: Vec<PlanValue>,
    pub cells: Vec<Cell>,
    /// Whether the values are numbers from one to another.
    pub is_range: bool,
}

impl Axis {
    /// Reads the table with this position in the list.
    ///
    /// # Errors
    /// A value is not a list or a range, or two lists differ in length.
    pub fn of(file: &TomlFile, index: usize, table: &Map<String, Value>, most: usize) -> Result<Self, Error> {
        let place = [TomlStep::from("vary"), index.into()];
        let start = Key::start(place.to_vec());
        let mut parameters = Vec::new();
        for (key, value) in start.flatten(table, is_range) {
            let values = PlanValue::list(file, &key, value, most)?;
            let cells = PlanValue::cells(&values);
            let column = key.name.clone();
            parameters.push(AxisParameter { key, column, values, cells, is_range: is_range(value) });
        }
        let Some(length) = parameters.first().map(|parameter| parameter.values.len()) else {
            let hint = "give it a key with a list of values, such as body.radius = [0.2, 0.3]";
            return Err(file.error(Kind::Count, place, "this table varies nothing", hint));
        };
        if let Some(other) = parameters.iter().find(|parameter| parameter.values.len() != length) {
            let message = format!(
                "`{}` has {} values, and `{}` has {length}",
                other.key.name,
                other.values.len(),
                parameters[0].key.name
            );
            let hint = "keys of one [[vary]] change together: give them equally many values, or a [[vary]] each";
            return Err(file.error(Kind::Conflict, other.key.steps.clone(), message, hint));
        }
        Ok(Self { parameters, length })
    }
    /// Returns the positions of values that a scene has to accept so that it accepts all. The values of a range are of
    /// one type: its ends are enough.
    pub fn tested(&self) -> impl Iterator<Item = usize> {
        let all = self.parameters.iter().any(|parameter| !parameter.is_range);
        let last = self.length - 1;
        (0..self.length).filter(move |&value| all || value == 0 || value == last)
    }
}

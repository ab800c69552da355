//! Values of parameters, and paths to the keys that get them.

use crate::Cell;
use serde_json::{Map, Number, Value};
use throng_scene::{Kind, TomlFile, TomlStep};

/// A value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanValue(Value);

/// A key of a plan: its path in the file, and the key of the scene that it names.
#[derive(Clone, Debug)]
pub struct Key {
    /// The position in the plan.
    pub steps: Vec<TomlStep>,
    /// The key, as in `--set`.
    pub name: String,
}

impl Key {
    /// Returns the key at the start of a table of the plan.
    pub fn start(steps: Vec<TomlStep>) -> Self {
        Self { steps, name: String::new() }
    }

    fn child(&self, key: &str) -> Self {
        let steps = self.steps.iter().cloned().chain([key.into()]).collect();
        let name = if self.name.is_empty() { key.to_owned() } else { format!("{}.{key}", self.name) };
        Self { steps, name }
    }

    /// Returns the values below this key that `ends` accepts as values, with their keys; all other tables are parts of
    /// dotted keys.
    pub fn flatten<'v>(&self, table: &'v Map<String, Value>, ends: fn(&Value) -> bool) -> Vec<(Self, &'v Value)> {
        let mut all = Vec::new();
        for (key, value) in table {
            let key = self.child(key.trim());
            match value {
                Value::Object(deeper) if !ends(value) => all.extend(key.flatten(deeper, ends)),
                _ => all.push((key, value)),
            }
        }
        all
    }
}

impl PlanValue {
    /// Returns the values of a list or of a range, `{ from = 1, to = 5, by = 1 }` or `{ from = 1, to = 5, count = 5 }`.
    ///
    /// # Errors
    /// The value is neither, has no values, or the numbers of the range do not make one.
    pub fn list(file: &TomlFile, key: &Key, value: &Value, most: usize) -> Result<Vec<Self>, throng_scene::Error> {
        let wrong = |kind, message: &str, hint: &str| {
            Err(file.error(kind, key.steps.clone(), format!("`{}` {message}", key.name), hint))
        };
        let shape = "write a list, [0.8, 1.2], or a range, { from = 0.8, to = 2.0, by = 0.1 } or { from = 0.8, to = 2.0, count = 13 }";
        match value {
            Value::Array(items) if items.is_empty() => wrong(Kind::Count, "has no values", "give it at least one"),
            Value::Array(items) if items.len() > most => {
                wrong(Kind::Count, &format!("has more than {most} values"), "give it fewer")
            }
            Value::Array(items) => Ok(items.iter().cloned().map(Self).collect()),
            range if is_range(range) => match Range::of(range).and_then(|range| range.values(most)) {
                Ok(values) => Ok(values),
                Err(why) => wrong(Kind::OutOfRange, &why, shape),
            },
            _ => wrong(Kind::WrongType, "is one value: nothing varies", shape),
        }
    }

    /// Returns a value that is the same for all runs.
    pub fn constant(value: &Value) -> Self {
        Self(value.clone())
    }

    /// Returns the value as `--set` takes it.
    pub fn toml(&self) -> String {
        toml(&self.0)
    }

    /// Returns the value for tables: a text without quotes.
    fn text(&self) -> String {
        self.0.as_str().map_or_else(|| self.toml(), str::to_owned)
    }

    /// Returns the columns' cells of all values of a parameter: whole numbers, numbers or truths if all are, else texts.
    pub fn cells(values: &[Self]) -> Vec<Cell> {
        let all = |test: fn(&Value) -> bool| values.iter().all(|value| test(&value.0));
        let cell: fn(&Self) -> Cell = if all(Value::is_i64) {
            |value| Cell::Whole(value.0.as_i64().unwrap_or(0))
        } else if all(Value::is_number) {
            |value| Cell::Number(value.0.as_f64().unwrap_or(f64::NAN))
        } else if all(Value::is_boolean) {
            |value| Cell::Truth(value.0.as_bool())
        } else {
            |value| Cell::Text(Some(value.text()))
        };
        values.iter().map(cell).collect()
    }
}

/// Returns a value as TOML. A text is written as JSON writes it, which is TOML too, but for one character.
fn toml(value: &Value) -> String {
    match value {
        Value::Array(items) => format!("[{}]", items.iter().map(toml).collect::<Vec<_>>().join(", ")),
        Value::Object(entries) => {
            let entry =
                |(key, value): (&String, &Value)| format!("{} = {}", toml(&Value::from(key.as_str())), toml(value));
            format!("{{ {} }}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
        }
        other => other.to_string().replace('\u{7f}', "\\u007f"),
    }
}

/// Whether a table is meant as a range: it has no other keys than those of ranges.
pub fn is_range(value: &Value) -> bool {
    let known = |key: &String| ["from", "to", "by", "count"].contains(&key.as_str());
    value.as_object().is_some_and(|entries| entries.contains_key("from") && entries.keys().all(known))
}

/// Values from one number to another.
struct Range {
    from: Number,
    to: f64,
    step: Step,
}

/// The distance of two values, or their number.
enum Step {
    By(Number),
    Count(u64),
}

impl Range {
    /// # Errors
    /// A number is missing or is not a number.
    fn of(value: &Value) -> Result<Self, String> {
        let number = |key: &str| match &value[key] {
            Value::Number(number) => Ok(number.clone()),
            Value::Null => Err(format!("is a range without `{key}`")),
            _ => Err(format!("is a range with a `{key}` that is not a number")),
        };
        let step = match (&value["by"], &value["count"]) {
            (Value::Null, Value::Null) => return Err("is a range without `by` or `count`".into()),
            (_, Value::Null) => Step::By(number("by")?),
            (Value::Null, count) => {
                let least = |count: &u64| *count >= 2;
                let count = count
                    .as_u64()
                    .filter(least)
                    .ok_or("is a range with a `count` that is not a whole number from 2")?;
                Step::Count(count)
            }
            _ => return Err("is a range with both `by` and `count`".into()),
        };
        Ok(Self { from: number("from")?, to: real(&number("to")?), step })
    }

    /// # Errors
    /// The range is empty or has more than `most` values.
    fn values(&self, most: usize) -> Result<Vec<PlanValue>, String> {
        let (from, length) = (real(&self.from), self.to - real(&self.from));
        if length <= 0.0 || !length.is_finite() {
            return Err(format!("is a range from {} to {}", self.from, self.to));
        }
        let by = match &self.step {
            Step::By(by) if real(by) > 0.0 => real(by),
            Step::By(by) => return Err(format!("is a range with `by` = {by}")),
            Step::Count(count) => length / (count - 1) as f64,
        };
        // rounding must not cost the last value
        let last = (length / by * (1.0 + 1e-9)).floor();
        if last >= most as f64 {
            return Err(format!("has more than {most} values"));
        }
        let whole = self.from.is_i64() && matches!(&self.step, Step::By(by) if by.is_i64());
        let decimals = decimals(from.abs().max(self.to.abs()));
        let value = |k: usize| {
            let value = from + k as f64 * by;
            // 0.6 + 3 * 0.1 is 0.9, and never -0
            let value = format!("{value:.decimals$}").parse().unwrap_or(value) + 0.0;
            PlanValue(if whole { Value::from(value as i64) } else { Value::from(value) })
        };
        Ok((0..=last as usize).map(value).collect())
    }
}

/// Returns the decimals of a number of this size with twelve digits.
fn decimals(size: f64) -> usize {
    let exponent = format!("{size:e}").split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    usize::try_from(11 - exponent.unwrap_or(0)).unwrap_or(0)
}

fn real(number: &Number) -> f64 {
    number.as_f64().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use serde_json::json;

    fn values(value: &Value) -> Result<Vec<Value>, String> {
        let file = TomlFile::new("plan.toml", "");
        let key = Key { steps: vec![], name: "x".into() };
        let values = PlanValue::list(&file, &key, value, 1000).map_err(|error| error.message)?;
        Ok(values.into_iter().map(|value| value.0).collect())
    }

    #[test]
    fn ranges_have_decimal_values() {
        assert_eq!(
            values(&json!({ "from": 0.6, "to": 1.0, "by": 0.1 })),
            Ok(vec![json!(0.6), json!(0.7), json!(0.8), json!(0.9), json!(1.0)])
        );
        assert_eq!(values(&json!({ "from": 1, "to": 6, "by": 2 })), Ok(vec![json!(1), json!(3), json!(5)]));
        assert_eq!(values(&json!({ "from": 1, "to": 2, "count": 3 })), Ok(vec![json!(1.0), json!(1.5), json!(2.0)]));
        assert_eq!(values(&json!(["a", true])), Ok(vec![json!("a"), json!(true)]));
        for (range, wrong) in [
            (json!({ "from": 2, "to": 1, "by": 1 }), "`x` is a range from 2 to 1"),
            (json!({ "from": 1, "to": 2, "by": 0 }), "`x` is a range with `by` = 0"),
            (json!({ "from": 1, "to": 2, "by": 1e-9 }), "`x` has more than 1000 values"),
            (json!({ "from": 1, "to": 2 }), "`x` is a range without `by` or `count`"),
            (json!({ "from": 1, "by": 1 }), "`x` is a range without `to`"),
            (json!({ "from": "a", "to": 2, "by": 1 }), "`x` is a range with a `from` that is not a number"),
            (
                json!({ "from": 1, "to": 2, "count": 1 }),
                "`x` is a range with a `count` that is not a whole number from 2",
            ),
            (json!({ "from": 1, "to": 2, "count": 2, "by": 1 }), "`x` is a range with both `by` and `count`"),
            (json!([]), "`x` has no values"),
            (json!(3), "`x` is one value: nothing varies"),
        ] {
            assert_eq!(values(&range), Err(wrong.to_owned()));
        }
    }

    #[test]
    fn dotted_keys_are_paths() {
        let table = json!({ "a": { "b": [1], "c.d": { "from": 1, "to": 2, "by": 1 } }, "e": [{ "f": 1 }] });
        let start = Key::start(vec![]);
        let found = start.flatten(table.as_object().unwrap(), |value| !value.is_object() || is_range(value));
        assert_eq!(found.iter().map(|(key, _)| key.name.as_str()).collect::<Vec<_>>(), ["a.b", "a.c.d", "e"]);
    }

    proptest! {
        #[test]
        fn a_range_reaches_its_ends(from in -1000i32..1000, by in 1i32..50, count in 1usize..60) {
            // in hundredths, which decimals represent
            let [low, high, step] = [from, from + by * (count as i32), by].map(|x| f64::from(x) / 100.0);
            let all = values(&json!({ "from": low, "to": high, "by": step })).unwrap();
            let want: Vec<Value> = (0..=count as i32).map(|k| json!(f64::from(from + by * k) / 100.0)).collect();
            prop_assert_eq!(all, want);
        }

        #[test]
        fn what_is_set_is_read_as_the_same_value(texts in proptest::collection::vec(".*", 0..4), numbers in proptest::collection::vec(-1e9f64..1e9, 0..4)) {
            let value = json!({ "texts": texts, "numbers": numbers, "a b": [true, 7] });
            let document = format!("value = {}", PlanValue(value.clone()).toml());
            #[derive(serde::Deserialize)]
            struct Holder { value: Value }
            let read: Holder = TomlFile::new("x", document).read().unwrap();
            prop_assert_eq!(read.value, value);
        }
    }
}

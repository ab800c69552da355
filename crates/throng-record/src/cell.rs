//! Values of tables: numbers, texts and truths.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A value of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cell {
    /// A whole number.
    Whole(i64),
    /// A number; unknown if it is not finite.
    Number(#[serde(with = "exact")] f64),
    /// Whether something holds; unknown if `None`.
    Truth(Option<bool>),
    /// A text; unknown if `None`.
    Text(Option<String>),
}

impl Cell {
    /// Returns the value as JSON; null if it is unknown.
    ///
    /// ```
    /// use throng_record::Cell;
    /// assert_eq!(Cell::from(3usize).json(), 3);
    /// assert!(Cell::Number(f64::INFINITY).json().is_null());
    /// ```
    pub fn json(&self) -> Value {
        match self {
            Self::Whole(value) => (*value).into(),
            // JSON has no other numbers
            Self::Number(value) => (*value).into(),
            Self::Truth(value) => (*value).into(),
            Self::Text(value) => value.as_deref().into(),
        }
    }

    /// Returns the value as a number; `None` for texts, truths and unknown values.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Whole(value) => Some(*value as f64),
            Self::Number(value) => Some(*value).filter(|value| value.is_finite()),
            Self::Truth(_) | Self::Text(_) => None,
        }
    }

    /// Returns the value as it stands in a table for reading, and in CSV before quotes; empty if it is unknown.
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone().unwrap_or_default(),
            other => match other.json() {
                Value::Null => String::new(),
                value => value.to_string(),
            },
        }
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

/// Converts a count; one that is too large becomes the largest `i64`.
impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        Self::Whole(i64::try_from(count).unwrap_or(i64::MAX))
    }
}

/// Converts a count; one that is too large becomes the largest `i64`.
impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Whole(i64::try_from(count).unwrap_or(i64::MAX))
    }
}

/// Numbers as texts, which keep every bit and values that are not finite.
mod exact {
    use serde::{Deserialize, Deserializer, Serializer, de};

    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(value)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(|_| de::Error::custom(format_args!("`{text}` is not a number")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_cell_is_the_same_after_it_was_written_and_read(bits: u64, whole: i64, text: Option<String>, truth: Option<bool>) {
            let number = f64::from_bits(bits);
            for cell in [Cell::Number(number), Cell::Whole(whole), Cell::Text(text), Cell::Truth(truth)] {
                let read: Cell = serde_json::from_str(&serde_json::to_string(&cell).unwrap()).unwrap();
                match (&read, &cell) {
                    (Cell::Number(a), Cell::Number(b)) if b.is_nan() => prop_assert!(a.is_nan()),
                    (Cell::Number(a), Cell::Number(b)) => prop_assert_eq!(a.to_bits(), b.to_bits()),
                    _ => prop_assert_eq!(&read, &cell),
                }
            }
        }
    }
}

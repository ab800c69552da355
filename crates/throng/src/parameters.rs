//! Parameters, each declared once: its unit, its limit, its default and its doc line are on the field of the type that
//! uses it. Checks read that declaration. With the feature `schema`, scene files, options, sliders, the JSON schema and
//! reference pages read it too.
//!
//! ```
//! use throng::parameters::{Parameters, parameters};
//!
//! /// Stops in front of walls.
//! #[parameters]
//! #[derive(Clone, Copy, Debug, PartialEq)]
//! pub struct Brake {
//!     /// The distance at which it begins to brake, metres.
//!     #[parameter(default = 2.0, unit = "m", above = 0)]
//!     pub distance: f32,
//! }
//!
//! assert_eq!((Brake::NAME, Brake::ABOUT), ("brake", "Stops in front of walls."));
//! assert_eq!(Brake::PARAMETERS[0].about, "The distance at which it begins to brake, metres. Limit: > 0.");
//! assert_eq!(Brake::default().distance, 2.0);
//! let error = Brake { distance: -0.1 }.check_limits().unwrap_err();
//! assert_eq!(error.to_string(), "distance is -0.1, but must be more than 0");
//! ```

use crate::Error;
pub use throng_macros::parameters;

#[cfg(feature = "schema")]
#[doc(hidden)]
pub use {schemars, serde};

/// A type with parameters as its fields. [`parameters`] implements it.
pub trait Parameters: Sized {
    /// The name in scene files.
    const NAME: &'static str;
    /// What it does: the first paragraph of the type's doc comment.
    const ABOUT: &'static str;
    /// The parameters, in the order of the fields.
    const PARAMETERS: &'static [Parameter];

    /// Checks the limit of each parameter.
    ///
    /// # Errors
    /// [`Error::Limit`] names the first parameter that is outside its limit.
    fn check_limits(&self) -> Result<(), Error>;
}

/// Parameters that can be read from files and written to them, and have a JSON schema.
#[cfg(feature = "schema")]
pub trait Declared:
    Parameters + serde::Serialize + serde::de::DeserializeOwned + schemars::JsonSchema + 'static
{
}

#[cfg(feature = "schema")]
impl<P: Parameters + serde::Serialize + serde::de::DeserializeOwned + schemars::JsonSchema + 'static> Declared for P {}

/// A parameter, as declared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// The name: that of the field, and the key in scene files.
    pub name: &'static str,
    /// The doc line, with the limit.
    pub about: &'static str,
    /// The unit; empty for a parameter without one.
    pub unit: &'static str,
    /// The limit.
    pub limit: Limit,
}

impl Parameter {
    /// Checks a value of the parameter.
    ///
    /// # Errors
    /// [`Error::Limit`] if it is outside the limit.
    pub fn check(&self, value: &impl Quantity) -> Result<(), Error> {
        match value.quantity() {
            Some(value) if !self.limit.holds(value) => {
                Err(Error::Limit { what: self.name, value, limit: self.limit.words })
            }
            _ => Ok(()),
        }
    }
}

/// The values that a parameter can have. All of them are finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// They are greater than this.
    pub above: Option<f64>,
    /// They are no less than this.
    pub least: Option<f64>,
    /// They are no greater than this.
    pub most: Option<f64>,
    /// The limit in words, as messages state it: `more than 0`.
    pub words: &'static str,
}

impl Limit {
    /// Whether a value is within the limit.
    pub fn holds(&self, value: f64) -> bool {
        value.is_finite()
            && self.above.is_none_or(|above| value > above)
            && self.least.is_none_or(|least| value >= least)
            && self.most.is_none_or(|most| value <= most)
    }
}

/// A value that limits apply to.
pub trait Quantity {
    /// Returns the value as a number, as files write it; `None` if there is no value.
    fn quantity(&self) -> Option<f64>;
}

impl Quantity for f32 {
    /// Returns the number with the fewest digits that is this value in single precision.
    fn quantity(&self) -> Option<f64> {
        Some(shortest(*self))
    }
}

impl Quantity for f64 {
    fn quantity(&self) -> Option<f64> {
        Some(*self)
    }
}

impl Quantity for u32 {
    fn quantity(&self) -> Option<f64> {
        Some(f64::from(*self))
    }
}

impl Quantity for usize {
    fn quantity(&self) -> Option<f64> {
        Some(*self as f64)
    }
}

impl<Q: Quantity> Quantity for Option<Q> {
    fn quantity(&self) -> Option<f64> {
        self.as_ref().and_then(Q::quantity)
    }
}

/// Returns the number with the fewest digits that is `value` in single precision: 0.1 for 0.1, not
/// 0.10000000149011612.
pub fn shortest(value: f32) -> f64 {
    value.to_string().parse().unwrap_or_else(|_| f64::from(value))
}

/// An angle: radians in code, degrees in files.
///
/// ```
/// use throng::parameters::Angle;
/// assert_eq!(Angle::degrees(180.0).radians(), std::f32::consts::PI);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Angle(f32);

impl Angle {
    /// Returns an angle of this many degrees.
    pub const fn degrees(degrees: f64) -> Self {
        Self(degrees.to_radians() as f32)
    }

    /// Returns an angle of this many radians.
    pub const fn from_radians(radians: f32) -> Self {
        Self(radians)
    }

    /// Returns the radians.
    pub const fn radians(self) -> f32 {
        self.0
    }

    /// Returns the degrees with the fewest decimals that are this angle.
    pub fn to_degrees(self) -> f64 {
        let degrees = f64::from(self.0).to_degrees();
        let rounded = (0..10).filter_map(|decimals| format!("{degrees:.decimals$}").parse().ok());
        rounded.into_iter().find(|rounded| Self::degrees(*rounded) == self).unwrap_or(degrees)
    }
}

impl Quantity for Angle {
    /// Returns the degrees.
    fn quantity(&self) -> Option<f64> {
        Some(self.to_degrees())
    }
}

#[cfg(feature = "schema")]
mod angle {
    use super::Angle;
    use schemars::{JsonSchema, Schema, SchemaGenerator};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::borrow::Cow;

    impl Serialize for Angle {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.serialize_f64(self.to_degrees())
        }
    }

    impl<'de> Deserialize<'de> for Angle {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            f64::deserialize(deserializer).map(Self::degrees)
        }
    }

    impl JsonSchema for Angle {
        fn inline_schema() -> bool {
            true
        }

        fn schema_name() -> Cow<'static, str> {
            "Angle".into()
        }

        fn json_schema(generator: &mut SchemaGenerator) -> Schema {
            f64::json_schema(generator)
        }
    }
}

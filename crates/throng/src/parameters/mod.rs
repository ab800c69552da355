//! Parameters, each declared once: its unit, its limit, its default and its doc line are on the field of the type that
//! uses it. Checks, scene files, options, sliders, the JSON schema and reference pages read that declaration.
//!
//! ```
//! use throng::parameters::{Parameters, Value, parameters};
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

mod angle;
mod given;
mod kind;
mod value;

pub use angle::Angle;
pub use given::Given;
pub use kind::{Kind, Name, Names, Table, Written};
pub use throng_macros::parameters;
pub use value::{FigureName, GroundPlace, SpacePlace, Value};

use crate::Error;

/// A type with parameters as its fields. [`parameters`] implements it.
pub trait Parameters: Value {
    /// The name in scene files.
    const NAME: &'static str;
    /// What it does: the first paragraph of the type's doc comment.
    const ABOUT: &'static str;
    /// The parameters, in the order of the fields.
    const PARAMETERS: &'static [Parameter];
}

/// A parameter, as declared.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// The name: that of the field, and the key in scene files.
    pub name: &'static str,
    /// The doc line, with the limit.
    pub about: &'static str,
    /// The unit; empty for a parameter without one.
    pub unit: &'static str,
    /// The limit.
    pub limit: Limit,
    /// What its values are.
    pub kind: Kind,
    /// Whether files must give it.
    pub is_required: bool,
    /// Returns the default, as files write it; `None` if files cannot write it.
    pub default: fn() -> Option<Written>,
}

impl Parameter {
    /// Checks a value of the parameter.
    ///
    /// # Errors
    /// [`Error::Limit`] if it is outside the limit.
    pub fn check(&self, value: &impl Value) -> Result<(), Error> {
        match value.quantity() {
            Some(value) if !self.limit.holds(value) => {
                Err(Error::Limit { what: self.name, value, limit: self.limit.words })
            }
            _ => value.check_limits(),
        }
    }
}

/// The values that a parameter can have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// They are greater than this.
    pub above: Option<f64>,
    /// They are no less than this.
    pub least: Option<f64>,
    /// They are no greater than this.
    pub most: Option<f64>,
    /// Whether they may be infinite.
    pub is_infinite: bool,
    /// The limit in words, as messages state it: `more than 0`.
    pub words: &'static str,
}

impl Limit {
    /// Whether a value is within the limit.
    pub fn holds(&self, value: f64) -> bool {
        (value.is_finite() || self.is_infinite && !value.is_nan())
            && self.above.is_none_or(|above| value > above)
            && self.least.is_none_or(|least| value >= least)
            && self.most.is_none_or(|most| value <= most)
    }
}

/// Returns the number with the fewest digits that is `value` in single precision: 0.1 for 0.1, not
/// 0.10000000149011612.
pub fn shortest(value: f32) -> f64 {
    value.to_string().parse().unwrap_or_else(|_| f64::from(value))
}

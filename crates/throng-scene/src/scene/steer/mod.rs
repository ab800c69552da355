//! Steering in scene files: the behaviours of [`throng::steer`] and their combinations.
//!
//! Each behaviour is a table of its parameters.
//! Angles are degrees, places are world coordinates, agents and groups are referred to by group names.
//!
//! ```
//! use throng_scene::Steer;
//!
//! let in_code = Steer::named("arrive").with("target", vec![3.0, 4.0]).with("slowing_distance", 2);
//! let in_a_file: Steer = toml::from_str("arrive = { target = [3, 4], slowing_distance = 2 }")?;
//! assert_eq!(in_code, in_a_file);
//! # Ok::<(), toml::de::Error>(())
//! ```

mod combine;
mod group;
mod place;
mod position;
mod single;
mod target;

pub use combine::*;
pub use group::*;
pub use place::*;
pub use position::Position;
pub use single::*;
pub use target::{GroupFilter, Member, Target};

use crate::registry::{Behaviours, Steer, described};

/// Defines tables of parameters.
macro_rules! parameters {
    ($($(#[$meta:meta])* $name:ident { $($(#[$about:meta])* $key:ident: $type:ty,)* })*) => { $(
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $($(#[$about])* pub $key: $type,)*
        }
    )* };
}
pub(in crate::scene) use parameters;

described! {
    Steer in Behaviours:
    /// Runs up to a leap, as gdx-ai's jump does.
    Takeoff = "takeoff",
    /// Keeps its place in a formation that moves with a leader.
    KeepFormation = "keep_formation",
    /// One behaviour at a time: a state machine.
    Switch = "switch",
}

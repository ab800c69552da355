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

mod obstacles;
mod position;
mod target;

pub use obstacles::ObstacleNames;
pub use position::Position;
pub use target::{GroupFilter, Member, Target};

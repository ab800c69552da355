//! What steering names in scene files: places, obstacles, targets, and agents that count.
//!
//! The behaviours are those of [`throng_steer`]: their types declare the keys of their tables. Angles are degrees, places are
//! world coordinates, agents and groups are referred to by group names.
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
pub(crate) use target::{GroupFilter, Member, Target};

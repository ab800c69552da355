//! A plug-in for the studio of throng: a behaviour, and two scenes that use it.

mod sunflower;
mod weave;

pub use weave::Weave;

use throng_studio::Plugins;

/// Returns the content of this plug-in.
pub fn plugins() -> Plugins {
    Plugins::new()
        .behaviour::<Weave>("weave")
        .scene("skaters", include_str!("skaters.toml"))
        .scene_in_code("sunflower", &sunflower::scene())
}

//! A plug-in of throng's studio: a behaviour, and two scenes that use it.

mod sunflower;
mod weave;

pub use weave::Weave;

use throng_studio::Plugins;

/// What this plug-in brings along.
pub fn plugins() -> Plugins {
    Plugins::new()
        .behaviour::<Weave>("weave")
        .scene("skaters", include_str!("skaters.toml"))
        .scene_in_code("sunflower", &sunflower::scene())
}

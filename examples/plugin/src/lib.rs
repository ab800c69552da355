//! A plug-in for the studio of throng: a local model, a behaviour, and scenes that use them.

mod brake;
mod sunflower;
mod weave;

pub use brake::Brake;
pub use weave::Weave;

use throng_studio::Plugins;

/// Returns the content of this plug-in.
pub fn plugins() -> Plugins {
    Plugins::new()
        .model::<Brake>()
        .behaviour::<Weave>()
        .scene("crossroads", include_str!("crossroads.toml"))
        .scene("skaters", include_str!("skaters.toml"))
        .scene_in_code("sunflower", &sunflower::scene())
}

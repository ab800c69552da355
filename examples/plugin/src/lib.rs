//! A plug-in for the studio of throng: a local model, a behaviour, a placement, a goal, and scenes that use them.

mod around;
mod brake;
mod spiral;
mod sunflower;
mod weave;

pub use around::Around;
pub use brake::Brake;
pub use spiral::Spiral;
pub use weave::Weave;

use throng_studio::Plugins;

/// Returns the content of this plug-in.
pub fn plugins() -> Plugins {
    Plugins::new()
        .model::<Brake>()
        .behaviour::<Weave>()
        .placement::<Spiral>()
        .goal::<Around>()
        .scene("crossroads", include_str!("crossroads.toml"))
        .scene("seeds", include_str!("seeds.toml"))
        .scene("skaters", include_str!("skaters.toml"))
        .scene_in_code("sunflower", &sunflower::scene())
}

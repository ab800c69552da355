//! Anything that can be a scene.

use super::{Imported, jupedsim};
use crate::error::{Error, Kind};
use crate::gallery;
use crate::scene::Scene;
use std::path::Path;

/// Opens whatever a user may call a scene: a scene file (`.toml`), the name of a gallery scene, or a JuPedSim
/// scenario (a folder with `config.json`, a `.zip` of one, or a single `.json`).
///
/// # Errors
/// Those of [`Scene::load`] and [`jupedsim::load`]; and a hint for what is not a scene by itself.
pub fn open(scene: impl AsRef<Path>) -> Result<Imported, Error> {
    let path = scene.as_ref();
    let plain = |scene: Scene| Imported { scene, notes: vec![] };
    if let Some(name) = path.to_str().filter(|name| !path.exists() && gallery::text(name).is_some()) {
        return gallery::scene(name).map(plain);
    }
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if path.is_dir() {
        return jupedsim::load(path);
    }
    let shown = path.display();
    match extension.as_str() {
        "toml" => Scene::load(path).map(plain),
        "zip" | "json" => jupedsim::load(path),
        "wkt" => Err(Error::new(Kind::NotAScene, format!("{shown} is a floor plan, not a scene: nobody is in it")).hint(
            format!(
                "write a scene file with `walkable.file = \"{}\"` and a [[group]], or say where the exit is and how many \
                 people: --exit x,y,width,height --people 500",
                path.file_name().unwrap_or_default().to_string_lossy()
            ),
        )),
        "" if !path.exists() => gallery::scene(&path.to_string_lossy()).map(plain),
        _ if !path.exists() => Err(crate::file::missing(path, &std::io::ErrorKind::NotFound.into())),
        _ => Err(Error::new(Kind::NotAScene, format!("{shown} is not a scene"))
            .hint("a scene is a .toml file, a JuPedSim scenario (folder, .zip or .json), or the name of a gallery scene")),
    }
}

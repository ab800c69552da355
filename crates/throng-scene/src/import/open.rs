//! Opens anything that can be a scene.

use super::{Imported, jupedsim, plan};
use crate::error::{Error, Kind};
use crate::gallery;
use crate::scene::Scene;
use std::path::Path;

/// Opens a scene, by its name and content: a scene file (`.toml`), the name of a gallery scene, a JuPedSim scenario (a
/// folder with `config.json`, a `.zip` of one, or a single `.json`), a Menge project (its `.xml` files, or their
/// folder), or a floor plan with exits (see [`plan`]).
///
/// # Errors
/// Those of [`Scene::load`], [`jupedsim::load`], [`menge::load`](super::menge::load) and [`plan::load`]; or the file is
/// not a scene by itself. The error has a hint.
pub fn open(scene: impl AsRef<Path>) -> Result<Imported, Error> {
    let path = scene.as_ref();
    let plain = |scene: Scene| Imported { scene, notes: vec![] };
    if let Some(name) = path.to_str().filter(|name| !path.exists() && gallery::text(name).is_some()) {
        return gallery::scene(name).map(plain);
    }
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if path.is_dir() {
        #[cfg(feature = "menge")]
        if !path.join("config.json").exists() && super::menge::is_project(path) {
            return super::menge::load(path);
        }
        return jupedsim::load(path);
    }
    let shown = path.display();
    match extension.as_str() {
        "toml" => Scene::load(path).map(plain),
        _ if plan::is_plan(path) => plan::load(path, &plan::PlanOptions::default()),
        "zip" | "json" => jupedsim::load(path),
        #[cfg(feature = "menge")]
        "xml" => super::menge::load(path),
        "" if !path.exists() => gallery::scene(&path.to_string_lossy()).map(plain),
        _ if !path.exists() => Err(crate::file::missing(path, &std::io::ErrorKind::NotFound.into())),
        _ => Err(Error::new(Kind::NotAScene, format!("{shown} is not a scene")).hint(
            "a scene is a .toml file, a JuPedSim scenario (folder, .zip or .json), a project of Menge's (folder or .xml), a floor plan \
             (.wkt, .geojson, .dxf, .svg or .obj), or the name of a gallery scene",
        )),
    }
}

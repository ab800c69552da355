//! Scenarios of the JuPedSim web editor: `config.json` and `geometry.wkt`, as a folder, a zip, or one JSON file with
//! the floor plan inside.
//!
//! Imported: the floor plan, distributions (number, radius, speed, flow, premovement), exits, checkpoints with waiting
//! times, journeys with weights, seed, time limit. Not imported, with a note for each: the model and its parameters,
//! zones that change the speed, throttled exits.

mod convert;
mod distribution;
mod parts;

use super::Imported;
use crate::error::{Error, Kind};
use std::path::Path;

/// Reads a scenario: a folder, a `.zip` or a `.json`.
///
/// # Errors
/// A part is missing or cannot be read, or it is not a JuPedSim scenario.
pub fn load(path: impl AsRef<Path>) -> Result<Imported, Error> {
    let path = path.as_ref();
    let parts = parts::read(path)?;
    let mut imported = from_text(&parts.config, parts.plan.as_deref()).map_err(|mut error| {
        error.file.get_or_insert_with(|| path.display().to_string().into());
        error
    })?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    imported.scene.title = format!("{name} (from JuPedSim)");
    Ok(imported)
}

/// Reads a scenario from the text of its `config.json` and of its floor plan (WKT), if that is not inside the JSON.
///
/// # Errors
/// The text is not a JuPedSim scenario, or there is no floor plan.
pub fn from_text(config: &str, plan: Option<&str>) -> Result<Imported, Error> {
    let config: serde_json::Value = serde_json::from_str(config).map_err(|error| {
        let mut out = Error::new(Kind::Syntax, format!("this is not JSON: {error}"));
        let line = config.lines().nth(error.line().saturating_sub(1)).unwrap_or_default();
        out.at = Some((error.line(), error.column().max(1)));
        out.line = Some((line.to_owned(), 1));
        out
    })?;
    if !config["distributions"].is_object() {
        return Err(Error::new(Kind::NotAScene, "this is not a JuPedSim scenario: it has no `distributions`")
            .hint("a scenario is a folder or zip of the JuPedSim web editor: config.json and geometry.wkt"));
    }
    let inside = config["walkable_area_wkt"].as_str();
    let Some(plan) = plan.or(inside) else {
        return Err(Error::new(Kind::File, "this scenario has no floor plan")
            .hint("put geometry.wkt beside config.json, or `walkable_area_wkt` inside it"));
    };
    convert::convert(&config, super::wkt::areas(plan)?)
}

//! The texts that make up a scenario.

use crate::error::{Error, Kind};
use crate::file::{LARGEST, read_text, too_large};
use std::io::Read;
use std::path::Path;

pub(super) struct JupedsimParts {
    pub config: String,
    pub plan: Option<String>,
}

pub(super) fn read(path: &Path) -> Result<JupedsimParts, Error> {
    if path.is_dir() {
        let plan = path.join("geometry.wkt");
        return Ok(JupedsimParts {
            config: read_text(&path.join("config.json"))?,
            plan: if plan.is_file() { Some(read_text(&plan)?) } else { None },
        });
    }
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("zip")) {
        return zipped(path).map_err(|error| error.file(path.display().to_string()));
    }
    Ok(JupedsimParts { config: read_text(path)?, plan: None })
}

fn zipped(path: &Path) -> Result<JupedsimParts, Error> {
    let file = std::fs::File::open(path).map_err(|error| crate::file::missing(path, &error))?;
    let broken =
        |error: &dyn std::fmt::Display| Error::new(Kind::Syntax, format!("this is not a readable zip: {error}"));
    let mut archive = zip::ZipArchive::new(file).map_err(|error| broken(&error))?;
    let (mut config, mut plan) = (None, None);
    for i in 0..archive.len() {
        let entry = archive.by_index(i).map_err(|error| broken(&error))?;
        let name = entry.name().map_err(|error| broken(&error))?.into_owned();
        let slot = match name.rsplit('/').next() {
            Some("config.json") => &mut config,
            Some("geometry.wkt") => &mut plan,
            _ => continue,
        };
        let mut text = String::new();
        entry.take(LARGEST + 1).read_to_string(&mut text).map_err(|error| broken(&error))?;
        if text.len() as u64 > LARGEST {
            return Err(too_large(&name, LARGEST));
        }
        *slot = Some(text);
    }
    let config = config.ok_or_else(|| {
        Error::new(Kind::NotAScene, "this zip is not a JuPedSim scenario: it has no config.json")
            .hint("a scenario is a zip of the JuPedSim web editor: config.json and geometry.wkt")
    })?;
    Ok(JupedsimParts { config, plan })
}

//! Floor plans: what is drawn, by the names of layers, as scenes in which people leave.
//!
//! | ending | what it is |
//! |---|---|
//! | `.wkt` | well-known text: polygons, all ground |
//! | `.geojson` | GeoJSON: features by their properties |
//! | `.dxf` | drawings of CAD programs, by their layers |
//! | `.svg` | vector graphics, by the labels and ids of groups; a feature of the crate, `svg` |
//! | `.obj` | triangle meshes: what of them can be walked on |
//!
//! `docs/import.md` says what becomes what.

mod assemble;
mod chain;
mod curve;
mod drawing;
mod dxf;
mod evacuation;
mod geojson;
mod layer;
mod levels;
mod overlay;
mod scale;
#[cfg(feature = "svg")]
mod svg;
mod walk;

#[cfg(feature = "menge")]
pub(super) use overlay::union;

use super::Imported;
use crate::error::{Error, Kind};
use crate::file::read_text;
use assemble::Parts;
use drawing::{Drawing, Form, Place};
use std::io::Read;
use std::path::Path;

/// So many bytes of a `.json` are looked at for what it is.
const START: u64 = 4096;

/// What a plan does not say by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ask {
    /// Where people leave, instead of the plan's own exits: x and y of the lower left corner, width and height, metres.
    pub exit: Option<[f64; 4]>,
    /// How many people there are. Without it, as many as the plan says, or one on every 4 m².
    pub people: Option<u64>,
    /// The length of the plan's unit, metres, instead of what the file says. Limit: more than 0.
    pub unit: Option<f64>,
    /// Which level of a mesh, from 1 for the lowest, instead of the largest. Only meshes have levels.
    pub level: Option<u64>,
}

/// Whether a file is a floor plan, by its ending; that of a `.json` is GeoJSON if it says so at its start.
pub fn is_plan(path: impl AsRef<Path>) -> bool {
    let path = path.as_ref();
    match ending(path).as_str() {
        "wkt" | "geojson" | "dxf" | "svg" | "obj" => true,
        "json" => says_geojson(path),
        _ => false,
    }
}

/// Whether the first bytes of a file have the word that a GeoJSON with several shapes begins with.
fn says_geojson(path: &Path) -> bool {
    let mut start = vec![];
    let file = std::fs::File::open(path).ok();
    let read = file.and_then(|file| file.take(START).read_to_end(&mut start).ok());
    read.is_some() && String::from_utf8_lossy(&start).contains("\"FeatureCollection\"")
}

/// What can be walked on in a floor plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    /// Areas, metres, apart from each other where there are several.
    pub areas: Vec<throng::Walkable>,
    /// What was left out or changed, a sentence each.
    pub notes: Vec<String>,
}

/// Reads the ground of a floor plan, less what is solid on it. Walls that are lines are 2 cm wide.
///
/// # Errors
/// The file cannot be read or is none of a plan; nothing says what is on its layers, or where its ground is; or an outline crosses
/// itself.
pub fn ground(path: impl AsRef<Path>, ask: &Ask) -> Result<Ground, Error> {
    of_file(path.as_ref(), |name, text| parts(name, text, ask)?.ground())
}

/// Reads a floor plan as a scene in which people leave.
///
/// # Errors
/// The file cannot be read or is none of a plan; nothing says what is on its layers; an outline crosses itself; there is no exit, or
/// nobody fits into it; or nothing is there to walk on.
pub fn load(path: impl AsRef<Path>, ask: &Ask) -> Result<Imported, Error> {
    of_file(path.as_ref(), |name, text| from_text(name, text, ask))
}

/// Reads the text of a floor plan; the ending of its name says what kind it is.
///
/// # Errors
/// As [`load`].
pub fn from_text(name: &str, text: &str, ask: &Ask) -> Result<Imported, Error> {
    let parts = parts(name, text, ask)?;
    let doubt = parts.doubt.clone();
    // where nothing fits into a plan, the unit is what to change first
    evacuation::scene(name, parts, ask).map_err(|error| match doubt {
        Some(doubt) if matches!(error.kind, Kind::Geometry | Kind::GoalInWall) => error.hint(doubt),
        _ => error,
    })
}

/// Reads a file, of which errors say the name.
fn of_file<T>(path: &Path, read: impl FnOnce(&str, &str) -> Result<T, Error>) -> Result<T, Error> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let read = read_text(path).and_then(|text| read(&name, &text));
    read.map_err(|error| match error.kind {
        // these say the name themselves
        Kind::File | Kind::NotAScene => error,
        _ => error.file(path.display().to_string()),
    })
}

/// What the text of a plan says.
fn parts(name: &str, text: &str, ask: &Ask) -> Result<Parts, Error> {
    if let Some(unit) = ask.unit.filter(|unit| !(unit.is_finite() && *unit > 0.0)) {
        return Err(
            Error::new(Kind::OutOfRange, format!("a unit of {unit} m")).hint("give its length in metres, such as 0.01")
        );
    }
    let ending = ending(Path::new(name));
    if ask.level.is_some() && ending != "obj" {
        return Err(Error::new(Kind::Conflict, "this plan has no levels to choose from: only meshes (.obj) do")
            .hint("leave out the level"));
    }
    let mut drawing = match ending.as_str() {
        "wkt" => wkt(text, ask.unit.unwrap_or(1.0))?,
        "geojson" | "json" => geojson::read(text, ask.unit)?,
        "dxf" => dxf::read(text, ask.unit)?,
        #[cfg(feature = "svg")]
        "svg" => svg::read(text, ask.unit)?,
        "obj" => walk::read(text, ask.unit.unwrap_or(1.0), ask.level)?,
        _ => {
            return Err(Error::new(Kind::NotAScene, format!("{name} is not a floor plan"))
                .hint("plans end in .wkt, .geojson, .dxf, .svg or .obj"));
        }
    };
    if let Some(unit) = ask.unit {
        drawing.unit = unit;
    }
    let doubt = scale::doubt(&drawing);
    if let Some(doubt) = &doubt {
        drawing.notes.whole(doubt.clone());
    }
    Ok(Parts { doubt, ..Parts::of(drawing)? })
}

/// The polygons of a text: all that can be walked on.
fn wkt(text: &str, unit: f64) -> Result<Drawing, Error> {
    let mut drawing = Drawing::of_ground();
    for (i, area) in super::wkt::areas(text)?.iter().enumerate() {
        let ring = |ring: &Vec<crate::scene::Point>| crate::geometry::points(ring).iter().map(|p| *p * unit).collect();
        let form = Form::Area(ring(&area.outer), area.holes.iter().map(ring).collect());
        drawing.add("", form, Place::Polygon(i));
    }
    Ok(drawing)
}

fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

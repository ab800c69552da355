//! Floor plans: drawings, read by the names of their layers, as scenes in which agents leave.
//!
//! | ending | format |
//! |---|---|
//! | `.wkt` | well-known text: polygons, all ground |
//! | `.geojson` | GeoJSON: features by their properties |
//! | `.dxf` | drawings of CAD programs, by their layers |
//! | `.svg` | vector graphics, by the labels and ids of groups; a feature of the crate, `svg` |
//! | `.obj` | triangle meshes: their walkable part |
//!
//! `docs/import.md` describes the roles of shapes.

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

pub use overlay::cut_ground;

#[cfg(feature = "menge")]
pub(super) use overlay::union;

use super::Imported;
use crate::error::{Error, Kind};
use crate::file::read_text;
use assemble::PlanParts;
use drawing::{Drawing, FilePosition, PlanShape};
use std::io::Read;
use std::path::Path;

/// The number of bytes of a `.json` that are searched for its kind.
const START: u64 = 4096;

/// Settings that a plan does not contain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanOptions {
    /// The exit, in place of the plan's own exits: x and y of the lower left corner, width and height, metres.
    pub exit: Option<[f64; 4]>,
    /// The number of agents. Without it, the plan's number, or one on every 4 m².
    pub people: Option<u64>,
    /// The length of the plan's unit, metres, in place of the file's unit. Limit: more than 0.
    pub unit: Option<f64>,
    /// The level of a mesh, from 1 for the lowest, in place of the largest. Only meshes have levels.
    pub level: Option<u64>,
}

/// The endings of files that are floor plans. A `.json` may be one, too.
pub const ENDINGS: [&str; 5] = ["wkt", "geojson", "dxf", "svg", "obj"];

/// Whether a file is a floor plan, by its ending. A `.json` is a floor plan if its start shows that it is GeoJSON.
pub fn is_plan(path: impl AsRef<Path>) -> bool {
    let path = path.as_ref();
    match ending(path).as_str() {
        "json" => says_geojson(path),
        other => ENDINGS.contains(&other),
    }
}

/// Whether the first bytes of a file have the word with which a GeoJSON with several shapes begins.
fn says_geojson(path: &Path) -> bool {
    let mut start = vec![];
    let file = std::fs::File::open(path).ok();
    let read = file.and_then(|file| file.take(START).read_to_end(&mut start).ok());
    read.is_some() && String::from_utf8_lossy(&start).contains("\"FeatureCollection\"")
}

/// The walkable ground of a floor plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlanGround {
    /// Areas, metres. Several areas are separate from each other.
    pub areas: Vec<throng::Walkable>,
    /// What was left out or changed, a sentence each.
    pub notes: Vec<String>,
}

/// Reads the ground of a floor plan, without obstacles. Walls that are lines are 2 cm wide.
///
/// # Errors
/// The file cannot be read or is not a plan, no layer has a known role, there is no ground, or an outline crosses
/// itself.
pub fn ground(path: impl AsRef<Path>, ask: &PlanOptions) -> Result<PlanGround, Error> {
    of_file(path.as_ref(), |name, text| parts(name, text, ask)?.ground())
}

/// Reads a floor plan as a scene in which agents leave.
///
/// # Errors
/// The file cannot be read or is not a plan, no layer has a known role, an outline crosses itself, there is no exit
/// with room for an agent, or there is no ground.
pub fn load(path: impl AsRef<Path>, ask: &PlanOptions) -> Result<Imported, Error> {
    of_file(path.as_ref(), |name, text| from_text(name, text, ask))
}

/// Reads the text of a floor plan; the ending of its name defines its kind.
///
/// # Errors
/// As [`load`].
pub fn from_text(name: &str, text: &str, ask: &PlanOptions) -> Result<Imported, Error> {
    let parts = parts(name, text, ask)?;
    let doubt = parts.doubt.clone();
    // if nothing fits into a plan, its unit is the first thing to change
    evacuation::scene(name, parts, ask).map_err(|error| match doubt {
        Some(doubt) if matches!(error.kind, Kind::Geometry | Kind::GoalInWall) => error.hint(doubt),
        _ => error,
    })
}

/// Reads a file, and adds its name to errors.
fn of_file<T>(path: &Path, read: impl FnOnce(&str, &str) -> Result<T, Error>) -> Result<T, Error> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let read = read_text(path).and_then(|text| read(&name, &text));
    read.map_err(|error| match error.kind {
        // these errors have the name already
        Kind::File | Kind::NotAScene => error,
        _ => error.file(path.display().to_string()),
    })
}

/// Reads the parts of a plan from its text.
fn parts(name: &str, text: &str, ask: &PlanOptions) -> Result<PlanParts, Error> {
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
    Ok(PlanParts { doubt, ..PlanParts::of(drawing)? })
}

/// Reads the polygons of a text, all of which are walkable.
fn wkt(text: &str, unit: f64) -> Result<Drawing, Error> {
    let mut drawing = Drawing::of_ground();
    for (i, area) in super::wkt::areas(text)?.iter().enumerate() {
        let ring = |ring: &Vec<crate::scene::Point>| crate::geometry::points(ring).iter().map(|p| *p * unit).collect();
        let form = PlanShape::Area(ring(&area.outer), area.holes.iter().map(ring).collect());
        drawing.add("", form, FilePosition::Polygon(i));
    }
    Ok(drawing)
}

fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

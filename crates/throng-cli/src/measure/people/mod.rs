//! People of a recording: their figures for the terminal, for programs, as a table of all moments, and as plots.

mod json;
mod plots;
mod text;

use super::Subject;
use super::args::MeasureArgs;
use crate::failure::Failure;
use glam::DVec2;
use std::fmt::Write;
use std::path::Path;
use throng::Walkable;
use throng_record::pedestrian::{self, Figures, Ground, Instant, Question};
use throng_record::{Spot, Tracks};
use throng_scene::import::wkt;

pub use json::{json, object};

/// How far Voronoi cells reach where the ground is not known, metres.
const CUT_OFF: f64 = 1.0;
/// The columns of the table of all moments.
const COLUMNS: &str = "time,people,speed,density,area_speed,voronoi_density,voronoi_speed,crossed,lane_order";

/// People and what was measured.
pub struct People {
    /// What was asked.
    question: Question,
    /// What was found.
    figures: Figures,
}

/// That nothing is asked of a scene that is measured of recordings only.
///
/// # Errors
/// Something is.
pub fn not_of_scenes(args: &MeasureArgs) -> Result<(), Failure> {
    let people = &args.people;
    if people.area.is_none() && people.line.is_none() && people.walkable.is_none() && people.cut_off.is_none() {
        return Ok(());
    }
    let text = format!("{}: people are measured in files of trajectories", args.of.display());
    Err(Failure::hint(text, "record it first, with `throng run SCENE -o NAME.csv`, and measure NAME.csv"))
}

/// Those of a recording who count; `None` where somebody is above the ground and nothing of people is asked.
///
/// # Errors
/// The floor plan cannot be read.
pub fn of(args: &MeasureArgs, tracks: &Tracks, counts: impl Fn(&Spot) -> bool) -> Result<Option<People>, Failure> {
    let asked = &args.people;
    let flies = tracks.spots.iter().any(|spot| spot.place.z != 0.0);
    if flies && asked.area.is_none() && asked.line.is_none() {
        return Ok(None);
    }
    let walkable = match &asked.walkable {
        Some(path) => plan(path)?,
        None => tracks.setting.walkable.clone(),
    };
    let cut_off = asked.cut_off.or(walkable.is_empty().then_some(CUT_OFF));
    let ground = Ground { walkable, cut_off };
    let question = Question { interval: asked.interval, area: asked.area.clone(), line: asked.line, ground };
    let people = pedestrian::People::of(tracks, counts);
    Ok(Some(People { figures: Figures::of(&people, &question), question }))
}

/// Reads a floor plan.
///
/// # Errors
/// It cannot be read, or is none.
pub fn plan(path: &Path) -> Result<Vec<Walkable>, Failure> {
    let wrong = |error: &dyn std::fmt::Display| Failure::Error(format!("cannot read {}: {error}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|error| wrong(&error))?;
    let ring = |ring: Vec<[f64; 2]>| ring.into_iter().map(DVec2::from).collect();
    let areas = wkt::areas(&text).map_err(|mut error| {
        error.file.get_or_insert_with(|| path.display().to_string().into());
        Failure::from(error)
    })?;
    let area = |area: throng_scene::Area| Walkable {
        outer: ring(area.outer),
        holes: area.holes.into_iter().map(ring).collect(),
    };
    Ok(areas.into_iter().map(area).collect())
}

/// All moments as comma-separated values; what is not known is empty.
///
/// # Errors
/// There are no people, as in a scene.
pub fn table(path: &Path, subject: &Subject) -> Result<String, Failure> {
    let Some(people) = &subject.people else {
        let text = format!("{}: only people of a file of trajectories have a table of moments", path.display());
        return Err(Failure::hint(text, "end the name in .html for a page of plots"));
    };
    let mut out = format!("{COLUMNS}\n");
    for at in &people.figures.instants {
        let fields = columns(at).map(|value| if value.is_finite() { value.to_string() } else { String::new() });
        let _ = writeln!(out, "{}", fields.join(","));
    }
    Ok(out)
}

/// The figures of a moment, in the order of [`COLUMNS`].
fn columns(at: &Instant) -> [f64; 9] {
    [
        at.time,
        at.people as f64,
        at.speed,
        at.density,
        at.area_speed,
        at.voronoi_density,
        at.voronoi_speed,
        at.crossed as f64,
        at.lane_order,
    ]
}

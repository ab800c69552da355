//! People of a recording: their figures as text, as JSON, as a table of all moments, and as plots.

mod json;
mod moments;
mod player;
mod plots;
mod text;

use super::MeasuredSubject;
use super::args::MeasureArgs;
use crate::failure::Failure;
use crate::files::is;
use crate::out::note;
use std::path::Path;
use throng_draw::page::Player;
use throng_record::pedestrian::{self, Figures, Ground, Question};
use throng_record::{Sample, Table, Trajectories};

pub use json::{json, object};
pub use plots::KEY;

/// The people of a recording and their figures.
pub struct People {
    /// What was measured.
    question: Question,
    /// The results.
    figures: Figures,
    /// The player that shows the people, if a page is written.
    player: Option<Player>,
}

/// Checks that a scene is not measured with options that apply only to recordings.
///
/// # Errors
/// Such an option is given.
pub fn not_of_scenes(args: &MeasureArgs) -> Result<(), Failure> {
    let people = &args.people;
    if people.area.is_empty() && people.line.is_empty() && people.walkable.is_none() && people.cut_off.is_none() {
        return Ok(());
    }
    let text = format!("{}: people are measured in files of trajectories", args.of.display());
    Err(Failure::hint(text, "record it first, with `throng run SCENE -o NAME.csv`, and measure NAME.csv"))
}

/// Measures the people of a recording that `counts` selects; `None` where a sample is above the ground and no area or
/// line is given.
///
/// # Errors
/// The floor plan cannot be read, or a page would have more moments than the limit.
pub fn of(
    args: &MeasureArgs,
    tracks: &Trajectories,
    counts: impl Fn(&Sample) -> bool,
) -> Result<Option<People>, Failure> {
    let asked = &args.people;
    let flies = tracks.spots.iter().any(|spot| spot.place.z != 0.0);
    if flies && asked.area.is_empty() && asked.line.is_empty() {
        return Ok(None);
    }
    let walkable = match &asked.walkable {
        Some(path) => {
            let ground = args.changes.plan.ground(path)?;
            if !args.report.quiet {
                note(&ground.notes);
            }
            ground.areas
        }
        None => tracks.setting.walkable.clone(),
    };
    let ground = Ground::new(walkable, asked.cut_off);
    let question = Question { interval: asked.interval, areas: asked.area.clone(), lines: asked.line.clone(), ground };
    let people = pedestrian::People::of(tracks, &counts);
    let page = args.output.iter().any(|path| is(path, "html") || is(path, "htm"));
    let player = page.then(|| player::player(&args.of, tracks, &question, &counts)).transpose()?;
    Ok(Some(People { figures: Figures::of(&people, &question), question, player }))
}

/// Returns the figures of all moments as a table.
///
/// # Errors
/// There are no people, as in a scene.
pub fn table(path: &Path, subject: &MeasuredSubject) -> Result<Table, Failure> {
    let Some(People { question, figures, .. }) = &subject.people else {
        let text = format!("{}: only people of a file of trajectories have a table of moments", path.display());
        return Err(Failure::hint(text, "end the name in .html for a page of plots"));
    };
    Ok(moments::table(question, figures))
}

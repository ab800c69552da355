//! The player on a page: recordings side by side on one clock, with the plots over time.

mod place;
mod tracks;

use super::fill;
use crate::{Style, WorldBox, columns, points_to_go};
use glam::DVec2;
use place::place;
use serde_json::json;
use throng_record::{Frame, Setting};
use tracks::PlayerTracks;

const SECTION: &str = include_str!("player.html");
const SCRIPT: &str = include_str!("player.js");

/// The contents of a player besides the trajectories.
pub struct Scenery {
    /// The place and the names of the groups.
    pub setting: Setting,
    /// The part of the world to show.
    pub view: WorldBox,
    /// The box of all positions at all times.
    pub all: WorldBox,
    /// The colours of the groups.
    pub colors: Vec<String>,
    /// The length of trails, seconds.
    pub trails: f32,
    /// The point goals and their tolerances.
    pub points: Vec<(DVec2, f64)>,
    /// The corners of the areas of figures.
    pub marked: Vec<Vec<DVec2>>,
    /// The ends of the lines of figures.
    pub counted: Vec<Vec<DVec2>>,
    /// The number of people in a run.
    pub agents: usize,
    /// The word for people that frames count as arrived.
    pub gone: &'static str,
    /// The time of the first moment, seconds.
    pub start: f64,
}

impl Scenery {
    /// Returns the scenery of runs of a scene with so many agents that begin with a frame. `min` and `max` are the corners
    /// of the scene.
    pub fn of_scene(setting: Setting, style: &Style, first: &Frame, [min, max]: [DVec2; 2], agents: usize) -> Self {
        let all = WorldBox::of(&setting, first).unwrap_or(WorldBox { min, max });
        let color = |k: usize| style.groups.get(k).copied().flatten().unwrap_or_else(|| style.theme.group(k)).hex();
        Self {
            view: style.view.unwrap_or(all),
            all,
            colors: (0..setting.groups.len()).map(color).collect(),
            trails: style.trails,
            points: points_to_go(&setting, first).collect(),
            marked: vec![],
            counted: vec![],
            agents,
            gone: "arrived",
            start: first.time,
            setting,
        }
    }
}

/// A player under construction.
pub struct Player {
    scenery: Scenery,
    count: usize,
    tracks: PlayerTracks,
}

impl Player {
    /// Creates a player of `count` runs. Moments are `step` seconds apart; numbers of agents are below `numbers`.
    pub fn new(scenery: Scenery, count: usize, numbers: usize, step: f64) -> Self {
        let Scenery { view, all, .. } = &scenery;
        let held = WorldBox { min: view.min.min(all.min), max: view.max.max(all.max) };
        Self { tracks: PlayerTracks::new(count, numbers, step, held), scenery, count }
    }

    /// Adds a moment, `steps` steps after the first, of the runs that have reached it.
    pub fn push<'a>(&mut self, steps: u64, frames: impl IntoIterator<Item = (usize, &'a Frame)>) {
        self.tracks.push(steps, frames);
    }

    /// Adds the last moment of a run.
    pub fn end(&mut self, run: usize, frame: &Frame) {
        self.tracks.end(run, frame, frame.time - self.scenery.start);
    }

    /// Returns the place and the names of the groups.
    pub fn setting(&self) -> &Setting {
        &self.scenery.setting
    }

    /// Returns the colours of the groups.
    pub fn colors(&self) -> &[String] {
        &self.scenery.colors
    }

    /// Returns the panels, the controls and the note as HTML. `names` of the panels are HTML.
    pub fn section(&self, names: &[String], note: &str) -> String {
        let panel = |name: &String| {
            format!(
                "<figure class=\"panel\"><figcaption><b>{name}</b><span></span></figcaption><canvas></canvas></figure>\n"
            )
        };
        let thinned = match self.tracks.left_out() {
            text if text.is_empty() => text,
            text => format!("Thinned, to keep the page small: {text}."),
        };
        let parts = [("panels", names.iter().map(panel).collect()), ("note", note.to_owned()), ("thinned", thinned)];
        fill(SECTION, &parts)
    }

    /// Returns the script and its data; they must be the last elements of the page.
    pub fn script(&self) -> String {
        let Scenery { setting, view, colors, trails, points, marked, counted, agents, gone, start, .. } = &self.scenery;
        let size = view.max - view.min;
        let data = json!({
            "view": [view.min.x, view.min.y, view.max.x, view.max.y],
            "columns": columns(self.count, 0.9 * (size.x / size.y).clamp(0.7, 4.0), 2.0),
            "agents": agents,
            "gone": gone,
            "start": start,
            "trails": trails,
            "colors": colors,
            "groups": setting.groups,
            "place": place(setting, points, marked, counted),
            "tracks": self.tracks.json(),
        });
        // A script element ends at the first `</`.
        let data = data.to_string().replace('<', "\\u003c");
        format!("<script type=\"application/json\" id=\"data\">{data}</script>\n<script>\n{SCRIPT}\n</script>")
    }
}

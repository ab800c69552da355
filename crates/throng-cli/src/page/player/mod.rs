//! The player on a page: recordings side by side on one clock, with the plots over time.

mod place;
mod tracks;

use super::fill;
use glam::DVec2;
use place::place;
use serde_json::json;
use throng_draw::{WorldBox, columns};
use throng_record::{Frame, Setting};
use tracks::Tracks;

const SECTION: &str = include_str!("player.html");
const SCRIPT: &str = include_str!("player.js");

/// What a player shows besides people.
pub struct Scenery {
    /// The place, and the names of the groups.
    pub setting: Setting,
    /// The part of the world to show.
    pub view: WorldBox,
    /// Where everybody is at all times.
    pub all: WorldBox,
    /// Colours of the groups.
    pub colors: Vec<String>,
    /// How long trails are, seconds.
    pub trails: f32,
    /// Point goals and their tolerances.
    pub points: Vec<(DVec2, f64)>,
    /// Corners of areas, and ends of lines, that figures are of.
    pub marked: Vec<Vec<DVec2>>,
    /// The ends of lines that figures are of.
    pub counted: Vec<Vec<DVec2>>,
    /// How many people there are in a run.
    pub agents: usize,
    /// What has become of those that frames count as arrived, in a word.
    pub gone: &'static str,
    /// Time of the first moment, seconds.
    pub start: f64,
}

/// A player being made.
pub struct Player {
    scenery: Scenery,
    count: usize,
    tracks: Tracks,
}

impl Player {
    /// Of so many runs, whose moments are `step` seconds apart and whose agents have numbers below `numbers`.
    pub fn new(scenery: Scenery, count: usize, numbers: usize, step: f64) -> Self {
        let Scenery { view, all, .. } = &scenery;
        let held = WorldBox { min: view.min.min(all.min), max: view.max.max(all.max) };
        Self { tracks: Tracks::new(count, numbers, step, held), scenery, count }
    }

    /// Takes in a moment, so many steps after the first, of those runs that have come so far.
    pub fn push<'a>(&mut self, steps: u64, frames: impl IntoIterator<Item = (usize, &'a Frame)>) {
        self.tracks.push(steps, frames);
    }

    /// Takes in the last moment of a run.
    pub fn end(&mut self, run: usize, frame: &Frame) {
        self.tracks.end(run, frame, frame.time - self.scenery.start);
    }

    /// The place and the names of the groups.
    pub fn setting(&self) -> &Setting {
        &self.scenery.setting
    }

    /// Colours of the groups.
    pub fn colors(&self) -> &[String] {
        &self.scenery.colors
    }

    /// The panels, whose names are HTML, the controls, and what is said of them.
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

    /// What makes it play; the last thing on the page.
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
        // a script ends at the first `</`
        let data = data.to_string().replace('<', "\\u003c");
        format!("<script type=\"application/json\" id=\"data\">{data}</script>\n<script>\n{SCRIPT}\n</script>")
    }
}

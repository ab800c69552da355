//! The page: one file without network, with the table, figures over time, a player and the wildest moments.

mod charts;
mod moments;
mod place;
mod tracks;

use super::figures::{FIGURES, Results};
use super::race::{Plan, Run};
use super::table::{Row, caption, rows};
use crate::failure::Failure;
use crate::options::FilmArgs;
use crate::page::{STYLE, escape, fill, swatch};
use glam::DVec2;
use place::place;
use serde_json::{Value, json};
use throng_draw::{Style, WorldBox, columns, palette, points_to_go};
use throng_record::series::Series;
use throng_record::{Frame, Setting, moment};
use tracks::Tracks;

const PAGE: &str = include_str!("page.html");
const SCRIPT: &str = include_str!("page.js");

/// A page being made.
pub struct Page {
    setting: Setting,
    /// Point goals and their tolerances.
    points: Vec<(DVec2, f64)>,
    colors: Vec<String>,
    trails: f32,
    view: WorldBox,
    /// How many models, and how many agents in all.
    count: usize,
    agents: usize,
    tracks: Tracks,
}

impl Page {
    /// A page about these runs.
    ///
    /// # Errors
    /// The camera sees nothing.
    pub fn new(args: &FilmArgs, plan: &Plan, runs: &[Run]) -> Result<Self, Failure> {
        let Style { view, trails, groups, .. } = args.look.style(&plan.loaded.scene, runs[0].built.bounds)?;
        let setting = moment::setting(&runs[0].world, &runs[0].built, plan.loaded.title());
        let [min, max] = runs[0].built.bounds;
        let all = WorldBox::of(&setting, &runs[0].frame).unwrap_or(WorldBox { min, max });
        let color = |k: usize| groups.get(k).copied().flatten().unwrap_or_else(|| palette(k)).hex();
        let colors = (0..setting.groups.len()).map(color).collect();
        let view = view.unwrap_or(all);
        let held = WorldBox { min: view.min.min(all.min), max: view.max.max(all.max) };
        let (count, agents) = (runs.len(), runs[0].built.agents);
        let points = points_to_go(&setting, &runs[0].frame).collect();
        Ok(Self { setting, points, colors, trails, view, count, agents, tracks: Tracks::new(runs, held) })
    }

    /// Takes in the runs that have moved on.
    pub fn push(&mut self, runs: &[Run]) {
        self.tracks.push(runs);
    }

    /// Takes in the last moment of all runs.
    pub fn end(&mut self, runs: &[Run]) {
        self.tracks.end(runs);
    }

    /// The page.
    pub fn text(self, plan: &Plan, results: &Results, all: bool) -> String {
        let series: Vec<&Series> =
            results.models.iter().filter_map(|(_, runs)| runs.first()).map(|run| &run.series).collect();
        let scene = &plan.loaded.scene;
        let left_out = match self.tracks.left_out() {
            text if text.is_empty() => text,
            text => format!("Thinned, to keep the page small: {text}."),
        };
        let parts = [
            ("title", escape(plan.loaded.title())),
            ("description", scene.description.lines().map(escape).collect::<Vec<_>>().join("<br>")),
            ("facts", self.facts(plan)),
            ("table", table(results, all)),
            ("caption", notes(plan, results)),
            ("seed", format!("Seed {}", plan.seeds[0])),
            ("panels", panels(results)),
            ("thinned", left_out),
            ("legend", legend(results)),
            ("plots", charts::plots(&series, self.agents)),
            ("moments", self.moments(results, &series)),
            ("style", STYLE.to_owned()),
            // a script ends at the first `</`
            ("data", self.data().to_string().replace('<', "\\u003c")),
            ("script", SCRIPT.to_owned()),
        ];
        fill(PAGE, &parts)
    }

    fn facts(&self, plan: &Plan) -> String {
        let seeds: Vec<String> = plan.seeds.iter().map(u64::to_string).collect();
        let facts = [
            ("scene", plan.loaded.name.clone()),
            ("agents", self.agents.to_string()),
            ("seeds", seeds.join(", ")),
            ("step", format!("{} s", plan.loaded.scene.time.step)),
            ("made by", format!("throng {}", env!("CARGO_PKG_VERSION"))),
        ];
        facts.iter().map(|(name, value)| format!("<div><dt>{name}</dt><dd>{}</dd></div>\n", escape(value))).collect()
    }

    fn moments(&self, results: &Results, series: &[&Series]) -> String {
        let row = |((label, _), series): (&(String, _), &&Series)| match series.peak() {
            Some(frames) => format!(
                "<article><h3>{}</h3><p>{}</p><div class=\"three\">{}</div></article>\n",
                escape(label),
                swing_of(frames, series),
                moments::pictures(frames, &self.setting, &self.colors)
            ),
            None => format!("<article><h3>{}</h3><p>no velocity ever swung</p></article>\n", escape(label)),
        };
        results.models.iter().zip(series).map(row).collect()
    }

    /// What the script draws.
    fn data(&self) -> Value {
        let (setting, size) = (&self.setting, self.view.max - self.view.min);
        json!({
            "view": [self.view.min.x, self.view.min.y, self.view.max.x, self.view.max.y],
            "columns": columns(self.count, 0.9 * (size.x / size.y).clamp(0.7, 4.0), 2.0),
            "agents": self.agents,
            "trails": self.trails,
            "colors": self.colors,
            "groups": setting.groups,
            "place": place(setting, &self.points),
            "tracks": self.tracks.json(),
        })
    }
}

/// How much velocities swung at these moments.
fn swing_of(frames: &[Frame; 3], series: &Series) -> String {
    let point = series.points().iter().find(|point| point.time == frames[2].time);
    let swing = point.map_or(0.0, |point| point.swing);
    format!(
        "{:.2} to {:.2} s: velocities go {swing:.2} m/s there and back, mean of all on their way",
        frames[0].time, frames[2].time
    )
}

/// What is in the table, in words.
fn notes(plan: &Plan, results: &Results) -> String {
    let small = if plan.seeds.len() > 1 { " Small: from the least to the greatest." } else { "" };
    let ended = if results.interrupted { " Interrupted: figures are those up to there." } else { "" };
    format!("{}.{small}{ended}", escape(&caption(plan, results)))
}

fn table(results: &Results, all: bool) -> String {
    let head = FIGURES.iter().map(|figure| format!("<th title=\"{}\">{}</th>", escape(figure.meaning), figure.head));
    let mut out = format!("<thead><tr><th>model</th>{}</tr></thead>\n<tbody>\n", head.collect::<String>());
    for Row { name, cells, single } in rows(results, all) {
        let class = if single { " class=\"single\"" } else { "" };
        out.push_str(&format!("<tr{class}><th>{}</th>", escape(&name)));
        for cell in cells {
            let range = cell.range.map(|range| format!("<small>{range}</small>")).unwrap_or_default();
            out.push_str(&format!("<td>{}{range}</td>", cell.value));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody>");
    out
}

fn panels(results: &Results) -> String {
    let panel = |(k, (label, _)): (usize, &(String, _))| {
        let name = format!("<b>{}{}</b>", swatch(k), escape(label));
        format!("<figure class=\"panel\"><figcaption>{name}<span></span></figcaption><canvas></canvas></figure>\n")
    };
    results.models.iter().enumerate().map(panel).collect()
}

fn legend(results: &Results) -> String {
    let entry = |(k, (label, _)): (usize, &(String, _))| format!("<span>{}{}</span>\n", swatch(k), escape(label));
    results.models.iter().enumerate().map(entry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_names_every_part_once() {
        let names = ["title", "description", "facts", "table", "plots", "moments", "style", "data", "script", "panels"];
        for name in names {
            let times = PAGE.matches(&format!("{{{{{name}}}}}")).count();
            assert_eq!(times, if name == "title" { 2 } else { 1 }, "{name}");
        }
    }
}

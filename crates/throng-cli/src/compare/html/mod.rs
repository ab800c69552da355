//! The page: one file without network, with the table, figures over time, a player and the wildest moments.

mod moments;
mod plot;
mod tracks;

use super::figures::{FIGURES, Results};
use super::race::{Plan, Run};
use super::table::{Row, caption, rows};
use crate::failure::Failure;
use crate::moment;
use crate::options::FilmArgs;
use plot::Plot;
use serde_json::{Value, json};
use throng::{Goal, Obstacle};
use throng_draw::{Style, WorldBox, columns, palette};
use throng_record::series::{Point, Series};
use throng_record::{Frame, Setting};
use tracks::Tracks;

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Points of a line of a plot, at most.
const POINTS: usize = 400;
/// Separations above this are not told apart: what is of interest is near 1.
const FAR: f64 = 3.0;

/// A page being made.
pub struct Page {
    setting: Setting,
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
        let setting = moment::setting(&runs[0].world, plan.loaded.title());
        let [min, max] = runs[0].built.bounds;
        let all = WorldBox::of(&setting, &runs[0].frame).unwrap_or(WorldBox { min, max });
        let color = |k: usize| groups.get(k).copied().flatten().unwrap_or_else(|| palette(k)).hex();
        let colors = (0..setting.groups.len()).map(color).collect();
        let view = view.unwrap_or(all);
        let held = WorldBox { min: view.min.min(all.min), max: view.max.max(all.max) };
        let (count, agents) = (runs.len(), runs[0].built.agents);
        Ok(Self { setting, colors, trails, view, count, agents, tracks: Tracks::new(runs, held) })
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
            ("plots", plots(&series)),
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
        let setting = &self.setting;
        let pair = |p: &glam::DVec2| json!([short(p.x), short(p.y)]);
        let ring = |points: &[glam::DVec2]| Value::from_iter(points.iter().map(pair));
        let areas = setting
            .walkable
            .iter()
            .map(|area| Value::from_iter(std::iter::once(&area.outer).chain(&area.holes).map(|points| ring(points))));
        let mut place = json!({ "walkable": Value::from_iter(areas), "circles": [], "polygons": [], "walls": [],
            "points": [], "areas": [], "exits": [] });
        let mut add = |kind: &str, value: Value| place[kind].as_array_mut().map(|list| list.push(value));
        for obstacle in &setting.obstacles {
            let _ = match obstacle {
                Obstacle::Circle { center, radius } => add("circles", json!([center.x, center.y, radius])),
                Obstacle::Polygon { corners } => add("polygons", ring(corners)),
                Obstacle::Wall { points } => add("walls", ring(points)),
            };
        }
        for goal in &setting.goals {
            let _ = match goal {
                Goal::Point { at, tolerance } => add("points", json!([short(at.x), short(at.y), tolerance])),
                Goal::Area { corners } => add("areas", ring(corners)),
                Goal::Exit { corners } => add("exits", ring(corners)),
            };
        }
        let size = self.view.max - self.view.min;
        json!({
            "view": [self.view.min.x, self.view.min.y, self.view.max.x, self.view.max.y],
            "columns": columns(self.count, (size.x / size.y).clamp(0.5, 4.0), 2.0),
            "agents": self.agents,
            "trails": self.trails,
            "colors": self.colors,
            "groups": setting.groups,
            "place": place,
            "tracks": self.tracks.json(),
        })
    }
}

/// Millimetres are enough for a picture.
fn short(metres: f64) -> f64 {
    (metres * 1e3).round() / 1e3
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
    let panel = |(label, _): &(String, _)| {
        format!(
            "<figure class=\"panel\"><figcaption><b>{}</b><span></span></figcaption><canvas></canvas></figure>\n",
            escape(label)
        )
    };
    results.models.iter().map(panel).collect()
}

fn legend(results: &Results) -> String {
    let entry = |(k, (label, _)): (usize, &(String, _))| {
        let line = format!("<svg viewBox=\"0 0 26 8\"><path class=\"line m{}\" d=\"M1 4H25\"/></svg>", k % 8);
        format!("<span>{line}{}</span>\n", escape(label))
    };
    results.models.iter().enumerate().map(entry).collect()
}

fn plots(series: &[&Series]) -> String {
    let points: Vec<Vec<Point>> = series.iter().map(|series| series.thinned(POINTS)).collect();
    let end = points.iter().filter_map(|points| points.last()).map(|point| point.time).fold(0.0, f64::max);
    let lines = |figure: fn(&Point) -> f64| -> Vec<Vec<(f64, f64)>> {
        points.iter().map(|points| points.iter().map(|point| (point.time, figure(point))).collect()).collect()
    };
    let plot = |title, unit, figure: fn(&Point) -> f64| Plot {
        title,
        unit,
        lines: lines(figure),
        most: f64::INFINITY,
        mark: None,
        end,
    };
    let apart = plot("Least separation", "distance of centres over the sum of radii", |point| point.separation);
    let plots = [
        plot("Arrived", "agents", |point| point.arrived as f64),
        Plot { most: FAR, mark: Some((1.0, "1: two touch")), ..apart },
        plot("Mean speed", "m/s, of those on their way", |point| point.speed),
        plot("Mean turning of headings", "°/s, of those on their way", |point| point.turning),
        plot("Mean swing of velocities", "m/s there and back in two steps", |point| point.swing),
    ];
    plots.iter().map(Plot::svg).collect()
}

/// A template with its `{{names}}` replaced; what is put in is not looked at again.
fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut out = String::with_capacity(template.len() + parts.iter().map(|part| part.1.len()).sum::<usize>());
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        out.push_str(before);
        out.push_str(parts.iter().find(|part| part.0 == name).map_or("", |part| &part.1));
        rest = after;
    }
    out.push_str(rest);
    out
}

/// Text as it may stand in HTML, between tags and in attributes.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_put_in_is_not_looked_at_again() {
        let parts = [("a", "{{b}}".to_owned()), ("b", "B".to_owned())];
        assert_eq!(fill("x{{a}}y{{b}}{{c}}z", &parts), "x{{b}}yBz");
        assert_eq!(fill("x{{", &parts), "x");
    }

    #[test]
    fn the_template_names_every_part_once() {
        let names = ["title", "description", "facts", "table", "plots", "moments", "style", "data", "script", "panels"];
        for name in names {
            let times = PAGE.matches(&format!("{{{{{name}}}}}")).count();
            assert_eq!(times, if name == "title" { 2 } else { 1 }, "{name}");
        }
    }
}

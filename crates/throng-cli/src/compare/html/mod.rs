//! The HTML page: one self-contained file with the table, figures over time, a player, and the moments of the largest
//! swings.

mod charts;
mod moments;

use super::figures::{CompareResults, FIGURES};
use super::race::{ComparePlan, ModelRun};
use super::table::{ComparisonRow, caption, rows};
use crate::failure::Failure;
use crate::options::FilmArgs;
use throng_draw::page::{Player, Scenery, document, escape, fill, swatch};
use throng_record::Frame;
use throng_record::series::Series;

const PAGE: &str = include_str!("page.html");

/// A page under construction.
pub struct ComparePage {
    player: Player,
    agents: usize,
}

impl ComparePage {
    /// Begins a page about these runs.
    ///
    /// # Errors
    /// The camera's view is empty.
    pub fn new(args: &FilmArgs, plan: &ComparePlan, runs: &[ModelRun]) -> Result<Self, Failure> {
        let style = args.look.style(&plan.loaded.scene, runs[0].built.bounds)?;
        let setting = plan.loaded.setting(&runs[0].world, &runs[0].built)?;
        let agents = runs[0].built.agents;
        // Scripted bodies have numbers too, beyond those of the agents.
        let present = runs.iter().flat_map(|run| &run.frame.bodies).map(|body| body.number as usize + 1);
        let numbers = present.chain([agents]).max().unwrap_or(0);
        let scenery = Scenery::of_scene(setting, &style, &runs[0].frame, runs[0].built.bounds, agents);
        Ok(Self { player: Player::new(scenery, runs.len(), numbers, runs[0].world.settings().step), agents })
    }

    /// Adds the current moment of the runs that made the latest step.
    pub fn push(&mut self, runs: &[ModelRun]) {
        let now = runs.iter().map(|run| run.world.steps()).max().unwrap_or(0);
        let moved = runs.iter().enumerate().filter(|(_, run)| run.world.steps() == now);
        self.player.push(now, moved.map(|(k, run)| (k, &*run.frame)));
    }

    /// Adds the last moment of all runs.
    pub fn end(&mut self, runs: &[ModelRun]) {
        runs.iter().enumerate().for_each(|(k, run)| self.player.end(k, &run.frame));
    }

    /// Returns the text of the page.
    pub fn text(self, plan: &ComparePlan, results: &CompareResults, all: bool) -> String {
        let series: Vec<&Series> =
            results.models.iter().filter_map(|(_, runs)| runs.first()).map(|run| &run.series).collect();
        let scene = &plan.loaded.scene;
        let seed = format!("Seed {}", plan.seeds[0]);
        let names: Vec<String> =
            results.models.iter().enumerate().map(|(k, (label, _))| swatch(k) + &escape(label)).collect();
        let note = format!("{seed}. A run that has ended keeps its last moment.");
        let parts = [
            ("title", escape(plan.loaded.title())),
            ("description", scene.about.see.as_deref().map_or_else(String::new, escape)),
            ("facts", self.facts(plan)),
            ("table", table(results, all)),
            ("caption", notes(plan, results)),
            ("seed", seed),
            ("player", self.player.section(&names, &note)),
            ("legend", legend(results)),
            ("plots", charts::plots(&series, self.agents)),
            ("moments", self.moments(results, &series)),
        ];
        let title = format!("{}: models compared", escape(plan.loaded.title()));
        document(&title, &fill(PAGE, &parts), &self.player.script())
    }

    fn facts(&self, plan: &ComparePlan) -> String {
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

    fn moments(&self, results: &CompareResults, series: &[&Series]) -> String {
        let row = |((label, _), series): (&(String, _), &&Series)| match series.peak() {
            Some(frames) => format!(
                "<article><h3>{}</h3><p>{}</p><div class=\"three\">{}</div></article>\n",
                escape(label),
                swing_of(frames, series),
                moments::pictures(frames, self.player.setting(), self.player.colors())
            ),
            None => format!("<article><h3>{}</h3><p>no velocity swings</p></article>\n", escape(label)),
        };
        results.models.iter().zip(series).map(row).collect()
    }
}

/// Describes how far velocities swing at these moments.
fn swing_of(frames: &[Frame; 3], series: &Series) -> String {
    let point = series.points().iter().find(|point| point.time == frames[2].time);
    let swing = point.map_or(0.0, |point| point.swing);
    format!(
        "{:.2} to {:.2} s: velocities swing by {swing:.2} m/s and back, mean of all walking agents",
        frames[0].time, frames[2].time
    )
}

/// Returns the caption of the table.
fn notes(plan: &ComparePlan, results: &CompareResults) -> String {
    let small = if plan.seeds.len() > 1 { " Small: from the least to the greatest." } else { "" };
    let ended = if results.interrupted { " Interrupted: figures cover the time until then." } else { "" };
    format!("{}.{small}{ended}", escape(&caption(plan, results)))
}

fn table(results: &CompareResults, all: bool) -> String {
    let head = FIGURES.iter().map(|figure| format!("<th title=\"{}\">{}</th>", escape(figure.meaning), figure.head));
    let mut out = format!("<thead><tr><th>model</th>{}</tr></thead>\n<tbody>\n", head.collect::<String>());
    for ComparisonRow { name, cells, single } in rows(results, all) {
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

fn legend(results: &CompareResults) -> String {
    let entry = |(k, (label, _)): (usize, &(String, _))| format!("<span>{}{}</span>\n", swatch(k), escape(label));
    results.models.iter().enumerate().map(entry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_names_every_part_once() {
        for name in ["title", "description", "facts", "table", "plots", "moments", "player"] {
            assert_eq!(PAGE.matches(&format!("{{{{{name}}}}}")).count(), 1, "{name}");
        }
    }
}

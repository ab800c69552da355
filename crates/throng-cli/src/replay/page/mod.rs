//! The page of a replay: the tables, a player of the recording and every model on one clock, and plots.

mod plots;

use super::report::ReplayReport;
use super::setup::Setup;
use super::tables::tables;
use super::text::facts;
use crate::files::title;
use std::sync::Arc;
use throng_draw::page::{Player, Plot, Scenery, document, escape, fill, swatch, table};
use throng_draw::{Style, WorldBox, palette};
use throng_record::Frame;

const PAGE: &str = include_str!("page.html");

/// A page under construction.
pub struct ReplayPage {
    player: Player,
    /// A moment in which people are numbered by their walks.
    frame: Frame,
}

impl ReplayPage {
    /// Begins a page. Its player shows the same view as pictures of this style.
    pub fn new(setup: &Setup, style: &Style) -> Self {
        let unit = WorldBox { min: glam::DVec2::ZERO, max: glam::DVec2::ONE };
        let view = style.view.unwrap_or(unit);
        let (walks, [start, _]) = (setup.cast.people.walks.len(), setup.span());
        let setting = setup.setting("");
        let scenery = Scenery {
            view,
            all: view,
            colors: (0..setting.groups.len().max(1)).map(|group| palette(group).hex()).collect(),
            trails: style.trails,
            points: Vec::new(),
            marked: Vec::new(),
            counted: setup.args.figures.line.iter().map(|line| vec![line.from, line.to]).collect(),
            agents: walks,
            gone: "gone",
            start,
            setting,
        };
        let step = setup.stages[0].settings.step;
        Self { player: Player::new(scenery, setup.models.len() + 1, walks, step), frame: Frame::default() }
    }

    /// Adds a moment of the recording and of every model, `steps` steps after the first.
    pub fn push(&mut self, setup: &Setup, steps: u64, frames: &[Arc<Frame>]) {
        for (run, frame) in frames.iter().enumerate() {
            self.take(setup, frame);
            self.player.push(steps, [(run, &self.frame)]);
        }
    }

    /// Adds the last moment.
    pub fn end(&mut self, setup: &Setup, frames: &[Arc<Frame>]) {
        for (run, frame) in frames.iter().enumerate() {
            self.take(setup, frame);
            self.player.end(run, &self.frame);
        }
    }

    /// Renumbers people by their walks: the player stores a row for every number up to the largest.
    fn take(&mut self, setup: &Setup, frame: &Frame) {
        self.frame.clone_from(frame);
        for body in &mut self.frame.bodies {
            body.number = setup.cast.walk_of(body.number).unwrap_or_default() as u32;
        }
    }

    /// Returns the text of the page.
    pub fn text(self, report: &ReplayReport) -> String {
        let setup = report.setup;
        let name = title(&setup.args.data);
        let names = std::iter::once("recorded").chain(setup.models.iter().map(String::as_str));
        let names: Vec<String> = names.enumerate().map(|(k, name)| swatch(k) + &escape(name)).collect();
        let grids = tables(report);
        let grids =
            grids.iter().map(|grid| format!("<h3>{}</h3>\n{}", escape(&grid.title), table(&grid.head, &grid.rows)));
        let key = std::iter::once("recorded").chain(report.predictors().into_iter().map(|predictor| predictor.name));
        let key = key.enumerate().map(|(k, name)| format!("<span>{}{}</span>\n", swatch(k), escape(name)));
        let ended = if report.interrupted { " Interrupted: figures cover the time until then." } else { "" };
        let parts = [
            ("name", escape(&name)),
            ("facts", escape(&(facts(report).join("; ") + "."))),
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("ended", ended.to_owned()),
            ("player", self.player.section(&names, "The number of people that have left is shown above each panel.")),
            ("key", key.collect()),
            ("plots", plots::plots(report).iter().map(Plot::svg).collect()),
            ("tables", grids.collect()),
        ];
        document(&format!("{}: replayed", escape(&name)), &fill(PAGE, &parts), &self.player.script())
    }
}

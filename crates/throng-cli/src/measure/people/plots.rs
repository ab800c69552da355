//! The section of the page about people.

use super::People;
use super::moments::numbered;
use crate::measure::page::escape_lines;
use throng_draw::page::{Height, Player, Plot, TIME, escape, swatch};
use throng_record::pedestrian::{Inside, Instant, count};

/// The maximum number of points of a line over time.
const POINTS: usize = 400;
/// The width of the bins of densities, 1/m².
const BIN: f64 = 0.25;
/// The highest density of the diagram, 1/m².
const DENSEST: f64 = 6.0;

/// The meanings of the lines in plots.
pub const KEY: [(usize, &str); 3] = [(0, "measured; classic"), (1, "by Voronoi cells"), (5, "Weidmann 1993")];

impl People {
    /// Returns the section as HTML.
    pub fn section(&self, name: &str) -> String {
        let figures = escape_lines(&self.text(name));
        let plots: String = self.plots().iter().map(Plot::svg).collect();
        let legend: String = KEY.map(|(k, name)| format!("<span>{}{name}</span>\n", swatch(k))).concat();
        let player = self.player.as_ref().map_or_else(String::new, |player| player.section(&[escape(name)], ""));
        format!(
            "<section>\n<h2>People</h2>\n<pre>{figures}</pre>\n{player}<p class=\"legend\">\n{legend}</p>\n<div class=\"plots\">\n{plots}</div>\n\
             <p class=\"note\">Speed at a density is the mean of all moments with a density within {BIN} /m². A click on a plot over time sets the clock of the player.</p>\n</section>\n"
        )
    }

    /// Returns the script of the player; empty without a player.
    pub fn script(&self) -> String {
        self.player.as_ref().map_or_else(String::new, Player::script)
    }

    /// Returns all plots.
    pub fn plots(&self) -> Vec<Plot<'static>> {
        let Self { question, figures, .. } = self;
        let whole = |figure: fn(&Instant) -> f64| figures.instants.iter().map(figure).collect();
        let mut out = vec![
            self.over_time("People".into(), "present", [whole(|at| at.people as f64)]),
            self.over_time("Mean speed".into(), "m/s", [whole(|at| at.speed)]),
        ];
        for (k, inside) in figures.areas.iter().enumerate() {
            let area = numbered("area", " ", k, question.areas.len());
            let of = |figure: fn(&Inside) -> f64| inside.iter().map(figure).collect::<Vec<f64>>();
            let densities = [of(|at| at.density), of(|at| at.voronoi_density)];
            out.push(self.over_time(format!("Density of {area}"), "1/m²", densities));
            let speeds = [of(|at| at.speed), of(|at| at.voronoi_speed)];
            out.push(self.over_time(format!("Speed in {area}"), "m/s", speeds));
            out.push(diagram(format!("Fundamental diagram of {area}"), inside));
        }
        for (k, crossings) in figures.crossings.iter().enumerate() {
            let line = numbered("line", " ", k, question.lines.len());
            let crossed = figures.instants.iter().map(|at| count(crossings, at.time) as f64).collect();
            out.push(self.over_time(format!("N(t): people that have crossed {line}"), "", [crossed]));
        }
        if figures.directions.iter().all(|&count| count > 0) {
            out.push(self.over_time("Lane order".into(), "", [whole(|at| at.lane_order)]));
        }
        out
    }

    /// Returns a plot of figures of all moments.
    fn over_time<const N: usize>(&self, title: String, unit: &'static str, figures: [Vec<f64>; N]) -> Plot<'static> {
        let instants = &self.figures.instants;
        let thin = instants.len().div_ceil(POINTS).max(1);
        let span = [instants.first(), instants.last()].map(|at| at.map_or(0.0, |at| at.time));
        let line = |figure: Vec<f64>| instants.iter().map(|at| at.time).zip(figure).step_by(thin).collect();
        let lines = figures.map(line).to_vec();
        let height = Height::FromZero([1e-3, f64::INFINITY]);
        Plot { title: title.into(), unit, lines, height, mark: None, axis: TIME, span }
    }
}

/// Returns the fundamental diagram of an area beside that of Weidmann (1993).
fn diagram(title: String, inside: &[Inside]) -> Plot<'static> {
    let mut bins: Vec<(f64, u32)> = Vec::new();
    let all = Inside::fundamental_diagram(inside);
    for [density, speed] in all.into_iter().filter(|[density, _]| *density < DENSEST) {
        let bin = (density / BIN) as usize;
        if bin >= bins.len() {
            bins.resize(bin + 1, (0.0, 0));
        }
        bins[bin].0 += speed;
        bins[bin].1 += 1;
    }
    let found = bins.iter().enumerate().map(|(bin, (sum, count))| ((bin as f64 + 0.5) * BIN, sum / f64::from(*count)));
    let weidmann = |density: f64| (1.34 * (1.0 - (-1.913 * (1.0 / density - 1.0 / 5.4)).exp())).max(0.0);
    let known = (1..=54).map(|k| f64::from(k) * 0.1).map(|density| (density, weidmann(density)));
    Plot {
        title: title.into(),
        unit: "speed, m/s",
        lines: vec![vec![], found.collect(), vec![], vec![], vec![], known.collect()],
        height: Height::FromZero([1.5, f64::INFINITY]),
        mark: None,
        axis: "density, 1/m²",
        span: [0.0, DENSEST],
    }
}

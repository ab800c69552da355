//! The section about people on the page.

use super::People;
use crate::measure::page::escape_lines;
use crate::page::{Height, Plot, swatch};
use throng_record::pedestrian::Instant;

/// Points of a line over time, at most.
const POINTS: usize = 400;
/// Width of the bins of densities, 1/m².
const BIN: f64 = 0.25;
/// The highest density of the diagram, 1/m².
const DENSEST: f64 = 6.0;

impl People {
    /// The section.
    pub fn section(&self, name: &str) -> String {
        let figures = escape_lines(&self.text(name));
        let plots: String = self.plots().iter().map(Plot::svg).collect();
        let names = [(0, "measured; classic"), (1, "by Voronoi cells"), (5, "Weidmann 1993")];
        let legend: String = names.map(|(k, name)| format!("<span>{}{name}</span>\n", swatch(k))).concat();
        format!(
            "<section>\n<h2>People</h2>\n<pre>{figures}</pre>\n<p class=\"legend\">\n{legend}</p>\n<div class=\"plots\">\n{plots}</div>\n\
             <p class=\"note\">Speed at a density is the mean of all moments whose density is within {BIN} /m².</p>\n</section>\n"
        )
    }

    fn plots(&self) -> Vec<Plot<'static>> {
        let instants = &self.figures.instants;
        let thin = instants.len().div_ceil(POINTS).max(1);
        let span = [instants.first(), instants.last()].map(|at| at.map_or(0.0, |at| at.time));
        let over_time = |title, unit, figures: &[fn(&Instant) -> f64]| {
            let line =
                |figure: &fn(&Instant) -> f64| instants.iter().step_by(thin).map(|at| (at.time, figure(at))).collect();
            let height = Height::FromZero([1e-3, f64::INFINITY]);
            Plot { title, unit, lines: figures.iter().map(line).collect(), height, mark: None, axis: "time, s", span }
        };
        let mut out = vec![
            over_time("People", "who are there", &[|at| at.people as f64]),
            over_time("Mean speed", "m/s", &[|at| at.speed]),
        ];
        if self.question.area.is_some() {
            out.push(over_time("Density of the area", "1/m²", &[|at| at.density, |at| at.voronoi_density]));
            out.push(over_time("Speed in the area", "m/s", &[|at| at.area_speed, |at| at.voronoi_speed]));
            out.push(self.diagram());
        }
        if self.question.line.is_some() {
            out.push(over_time("N(t): how many have crossed the line", "", &[|at| at.crossed as f64]));
        }
        if self.figures.directions.iter().all(|&count| count > 0) {
            out.push(over_time("Lane order", "", &[|at| at.lane_order]));
        }
        out
    }

    /// The fundamental diagram, beside Weidmann's.
    fn diagram(&self) -> Plot<'static> {
        let mut bins: Vec<(f64, u32)> = Vec::new();
        let all = self.figures.fundamental_diagram();
        for [density, speed] in all.into_iter().filter(|[density, _]| *density < DENSEST) {
            let bin = (density / BIN) as usize;
            if bin >= bins.len() {
                bins.resize(bin + 1, (0.0, 0));
            }
            bins[bin].0 += speed;
            bins[bin].1 += 1;
        }
        let found =
            bins.iter().enumerate().map(|(bin, (sum, count))| ((bin as f64 + 0.5) * BIN, sum / f64::from(*count)));
        let weidmann = |density: f64| (1.34 * (1.0 - (-1.913 * (1.0 / density - 1.0 / 5.4)).exp())).max(0.0);
        let known = (1..=54).map(|k| f64::from(k) * 0.1).map(|density| (density, weidmann(density)));
        Plot {
            title: "Fundamental diagram",
            unit: "speed, m/s",
            lines: vec![vec![], found.collect(), vec![], vec![], vec![], known.collect()],
            height: Height::FromZero([1.5, f64::INFINITY]),
            mark: None,
            axis: "density, 1/m²",
            span: [0.0, DENSEST],
        }
    }
}

//! The plots of figures over time on the page.

use std::borrow::Cow;
use throng_draw::page::{Height, Plot, TIME};
use throng_record::series::{Series, SeriesPoint};

/// The maximum number of points of a line of a plot.
const POINTS: usize = 400;
/// Separations above this value are cut off: only values near 1 matter.
const FAR: f64 = 3.0;

/// Returns all plots as HTML, with one line per model. `agents` is the number of agents that can arrive.
pub fn plots(series: &[&Series], agents: usize) -> String {
    let points: Vec<Vec<SeriesPoint>> = series.iter().map(|series| series.thinned(POINTS)).collect();
    let end = points.iter().filter_map(|points| points.last()).map(|point| point.time).fold(0.0, f64::max);
    let lines = |figure: fn(&SeriesPoint) -> f64| -> Vec<Vec<(f64, f64)>> {
        points.iter().map(|points| points.iter().map(|point| (point.time, figure(point))).collect()).collect()
    };
    let plot = |title, unit, top: [f64; 2], figure: fn(&SeriesPoint) -> f64| {
        let mark = (top[1] == FAR).then_some((1.0, "1: two touch"));
        Plot {
            title: Cow::Borrowed(title),
            unit,
            lines: lines(figure),
            height: Height::FromZero(top),
            mark,
            axis: TIME,
            span: [0.0, end],
        }
    };
    let any = f64::INFINITY;
    let plots = [
        plot("Arrived", "agents", [agents as f64, any], |point| point.arrived as f64),
        plot("Least separation", "distance of centres over the sum of radii", [1.2, FAR], |point| point.separation),
        plot("Mean speed", "m/s, of walking agents", [0.1, any], |point| point.speed),
        plot("Mean turning of headings", "°/s, of walking agents", [10.0, any], |point| point.turning),
        plot("Mean swing of velocities", "m/s there and back in two steps", [0.1, any], |point| point.swing),
    ];
    plots.iter().map(Plot::svg).collect()
}

//! The figures over time that the page shows.

use crate::page::{Height, Plot, TIME};
use std::borrow::Cow;
use throng_record::series::{Point, Series};

/// Points of a line of a plot, at most.
const POINTS: usize = 400;
/// Separations above this are not told apart: what is of interest is near 1.
const FAR: f64 = 3.0;

/// All plots, as HTML; a line a model. `agents` is how many can arrive.
pub fn plots(series: &[&Series], agents: usize) -> String {
    let points: Vec<Vec<Point>> = series.iter().map(|series| series.thinned(POINTS)).collect();
    let end = points.iter().filter_map(|points| points.last()).map(|point| point.time).fold(0.0, f64::max);
    let lines = |figure: fn(&Point) -> f64| -> Vec<Vec<(f64, f64)>> {
        points.iter().map(|points| points.iter().map(|point| (point.time, figure(point))).collect()).collect()
    };
    let plot = |title, unit, top: [f64; 2], figure: fn(&Point) -> f64| {
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
        plot("Mean speed", "m/s, of those on their way", [0.1, any], |point| point.speed),
        plot("Mean turning of headings", "°/s, of those on their way", [10.0, any], |point| point.turning),
        plot("Mean swing of velocities", "m/s there and back in two steps", [0.1, any], |point| point.swing),
    ];
    plots.iter().map(Plot::svg).collect()
}

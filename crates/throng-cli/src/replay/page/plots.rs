//! The plots of a replay: a line for the recording, for each model, and for the two predictors without interaction.

use crate::replay::report::{ModelResults, ReplayReport, mean_and_median};
use throng_draw::page::{Height, Plot, TIME};
use throng_record::pedestrian::replay::{Pair, PredictionSample, from_entry};
use throng_record::pedestrian::{Figures, Instant, count};

/// The maximum number of points of a line.
const POINTS: usize = 400;
/// The number of points of the displacement since entry.
const SINCE: u32 = 40;
/// Times at which fewer people than this share were recorded are not plotted.
const FEW: f64 = 0.1;
/// The share of values up to which distributions are plotted.
const MOST: f64 = 0.98;

/// Displacements above this multiple of the models' largest are cut off.
const BEYOND: f64 = 2.5;
/// The least height of plots of displacement, metres.
const LEAST: f64 = 0.1;

type Line = Vec<(f64, f64)>;

/// Returns all plots.
pub fn plots(report: &ReplayReport) -> Vec<Plot<'static>> {
    let mut out = vec![since_entry(report)];
    out.extend(ahead(report));
    out.push(distribution(report, "Speed", "speed, m/s", |came| &came.compared.speed));
    out.push(distribution(report, "Distance to the nearest neighbour", "distance, m", |came| &came.compared.nearest));
    out.push(over_time(report, "People", "present", |_, at| at.people as f64));
    out.push(over_time(report, "Mean speed", "m/s", |_, at| at.speed));
    if !report.question.lines.is_empty() {
        let crossed = |figures: &Figures, at: &Instant| count(&figures.crossings[0], at.time) as f64;
        out.push(over_time(report, "N(t): people that have crossed the line", "", crossed));
    }
    out
}

fn since_entry(report: &ReplayReport) -> Plot<'static> {
    let cast = &report.setup.cast;
    let duration = |walk: &throng_record::pedestrian::Walk| walk.times[walk.times.len() - 1] - walk.times[0];
    let mut durations: Vec<f64> = cast.people.walks.iter().map(duration).collect();
    durations.sort_by(f64::total_cmp);
    let end = durations[((1.0 - FEW) * (durations.len() - 1) as f64) as usize];
    let times = (1..=SINCE).map(|k| end * f64::from(k) / f64::from(SINCE));
    let points = times.map(|time| {
        let samples = report.models.iter().map(|came| from_entry(cast, &came.replayed, Some(time))).collect();
        (time, samples)
    });
    displacement(report, "Displacement since entry", "since entry, s", points.collect())
}

fn ahead(report: &ReplayReport) -> Option<Plot<'static>> {
    let predicted = report.predicted.as_ref()?;
    let of = |k: usize| predicted.samples.iter().map(|all| all[k].clone()).collect();
    let mut points: Vec<(f64, Vec<Vec<PredictionSample>>)> =
        predicted.horizons.iter().enumerate().map(|(k, &seconds)| (seconds, of(k))).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Some(displacement(report, "Displacement ahead", "ahead, s", points))
}

/// Returns a plot of mean displacements after these times; the samples are by model.
fn displacement(
    report: &ReplayReport,
    title: &'static str,
    axis: &'static str,
    points: Vec<(f64, Vec<Vec<PredictionSample>>)>,
) -> Plot<'static> {
    let mut lines = vec![Line::new()];
    for predictor in report.predictors() {
        let mean = |samples| mean_and_median(predictor.samples(samples), |sample| predictor.last(sample))[0];
        let found = points.iter().map(|(time, samples)| (*time, mean(samples)));
        lines.push(std::iter::once((0.0, 0.0)).chain(found).collect());
    }
    let span = [0.0, points.last().map_or(1.0, |point| point.0)];
    // Constant velocity soon leads far beyond the differences between models.
    let models = lines[..=report.models.len()].iter().flatten().map(|point| point.1);
    let most = BEYOND * models.filter(|off| off.is_finite()).fold(LEAST, f64::max);
    lines.iter_mut().for_each(|line| line.retain(|point| point.1 <= most));
    let height = Height::FromZero([LEAST, f64::INFINITY]);
    Plot { title: title.into(), unit: "m, mean of people recorded that long", lines, height, mark: None, axis, span }
}

/// Returns a plot of cumulative distributions.
fn distribution(
    report: &ReplayReport,
    title: &'static str,
    axis: &'static str,
    pair: fn(&ModelResults) -> &Pair,
) -> Plot<'static> {
    let recorded = pair(&report.models[0]).recorded.clone();
    let all = std::iter::once(recorded).chain(report.models.iter().map(|came| pair(came).replayed.clone()));
    let all: Vec<Vec<f64>> = all
        .map(|mut values| {
            values.sort_by(f64::total_cmp);
            values
        })
        .collect();
    let most = |values: &Vec<f64>| values.get((MOST * values.len() as f64) as usize).copied().unwrap_or(0.0);
    let end = all.iter().map(most).fold(0.0, f64::max);
    let line = |values: &Vec<f64>| {
        let (count, thin) = (values.len(), values.len().div_ceil(POINTS).max(1));
        let share = |(k, &value): (usize, &f64)| (value, (k + 1) as f64 / count as f64);
        values.iter().enumerate().step_by(thin).map(share).collect()
    };
    let (lines, height) = (all.iter().map(line).collect(), Height::Between([0.0, 1.0]));
    let unit = "share of values up to this one";
    Plot { title: title.into(), unit, lines, height, mark: None, axis, span: [0.0, end] }
}

/// Returns a plot of a figure over all moments.
fn over_time(
    report: &ReplayReport,
    title: &'static str,
    unit: &'static str,
    figure: impl Fn(&Figures, &Instant) -> f64,
) -> Plot<'static> {
    let all = std::iter::once(&report.recorded).chain(report.models.iter().map(|came| &came.figures));
    let line = |figures: &Figures| -> Line {
        let thin = figures.instants.len().div_ceil(POINTS).max(1);
        figures.instants.iter().step_by(thin).map(|at| (at.time, figure(figures, at))).collect()
    };
    let height = Height::FromZero([1e-3, f64::INFINITY]);
    let (lines, span) = (all.map(line).collect(), report.setup.span());
    Plot { title: title.into(), unit, lines, height, mark: None, axis: TIME, span }
}

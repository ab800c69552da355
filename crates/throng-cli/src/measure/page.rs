//! The page: one self-contained file with the figures and their plots.

use super::json::BIN;
use super::people::People;
use super::{Measured, MeasuredSubject, people, text};
use std::f64::consts::{PI, TAU};
use throng_draw::page::{Height, Plot, TIME, document, escape, figure as sheet, fill, swatch};
use throng_draw::{Error, Figure};
use throng_record::swarm::{Distribution, Swarm, SwarmMoment};

const PAGE: &str = include_str!("page.html");
/// The maximum number of points of a line over time.
const POINTS: usize = 400;
/// Plots cut off densities below this value.
const RARE: f64 = 1e-4;
/// The range of plots to each side, in standard deviations.
const WIDE: f64 = 6.0;

/// The meanings of the lines in plots.
const KEY: [(usize, &str); 7] = [
    (0, "measured, or along x"),
    (1, "along y"),
    (2, "along z"),
    (3, "the closed form, or the total"),
    (BESIDE, "of the file beside, or along x"),
    (BESIDE + 1, "the same along y"),
    (BESIDE + 2, "the same along z"),
];
/// The first line of the file beside.
const BESIDE: usize = 4;

/// Returns the meanings of the lines in plots with or without a file beside.
fn key(beside: Option<&Measured>) -> &'static [(usize, &'static str)] {
    if beside.is_some() { &KEY } else { &KEY[..BESIDE] }
}

/// Returns one picture of the plots: those of people where there are any, else those of the first group.
///
/// # Errors
/// There are too many plots for a picture.
pub fn figure(subject: &MeasuredSubject) -> Result<Figure, Error> {
    match &subject.people {
        Some(people) => sheet(&subject.title, &people::KEY, &people.plots()),
        None => {
            let beside = subject.beside.as_ref();
            sheet(&subject.title, key(beside), &plots(&subject.groups[0].swarm, beside))
        }
    }
}

/// Returns the page of a measured scene or file.
pub fn text(subject: &MeasuredSubject) -> String {
    let name = &subject.title;
    let people = subject.people.as_ref().map_or_else(String::new, |people| people.section(name));
    let sections: String = subject.groups.iter().map(|group| section(name, group, subject.beside.as_ref())).collect();
    let parts = [
        ("title", escape(name)),
        ("people", people),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("groups", sections),
    ];
    let script = subject.people.as_ref().map_or_else(String::new, People::script);
    document(&format!("{}: measured", escape(name)), &fill(PAGE, &parts), &script)
}

fn section(scene: &str, group: &Measured, beside: Option<&Measured>) -> String {
    let Measured { name, swarm } = group;
    let mut figures = text::of(scene, group);
    if let Some(beside) = beside {
        figures += &text::of("beside", beside);
    }
    let figures = escape_lines(&figures);
    let plots: String = plots(swarm, beside).iter().map(Plot::svg).collect();
    let legend: String = key(beside).iter().map(|(k, name)| format!("<span>{}{name}</span>\n", swatch(*k))).collect();
    format!(
        "<section>\n<h2>{}</h2>\n<pre>{figures}</pre>\n<p class=\"legend\">\n{legend}</p>\n<div class=\"plots\">\n{plots}</div>\n</section>\n",
        escape(name)
    )
}

/// Escapes text for HTML, with its line breaks.
pub fn escape_lines(text: &str) -> String {
    text.lines().map(escape).collect::<Vec<_>>().join("\n")
}

/// Returns the plots of a swarm, with the distributions and the autocorrelation of another one beside.
fn plots(swarm: &Swarm, beside: Option<&Measured>) -> Vec<Plot<'static>> {
    let beside = beside.map(|beside| &beside.swarm);
    let time = |figures: &[fn(&SwarmMoment) -> f64]| -> Vec<Vec<(f64, f64)>> {
        let moments = swarm.moments();
        let thin = moments.len().div_ceil(POINTS).max(1);
        let line =
            |figure: &fn(&SwarmMoment) -> f64| moments.iter().step_by(thin).map(|at| (at.time, figure(at))).collect();
        figures.iter().map(line).collect()
    };
    let span = [0, swarm.moments().len().saturating_sub(1)].map(|k| swarm.moments().get(k).map_or(0.0, |at| at.time));
    let over_time = |title: &'static str, unit, lines, height| Plot {
        title: title.into(),
        unit,
        lines,
        height,
        mark: None,
        axis: TIME,
        span,
    };
    let correlation = swarm.correlation().points();
    let lowest = correlation.iter().map(|point| point.1).fold(0.0, f64::min);
    let longest = correlation.last().map_or(0.0, |point| point.0);
    let mut correlations = vec![correlation];
    if let Some(beside) = beside {
        correlations.resize(BESIDE, Vec::new());
        correlations.push(beside.correlation().points());
    }
    let any = f64::INFINITY;
    vec![
        density("Speed", "density, s/m", "speed, m/s", (swarm.speed(), beside.map(Swarm::speed)), maxwell),
        standardised(
            "Velocity along each axis",
            "density",
            "standard deviations from the mean",
            (swarm.velocity(), beside.map(Swarm::velocity)),
        ),
        standardised(
            "Acceleration along each axis",
            "density",
            "standard deviations from the mean",
            (swarm.acceleration(), beside.map(Swarm::acceleration)),
        ),
        density(
            "Distance to the nearest neighbour",
            "density, 1/m",
            "distance, m",
            (swarm.nearest(), beside.map(Swarm::nearest)),
            |_, _| f64::NAN,
        ),
        Plot {
            title: "Autocorrelation of velocities".into(),
            unit: "",
            lines: correlations,
            height: Height::Between([if lowest < 0.0 { -1.0 } else { 0.0 }, 1.0]),
            mark: Some(((-1.0f64).exp(), "1/e")),
            axis: "lag, s",
            span: [0.0, longest],
        },
        over_time(
            "Radius of gyration",
            "m, along each axis and total",
            time(&[|at| at.axes.x, |at| at.axes.y, |at| at.axes.z, SwarmMoment::size]),
            Height::FromZero([1e-3, any]),
        ),
        over_time("Polarisation", "", time(&[|at| at.polarisation]), Height::FromZero([1.0, 1.0])),
        over_time("Mean speed", "m/s", time(&[|at| at.speed]), Height::FromZero([1e-3, any])),
    ]
}

/// Returns a plot of a density beside that of a closed form.
fn density(
    title: &'static str,
    unit: &'static str,
    axis: &'static str,
    (all, beside): (&Distribution, Option<&Distribution>),
    form: impl Fn(&Distribution, f64) -> f64,
) -> Plot<'static> {
    let end = |all: &Distribution| (all.mean() + WIDE * all.deviation()).min(all.most());
    let end = [Some(all), beside].into_iter().flatten().map(end).filter(|end| end.is_finite()).fold(0.0, f64::max);
    let found = all.density(BIN);
    let closed = (0..=100).map(|k| f64::from(k) * 0.01 * end).map(|x| (x, form(all, x))).collect();
    let mut lines = vec![found, vec![], vec![], closed];
    lines.extend(beside.map(|beside| beside.density(BIN)));
    let height = Height::FromZero([1e-6, f64::INFINITY]);
    Plot { title: title.into(), unit, lines, height, mark: None, axis, span: [0.0, end] }
}

/// Returns the Maxwell-Boltzmann density of a speed for the same mean square.
fn maxwell(all: &Distribution, speed: f64) -> f64 {
    let one = all.rms() / 3f64.sqrt();
    let s = speed / one;
    (2.0 / PI).sqrt() * s * s * (-0.5 * s * s).exp() / one
}

/// Returns a plot of the standardised distributions along each axis beside the normal distribution.
fn standardised(
    title: &'static str,
    unit: &'static str,
    axis: &'static str,
    (all, beside): (&[Distribution; 3], Option<&[Distribution; 3]>),
) -> Plot<'static> {
    let line = |axis: &Distribution| if axis.deviation() > 0.0 { axis.standardised(BIN) } else { vec![] };
    let mut lines: Vec<Vec<(f64, f64)>> = all.iter().map(line).collect();
    let normal = |x: f64| (-0.5 * x * x).exp() / TAU.sqrt();
    lines.push((-120..=120).map(|k| f64::from(k) * 0.05).map(|x| (x, normal(x))).collect());
    lines.extend(beside.into_iter().flatten().map(line));
    Plot { title: title.into(), unit, lines, height: Height::Decades(RARE), mark: None, axis, span: [-WIDE, WIDE] }
}

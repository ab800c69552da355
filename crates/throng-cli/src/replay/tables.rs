//! The figures as tables with a row a model, for the terminal and for pages.

use super::report::{Came, Horizon, Predictor, Report, mean_and_median};
use crate::measure::short;
use throng_record::pedestrian::replay::{Pair, Sample};
use throng_record::pedestrian::{Figures, Microscopic, flow, steady_flow};

/// A table.
pub struct Grid {
    /// What is in it.
    pub title: String,
    /// The heads of its columns; that of the first is empty.
    pub head: Vec<String>,
    /// Its rows, each with its name first.
    pub rows: Vec<Vec<String>>,
}

impl Grid {
    fn new(title: impl Into<String>, head: &[&str]) -> Self {
        let head = std::iter::once("").chain(head.iter().copied()).map(str::to_owned).collect();
        Self { title: title.into(), head, rows: Vec::new() }
    }

    fn row(&mut self, name: &str, cells: impl IntoIterator<Item = String>) {
        self.rows.push(std::iter::once(name.to_owned()).chain(cells).collect());
    }
}

/// All tables.
pub fn tables(report: &Report) -> Vec<Grid> {
    let mut out = vec![walked(report), since_entry(report)];
    out.extend(ahead(report));
    out.push(distributions(report));
    out.push(motion(report));
    out.push(microscopic(report));
    out
}

/// How the replays went.
fn walked(report: &Report) -> Grid {
    let head = [
        "entered",
        "overlapping",
        "moved",
        "refused",
        "arrived",
        "later by, s",
        "on their way",
        "stranded",
        "overlaps",
        "separation",
        "guard, %",
    ];
    let mut grid = Grid::new("How the replays went", &head);
    for (name, came) in report.setup.models.iter().zip(&report.models) {
        let (all, summary) = (&came.replayed, &came.replayed.summary);
        let counts = [all.entered, all.overlapping, all.moved, all.refused, came.arrived()].map(|n| n.to_string());
        let rest = [
            short(report.delay(came)),
            came.walking().to_string(),
            all.stranded.to_string(),
            summary.overlaps.to_string(),
            short(summary.least_separation),
            short(100.0 * summary.guard_share),
        ];
        grid.row(name, counts.into_iter().chain(rest));
    }
    grid
}

fn since_entry(report: &Report) -> Grid {
    let columns = report.from_entry.iter().map(|Horizon { seconds, samples }| {
        let head = seconds.map_or_else(|| "at the end".to_owned(), |seconds| format!("{seconds} s"));
        (head, samples.iter().map(|samples| &samples[..]).collect())
    });
    displacements(report, "Displacement since they entered, m: average / final, means", columns.collect())
}

fn ahead(report: &Report) -> Option<Grid> {
    let predicted = report.predicted.as_ref()?;
    let horizons = report.setup.args.figures.horizons.iter().enumerate();
    let mut columns: Vec<(String, Vec<&[Sample]>)> = horizons
        .map(|(k, seconds)| (format!("{seconds} s"), predicted.samples.iter().map(|all| &all[k][..]).collect()))
        .collect();
    let split = report.longest().and_then(|(seconds, samples)| {
        let split: Option<Vec<[Vec<Sample>; 2]>> = samples.into_iter().map(|samples| report.split(samples)).collect();
        Some((seconds, split?))
    });
    if let Some((seconds, split)) = &split {
        for (who, name) in ["alone", "in groups"].into_iter().enumerate() {
            columns.push((format!("{seconds} s, {name}"), split.iter().map(|split| &split[who][..]).collect()));
        }
    }
    let (every, moments) = (predicted.every, predicted.moments);
    let title = format!("Displacement ahead, begun anew every {every} s ({moments} times), m: average / final, means");
    Some(displacements(report, &title, columns))
}

/// A table with a column for each of some samples, by model.
fn displacements(report: &Report, title: &str, columns: Vec<(String, Vec<&[Sample]>)>) -> Grid {
    let heads: Vec<&str> = columns.iter().map(|(head, _)| head.as_str()).collect();
    let mut grid = Grid::new(title, &heads);
    grid.row("people", columns.iter().map(|(_, samples)| samples[0].len().to_string()));
    for predictor in report.predictors() {
        let cell = |(_, samples): &(String, Vec<&[Sample]>)| both(predictor, samples);
        grid.row(predictor.name, columns.iter().map(cell));
    }
    grid
}

/// Average and final displacement, means.
fn both(predictor: Predictor, samples: &[&[Sample]]) -> String {
    let samples = predictor.samples(samples);
    let [average, _] = mean_and_median(samples, |sample| predictor.average(sample));
    let [last, _] = mean_and_median(samples, |sample| predictor.last(sample));
    format!("{} / {}", short(average), short(last))
}

/// How recorded and replayed are distributed.
fn distributions(report: &Report) -> Grid {
    let pairs: Vec<Vec<&Pair>> = report.models.iter().map(pairs).collect();
    let heads = ["speed, m/s", "KS distance", "nearest other, m", "KS distance", "cross the line, s", "KS distance"];
    let mut grid = Grid::new("Recorded and replayed: mean (median)", &heads[..2 * pairs[0].len()]);
    let cell = |pair: &Pair, of: usize| {
        let [mean, median] = [pair.means()[of], pair.medians()[of]].map(short);
        format!("{mean} ({median})")
    };
    grid.row("recorded", pairs[0].iter().flat_map(|pair| [cell(pair, 0), String::new()]));
    for (name, pairs) in report.setup.models.iter().zip(&pairs) {
        grid.row(name, pairs.iter().flat_map(|pair| [cell(pair, 1), short(pair.distance())]));
    }
    grid
}

/// What is compared of a model.
fn pairs(came: &Came) -> Vec<&Pair> {
    let compared = &came.compared;
    [&compared.speed, &compared.nearest].into_iter().chain(&compared.crossings).collect()
}

/// How people move and how near they come.
fn motion(report: &Report) -> Grid {
    let head = [
        "acceleration, m/s²",
        "turning, °/s",
        "path ratio",
        "collisions",
        "near misses",
        "least distance, m",
        "cross the line",
        "flow, 1/s",
        "steady flow, 1/s",
    ];
    let lines = report.question.lines.len();
    let mut grid = Grid::new("Motion", if lines > 0 { &head } else { &head[..6] });
    let cells = |figures: &Figures| {
        let (motion, contacts) = (&figures.motion, &figures.contacts);
        let mut cells = vec![
            short(motion.acceleration.mean()),
            short(motion.turning.mean()),
            short(figures.ways.ratio.mean()),
            contacts.collisions.to_string(),
            contacts.near_misses.to_string(),
            short(contacts.least),
        ];
        for crossings in &figures.crossings {
            cells.extend([crossings.len().to_string(), short(flow(crossings)), short(steady_flow(crossings))]);
        }
        cells
    };
    grid.row("recorded", cells(&report.recorded));
    for (name, came) in report.setup.models.iter().zip(&report.models) {
        grid.row(name, cells(&came.figures));
    }
    grid
}

/// How people move next to each other.
fn microscopic(report: &Report) -> Grid {
    let head = [
        "standing, %",
        "sd of own speed, m/s",
        "turning, °/s",
        "acceleration, m/s²",
        "99 % below",
        "head-on pairs",
        "least distance, m",
        "5 % below",
        "rms of g",
    ];
    let mut grid = Grid::new("Every 0.4 s: medians", &head);
    let cells = |own: &Microscopic| {
        let first = [100.0 * own.standing, own.speed_deviation, own.turning, own.acceleration[0], own.acceleration[1]];
        let off = own.interaction_off(&report.microscopic);
        let last = [own.head_on.to_string(), short(own.passing[0]), short(own.passing[1]), short(off)];
        first.map(short).into_iter().chain(last)
    };
    grid.row("recorded", cells(&report.microscopic));
    for (name, came) in report.setup.models.iter().zip(&report.models) {
        grid.row(name, cells(&came.microscopic));
    }
    grid
}

//! The figures as tables with one row per model, for the terminal and for pages.

use super::report::{Horizon, ModelResults, Predictor, ReplayReport, mean_and_median};
use crate::measure::short;
use throng_record::pedestrian::replay::{Pair, PredictionSample};
use throng_record::pedestrian::{Figures, Microscopic, flow, steady_flow};

/// A table.
pub struct Grid {
    /// The title.
    pub title: String,
    /// The headings of the columns; the first is empty.
    pub head: Vec<String>,
    /// The rows; the first cell is the row's name.
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

/// Returns all tables.
pub fn tables(report: &ReplayReport) -> Vec<Grid> {
    let mut out = vec![walked(report), since_entry(report)];
    out.extend(ahead(report));
    out.push(distributions(report));
    out.push(motion(report));
    out.push(microscopic(report));
    out
}

/// Returns the counts of the replays.
fn walked(report: &ReplayReport) -> Grid {
    let head = [
        "entered",
        "overlapping",
        "moved",
        "refused",
        "arrived",
        "later by, s",
        "walking",
        "stranded",
        "overlaps",
        "separation",
        "guard, %",
    ];
    let mut grid = Grid::new("Replays", &head);
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

fn since_entry(report: &ReplayReport) -> Grid {
    let columns = report.from_entry.iter().map(|Horizon { seconds, samples }| {
        let head = seconds.map_or_else(|| "at the end".to_owned(), |seconds| format!("{seconds} s"));
        (head, samples.iter().map(|samples| &samples[..]).collect())
    });
    displacements(report, "Displacement since entry, m: average / final, means", columns.collect())
}

fn ahead(report: &ReplayReport) -> Option<Grid> {
    let predicted = report.predicted.as_ref()?;
    let horizons = report.setup.args.figures.horizons.iter().enumerate();
    let mut columns: Vec<(String, Vec<&[PredictionSample]>)> = horizons
        .map(|(k, seconds)| (format!("{seconds} s"), predicted.samples.iter().map(|all| &all[k][..]).collect()))
        .collect();
    let split = report.longest().and_then(|(seconds, samples)| {
        let split: Option<Vec<[Vec<PredictionSample>; 2]>> =
            samples.into_iter().map(|samples| report.split(samples)).collect();
        Some((seconds, split?))
    });
    if let Some((seconds, split)) = &split {
        for (half, name) in ["alone", "in groups"].into_iter().enumerate() {
            columns.push((format!("{seconds} s, {name}"), split.iter().map(|split| &split[half][..]).collect()));
        }
    }
    let (every, moments) = (predicted.every, predicted.moments);
    let title = format!("Displacement ahead, restarted every {every} s ({moments} times), m: average / final, means");
    Some(displacements(report, &title, columns))
}

/// Returns a table with one column for each set of samples; each set is by model.
fn displacements(report: &ReplayReport, title: &str, columns: Vec<(String, Vec<&[PredictionSample]>)>) -> Grid {
    let heads: Vec<&str> = columns.iter().map(|(head, _)| head.as_str()).collect();
    let mut grid = Grid::new(title, &heads);
    grid.row("people", columns.iter().map(|(_, samples)| samples[0].len().to_string()));
    for predictor in report.predictors() {
        let cell = |(_, samples): &(String, Vec<&[PredictionSample]>)| both(predictor, samples);
        grid.row(predictor.name, columns.iter().map(cell));
    }
    grid
}

/// Returns the means of average and final displacement.
fn both(predictor: Predictor, samples: &[&[PredictionSample]]) -> String {
    let samples = predictor.samples(samples);
    let [average, _] = mean_and_median(samples, |sample| predictor.average(sample));
    let [last, _] = mean_and_median(samples, |sample| predictor.last(sample));
    format!("{} / {}", short(average), short(last))
}

/// Returns the distributions of recorded and replayed people.
fn distributions(report: &ReplayReport) -> Grid {
    let pairs: Vec<Vec<&Pair>> = report.models.iter().map(pairs).collect();
    let heads = ["speed, m/s", "KS distance", "nearest neighbour, m", "KS distance", "crossing time, s", "KS distance"];
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

/// Returns the compared distributions of a model.
fn pairs(came: &ModelResults) -> Vec<&Pair> {
    let compared = &came.compared;
    [&compared.speed, &compared.nearest].into_iter().chain(&compared.crossings).collect()
}

/// Returns how people move and how near they come to each other.
fn motion(report: &ReplayReport) -> Grid {
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

/// Returns the microscopic figures.
fn microscopic(report: &ReplayReport) -> Grid {
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

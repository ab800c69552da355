//! The figures for the terminal.

use super::report::{Report, mean_and_median};
use crate::columns::aligned;
use crate::measure::short;
use std::fmt::Write;
use throng_record::pedestrian::replay::{PREDICTORS, Pair, Sample};
use throng_record::pedestrian::{flow, steady_flow};

/// The figures of a replay.
pub fn of(report: &Report) -> String {
    let Report { args, stage, cast, replayed, .. } = report;
    let [from, until] = report.span();
    let count = cast.people.walks.len();
    let (name, model) = (args.data.display(), &args.stage.model);
    let mut out =
        format!("{name}: {count} people, {from:.2} to {until:.2} s, by {model}, step {} s\n", stage.settings.step);
    // writing to a string does not fail
    let (areas, walls) = (stage.walkable.len(), stage.obstacles.len());
    if areas + walls > 0 {
        let of = report.map.as_ref().map_or_else(|| "the recording".to_owned(), |path| path.display().to_string());
        let through = report.through;
        let _ = writeln!(
            out,
            "  map        {of}: {areas} areas, {walls} obstacles; {through} of the recorded walk through what is solid"
        );
    }
    if let Some(groups) = &report.groups {
        let _ = writeln!(out, "  groups     {}", groups.iter().filter(|group| group.len() > 1).count());
    }
    let once = match cast.seen_once {
        0 => String::new(),
        once => format!("; {once} were seen only once"),
    };
    let (entered, overlapping, moved, refused) =
        (replayed.entered, replayed.overlapping, replayed.moved, replayed.refused);
    let _ = writeln!(
        out,
        "  entered    {entered}: {overlapping} overlapped somebody, {moved} stood in something solid; {refused} found no room{once}"
    );
    let (arrived, goals, stranded) = (report.arrived(), replayed.goals_moved, replayed.stranded);
    let delay = short(report.delay());
    let late = entered.saturating_sub(arrived);
    let _ = writeln!(
        out,
        "  arrived    {arrived}, {delay} s after the recorded left (median); {late} on their way at the end, {stranded} cannot; {goals} goals are solid"
    );
    let summary = &replayed.summary;
    let (least, guard) = (short(summary.least_separation), short(100.0 * summary.guard_share));
    let overlaps = summary.overlaps;
    let _ = writeln!(
        out,
        "  motion     {overlaps} overlaps in sub-steps, separation {least}; the guard changed {guard} % of the moves"
    );
    out.push_str("\ndisplacement, m: mean (median)\n");
    out.push_str(&displacements(report));
    out.push_str("\nrecorded and replayed\n");
    out.push_str(&distributions(report));
    for file in args.output.iter().chain(&args.table) {
        let _ = writeln!(out, "wrote {}", file.display());
    }
    out
}

fn displacements(report: &Report) -> String {
    let mut lines = vec![[""].into_iter().chain(["people"]).chain(PREDICTORS).map(str::to_owned).collect::<Vec<_>>()];
    let mut row = |what: &str, samples: &[&Sample], figure: fn(&Sample) -> &[f64; 3]| {
        let cell = |k: usize| {
            let [mean, median] = mean_and_median(samples.iter().copied(), |sample| figure(sample)[k]).map(short);
            format!("{mean} ({median})")
        };
        lines.push([what.to_owned(), samples.len().to_string()].into_iter().chain((0..3).map(cell)).collect());
    };
    for horizon in &report.from_entry {
        let samples: Vec<&Sample> = horizon.samples.iter().collect();
        let at = horizon.seconds.map_or_else(|| "at the end".to_owned(), |seconds| format!("{seconds} s after entry"));
        row(&format!("{at}, average"), &samples, |sample| &sample.average);
        row(&format!("{at}, final"), &samples, |sample| &sample.last);
    }
    if let Some(predicted) = &report.predicted {
        for (seconds, samples) in report.args.figures.horizons.iter().zip(&predicted.samples) {
            let all: Vec<&Sample> = samples.iter().collect();
            row(&format!("{seconds} s ahead, average"), &all, |sample| &sample.average);
            row(&format!("{seconds} s ahead, final"), &all, |sample| &sample.last);
            if let Some(split) = report.split(samples) {
                for (who, samples) in ["alone", "in groups"].iter().zip(split) {
                    row(&format!("  {who}, final"), &samples, |sample| &sample.last);
                }
            }
        }
    }
    aligned(&lines)
}

fn distributions(report: &Report) -> String {
    let [recorded, replayed] = &report.figures;
    let heads = ["", "recorded", "replay", "KS distance"].map(str::to_owned).to_vec();
    let both = |what: &str, values: [f64; 2]| {
        let [a, b] = values.map(short);
        vec![what.to_owned(), a, b, String::new()]
    };
    let pair = |what: &str, pair: &Pair| {
        let ([a, b], [c, d]) = (pair.means().map(short), pair.medians().map(short));
        vec![what.to_owned(), format!("{a} ({c})"), format!("{b} ({d})"), short(pair.distance())]
    };
    let compared = &report.compared;
    let mut lines = vec![heads, pair("speed, m/s: mean (median)", &compared.speed)];
    lines.push(pair("nearest other, m: mean (median)", &compared.nearest));
    lines.push(both("acceleration, m/s²", [recorded, replayed].map(|all| all.motion.acceleration.mean())));
    lines.push(both("turning, °/s", [recorded, replayed].map(|all| all.motion.turning.mean())));
    lines.push(both("path ratio", [recorded, replayed].map(|all| all.ways.ratio.mean())));
    lines.push(both("collisions", [recorded, replayed].map(|all| all.contacts.collisions as f64)));
    lines.push(both("near misses", [recorded, replayed].map(|all| all.contacts.near_misses as f64)));
    lines.push(both("least distance, m", [recorded, replayed].map(|all| all.contacts.least)));
    if let Some(crossings) = &compared.crossings {
        lines.push(both("cross the line", [recorded, replayed].map(|all| all.crossings[0].len() as f64)));
        lines.push(pair("when, s: mean (median)", crossings));
        lines.push(both("flow, 1/s", [recorded, replayed].map(|all| flow(&all.crossings[0]))));
        lines.push(both("steady flow, 1/s", [recorded, replayed].map(|all| steady_flow(&all.crossings[0]))));
    }
    aligned(&lines)
}

//! The figures as JSON; `throng replay --help` describes the keys.

use super::report::{Report, mean_and_median};
use crate::measure::people_json;
use crate::report::number;
use serde_json::{Map, Value, json};
use std::time::Duration;
use throng_record::pedestrian::replay::{Pair, Sample};

/// The predictors, as keys.
const KEYS: [&str; 3] = ["replay", "constant_velocity", "straight"];

/// The figures as one object.
pub fn of(report: &Report, wall: Duration) -> Value {
    let Report { args, stage, cast, replayed, .. } = report;
    let [from, until] = report.span();
    let horizons = args.figures.horizons.iter().copied().map(Some);
    let predicted = report.predicted.as_ref().map(|predicted| {
        let all = horizons.zip(&predicted.samples);
        let longest = args.figures.horizons.iter().zip(&predicted.samples).max_by(|a, b| a.0.total_cmp(b.0));
        let split = longest.and_then(|(seconds, samples)| {
            Some(report.split(samples)?.map(|samples| displacement(Some(*seconds), &samples)))
        });
        let [alone, in_groups] = split.unwrap_or_default();
        json!({
            "every": predicted.every,
            "moments": predicted.moments,
            "horizons": all.map(|(seconds, samples)| displacement(seconds, &refs(samples))).collect::<Vec<_>>(),
            "alone": alone,
            "in_groups": in_groups,
        })
    });
    let from_entry = report.from_entry.iter().map(|horizon| displacement(horizon.seconds, &refs(&horizon.samples)));
    let [recorded, again] = &report.figures;
    let (arrived, summary) = (report.arrived(), &replayed.summary);
    json!({
        "data": args.data.to_string_lossy(),
        "model": args.stage.model,
        "step": stage.settings.step,
        "from": number(from),
        "until": number(until),
        "map": { "areas": stage.walkable.len(), "obstacles": stage.obstacles.len(), "through": report.through },
        "people": {
            "recorded": cast.people.walks.len(),
            "seen_once": cast.seen_once,
            "entered": replayed.entered,
            "overlapping": replayed.overlapping,
            "moved": replayed.moved,
            "refused": replayed.refused,
            "goals_moved": replayed.goals_moved,
            "arrived": arrived,
            "stranded": replayed.stranded,
            "walking": replayed.entered.saturating_sub(arrived),
            "delay": number(report.delay()),
        },
        "from_entry": from_entry.collect::<Vec<_>>(),
        "predicted": predicted,
        "speed": pair(&report.compared.speed),
        "nearest": pair(&report.compared.nearest),
        "crossings": report.compared.crossings.as_ref().map(pair),
        "recorded": people_json(&report.question, recorded),
        "replay": people_json(&report.question, again),
        "summary": {
            "least_separation": number(summary.least_separation),
            "overlaps": summary.overlaps,
            "guard_share": number(summary.guard_share),
        },
        "wall_seconds": wall.as_secs_f64(),
        "interrupted": report.interrupted,
        "files": args.output.iter().chain(&args.table).map(|path| path.to_string_lossy()).collect::<Vec<_>>(),
    })
}

fn refs(samples: &[Sample]) -> Vec<&Sample> {
    samples.iter().collect()
}

fn displacement(seconds: Option<f64>, samples: &[&Sample]) -> Value {
    let by_predictor = |figure: fn(&Sample) -> &[f64; 3]| {
        let one = |k: usize| mean_and_median(samples.iter().copied(), |sample| figure(sample)[k]);
        Map::from_iter(KEYS.iter().enumerate().map(|(k, key)| ((*key).to_owned(), both(one(k)))))
    };
    json!({
        "horizon": seconds,
        "people": samples.len(),
        "average": by_predictor(|sample| &sample.average),
        "final": by_predictor(|sample| &sample.last),
    })
}

fn pair(all: &Pair) -> Value {
    let [recorded, replay] = [0, 1].map(|k| both([all.means()[k], all.medians()[k]]));
    json!({ "recorded": recorded, "replay": replay, "distance": number(all.distance()) })
}

fn both([mean, median]: [f64; 2]) -> Value {
    json!({ "mean": number(mean), "median": number(median) })
}

//! The figures as JSON; `throng replay --help` describes the keys.

use super::outputs;
use super::report::{ModelResults, Pauses, ReplayReport, mean_and_median};
use crate::measure::people_json;
use crate::report::number;
use serde_json::{Map, Value, json};
use std::time::Duration;
use throng_record::pedestrian::Microscopic;
use throng_record::pedestrian::replay::{Pair, PredictionSample};

/// Returns the figures as one JSON object.
pub fn of(report: &ReplayReport, wall: Duration) -> Value {
    let setup = report.setup;
    let (args, cast, stage) = (setup.args, &setup.cast, &setup.stages[0]);
    let [from, until] = setup.span();
    let from_entry = report.from_entry.iter().map(|horizon| {
        let samples: Vec<&[PredictionSample]> = horizon.samples.iter().map(|samples| &samples[..]).collect();
        displacement(report, horizon.seconds, &samples)
    });
    let (compared, pauses) = (&report.models[0].compared, Pauses::of(cast));
    let recorded = |pair: &Pair| both([pair.means()[0], pair.medians()[0]]);
    let models = setup.models.iter().zip(&report.models).map(|(name, came)| model(report, name, came));
    let files = outputs::paths(setup);
    json!({
        "data": args.data.to_string_lossy(),
        "step": stage.settings.step,
        "from": number(from),
        "until": number(until),
        "map": { "areas": stage.walkable.len(), "obstacles": stage.obstacles.len(), "through": report.through },
        "recorded": {
            "entered": cast.people.walks.len(),
            "seen_once": cast.seen_once,
            "pauses": { "people": pauses.people, "count": pauses.count, "seconds": pauses.seconds },
            "speed": recorded(&compared.speed),
            "nearest": recorded(&compared.nearest),
            "crossings": compared.crossings.as_ref().map(recorded),
            "people": people_json(&report.question, &report.recorded),
            "microscopic": microscopic(&report.microscopic, report),
        },
        "models": models.collect::<Vec<_>>(),
        "from_entry": from_entry.collect::<Vec<_>>(),
        "predicted": predicted(report),
        "wall_seconds": wall.as_secs_f64(),
        "interrupted": report.interrupted,
        "files": files.iter().chain(&args.table).map(|path| path.to_string_lossy()).collect::<Vec<_>>(),
    })
}

/// Returns the figures of one model.
fn model(report: &ReplayReport, name: &str, came: &ModelResults) -> Value {
    let (all, summary) = (&came.replayed, &came.replayed.summary);
    let pair = |pair: &Pair| {
        let [mean, median] = [pair.means()[1], pair.medians()[1]].map(number);
        json!({ "mean": mean, "median": median, "distance": number(pair.distance()) })
    };
    json!({
        "model": name,
        "entered": all.entered,
        "overlapping": all.overlapping,
        "moved": all.moved,
        "refused": all.refused,
        "goals_moved": all.goals_moved,
        "arrived": came.arrived(),
        "stranded": all.stranded,
        "walking": came.walking(),
        "delay": number(report.delay(came)),
        "speed": pair(&came.compared.speed),
        "nearest": pair(&came.compared.nearest),
        "crossings": came.compared.crossings.as_ref().map(pair),
        "people": people_json(&report.question, &came.figures),
        "microscopic": microscopic(&came.microscopic, report),
        "summary": {
            "least_separation": number(summary.least_separation),
            "overlaps": summary.overlaps,
            "guard_share": number(summary.guard_share),
        },
    })
}

/// Returns the microscopic figures: how people move next to each other.
fn microscopic(own: &Microscopic, report: &ReplayReport) -> Value {
    let [[median, most], [passing, close]] = [own.acceleration, own.passing];
    json!({
        "standing": number(own.standing),
        "speed_deviation": number(own.speed_deviation),
        "turning": number(own.turning),
        "acceleration": { "median": number(median), "p99": number(most) },
        "head_on": { "pairs": own.head_on, "median": number(passing), "p5": number(close) },
        "g": own.interaction.iter().map(|&g| number(g)).collect::<Vec<_>>(),
        "g_rms": number(own.interaction_off(&report.microscopic)),
    })
}

fn predicted(report: &ReplayReport) -> Option<Value> {
    let predicted = report.predicted.as_ref()?;
    let horizons = report.setup.args.figures.horizons.iter().enumerate().map(|(k, &seconds)| {
        let samples: Vec<&[PredictionSample]> = predicted.samples.iter().map(|all| &all[k][..]).collect();
        displacement(report, Some(seconds), &samples)
    });
    let split = report.longest().and_then(|(seconds, samples)| {
        let split = samples.into_iter().map(|samples| report.split(samples)).collect::<Option<Vec<_>>>()?;
        let part = |half: usize| {
            let samples: Vec<&[PredictionSample]> = split.iter().map(|split| &split[half][..]).collect();
            displacement(report, Some(seconds), &samples)
        };
        Some([part(0), part(1)])
    });
    let [alone, in_groups] = split.unwrap_or_default();
    Some(json!({
        "every": predicted.every,
        "moments": predicted.moments,
        "horizons": horizons.collect::<Vec<_>>(),
        "alone": alone,
        "in_groups": in_groups,
    }))
}

/// Returns the displacements by predictor; the samples are by model.
fn displacement(report: &ReplayReport, seconds: Option<f64>, samples: &[&[PredictionSample]]) -> Value {
    let (mut average, mut last) = (Map::new(), Map::new());
    for predictor in report.predictors() {
        let own = predictor.samples(samples);
        average.insert(predictor.key(), both(mean_and_median(own, |sample| predictor.average(sample))));
        last.insert(predictor.key(), both(mean_and_median(own, |sample| predictor.last(sample))));
    }
    json!({ "horizon": seconds, "people": samples[0].len(), "average": average, "final": last })
}

fn both([mean, median]: [f64; 2]) -> Value {
    json!({ "mean": number(mean), "median": number(median) })
}

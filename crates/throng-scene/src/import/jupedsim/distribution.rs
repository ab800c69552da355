//! Distributions: the number of agents that start in an area, their bodies and speeds.

use super::super::notes::Notes;
use super::convert::corners_or_none;
use crate::geometry::{points, signed_area};
use crate::scene::{Normal, Number, Source};
use serde_json::Value;

/// The greatest share of the ground under bodies that random placement reaches.
const RANDOM_COVER: f64 = 0.5;

pub(super) struct Distribution {
    pub id: String,
    pub count: u64,
    pub radius: Number,
    pub speed: Number,
    pub source: Option<Source>,
    pub wait: Option<Number>,
}

impl Distribution {
    pub fn read(id: &str, value: &Value, notes: &mut Notes) -> Self {
        let parameters = &value["parameters"];
        let radius = number_of(parameters, "radius", 0.2, 0.05, id, notes);
        let speed = number_of(parameters, "v0", 1.3, 0.0, id, notes);
        let number = parameters["number"].as_u64();
        let mut count = number.unwrap_or(0);
        if parameters["distribution_mode"].as_str() == Some("by_percentage") {
            let share = parameters["percentage"].as_f64().unwrap_or(0.0).clamp(0.0, 100.0) / 100.0;
            let area = corners_or_none(value).map_or(0.0, |corners| signed_area(&points(&corners)).abs());
            let mean = (radius.bounds()[0] + radius.bounds()[1]) * 0.5;
            count = (share * RANDOM_COVER * area / (std::f64::consts::PI * mean * mean)).floor() as u64;
            notes.about(id, format!("filled to {} percent: taken as {count} people", share * 100.0));
        }
        let flowing = parameters["use_flow_spawning"].as_bool() == Some(true);
        let source = flowing.then(|| Source {
            start: parameters["flow_start_time"].as_f64().unwrap_or(0.0).max(0.0),
            end: Some(parameters["flow_end_time"].as_f64().unwrap_or(10.0)),
            count: Some(count),
            ..Source::default()
        });
        Self { id: id.to_owned(), count, radius, speed, source, wait: premovement(id, parameters, notes) }
    }
}

/// Returns the time that agents stand before they set off.
fn premovement(id: &str, parameters: &Value, notes: &mut Notes) -> Option<Number> {
    if parameters["use_premovement"].as_bool() != Some(true) {
        return None;
    }
    let kind = parameters["premovement_distribution"].as_str().unwrap_or_default();
    let (Some(a), Some(b)) = (parameters["premovement_param_a"].as_f64(), parameters["premovement_param_b"].as_f64())
    else {
        notes.about(id, "premovement times without parameters: left out");
        return None;
    };
    match kind {
        "uniform" => Some(Number::Uniform([a.min(b).max(0.0), a.max(b).max(0.0)])),
        "normal" | "gaussian" => Some(normal(a, b, 0.0)),
        "gamma" => {
            notes.about(id, "gamma premovement times: a normal distribution of the same mean and deviation");
            Some(normal(a * b, a.max(0.0).sqrt() * b, 0.0))
        }
        _ => {
            notes.about(id, format!("premovement times of the kind `{kind}`: left out"));
            None
        }
    }
}

/// Reads a value that may be a distribution: `key`, `key_distribution` and `key_std`. It is at least `least`.
pub(super) fn number_of(value: &Value, key: &str, standard: f64, least: f64, id: &str, notes: &mut Notes) -> Number {
    let mean = value[key].as_f64().unwrap_or(standard).max(least);
    let kind = value[format!("{key}_distribution")].as_str().unwrap_or("constant");
    match kind {
        "constant" => Number::Constant(mean),
        "gaussian" | "normal" => match value[format!("{key}_std")].as_f64() {
            Some(deviation) if deviation > 0.0 => normal(mean, deviation, least),
            Some(_) => Number::Constant(mean),
            None => {
                notes.about(id, format!("{kind} {key} without a deviation: all agents get {mean}"));
                Number::Constant(mean)
            }
        },
        "uniform" => {
            let bound = |name: &str| value[format!("{key}_{name}")].as_f64();
            match (bound("min"), bound("max")) {
                (Some(low), Some(high)) if low <= high => Number::Uniform([low.max(least), high.max(least)]),
                _ => {
                    notes.about(id, format!("uniform {key} without bounds: all agents get {mean}"));
                    Number::Constant(mean)
                }
            }
        }
        other => {
            notes.about(id, format!("{key} of the kind `{other}`: all agents get {mean}"));
            Number::Constant(mean)
        }
    }
}

/// Returns a normal distribution truncated at three deviations to each side, and at `least`.
fn normal(mean: f64, deviation: f64, least: f64) -> Number {
    let deviation = deviation.abs();
    let cut = (mean - 3.0 * deviation < least).then_some(least);
    Number::Normal(Normal { mean: mean.max(least), deviation, min: cut, max: None })
}

//! The figures as JSON; `throng measure --help` describes the keys.

use super::{Measured, MeasuredSubject, mean, people};
use crate::report::number;
use serde_json::{Value, json};
use std::path::PathBuf;
use throng_record::swarm::{Distribution, SwarmMoment};

/// The maximum number of points over time.
pub const POINTS: usize = 500;
/// The width of bins, in standard deviations.
pub const BIN: f64 = 0.25;

/// Returns the figures as one JSON object.
pub fn of(subject: &MeasuredSubject, files: &[PathBuf]) -> Value {
    json!({
        "scene": subject.name,
        "groups": subject.groups.iter().map(group).collect::<Vec<_>>(),
        "beside": subject.beside.as_ref().map(group),
        "people": subject.people.as_ref().map(people::json),
        "files": files,
    })
}

fn group(Measured { name, swarm }: &Measured) -> Value {
    let moments = swarm.moments();
    let time = |at: Option<&SwarmMoment>| at.map_or(Value::Null, |moment| number(moment.time));
    let each = |all: &[Distribution; 3]| all.iter().map(distribution).collect::<Vec<_>>();
    let thin = moments.len().div_ceil(POINTS).max(1);
    let over_time = moments.iter().step_by(thin).map(|moment| {
        let figures = [moment.time, moment.count as f64, moment.size(), moment.polarisation, moment.speed];
        figures.map(number)
    });
    let axes = [0, 1, 2].map(|axis| number(mean(swarm, |moment| moment.axes[axis])));
    json!({
        "name": name,
        "from": time(moments.first()),
        "to": time(moments.last()),
        "moments": moments.len(),
        "agents": number(mean(swarm, |moment| moment.count as f64)),
        "speed": distribution(swarm.speed()),
        "velocity": each(swarm.velocity()),
        "acceleration": each(swarm.acceleration()),
        "nearest": distribution(swarm.nearest()),
        "correlation": {
            "time": swarm.correlation().time().map_or(Value::Null, number),
            "points": pairs(&swarm.correlation().points()),
        },
        "size": number(mean(swarm, |moment| moment.size())),
        "axes": axes,
        "polarisation": number(mean(swarm, |moment| moment.polarisation)),
        "over_time": over_time.collect::<Vec<_>>(),
    })
}

/// Returns a distribution as JSON.
pub fn distribution(all: &Distribution) -> Value {
    json!({
        "count": all.count(),
        "mean": number(all.mean()),
        "sd": number(all.deviation()),
        "rms": number(all.rms()),
        "least": number(all.least()),
        "most": number(all.most()),
        "skewness": number(all.skewness()),
        "kurtosis": number(all.kurtosis()),
        "pdf": pairs(&all.density(BIN)),
    })
}

fn pairs(all: &[(f64, f64)]) -> Vec<[Value; 2]> {
    all.iter().map(|&(x, y)| [number(x), number(y)]).collect()
}

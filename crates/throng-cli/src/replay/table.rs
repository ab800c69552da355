//! A line a person.

use super::report::Report;
use std::fmt::Write;
use throng_record::pedestrian::Walk;
use throng_record::pedestrian::replay::Sample;

/// Everybody as comma-separated values; what is not known is empty.
pub fn csv(report: &Report) -> String {
    let Report { cast, replayed, .. } = report;
    let mut out = String::from("number,group,entered,left,arrived,way,preferred_speed");
    let name = |seconds: Option<f64>| seconds.map_or_else(|| "end".to_owned(), |seconds| seconds.to_string());
    for horizon in &report.from_entry {
        let at = name(horizon.seconds);
        // writing to a string does not fail
        let _ = write!(out, ",replay_{at},constant_velocity_{at},straight_{at}");
    }
    out.push('\n');
    for (index, (walk, walker)) in cast.people.walks.iter().zip(&cast.walkers).enumerate() {
        let Walk { number, times, places, .. } = walk;
        let way: f64 = places.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let group = report.group_of(*number).map(|group| group as f64);
        let fields = [
            group,
            times.first().copied(),
            times.last().copied(),
            replayed.arrived[index],
            Some(way),
            Some(walker.speed),
        ];
        let _ = write!(out, "{number}");
        let mut put = |value: Option<f64>| {
            out.push(',');
            if let Some(value) = value.filter(|value| value.is_finite()) {
                let _ = write!(out, "{}", (value * 1e6).round() / 1e6);
            }
        };
        fields.into_iter().for_each(&mut put);
        for horizon in &report.from_entry {
            let at = horizon.samples.binary_search_by_key(&index, |sample: &Sample| sample.walk);
            (0..3).for_each(|k| put(at.ok().map(|at| horizon.samples[at].last[k])));
        }
        out.push('\n');
    }
    out
}

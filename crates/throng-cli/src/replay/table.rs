//! A line a person.

use super::report::Report;
use throng_record::Table;
use throng_record::pedestrian::replay::Sample;

/// Everybody; what is not known is not a number.
pub fn table(report: &Report) -> Table {
    let Report { cast, replayed, .. } = report;
    let (walks, walkers) = (&cast.people.walks, &cast.walkers);
    let mut table = Table::default();
    let mut put = |name: &str, values: &dyn Fn(usize) -> Option<f64>| {
        let rounded = |index| values(index).map_or(f64::NAN, |value| (value * 1e6).round() / 1e6);
        table.push(name, (0..walks.len()).map(rounded).collect());
    };
    put("number", &|index| Some(walks[index].number.into()));
    put("group", &|index| report.group_of(walks[index].number).map(|group| group as f64));
    put("entered", &|index| walks[index].times.first().copied());
    put("left", &|index| walks[index].times.last().copied());
    put("arrived", &|index| replayed.arrived[index]);
    put("way", &|index| Some(walks[index].places.windows(2).map(|pair| pair[0].distance(pair[1])).sum()));
    put("preferred_speed", &|index| Some(walkers[index].speed));
    for horizon in &report.from_entry {
        let after = horizon.seconds.map_or_else(|| "end".to_owned(), |seconds| seconds.to_string());
        for (kind, name) in ["replay", "constant_velocity", "straight"].into_iter().enumerate() {
            put(&format!("{name}_{after}"), &|index| {
                let at = horizon.samples.binary_search_by_key(&index, |sample: &Sample| sample.walk).ok()?;
                Some(horizon.samples[at].last[kind])
            });
        }
    }
    table
}

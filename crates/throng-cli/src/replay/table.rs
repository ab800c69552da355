//! The table of people: one line per person.

use super::report::ReplayReport;
use throng_record::Table;
use throng_record::pedestrian::replay::PredictionSample;

/// Returns one row for each person; unknown values are NaN.
pub fn table(report: &ReplayReport) -> Table {
    let setup = report.setup;
    let (walks, walkers) = (&setup.cast.people.walks, &setup.cast.walkers);
    let mut table = Table::default();
    let mut put = |name: &str, values: &dyn Fn(usize) -> Option<f64>| {
        let rounded = |index| values(index).map_or(f64::NAN, |value| (value * 1e6).round() / 1e6);
        table.push(name, (0..walks.len()).map(rounded).collect());
    };
    put("number", &|index| Some(walks[index].number.into()));
    put("group", &|index| report.group_of(walks[index].number).map(|group| group as f64));
    put("entered", &|index| walks[index].times.first().copied());
    put("left", &|index| walks[index].times.last().copied());
    put("way", &|index| Some(walks[index].places.windows(2).map(|pair| pair[0].distance(pair[1])).sum()));
    put("preferred_speed", &|index| Some(walkers[index].speed));
    for (name, came) in setup.models.iter().zip(&report.models) {
        put(&format!("arrived_{name}"), &|index| came.replayed.arrived[index]);
    }
    for horizon in &report.from_entry {
        let after = horizon.seconds.map_or_else(|| "end".to_owned(), |seconds| seconds.to_string());
        for predictor in report.predictors() {
            let samples = predictor.samples(&horizon.samples);
            put(&format!("{}_{after}", predictor.key()), &|index| {
                let at = samples.binary_search_by_key(&index, |sample: &PredictionSample| sample.walk).ok()?;
                Some(predictor.last(&samples[at]))
            });
        }
    }
    table
}

//! Runs the replay of all models on one clock, and the predictions from regular starts.

use super::outputs::{Pages, ReplayOutputs};
use super::report::Predicted;
use super::setup::{ROUNDING, Setup};
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::Progress;
use crate::threads::Workers;
use std::sync::atomic::{AtomicUsize, Ordering};
use throng_record::pedestrian::replay::{Replay, Replayed, predict};

/// Replays the people by every model and writes the files, except the pages, which are not written yet.
///
/// # Errors
/// The world returns an error, or a file cannot be written.
pub fn walk(setup: &Setup) -> Result<(Vec<Replayed>, Option<Pages>), Failure> {
    let Setup { args, stages, cast, .. } = setup;
    let times = cast.times();
    let (start, end) = (times[0], times[times.len() - 1]);
    let mut outputs = ReplayOutputs::create(setup)?;
    let refused = |error| setup.refused(error);
    let replays = stages.iter().map(|stage| Replay::new(stage, cast, start, times.clone()));
    let mut replays = replays.collect::<Result<Vec<_>, _>>().map_err(refused)?;
    let progress = Progress::new(args.report.quiet);
    outputs.push(&replays)?;
    while replays[0].time() < end - ROUNDING && !interrupt::asked() {
        replays.iter_mut().try_for_each(Replay::step).map_err(refused)?;
        outputs.push(&replays)?;
        let first = &replays[0];
        progress.show((first.time() - start) / (end - start), || {
            format!("{:.1} s, {} of {} gone", first.time(), first.gone(), cast.people.walks.len())
        });
    }
    progress.done();
    let pages = outputs.finish(&replays)?;
    Ok((replays.into_iter().map(Replay::finish).collect(), pages))
}

/// Makes predictions by every model from regular starts, up to the requested horizons and those of a page.
///
/// # Errors
/// The world returns an error.
pub fn predictions(setup: &Setup, pages: Option<&Pages>) -> Result<Option<Predicted>, Failure> {
    let Setup { args, stages, cast, .. } = setup;
    let every = args.figures.every;
    if every == 0.0 || interrupt::asked() {
        return Ok(None);
    }
    let mut starts: Vec<f64> = Vec::new();
    for time in cast.times() {
        if starts.last().is_none_or(|last| time >= last + every - ROUNDING) {
            starts.push(time);
        }
    }
    let mut horizons = args.figures.horizons.clone();
    horizons.extend(pages.iter().flat_map(|_| args.figures.ahead()));
    let worlds = stages.iter().map(|stage| stage.world()).collect::<Result<Vec<_>, _>>();
    let worlds = worlds.map_err(|error| setup.refused(error))?;
    let tasks: Vec<(f64, usize)> =
        starts.iter().flat_map(|&start| (0..stages.len()).map(move |model| (start, model))).collect();
    let count = tasks.len();
    let workers = Workers::new(args.threads.count(), count)?;
    let (progress, done) = (Progress::new(args.report.quiet), AtomicUsize::new(0));
    let ahead = |(start, model): (f64, usize)| {
        if interrupt::asked() {
            return Ok(None);
        }
        let samples = predict(&stages[model], cast, worlds[model].clone(), start, &horizons)?;
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.show(done as f64 / count as f64, || format!("{done} of {count} predictions"));
        Ok(Some(samples))
    };
    let all: Result<Vec<_>, throng::Error> = workers.map(tasks, ahead).into_iter().collect();
    progress.done();
    let mut samples = vec![vec![Vec::new(); horizons.len()]; stages.len()];
    let mut moments = 0;
    let mut all = all.map_err(|error| setup.refused(error))?;
    // Models are compared only at starts that all of them completed.
    for all in all.chunks_mut(stages.len()).filter(|all| all.iter().all(Option::is_some)) {
        moments += 1;
        for (samples, ahead) in samples.iter_mut().zip(all) {
            let ahead = ahead.take().into_iter().flatten();
            samples.iter_mut().zip(ahead).for_each(|(samples, more)| samples.extend(more));
        }
    }
    Ok(Some(Predicted { every, moments, horizons, samples }))
}

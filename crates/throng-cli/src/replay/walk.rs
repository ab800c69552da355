//! Everybody walks, by all models on one clock; and what is ahead of them, from moment to moment.

use super::outputs::{Outputs, Pages};
use super::report::Predicted;
use super::setup::{ROUNDING, Setup};
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::Progress;
use crate::threads::Workers;
use std::sync::atomic::{AtomicUsize, Ordering};
use throng_record::pedestrian::replay::{Replay, Replayed, predict};

/// Lets everybody walk, by every model, and writes the files; the pages are not written yet.
///
/// # Errors
/// The world refuses something, or a file cannot be written.
pub fn walk(setup: &Setup) -> Result<(Vec<Replayed>, Option<Pages>), Failure> {
    let Setup { args, stages, cast, .. } = setup;
    let times = cast.times();
    let (start, end) = (times[0], times[times.len() - 1]);
    let mut outputs = Outputs::create(setup)?;
    let refused = |error| setup.refused(error);
    let replays = stages.iter().map(|stage| Replay::new(stage, cast, start, times.clone()));
    let mut replays = replays.collect::<Result<Vec<_>, _>>().map_err(refused)?;
    let progress = Progress::new(args.quiet);
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

/// Begins anew so often, and looks ahead by every model; as far as the horizons that are asked for, and as a page shows.
///
/// # Errors
/// The world refuses something.
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
    let (progress, done) = (Progress::new(args.quiet), AtomicUsize::new(0));
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
    // models are compared where all of them came that far
    for all in all.chunks_mut(stages.len()).filter(|all| all.iter().all(Option::is_some)) {
        moments += 1;
        for (samples, one) in samples.iter_mut().zip(all) {
            let one = one.take().into_iter().flatten();
            samples.iter_mut().zip(one).for_each(|(samples, more)| samples.extend(more));
        }
    }
    Ok(Some(Predicted { every, moments, horizons, samples }))
}

//! Makes one run.

use super::recorded::Recorded;
use super::{Row, SweepRun};
use crate::validate::AgentPaths;
use crate::{Cell, summary_cells};
use throng::{Summary, World};
use throng_scene::{Error, Expectations, Outcome, WalkingSpeed, caught};

/// Makes a run on the calling thread and returns its row. `goes_on` is called after every step; if it returns `false`,
/// the run ends without a result, and this function returns `None`. A run that cannot be made has a row with the reason
/// ([`Row::error`]). The row depends only on the run, to the bit.
pub fn run_one(run: &SweepRun, mut goes_on: impl FnMut() -> bool) -> Option<Row> {
    let results = match caught(|| simulate(run, &mut goes_on)) {
        Ok(Ok(results)) => results?,
        Ok(Err(error)) => failed(error.to_string()),
        Err(panic) => failed(format!("a plug-in panicked: {panic}")),
    };
    Some(Row::of(run, results))
}

fn failed(why: String) -> Vec<(String, Cell)> {
    vec![("error".to_owned(), Cell::Text(Some(why)))]
}

fn simulate(run: &SweepRun, goes_on: &mut dyn FnMut() -> bool) -> Result<Option<Vec<(String, Cell)>>, Error> {
    let scene = run.scene()?;
    let (mut world, built) = scene.build()?;
    let recorded = &run.plan.recorded;
    let every = (recorded.file.interval / scene.time.step).round().max(1.0) as u64;
    let mut walks = AgentPaths::default();
    let mut record = |world: &World| {
        if recorded.positions() && world.steps().is_multiple_of(every) && recorded.covers(world.time()) {
            walks.push(world);
        }
    };
    let mut expectations = Expectations::new(&scene.expect, &world, &built);
    let mut speed = WalkingSpeed::default();
    record(&world);
    while !scene.time.over(&world) {
        if !goes_on() {
            return Ok(None);
        }
        world.step();
        record(&world);
        expectations.step(&world);
        speed.step(&world);
    }
    let outcome = expectations.verdict(&world);
    let mut results = whole(&world.summary(), world.state_hash(), speed, &outcome);
    results.extend(recorded.cells(&walks.people(), &built.walkable));
    results.extend(world.figures().map(|(name, value)| (format!("figures.{name}"), Cell::Number(value))));
    Ok(Some(results))
}

/// Returns the results that every run has.
fn whole(summary: &Summary, state_hash: u64, speed: WalkingSpeed, outcome: &Outcome) -> Vec<(String, Cell)> {
    let failed: Vec<&str> =
        outcome.checks.iter().filter(|check| !check.passed).map(|check| check.name.as_str()).collect();
    let checked = !outcome.checks.is_empty();
    let first = [("error", Cell::Text(None)), ("state_hash", Cell::Text(Some(format!("{state_hash:016x}"))))];
    let last = [
        ("least_wall_separation", summary.least_wall_separation.into()),
        ("sub_steps", summary.sub_steps.into()),
        ("mean_speed", speed.mean().into()),
        ("passed", Cell::Truth(checked.then_some(outcome.passed))),
        ("failed", Cell::Text(checked.then(|| failed.join(", ")))),
    ];
    let all = first.into_iter().chain(summary_cells(summary)).chain(last);
    all.map(|(name, cell)| (name.to_owned(), cell)).collect()
}

/// Returns the names of all results that a plan's runs have, except those that rules count.
pub(super) fn result_names(recorded: &Recorded) -> Vec<String> {
    let results = whole(&Summary::default(), 0, WalkingSpeed::default(), &Outcome::default());
    let people = recorded.cells(&crate::pedestrian::People::default(), &[]);
    results.into_iter().chain(people).map(|(name, _)| name).collect()
}

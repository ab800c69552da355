//! Lists the runs of a plan.

use super::args::SweepArgs;
use super::make::SweepWork;
use crate::columns::aligned;
use crate::failure::Failure;
use crate::out::Out;
use crate::threads::Workers;
use serde_json::{Map, Value, json};
use throng_record::sweep::{Plan, RunFolder, SweepRun};

/// Writes the chosen runs, and which of them are finished.
///
/// # Errors
/// Standard output cannot be written.
pub fn list(args: &SweepArgs, plan: &Plan, chosen: &[usize], workers: &Workers, out: &mut Out) -> Result<(), Failure> {
    let folder = RunFolder::at(args.folder());
    let work = SweepWork { plan, folder: &folder, workers, quiet: args.report.quiet };
    let kept: Vec<bool> = work.kept(chosen).iter().map(Option::is_some).collect();
    let runs: Vec<SweepRun> = chosen.iter().filter_map(|&index| plan.run(index)).collect();
    if args.report.json {
        let entries = runs.iter().zip(&kept).map(|(run, kept)| {
            let parameters = run.parameters().into_iter().map(|parameter| (parameter.column, parameter.cell.json()));
            json!({
                "index": run.index,
                "scene": run.scene.name,
                "parameters": Map::from_iter(parameters),
                "seed": run.seed(),
                "kept": kept,
            })
        });
        let entries: Vec<Value> = entries.collect();
        let (plan_file, folder) = (args.plan.to_string_lossy(), folder.path().to_string_lossy());
        return out.line(format_args!(
            "{}",
            json!({ "plan": plan_file, "runs": plan.len(), "folder": folder, "list": entries })
        ));
    }
    let names = runs.first().map_or_else(Vec::new, SweepRun::parameters).into_iter().map(|parameter| parameter.column);
    let heads = ["run", "scene"].map(String::from).into_iter().chain(names).chain(["seed", ""].map(String::from));
    let mut lines: Vec<Vec<String>> = vec![heads.collect()];
    for (run, kept) in runs.iter().zip(&kept) {
        let first = [run.index.to_string(), run.scene.name.clone()];
        let values = run.parameters().into_iter().map(|parameter| parameter.cell.text());
        let last = [run.seed().to_string(), if *kept { "finished".into() } else { String::new() }];
        lines.push(first.into_iter().chain(values).chain(last).collect());
    }
    out.text(aligned(&lines).as_bytes())?;
    let finished = kept.iter().filter(|kept| **kept).count();
    let (all, count, folder) = (plan.len(), runs.len(), folder.path().display());
    out.line(format_args!("{count} of {all} runs, {finished} of them finished and kept in {folder}"))
}

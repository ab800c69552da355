//! `throng run`: runs a scene and writes its files and summary.

use crate::args::RunArgs;
use crate::failure::Failure;
use crate::files;
use crate::out::{Out, complain, note};
use crate::progress::{Progress, share};
use crate::report::Report;
use crate::source::Loaded;
use crate::swarms::Swarms;
use crate::{interrupt, threads};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use throng::World;
use throng_bench::clock::process_time;
use throng_draw::Style;
use throng_draw::record::Plan;
use throng_record::{Frame, moment};
use throng_scene::{Expect, Expectations};

/// Runs a scene, writes its files and its summary, and checks its `[expect]`.
///
/// # Errors
/// The scene cannot be built, a file cannot be written, the run was interrupted, or an expectation failed.
pub fn run(args: &RunArgs, out: &mut Out) -> Result<(), Failure> {
    let mut loaded = args.scene.load()?;
    args.end.apply(&mut loaded.scene);
    if args.no_expect {
        loaded.scene.expect = Expect::default();
    }
    if !args.report.quiet {
        note(&loaded.notes);
    }
    let report = threads::with(args.threads.count(), || simulate(args, &loaded))?;
    if args.report.json {
        out.line(format_args!("{}", report.json()))?;
    } else if !args.report.quiet {
        report.print(out)?;
    }
    out.flush()?;
    if report.interrupted && !args.report.quiet {
        complain(&format!("interrupted at {:.2} s; the files cover the time until then", report.summary.time));
    }
    match (report.interrupted, report.verdict.passed) {
        (true, _) => Err(Failure::Interrupted),
        (false, false) => {
            if args.report.quiet && !args.report.json {
                let failed = report.verdict.checks.iter().filter(|check| !check.passed);
                let failed: String = failed.map(|check| format!("\n  {check}")).collect();
                complain(&format!("{}: the scene did not meet its [expect]{failed}", report.scene));
            }
            Err(Failure::Expectation)
        }
        (false, true) => Ok(()),
    }
}

fn simulate(args: &RunArgs, loaded: &Loaded) -> Result<Report, Failure> {
    let begin = Instant::now();
    let Loaded { name, scene, .. } = loaded;
    let (mut world, built) = loaded.build(args.report.quiet)?;
    // Before this point there are no files to finish, and an interrupt ends the program at once.
    interrupt::watch();
    if !args.report.quiet {
        note(&built.notes);
    }
    let annotations = args.annotate.annotations(scene);
    let explained = annotations.explained();
    let setting = loaded.setting(&world, &built)?;
    let capture = |world: &World, frame: &mut Frame| {
        moment::capture(world, frame);
        moment::explain(world, &explained, frame);
        moment::capture_obstacles(world, scene, &setting, frame);
    };
    if !args.no_files {
        world.request_traces(annotations.asked());
    }
    let style = Style { annotations, ..args.film.style(scene, built.bounds)? };
    let choice = args.choice.choice();
    let plan = Plan {
        setting: &setting,
        sheet: None,
        style: &style,
        rate: args.film.rate(scene),
        speed_up: args.film.speed_up,
        still: args.film.still(),
        from: choice.from.max(0.0),
        choice: &choice,
        stop: interrupt::asked,
    };
    let paths = outputs(args, name);
    let mut files = files::create(&paths, &plan)?;

    let step = scene.time.step;
    let mut watch = Expectations::new(&scene.expect, &world, &built);
    let mut swarms = Swarms::of(scene, args.report.json || !args.report.quiet);
    let progress = Progress::new(args.report.quiet);
    let show = |world: &World| {
        if progress.is_due() {
            let counts = world.counts();
            let message = || format!("{:.1} s, {}/{} arrived", world.time(), counts.arrived, counts.agents);
            progress.show(share(world, scene.time.limit), message);
        }
    };
    let mut stepping = Duration::ZERO;
    // The first step plans the ways of all agents, which can take long.
    show(&world);
    swarms.push(&world, step);
    files.push(0.0, step, |frame| capture(&world, frame))?;
    while !scene.time.over(&world) && !interrupt::asked() {
        let start = Instant::now();
        world.step();
        stepping += start.elapsed();
        files.push(world.time(), step, |frame| capture(&world, frame))?;
        watch.step(&world);
        swarms.push(&world, step);
        show(&world);
    }
    progress.done();
    files.finish(world.time(), |frame| capture(&world, frame))?;
    Ok(Report {
        scene: name.clone(),
        verdict: watch.verdict(&world),
        summary: world.summary(),
        figures: world.figures().map(|(name, value)| (name.to_owned(), value)).collect(),
        refused: world.refused().map(ToString::to_string),
        stranded: world.stranded().iter().map(|(number, why)| (*number, why.to_string())).collect(),
        state_hash: world.state_hash(),
        swarms: swarms.finish(),
        wall: begin.elapsed(),
        stepping,
        cpu: process_time(),
        interrupted: interrupt::asked(),
        files: paths,
    })
}

fn outputs(args: &RunArgs, name: &str) -> Vec<PathBuf> {
    match (args.no_files, args.output.is_empty()) {
        (true, _) => Vec::new(),
        (false, true) => vec![PathBuf::from(format!("{name}.mp4"))],
        (false, false) => args.output.clone(),
    }
}

//! Measures the quality of every local model over scenes and time steps: prints the Markdown tables of docs/quality.md.
//! `cargo run --release -p throng-scene --example quality [-- [--models orca,rvo] NAME...]`: the scenes with these
//! names, as in the first column of the tables, or all.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use throng::Summary;
use throng_scene::{Error, Model, Scene, gallery};

const MODELS: &str = "orca,avo,hrvo,clearpath,rvo,vo,none,rvo-lab";
const STEPS: [f64; 3] = [1.0 / 60.0, 1.0 / 25.0, 0.1];
/// Maximum duration of a run, seconds.
const LIMIT: f64 = 200.0;

/// Name, scene of the gallery, and changes of the scene.
type Case = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

const CASES: [Case; 17] = [
    ("ring of 2", "ring", &[("count", "2"), ("place.ring.radius", "7")]),
    ("ring of 10", "ring", &[("count", "10"), ("place.ring.radius", "7")]),
    ("ring of 36", "ring", &[("count", "36"), ("place.ring.radius", "7")]),
    ("ring of 100", "ring", &[("count", "100"), ("place.ring.radius", "10.4")]),
    ("ring of 250", "ring", &[]),
    ("ring of 1000", "ring-1000", &[]),
    ("corridor, 0.5 per m²", "corridor", &[("count", "50")]),
    ("corridor, 1 per m²", "corridor", &[("count", "100")]),
    ("corridor, 2 per m²", "corridor", &[("count", "200")]),
    ("door of 0.6 m", "doorway-0.6", &[]),
    ("door of 0.8 m", "doorway-0.8", &[]),
    ("door of 1.0 m", "doorway", &[]),
    (
        "door of 2.0 m",
        "doorway",
        &[
            ("obstacle.wall-north.shape.rectangle", "{ center = [0.0, 3.0], size = [0.2, 4.0] }"),
            ("obstacle.wall-south.shape.rectangle", "{ center = [0.0, -3.0], size = [0.2, 4.0] }"),
        ],
    ),
    ("crossing at 90°", "crossing", &[]),
    ("overtaking", "overtaking", &[]),
    ("moving vehicle", "vehicle", &[]),
    ("gathering of 200", "gathering", &[("time.limit", "60")]),
];

/// The summary of a run, with its case, model and step.
struct Run {
    case: usize,
    step: usize,
    model: usize,
    summary: Summary,
}

fn run((_, name, changes): &Case, step: f64, model: &Model) -> Result<Summary, Error> {
    let mut scene: Scene = gallery::scene(name)?;
    for (path, value) in *changes {
        scene.set(path, value)?;
    }
    scene.time.step = step;
    scene.time.limit = scene.time.limit.min(LIMIT);
    let scene = scene.with_model(model)?;
    let (mut world, _) = scene.build()?;
    while !scene.time.over(&world) {
        world.step();
    }
    Ok(world.summary())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut names: Vec<String> = std::env::args().skip(1).collect();
    let given = names.iter().position(|name| name == "--models").map(|at| names.drain(at..at + 2).nth(1));
    let models = given.flatten().unwrap_or_else(|| MODELS.to_owned());
    let models = models.split(',').map(str::parse).collect::<Result<Vec<Model>, Error>>()?;
    let chosen = |case: &Case| names.is_empty() || names.iter().any(|name| case.0 == name);
    let cases: Vec<&Case> = CASES.iter().filter(|case| chosen(case)).collect();

    // the longest runs first, so that no thread waits for the last
    let jobs = (0..cases.len()).rev().flat_map(|case| (0..STEPS.len()).map(move |step| (case, step)));
    let jobs: Vec<(usize, usize, usize)> =
        jobs.flat_map(|(case, step)| (0..models.len()).map(move |model| (case, step, model))).collect();
    let (next, runs) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        while let Some(&(case, step, model)) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
            let made = run(cases[case], STEPS[step], &models[model]);
            let mut runs = runs.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            let (number, all) = (runs.len() + 1, jobs.len());
            if let Ok(s) = &made {
                let (name, step, model) = (cases[case].0, STEPS[step], models[model].label());
                eprintln!(
                    "{number} of {all}: {name}; {step:.3} s; {model}; {} of {}; {:.2} times, {:.0} s; {:.4}; {:.2} %; {:.1}; {:.0}",
                    s.arrived,
                    s.agents,
                    s.time_ratio,
                    s.time,
                    s.least_separation,
                    s.guard_share * 100.0,
                    s.heading_change_deg_per_s,
                    s.course_change_deg_per_s,
                );
            }
            runs.push(made.map(|summary| Run { case, step, model, summary }));
        }
    };
    std::thread::scope(|scope| {
        (0..std::thread::available_parallelism().map_or(1, usize::from)).for_each(|_| {
            scope.spawn(work);
        });
    });
    let runs = runs.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    let runs = runs.into_iter().collect::<Result<Vec<Run>, Error>>()?;

    let table = |title: &str, cell: fn(&Summary) -> String| {
        println!("\n## {title}\n");
        let heads: Vec<&str> = models.iter().map(Model::label).collect();
        println!("| scene | step s | {} |", heads.join(" | "));
        println!("|---|---|{}", "---|".repeat(heads.len()));
        for (case, (name, ..)) in cases.iter().enumerate() {
            for (step, seconds) in STEPS.iter().enumerate() {
                let of = |model| runs.iter().find(|run| (run.case, run.step, run.model) == (case, step, model));
                let cells = (0..models.len()).map(|model| of(model).map_or(String::new(), |run| cell(&run.summary)));
                println!("| {name} | {seconds:.3} | {} |", cells.collect::<Vec<_>>().join(" | "));
            }
        }
    };
    table("Arrivals and their duration", |s| match s.agents - s.arrived {
        0 => format!("{:.2} ({:.0} s)", s.time_ratio, s.time),
        missing => format!("**{missing} not**"),
    });
    table("Least separation", |s| format!("{:.4}", s.least_separation.min(9.9999)));
    table("Share of moves that the guard changes", |s| format!("{:.2} %", s.guard_share * 100.0));
    table("Turning of headings, degrees a second", |s| format!("{:.1}", s.heading_change_deg_per_s));
    table("Turning of courses, degrees a second", |s| format!("{:.0}", s.course_change_deg_per_s));
    Ok(())
}

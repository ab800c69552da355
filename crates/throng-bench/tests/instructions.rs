//! How many instructions an agent-step takes, counted by valgrind: a slowdown shows here without timing anything.
//!
//! `instructions.txt` holds the bounds: a work and how it runs, and the most instructions an agent-step may take. They are
//! what was counted, plus a twentieth. `CARGO_INCREMENTAL=0 UPDATE=1 cargo test -p throng-bench --test instructions` counts
//! anew and writes them: incremental builds, which CI does not make, take a tenth more. Do so when the step got faster, so
//! that the gain is kept, or when it got slower for a good reason: say which.
//!
//! Counted in the profile that the tests run in, on one thread, with the best instruction set that is found under valgrind: fewer lanes than without it.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::Command;
use throng::World;
use throng_bench::work;

const WARM_UP: u32 = 5;
const STEPS: u32 = 5;

/// What is counted: a work, how many people, and whether the guard is on.
const COUNTED: [(&str, usize, bool); 8] = [
    ("crossing", 2_000, false),
    ("crossing", 2_000, true),
    ("crossing-manners", 1_000, true),
    ("density-4", 500, true),
    ("at-rest", 1_000, true),
    ("rooms", 100, true),
    ("flock", 1_000, false),
    ("flock-dense", 500, false),
];

/// What valgrind counts, by this name.
#[inline(never)]
fn counted_steps(world: &mut World) {
    for _ in 0..STEPS {
        world.step();
    }
}

/// Not a test of its own: what runs under valgrind.
#[test]
#[ignore = "run by the other test, under valgrind"]
fn steps() {
    let variable = |name: &str| std::env::var(name).expect("set by the other test");
    let agents = variable("AGENTS").parse().unwrap();
    let mut world = work(&variable("WORK")).unwrap().world(agents, variable("GUARD") == "true").unwrap();
    for _ in 0..WARM_UP {
        world.step();
    }
    counted_steps(&mut world);
}

/// Instructions an agent-step.
fn counted(name: &str, agents: usize, guard: bool) -> f64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=*counted_steps*"])
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", "steps", "--ignored", "--test-threads=1"])
        .envs([("WORK", name), ("AGENTS", &agents.to_string()), ("GUARD", &guard.to_string())])
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    let line = told.lines().find_map(|line| line.split_once("Collected : ")).expect("valgrind tells");
    let all: f64 = line.1.trim().parse().unwrap();
    assert!(all > 0.0, "nothing was counted: {told}");
    all / (f64::from(STEPS) * agents as f64)
}

fn label(name: &str, guard: bool) -> String {
    format!("{name} guard-{}", if guard { "on" } else { "off" })
}

#[test]
fn an_agent_step_takes_no_more_instructions_than_it_did() {
    if !Command::new("valgrind").arg("--version").output().is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: there is no valgrind, which counts the instructions");
        return;
    }
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/instructions.txt");
    let counts = COUNTED.map(|(name, agents, guard)| (label(name, guard), counted(name, agents, guard)));
    if std::env::var_os("UPDATE").is_some() {
        let mut text = String::new();
        for (label, count) in &counts {
            writeln!(text, "{label} {:.0}", count * 1.05).unwrap();
        }
        std::fs::write(&path, text).unwrap();
        return;
    }
    let bounds = std::fs::read_to_string(&path).unwrap();
    for (label, count) in counts {
        let bound = bounds.lines().find_map(|line| line.strip_prefix(&label)).expect("a bound; UPDATE=1 writes it");
        let bound: f64 = bound.trim().parse().unwrap();
        eprintln!("{label}: {count:.0} of {bound} instructions an agent-step");
        assert!(count <= bound, "{label}: {count:.0} instructions an agent-step, more than the bound of {bound}");
    }
}

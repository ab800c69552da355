//! Tests the number of instructions per agent-step, counted by valgrind: this finds slowdowns without measuring time.
//!
//! `instructions.txt` holds the bounds: a work and how it runs, and the greatest number of instructions per agent-step.
//! The bounds are counted numbers plus a twentieth. `CARGO_INCREMENTAL=0 UPDATE=1 cargo test -p throng-bench --test
//! instructions` counts again and writes them: incremental builds, which CI does not make, need a tenth more. Update
//! the bounds when a step gets faster, to keep the gain, or when it gets slower for a good reason, and state the
//! reason.
//!
//! Instructions are counted in the profile of the tests, on one thread, with the best instruction set found under
//! valgrind: its SIMD vectors are narrower than those used without it.

use outside::Need;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::Command;
use throng::World;
use throng_bench::work;

#[path = "../../throng/tests/shared/outside.rs"]
#[allow(dead_code, reason = "this test needs no data")]
mod outside;

/// The environment variable that names the work of a run under valgrind.
const WORK: &str = "WORK";
const WARM_UP: u32 = 5;
const STEPS: u32 = 5;

/// The counted runs: a work, its number of agents, and whether the guard is on.
const COUNTED: [(&str, usize, bool); 14] = [
    ("crossing", 2_000, false),
    ("crossing", 2_000, true),
    ("crossing-rules", 1_000, true),
    ("mixed", 1_000, true),
    ("shared-goals", 1_000, true),
    ("density-4", 500, true),
    ("at-rest", 1_000, true),
    ("rooms", 100, true),
    ("flock", 1_000, false),
    ("flock-dense", 500, false),
    ("own-goals", 1_000, true),
    ("evacuation", 1_000, true),
    ("city", 2_000, true),
    ("flock-in-scene", 1_000, false),
];

fn main() {
    if let Ok(name) = std::env::var(WORK) {
        return steps(&name);
    }
    let name = "an_agent_step_takes_no_more_instructions_than_it_did";
    let test = an_agent_step_takes_no_more_instructions_than_it_did;
    let whole = Need::Build(option_env!("CARGO_INCREMENTAL") == Some("0"), "a build with CARGO_INCREMENTAL=0");
    outside::run(vec![outside::test(name, &[Need::Program("valgrind"), whole], test)]);
}

/// Valgrind counts the instructions of this function, by name.
#[inline(never)]
fn counted_steps(world: &mut World) {
    for _ in 0..STEPS {
        world.step();
    }
}

/// Runs a work. This program calls itself under valgrind, with a work in its environment.
fn steps(name: &str) {
    let variable = |name: &str| std::env::var(name).expect("set by the test");
    let agents = variable("AGENTS").parse().unwrap();
    let mut world = work(name).unwrap().world(agents, variable("GUARD") == "true").unwrap();
    for _ in 0..WARM_UP {
        world.step();
    }
    counted_steps(&mut world);
}

/// Returns the instructions per agent-step.
fn counted(name: &str, agents: usize, guard: bool) -> f64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=*counted_steps*"])
        .arg(std::env::current_exe().unwrap())
        .envs([(WORK, name), ("AGENTS", &agents.to_string()), ("GUARD", &guard.to_string())])
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .unwrap();
    let report = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{report}");
    let line = report.lines().find_map(|line| line.split_once("Collected : ")).expect("valgrind reports the count");
    let all: f64 = line.1.trim().parse().unwrap();
    assert!(all > 0.0, "nothing was counted: {report}");
    all / (f64::from(STEPS) * agents as f64)
}

fn label(name: &str, guard: bool) -> String {
    format!("{name} guard-{}", if guard { "on" } else { "off" })
}

fn an_agent_step_takes_no_more_instructions_than_it_did() {
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

//! One hour of simulated time in the studio: memory stays constant.
//!
//! `cargo test --release -p throng-studio --test soak -- --ignored --nocapture`
//!
//! This binary is separate: it counts the memory of the whole process.
#![allow(clippy::print_stdout)]

use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};
use std::alloc::System;
use std::sync::Arc;
use std::time::Duration;
use throng_scene::gallery;
use throng_studio::play::{Command, Engine, Speed};

#[global_allocator]
static MEMORY: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// The simulated time, seconds.
const HOUR: f64 = 3600.0;

/// Returns the bytes allocated now.
fn in_use() -> usize {
    let stats = MEMORY.stats();
    stats.bytes_allocated.wrapping_sub(stats.bytes_deallocated)
}

/// Plays scenes as fast as possible, repeatedly from their starts, with an explained agent. Saved states have their own
/// memory limit and are not counted.
#[test]
#[ignore = "an hour of simulated time takes minutes"]
fn an_hour_of_playing_takes_no_more_memory_than_half_of_it() {
    for name in ["boids", "pedestrians", "capture-the-flag", "swarm-migration", "field-jam", "office"] {
        let mut engine = Engine::default();
        engine.command(Command::Load { name: name.into(), scene: Arc::new(gallery::scene(name).unwrap()), run: true });
        engine.command(Command::Speed(Speed::Fastest));
        engine.command(Command::Explain(Some(0)));
        let (mut before, mut last, mut most, mut kept, mut runs) = (0.0, 0.0, [0, 0], 0, 1);
        while before + last < HOUR {
            engine.work(Duration::from_millis(50));
            let shown = engine.shown().unwrap();
            last = shown.frame.time;
            let half = usize::from(before + last >= 0.5 * HOUR);
            most[half] = most[half].max(in_use() - shown.kept);
            kept = kept.max(shown.kept);
            if shown.over {
                before += last;
                last = 0.0;
                runs += 1;
                engine.command(Command::Run);
            }
        }
        let [first, second] = most.map(|bytes| bytes as f64 / 1024.0);
        println!(
            "{name}: {runs} runs, {first:.0} kB in the first half, {second:.0} kB in the second, {} kB kept",
            kept / 1024
        );
        assert!(second <= 1.02 * first, "{name}: {first:.0} kB, then {second:.0} kB");
        assert!(kept <= 257 << 20, "{name}: {kept}");
    }
}

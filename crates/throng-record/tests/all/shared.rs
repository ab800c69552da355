//! Helpers that the tests share.

use std::path::PathBuf;
use throng::{Agent, Group, Settings};
use throng_record::pedestrian::median;
use throng_record::pedestrian::replay::{RecordedPeople, Replay, ReplayScene, Replayed};

/// The step of replays, seconds.
pub const STEP: f64 = 0.04;

/// Returns a scene of open ground.
pub fn stage() -> ReplayScene {
    ReplayScene {
        settings: Settings { step: STEP, ..Settings::default() },
        group: Group { look_ahead: false, keep_right: 0.0, ..Group::default() },
        agent: Agent::default(),
        walkable: Vec::new(),
        obstacles: Vec::new(),
        near: 0.05,
        stay: false,
    }
}

/// Returns a replay from the first to the last recorded time.
pub fn replayed(stage: &ReplayScene, cast: &RecordedPeople) -> Replayed {
    let times = cast.times();
    let end = times[times.len() - 1];
    let mut replay = Replay::new(stage, cast, times[0], times).unwrap();
    while replay.time() < end - 1e-9 {
        replay.step().unwrap();
    }
    replay.finish()
}

/// Returns a pseudorandom number generator.
pub fn draws() -> impl FnMut() -> usize {
    let mut state = 11u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize
    }
}

/// Asserts that a number is `want`, with a relative error of at most `within`.
#[track_caller]
pub fn near(found: f64, want: f64, within: f64) {
    assert!((found / want - 1.0).abs() <= within, "{found}, not {want}");
}

/// Returns the first two numbers of each line, from all files of a folder of published measurements
/// (`tests/data/fundamental_diagram`) with names that begin with `begins`.
pub fn points(folder: &str, begins: &str) -> Vec<[f64; 2]> {
    let folder: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests/data/fundamental_diagram", folder].iter().collect();
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    files.retain(|path| path.file_name().unwrap().to_string_lossy().starts_with(begins));
    files.sort();
    let text: String = files.iter().map(|path| std::fs::read_to_string(path).unwrap() + "\n").collect();
    let pair = |line: &str| {
        let mut numbers = line.split_whitespace().map_while(|word| word.parse().ok());
        Some([numbers.next()?, numbers.next()?])
    };
    text.lines().filter_map(pair).collect()
}

/// Returns the median speed of the points with a density within 0.25 of `density`.
pub fn speed_at(points: &[[f64; 2]], density: f64) -> f64 {
    median(points.iter().filter(|[at, _]| (at - density).abs() < 0.25).map(|[_, speed]| *speed).collect())
}

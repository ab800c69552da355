//! Helpers of tests that open and run scenes of files.

use std::path::{Path, PathBuf};
use throng_scene::Scene;

/// Returns the paths in a folder, sorted.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// Runs a scene. Returns whether all agents arrived. No two agents may overlap.
pub fn run(what: &str, scene: &Scene) -> bool {
    let (mut world, _) = scene.build().unwrap_or_else(|error| panic!("{what}: {error}"));
    while !scene.time.over(&world) {
        world.step();
    }
    let summary = world.summary();
    assert!(summary.least_separation.min(summary.least_wall_separation) >= 0.9999, "{what}: {summary:?}");
    assert_eq!(world.stranded(), [], "{what}");
    summary.arrived == summary.agents
}
